"""Results as labeled arrays for notebooks, where xarray is installed.

Computes nothing. Read `dataset`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray as xr


def dataset(axes: Mapping[str, Any], values: Mapping[str, NDArray[Any]]) -> xr.Dataset:
    """Return arrays, each over all axes in their order, as a dataset.

    Raises
    ------
    ImportError
        Where xarray is not installed.
    """
    try:
        import xarray as xr
    except ImportError as error:
        raise ImportError("to_xarray needs xarray; run: pip install xarray") from error
    return xr.Dataset({name: (tuple(axes), array) for name, array in values.items()}, dict(axes))
