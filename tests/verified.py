"""`roofslip verify --quick`, run once in a run of the tests; only read what it gives."""

from __future__ import annotations

import copyreg
import datetime as dt
import pickle
from dataclasses import dataclass, fields
from pathlib import Path
from types import MappingProxyType

import pandas as pd
import pytest
from click.testing import CliRunner

import packages
import report.cli.verify
import report.manual.render
from report.cli.main import main
from report.cli.terminal import Progress
from report.manual.render import manual_html
from solver.verification.evidence import Verification
from solver.verification.workprecision import SINGLE, TIME

DATE = dt.date(2026, 3, 5)


_ERRORS = [f"{what} error [{unit}]" for what in ("PRD", "residual") for unit in ("m", "%")]
NO_RUNS = pd.DataFrame(
    columns=["method", "setting", "record", "case", TIME, SINGLE, *_ERRORS, "status"]
)
NO_ERRORS = pd.DataFrame(columns=["method", "motions", "error [%]"])


def only(**found: object) -> Verification:
    """Return a verification that has found nothing but this."""
    nothing = dict.fromkeys((field.name for field in fields(Verification)), ())
    some = {"rivals": NO_ERRORS, "work": NO_RUNS, "quick": True, "seconds": 1.0}
    return Verification(**{**nothing, **some, **found})


def read_only(mapping: dict[str, object]) -> MappingProxyType[str, object]:
    """Return a mapping as the solver keeps the parameters of a method."""
    return MappingProxyType(mapping)


copyreg.pickle(MappingProxyType, lambda mapping: (read_only, (dict(mapping),)))


class Counting(Progress):
    """Progress whose bar must be full at the end."""

    def __exit__(self, *about: object) -> None:
        assert self._done == len(report.cli.verify.VERIFY_STEPS)
        super().__exit__(*about)


@dataclass(frozen=True)
class Verified:
    """What the command computed, laid out and printed, its sections by name, and its folder."""

    verification: Verification
    html: str
    parts: dict[str, object]
    stdout: str
    output: str
    out: Path


def verified(factory: pytest.TempPathFactory) -> Verified:
    """Return what the command did."""
    folder = packages.once(factory, "verified", _fill)
    found = pickle.loads((folder / "kept").read_bytes())  # this run of the tests has written it
    return Verified(**found, out=folder / "v")


def _fill(folder: Path) -> None:
    found, started = {}, dt.date.today()

    def kept_html(verification, parts, machine, date):
        assert started <= date <= dt.date.today()
        found["verification"] = verification
        found["parts"] = {part.id: part for part in parts}
        found["html"] = manual_html(verification, parts, machine, DATE)
        return found["html"]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report.manual.render, "manual_html", kept_html)
        patch.setattr(report.cli.verify, "Progress", Counting)
        done = CliRunner().invoke(main, ["verify", "--quick", "--out", str(folder / "v")])
    assert done.exit_code == 0, done.output
    kept = pickle.dumps(found | {"stdout": done.stdout, "output": done.output})
    (folder / "kept").write_bytes(kept)
