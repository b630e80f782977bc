"""Run by Windows' Python: an output, and then the workbook, are open as Excel has them open.

held.py FOLDER, which has input.xlsx. Prints a line for each thing that is tried.
"""

import ctypes
import os
import stat
import sys
import threading
from contextlib import contextmanager
from pathlib import Path

from report.project.read.read import read
from report.project.write.filled import changing
from report.results.publish import publish
from report.typeset.letters import undrawable
from solver.errors import InputError

KERNEL = ctypes.windll.kernel32
KERNEL.CreateFileW.restype = ctypes.c_void_p
KERNEL.CreateFileW.argtypes = [
    ctypes.c_wchar_p, ctypes.c_uint, ctypes.c_uint, ctypes.c_void_p, ctypes.c_uint, ctypes.c_uint,
    ctypes.c_void_p,
]  # fmt: skip
KERNEL.CloseHandle.argtypes = [ctypes.c_void_p]


def opened(path):
    """Open a file for reading and writing, which others may only read."""
    return KERNEL.CreateFileW(str(path), 0xC0000000, 1, None, 3, 0, None)


@contextmanager
def held(path):
    handle = opened(path)
    yield
    KERNEL.CloseHandle(handle)


def attempt(what, do):
    try:
        done = do()
    except InputError as error:
        done = str(error)
    print(f"{what}: {done}", flush=True)


def written(text):
    publish(dict.fromkeys(("calc-package.pdf", "results.xlsx"), text), OUT)
    return state()


def state():
    return " ".join(
        f"{path.name}={path.read_bytes()[:3].decode()}" for path in sorted(OUT.glob("*"))
    )


def change():
    with changing(BOOK) as change:
        change.files["a.csv"] = b"1"
    return "changed"


sys.stdout.reconfigure(encoding="utf-8")
FOLDER = Path(sys.argv[1])
BOOK, OUT = FOLDER / "input.xlsx", FOLDER / "out"
TABLES = OUT / "results.xlsx"
attempt("new", lambda: written(b"one"))
with held(TABLES):
    attempt("held", lambda: written(b"two"))
    print("after held:", state())
threading.Timer(0.3, KERNEL.CloseHandle, [opened(TABLES)]).start()
attempt("held for a moment", lambda: written(b"two"))
os.chmod(TABLES, stat.S_IREAD)
attempt("read-only", lambda: written(b"six"))
print("after read-only:", state())
with held(BOOK):
    attempt("read", lambda: f"{len(read(BOOK).echo) > 0}")
    attempt("change", change)
    (FOLDER / "~$input.xlsx").touch()
    attempt("change in Excel", change)
attempt("letters", lambda: undrawable("\u10d0\u5009"))
