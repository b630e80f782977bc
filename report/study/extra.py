"""The packages that only a study needs, imported where they are used. Read `arrow`."""

from __future__ import annotations

import importlib
from typing import Any

from solver.model import InputError


def arrow() -> Any:
    """Return pyarrow with its module `parquet`.

    Raises
    ------
    InputError
        If it is not installed, with what to type.
    """
    module = _imported("pyarrow")
    _imported("pyarrow.parquet")
    return module


def dask() -> Any:
    """Return `distributed`.

    Raises
    ------
    InputError
        If it is not installed, with what to type.
    """
    return _imported("distributed")


def _imported(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        raise InputError(
            f"a study needs the package {package}, which is not installed; type: "
            "./roofslip study --help (the launcher installs the extra), or: "
            "pip install 'roofslip[study]'"
        ) from error
