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
    try:
        # Without its commit, which has no order.
        made = Version(Version(made_by).public)
    except InvalidVersion:
        made = Version("0")  # it may be any: an error is named rather than left out
    for error in known_errors():
        needed = results
        for key in filter(None, error.needs.split(".")):
            needed = needed.get(key) if isinstance(needed, dict) else None
        if error.of == "package" and made <= Version(error.until) and needed:
            yield error
