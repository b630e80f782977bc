"""The version of this program: that of a release, or of the commit that runs.

hatchling runs this file too and fixes the version in a wheel, so it imports nothing of the program.
"""

from __future__ import annotations

import os
import tomllib
from functools import cache
from importlib import metadata
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2]

# No tag: a clone without the tags would else count other commits than one with them.
_NO_TAG = "(?P<base>(?!))"


@cache
def version() -> str:
    """Return the version that packages, results, the manual and `--version` print."""
    # Set for tests and for the files of the docs, which are the same at every commit.
    if fixed := os.environ.get("ROOFSLIP_VERSION"):
        return fixed
    return of_folder(FOLDER) if _names_a_commit(FOLDER) else metadata.version("roofslip")


def of_folder(folder: Path) -> str:
    """Return the version of a checkout, or of an archive of one."""
    project = tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))
    base: str = project["tool"]["roofslip"]["version"]
    if not base.endswith(".dev"):
        return base
    if not _names_a_commit(folder):
        return f"{base}+unknown"
    try:
        from dunamai import Version

        # Untracked files are not of the program: a project beside it makes no version dirty.
        checkout = Version.from_git(_NO_TAG, path=folder, ignore_untracked=True, commit_length=8)
    # dunamai or git is not installed, or git refuses a folder that belongs to another user.
    except (ImportError, OSError, RuntimeError):
        return f"{base}+unknown"
    count = checkout.distance or ""  # an archive has the commit alone
    return f"{base}{count}+{checkout.commit}{'.dirty' if checkout.dirty else ''}"


def _names_a_commit(folder: Path) -> bool:
    # What `git archive` and the ZIP of a forge write the commit into. Of this folder itself: the
    # folder above may be another repository.
    stamp = folder / ".git_archival.json"
    is_stamped = stamp.is_file() and "$Format" not in stamp.read_text(encoding="utf-8")
    return is_stamped or (folder / ".git").exists()
