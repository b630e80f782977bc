"""`roofslip doctor`, with everything and with something missing."""

import re
from types import SimpleNamespace

from commands import printed, run
from places import ROOT
from report.cli import doctor


def test_with_everything_installed_it_says_so():
    told = printed("doctor")
    lines = told.splitlines()
    names = [line.split("  ")[0] for line in lines]
    assert {"Python", "numpy", "fonts", "cores", "test run", "test page"} <= set(names)
    count = len(list((ROOT / "templates" / "fonts").glob("*.ttf")))
    assert f"{count} with the program" in told
    # 0.1 g x 0.8^2 / 6, in closed form.
    assert any(line.startswith("test run") and "0.104604267 m" in line for line in lines)
    assert lines[-1] == "Everything that a package needs is here."


def test_a_native_library_that_is_missing_is_named_with_its_package(monkeypatch):
    monkeypatch.setitem(doctor.NATIVE, "no-such-library", "libnone0")
    done = run("doctor")
    assert done.exit_code == 1
    assert done.stderr == "no-such-library: install it: sudo apt-get install libnone0\n"
    assert "Everything" not in done.stdout


def test_a_package_that_is_missing_is_named(monkeypatch):
    monkeypatch.setattr(doctor, "PACKAGES", ("numpy", "no-such-package"))
    done = run("doctor")
    assert done.exit_code == 1
    assert "no-such-package: install it" in done.stderr


def test_a_renderer_that_fails_is_a_finding_not_a_traceback(monkeypatch):
    def broken(_):
        raise OSError("cannot load library 'libpango-1.0-0'")

    monkeypatch.setattr("report.typeset.pdf.lay_out", broken)
    done = run("doctor")
    assert re.search(r"test page +fails: cannot load library 'libpango-1.0-0'", done.stdout)
    assert done.stderr == "test page: install what is missing above, then try again\n"


def test_a_solver_that_is_wrong_is_found(monkeypatch):
    wrong = SimpleNamespace(result=SimpleNamespace(prd_m=0.1))
    monkeypatch.setattr("solver.solve", lambda _: wrong)
    done = run("doctor")
    assert done.stderr == "test run: the solver is wrong on this computer; report it\n"
