"""A roof plan read from a drawing into the workbook. Read `report.drawing_read.fill`."""
