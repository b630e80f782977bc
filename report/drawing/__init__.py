"""The roof plan as a drawing for CAD. Read `report.drawing.plan_dxf`."""
