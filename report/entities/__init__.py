"""The schema of results: one model for each entity, whose fields say how they are shown.

A field says once its heading, quantity, digits, alignment, where its value is found in the
assessment, its columns in results.xlsx with their formulas, and how `--since` tells its change.
results.json is a dump of these models; pages and the terminal name the fields that they print.
Computes nothing. Read `report.entities.shown`, then `clearance`.
"""
