"""Files beside a workbook: which of them it may access."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, islice
from pathlib import Path, PurePosixPath, PureWindowsPath
from unicodedata import normalize

from report.text.grouping import grouped_by
from solver.errors import InputError
from solver.file_checks import check_length
from solver.suggestions import nearest

# Files among which one is sought whose name nearly fits, and names that are taken.
MOST_LISTED = 2_000


def path_beside(
    folder: Path, name: str, max_bytes: int, example: str, taken: Iterable[str] = ()
) -> Path:
    """Return the file of a name within the workbook's folder; names that are taken are not meant.

    Raises `InputError` if it is outside the folder, also by a link, is no file, or is too large.
    """
    # A path may have been typed on Windows, and is read on any system.
    name = name.replace("\\", "/")
    where = f"give a file in the workbook's folder, such as {example}"
    if PurePosixPath(name).is_absolute() or PureWindowsPath(name).drive or ".." in name.split("/"):
        raise InputError(f"'{name}' is outside the workbook's folder; {where}")
    try:
        # A link within the folder may lead out of it.
        path = _as_spelled(folder / name).resolve()
        if not path.is_relative_to(folder.resolve()):
            raise InputError(f"'{name}' is a link to a file outside the workbook's folder; {where}")
        if not path.exists():
            check_length(path)
            raise InputError(f"'{name}' does not exist; {_meant(folder, name, taken) or where}")
        if not path.is_file():
            raise InputError(f"'{name}' is not a file; {where}")
        size = path.stat().st_size
        path.open("rb").close()  # raises where that is not permitted
    except PermissionError as error:
        raise InputError(f"'{name}' cannot be read ({error.strerror}); allow it") from error
    # RuntimeError of links in a circle, ValueError of a null character.
    except (OSError, RuntimeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"'{name}' cannot be found; {where}") from error
    if size > max_bytes:
        raise InputError(f"'{name}' has {size / 1e6:.0f} MB; give at most {max_bytes / 1e6:.0f} MB")
    return path


def _as_spelled(path: Path) -> Path:
    """Return a path; where there is no such file, the one beside it whose name looks the same."""
    if path.exists():
        return path
    # macOS writes the accent of a letter as a character of its own; Excel does not.
    name = normalize("NFC", path.name)
    files = islice(path.parent.glob("*"), MOST_LISTED)
    return next((file for file in files if normalize("NFC", file.name) == name), path)


def _meant(folder: Path, name: str, taken: Iterable[str]) -> str:
    """Ask for the file whose name nearly fits, in the named folder or one of the workbook's."""
    asked = PurePosixPath(name)
    near = islice(chain((folder / asked).parent.glob("*"), folder.glob("*/*")), MOST_LISTED)
    by_stem = grouped_by((path for path in near if path.is_file()), lambda path: path.stem)
    stems = {PurePosixPath(name_taken).stem for name_taken in islice(taken, MOST_LISTED)}
    alike = by_stem.get(nearest(asked.stem, by_stem, stems), [])
    files = [path.relative_to(folder).as_posix() for path in alike]
    return f"did you mean '{nearest(name, files) or files[0]}'?" if files else ""
