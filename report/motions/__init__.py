"""From the rows of a workbook to motions at the roof. Read `prepare`."""
