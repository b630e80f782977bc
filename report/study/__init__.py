"""Studies: many runs from one workbook, as Parquet parts, curves, fragilities and a report.

Read `report.cli.study` for the way from the workbook to the published files. `solver.studies` runs
and computes; this package reads, stores and shows.
"""
