"""From the rows of a workbook to roof motions. Read `prepare`."""
