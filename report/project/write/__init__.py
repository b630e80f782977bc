"""The blank or filled workbook: sheets, formulas, formats and marks."""
