"""From a filled workbook to a calculation package. Read `report.cli` first."""
