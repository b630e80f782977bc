"""The packages that only a study needs, imported where they are used. Read `optional_package`."""

from __future__ import annotations

import importlib
import sys
from typing import Any

from solver.errors import InputError

ARROW = "pyarrow.parquet"
DASK = "distributed"
# By every study; the modules that import them need not be loaded to say so.
NEEDED = ("scipy", ARROW)


def optional_package(name: str) -> Any:
    """Return a package, by the name of the module of it that is needed.

    Raises `InputError` if it is not installed, with what to type.
    """
    package = name.partition(".")[0]
    try:
        importlib.import_module(name)
    except ImportError as error:
        raise InputError(
            f"a study needs the package {package}, which is not installed; type: "
            "./roofslip study (the launcher installs the extra), or: "
            "pip install '.[study]' in its folder"
        ) from error
    return sys.modules[package]
