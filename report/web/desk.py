"""What the routes ask: the sessions, the processes that compute and the packages, together.

Read `Desk.ask`.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request

from report.web.packages import Packages
from report.web.plan import USUAL_PX
from report.web.sessions import EXAMPLE, Session, Sessions
from report.web.worker import computing
from report.web.workers import JobOrigin, Rank, Workers


class RefusedError(Exception):
    """What a workbook could not have, with each problem as data."""

    def __init__(self, sentence: str, problems: Sequence[Mapping[str, Any]]) -> None:
        super().__init__(sentence)
        self.problems = problems


class Asked(BaseModel):
    """A request of the page about what is open, with the values of its sliders.

    Of two requests of a page only that with the larger number counts. A script that does not say
    what is open asks about whatever it is.
    """

    model_config = ConfigDict(strict=True, frozen=True)

    page: str = Field("", max_length=100)
    n: int = Field(0, ge=-(2**53), le=2**53)
    opened: str | None = None
    values: dict[str, int | float | str] = Field({}, max_length=40)
    moving: bool = False
    room: int = USUAL_PX
    array: str | None = None
    motion: str | None = None
    run: str | None = None


class Desk:
    """The sessions, processes and packages of a server."""

    def __init__(self, sessions: Sessions, processes: int) -> None:
        self.sessions, self.packages = sessions, Packages()
        self.workers = Workers(processes, partial(computing, sessions.folder))
        self._asked = 0

    def start(self) -> None:
        """Start the processes, each with the example."""
        self.workers.start({"do": "state", "workbook": str(EXAMPLE)})

    async def stop(self) -> None:
        """End every process."""
        await self.packages.stop()
        await self.workers.stop()

    async def clean(self) -> None:
        """End the sessions that are not used, with their packages."""
        self.sessions.end_unused()
        await self.packages.keep({session.id for session in self.sessions.alive})

    async def ask(
        self,
        session: Session,
        job: Mapping[str, Any],
        rank: Rank,
        asked: Asked | None = None,
    ) -> Mapping[str, Any]:
        """Return the answer to a job of a session, about what it has open if it names no workbook.

        Parameters
        ----------
        asked : Asked, optional
            Request whose page and number tell which of two jobs is the newer one.

        Raises
        ------
        RefusedError, StaleError, LostError
        OSError
            If the disk is full.
        """
        self._asked += 1
        page, number = (asked.page, asked.n) if asked else (str(self._asked), 0)
        origin = JobOrigin((session.id, str(job["do"]), page), number)
        found = await self.workers.ask({"workbook": str(session.workbook), **job}, rank, origin)
        if "answer" in found:
            answer: Mapping[str, Any] = found["answer"]
            return answer
        if "errno" in found:
            raise OSError(found["errno"], os.strerror(found["errno"]))
        first = found["refused"] if "refused" in found else found["problems"][0]["text"]
        raise RefusedError(first, found["problems"])


def session_of(request: Request) -> Session:
    """Return the session that `report.web.access` found."""
    session: Session = request.state.session
    return session


def desk_of(request: Request) -> Desk:
    """Return the desk of the server."""
    desk: Desk = request.app.state.desk
    return desk
