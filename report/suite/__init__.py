"""Generated suites of motions: targets, files, tables. Read `suite_files`."""
