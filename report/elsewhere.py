"""Libraries and workers take nothing from the current folder, which may be a stranger's.

For commands and their workers: a Python session trusts its folder, from which Python imports. What
numba reads is in `report.cli.main` and `solver.kernels.compiler`. Read `stay_apart`.
"""

import sys
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from importlib.machinery import ModuleSpec, PathFinder
from threading import RLock

_READ_IT = ("ezdxf", "matplotlib")
"""Libraries that read settings from the current folder as they are loaded."""
_ONE_AT_A_TIME = RLock()


@contextmanager
def apart() -> Iterator[None]:
    """Do something in the folder of the installation; a relative path means another file there."""
    with _ONE_AT_A_TIME, chdir(sys.prefix):
        yield


def stay_apart() -> None:
    """Have libraries loaded apart from the current folder, from now on."""
    if _Apart not in sys.meta_path:
        sys.meta_path.insert(0, _Apart)


class _Apart:
    @staticmethod
    def find_spec(name: str, _: object, __: object = None) -> ModuleSpec | None:
        spec = PathFinder.find_spec(name) if name in _READ_IT else None
        if spec and spec.loader:  # one of this library alone
            spec.loader.exec_module = apart()(spec.loader.exec_module)  # type: ignore[method-assign]
        return spec
