"""Studies: many runs from one workbook, as Parquet parts, curves, fragilities and a report.

Read `report.study.outputs.make_study`: from the plan to the published files. `solver.studies` runs
and computes; this package reads, stores and shows.
"""
