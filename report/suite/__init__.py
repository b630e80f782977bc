"""Made suites of motions: targets, files, tables. Read `files`."""
