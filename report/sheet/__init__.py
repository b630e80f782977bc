"""The input workbook: its fields (schema), how they are checked, read and written."""
