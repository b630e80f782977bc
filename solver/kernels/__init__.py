"""All jitted functions, one family per file: numba caches by file. Read `one_axis` first."""
