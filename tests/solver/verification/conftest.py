"""With numba's compiler off nothing here is collected: whole records would take minutes."""

import numba

collect_ignore_glob = ["test_*.py"] if numba.config.DISABLE_JIT else []
