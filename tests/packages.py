"""Packages of the projects, each made once in a run of the tests, and packages without layout."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from html import unescape
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner
from filelock import FileLock
from matplotlib.figure import Figure

import report.typeset.pdf
from places import ROOT
from report.cli.main import main
from report.figures import charts, history, plan, records, spectra


def once(factory: pytest.TempPathFactory, name: str, fill: Callable[[Path], object]) -> Path:
    """Return a folder of this run of the tests, filled by the worker that first asks for it."""
    top = factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        top = top.parent
    folder, filled = top / name, top / f"{name}-is-filled"
    with FileLock(top / f"{name}-lock"):
        if not filled.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            fill(folder)
            filled.touch()
    return folder


def built(factory: pytest.TempPathFactory) -> Path:
    """Return the folder with the wheel and the sdist, built offline."""
    return once(factory, "dist", _build)


def _build(folder: Path) -> None:
    command = [sys.executable, "-m", "hatchling", "build", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True, timeout=60)


@dataclass(frozen=True)
class Reported:
    """The folder of a project with its report, and what the command printed; only read it."""

    project: Path
    stdout: str
    stderr: str

    @property
    def out(self) -> Path:
        return self.project / "out"


def here(top: Path, project: str) -> tuple[str, str]:
    """Report a project in this process; return what is printed."""
    done = CliRunner().invoke(main, ["report", str(top / project)])
    assert done.exit_code == 0, done.output
    return done.stdout, done.stderr


def by_script(top: Path, project: str) -> tuple[str, str]:
    """Report a project as a script does, in a process of its own; return what is printed."""
    command = [sys.executable, "-m", "report.cli", "report", project]
    done = subprocess.run(
        command, cwd=top, capture_output=True, text=True, check=False, timeout=240
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout, done.stderr


def without_figures(top: Path, project: str) -> tuple[str, str]:
    """Report a project without its figures, which take half of the time of a small one."""
    with undrawn():
        return here(top, project)


def results_alone(top: Path, project: str) -> tuple[str, str]:
    """Report a project without figures and layout, which take most of the time."""
    with unlaid(), undrawn():
        return here(top, project)


def reported(
    factory: pytest.TempPathFactory,
    name: str,
    run: Callable[[Path, str], tuple[str, str]] = here,
) -> Reported:
    """Return a project with its report, which is made once in each way of running it."""
    top = once(factory, f"{name}-{run.__name__}", partial(_report, name=name, run=run))
    return Reported(
        project=top / "projects" / name,
        stdout=(top / "stdout").read_text(encoding="utf-8"),
        stderr=(top / "stderr").read_text(encoding="utf-8"),
    )


def _report(top: Path, name: str, run: Callable[[Path, str], tuple[str, str]]) -> None:
    source, project = ROOT / "projects" / name, top / "projects" / name
    shutil.copytree(source, project, ignore=shutil.ignore_patterns("out", "make.py", "__pycache__"))
    for stream, text in zip(("stdout", "stderr"), run(top, f"projects/{name}"), strict=True):
        (top / stream).write_text(text, encoding="utf-8")


@contextmanager
def unlaid() -> Iterator[None]:
    """Have packages written as HTML: the layout takes four fifths of the time of a small one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report.typeset.pdf, "lay_out", _unlaid)
        yield


def _unlaid(html: str, attached: object, tell: Callable[[int], object]) -> bytes:
    tell(1)
    return html.encode()


@contextmanager
def undrawn() -> Iterator[None]:
    """Have figures left out: they take nine tenths of the time of the pages."""
    with pytest.MonkeyPatch.context() as patch:
        empty = '<svg width="1pt" height="1pt"></svg>'
        patch.setattr(Figure, "savefig", lambda _, out, **__: out.write(empty))
        for module, name in (
            (records, "accelerations"), (charts, "comparison"),
            (history, "histories"), (history, "hodographs"), (plan, "paper_svg"),
            (spectra, "spectra"),
        ):  # fmt: skip
            patch.setattr(module, name, lambda *_, **__: empty)
        yield


def words(html: str) -> str:
    """Return the words of a package or manual before its layout, whose markup and links are whole.

    Broken ones stop the layout.
    """
    elements = list(ElementTree.fromstring(html).iter())
    places = {f"#{element.get('id')}" for element in elements}
    links = {element.get("href", "") for element in elements}
    assert {link for link in links if link.startswith("#")} <= places
    body = re.sub(r"<style.*?</style>|<[^>]+>", " ", html[html.index("<body") :])
    return " ".join(unescape(body).split())
