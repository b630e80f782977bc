"""Imports a roof plan from a drawing into the workbook. Read `report.drawing_read.fill`."""
