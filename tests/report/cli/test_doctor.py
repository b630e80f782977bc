"""`roofslip doctor`, with everything and with something missing."""

import re
from types import SimpleNamespace

import pytest

from commands import printed, run
from report.cli import main

pytestmark = pytest.mark.quick


@pytest.mark.nightly
def test_with_everything_installed_it_says_so():
    told = printed("doctor")
    lines = told.splitlines()
    names = [line.split("  ")[0] for line in lines]
    assert {"Python", "cores", "numpy", "weasyprint", "fontconfig", "test run"} <= set(names)
    assert any(re.match(r"test page +[\d,]+ bytes", line) for line in lines)
    # 0.1 g x 0.8^2 / 6, in closed form.
    assert any(line.startswith("test run") and "0.104604267 m" in line for line in lines)
    assert lines[-1] == "Everything that a package needs is here."


def test_missing_packages_and_libraries_are_named(monkeypatch):
    monkeypatch.setitem(main.NATIVE, "no-such-library", "libnone0")
    done = run("doctor")
    assert done.exit_code == 1
    assert done.stderr == "Error: no-such-library: install it: sudo apt-get install libnone0\n"
    assert re.search(r"no-such-library +missing", done.stdout)
    assert "Everything" not in done.stdout
    needed = ["numpy", "no-such-package", "other-package; extra == 'sign'"]
    monkeypatch.setattr("importlib.metadata.requires", lambda _: needed)
    done = run("doctor")
    assert done.exit_code == 1
    assert "no-such-package: install it" in done.stderr
    assert "other-package" not in done.output


def test_a_broken_renderer_or_solver_is_a_finding(monkeypatch):
    def broken(_):
        raise OSError("cannot load library 'libpango-1.0-0'")

    monkeypatch.setattr("report.typeset.pdf.lay_out", broken)
    done = run("doctor")
    assert re.search(r"test page +fails: cannot load library 'libpango-1.0-0'", done.stdout)
    assert done.stderr == (
        "Error: test page: install what is missing above, or the program again\n"
    )
    monkeypatch.setattr("solver.slide", lambda *_, **__: SimpleNamespace(prd_m=0.1))
    done = run("doctor")
    assert done.exit_code == 1
    assert re.search(r"test run +fails: 0\.100000000 m", done.stdout)
    assert done.stderr.startswith("Error: test run: remove .venv and run ./roofslip again")
