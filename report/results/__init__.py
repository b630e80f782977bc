"""Results as tables: results.json and results.xlsx. Read `results_json`."""
