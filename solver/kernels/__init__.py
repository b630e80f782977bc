"""Every jitted function, a family to a file: numba caches by file. Read `one_axis` first."""
