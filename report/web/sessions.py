"""Sessions: a folder of its own for each, removed after an hour without use.

Read `Sessions`.
"""

from __future__ import annotations

import secrets
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

from report.sheet.writing import shipped

LIFE_S = 3600.0
"""How long a session lives without use [s]."""

MOST = 200
"""Most sessions at once: each may fill a folder."""

_UPLOAD = "upload-"
EXAMPLE = shipped.EXAMPLE / "input.xlsx"


class OtherProjectError(Exception):
    """A page asks about a project that its session no longer has open."""


@dataclass(slots=True)
class Session:
    """A session.

    Attributes
    ----------
    folder : Path
        Its own; no other session reads or writes it.
    workbook : Path
        What is open: the example, or the last upload that could be read.
    used_s : float
        When it was last used, on the clock `time.monotonic`.
    openings : int
        How many uploads were begun and projects opened; a newer one replaces an upload under way.
    """

    id: str
    folder: Path
    used_s: float
    workbook: Path = EXAMPLE
    openings: int = 0

    @property
    def opened(self) -> str:
        """Name of what is open, which no other upload has."""
        if self.workbook == EXAMPLE:
            return "example"
        return self.workbook.relative_to(self.folder).parts[0]

    def new_folder(self) -> Path:
        """Return an empty folder for an upload."""
        self.openings += 1
        folder = self.folder / f"{_UPLOAD}{self.openings}"
        folder.mkdir()
        return folder

    def is_newest(self, folder: Path) -> bool:
        """Whether nothing was opened, and no upload begun, after that of a folder."""
        return folder.name == f"{_UPLOAD}{self.openings}"

    def open(self, workbook: Path) -> Path:
        """Open a workbook, and return the folder of what was open, which can be removed."""
        former = self.folder / self.opened
        self.workbook = workbook
        self.openings += 1
        return former


class Sessions:
    """The sessions of a server, in a folder that ends with it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._by_id: dict[str, Session] = {}

    def begin(self) -> Session:
        """Begin a session; where there are too many, the one unused for longest ends."""
        self.end_unused()
        if len(self._by_id) >= MOST:
            self.end(min(self._by_id.values(), key=lambda session: session.used_s))
        name = secrets.token_urlsafe(32)
        # Its name in the file system is another one: a listing opens no session.
        folder = self.folder / secrets.token_hex(16)
        folder.mkdir(mode=0o700)
        session = Session(id=name, folder=folder, used_s=time.monotonic())
        self._by_id[name] = session
        return session

    def find(self, name: str) -> Session | None:
        """Return a session that is alive, and take note of its use."""
        session = self._by_id.get(name)
        if session is None or self._is_over(session):
            return None
        session.used_s = time.monotonic()
        return session

    def end_unused(self) -> None:
        """End the sessions that were not used for an hour."""
        for session in [s for s in self._by_id.values() if self._is_over(s)]:
            self.end(session)

    def end(self, session: Session) -> None:
        """End a session and remove its folder."""
        del self._by_id[session.id]
        shutil.rmtree(session.folder, ignore_errors=True)

    @property
    def alive(self) -> list[Session]:
        """The sessions."""
        return list(self._by_id.values())

    def _is_over(self, session: Session) -> bool:
        return time.monotonic() - session.used_s > LIFE_S
