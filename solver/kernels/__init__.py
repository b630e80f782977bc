"""All jitted functions, one family per file: numba caches by file. Read `one_axis` first."""

from solver.kernels import cache  # noqa: F401  # before any kernel is loaded
