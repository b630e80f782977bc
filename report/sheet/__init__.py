"""The input sheet: what is asked, how the workbook is made, how it is read and checked."""
