"""The errors of earlier versions, and those that may affect a package.

The list is `templates/known-errors.toml`. Read `touching`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from packaging.version import InvalidVersion, Version

from report.typeset.pdf import TEMPLATES


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownError:
    """A corrected error; the list explains each field."""

    until: str
    of: str
    needs: str = ""
    error: str
    effect: str
    action: str
    changes: tuple[str, ...] = ()


@cache
def known_errors() -> tuple[KnownError, ...]:
    """Return all of them, the newest first."""
    text = (TEMPLATES / "known-errors.toml").read_text(encoding="utf-8")
    return tuple(KnownError(**entry) for entry in tomllib.loads(text)["errors"])


def touching(made_by: str, results: Any) -> Iterator[KnownError]:
    """Yield errors that may affect a package, from its version and its results.json."""
    for error in known_errors():
        is_of_it = error.of == "package" and _holds(results, error.needs)
        if is_of_it and _is_up_to(made_by, error.until):
            yield error


def _is_up_to(made_by: str, last: str) -> bool:
    try:
        # Without its commit, which has no order.
        return Version(Version(made_by).public) <= Version(last)
    except InvalidVersion:
        # A version that cannot be read may be any: the error is named rather than left out.
        return True


def _holds(results: Any, place: str) -> bool:
    """Whether an unchecked results.json contains something at a place."""
    for key in filter(None, place.split(".")):
        results = results.get(key) if isinstance(results, dict) else None
    return bool(results)
