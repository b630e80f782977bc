"""Roofslip in a notebook or a script: what `import solver` offers, and `assess_project`.

Loads `solver` and `report` from its own folder: a file solver.py beside a notebook would hide ours.
"""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from report import *  # noqa: F403
    from solver.public import *  # noqa: F403

_FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(_FOLDER))
try:
    import report
    import solver
finally:
    sys.path.remove(str(_FOLDER))

for _package in (solver, report):
    if _FOLDER not in Path(str(_package.__file__)).resolve().parents:
        raise ImportError(
            f"{_package.__file__} hides a package of Roofslip: rename it, or import roofslip first"
        )


def __getattr__(name: str) -> Any:
    """Return a public name of `report` or of `solver`; the latter are loaded with the first."""
    if name == "__version__":
        from report.provenance.release import version

        return version()
    if name == "__all__":
        return [*solver.__all__, *report.__all__]
    return getattr(report if name in report.__all__ else solver, name)


def __dir__() -> list[str]:
    return __getattr__("__all__")  # type: ignore[no-any-return]
