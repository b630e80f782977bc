"""Generated suites of motions: targets, files, tables. Read `files`."""
