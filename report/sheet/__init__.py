"""The input workbook: its fields, its template, how it is read and checked."""
