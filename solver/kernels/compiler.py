"""Settings of numba for the kernels: the cache on disk, and undocumented options.

Knows no kernel; each is declared with `cache=KEPT`. Where nothing can be kept, every process
compiles for itself, half a minute for a report, and nothing else is different.
"""

from __future__ import annotations

import os
import pickle
import pickletools
import warnings
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

from numba import config, njit

# Numba reads this file of the current folder, again at each compilation: it could name a folder of
# compiled code, which would run. What it said is undone; the environment alone has settings.
config._config_fname = os.devnull
config.reload_config()

NOT_KEPT = (
    "the compiled solver cannot be kept on disk ({reason}), so every run compiles it again; set "
    "the environment variable NUMBA_CACHE_DIR to a folder that can be written"
)

# Bytes that must be free: the kernels of a report take 3 MB.
ROOM = 8_000_000

# Versions of numba that are known to have the options.
TRIED = ("0.68.1",)

# For functions that borrow their arrays: counts no references to them, which takes a lock.
# `roofslip report projects/example` takes 1.05 times as long without it: medians of five pairs.
UNCOUNTED = {"_nrt": False} if version("numba") in TRIED else {}

# For functions that kernels alone call: no entry from Python, where a call would crash.
# Two axes compile in 0.85 of the time: the entries are compiled again with each caller.
INNER = UNCOUNTED | (
    {"no_cpython_wrapper": True, "no_cfunc_wrapper": True} if version("numba") in TRIED else {}
)


def _is_damaged(path: Path) -> bool:
    """Whether compiled code is empty or cut, as a stopped process or a full disk may leave it."""
    with path.open("rb") as file:
        try:
            if path.suffix == ".nbc":  # large, and without its end where it is cut
                file.seek(-1, os.SEEK_END)
                return file.read() != pickle.STOP
            for _ in range(2):  # the version of numba, and what was compiled
                list(pickletools.genops(file))
        except (OSError, ValueError):
            return True
    return False


def _nothing() -> None:
    pass


def _is_kept() -> bool:
    """Whether numba finds a folder for compiled code, and that has room; warn if not."""
    if config.DISABLE_JIT:
        return False
    try:
        folder = njit(cache=True)(_nothing).stats.cache_path
        assert folder is not None  # it raises without one
        for path in filter(_is_damaged, Path(folder).glob("*.nb[ci]")):
            path.unlink()
        with TemporaryFile(dir=folder) as file:
            if hasattr(os, "posix_fallocate"):  # of POSIX alone
                os.posix_fallocate(file.fileno(), 0, ROOM)
    except RuntimeError:
        reason = "no folder for it can be written"
    except OSError as error:
        reason = error.strerror or str(error)
    else:
        return True
    warnings.warn(NOT_KEPT.format(reason=reason), stacklevel=1)
    return False


def is_compiled(kernel: Any) -> bool:
    """Whether compiled code of a kernel is kept, so that its first call does not compile it."""
    folder = kernel.stats.cache_path if KEPT else None
    return folder is not None and any(Path(folder).glob(f"*.{kernel.__name__}-*.nbi"))


# Whether kernels are kept on disk.
KEPT = _is_kept()

# Cores that many runs are distributed over; the environment variable of that name limits them.
THREADS: int = vars(config)["NUMBA_NUM_THREADS"]
