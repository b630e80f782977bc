"""`roofslip doctor`, with everything and with something missing."""

from click.testing import CliRunner

from places import ROOT
from report.cli import doctor
from report.cli.main import main


def run():
    return CliRunner().invoke(main, ["doctor"])


def test_with_everything_installed_it_says_so():
    done = run()
    assert done.exit_code == 0, done.output
    lines = done.stdout.splitlines()
    names = [line.split("  ")[0] for line in lines]
    assert {"Python", "numpy", "fonts", "cores", "test run", "test page"} <= set(names)
    count = len(list((ROOT / "templates" / "fonts").glob("*.ttf")))
    assert f"{count} with the program" in done.stdout
    # 0.1 g x 0.8^2 / 6, in closed form.
    assert any(line.startswith("test run") and "0.104604267 m" in line for line in lines)
    assert lines[-1] == "Everything that a package needs is here."


def quick(monkeypatch, *checks):
    monkeypatch.setattr(doctor, "CHECKS", checks)
    return run()


def test_a_native_library_that_is_missing_is_named_with_its_package(monkeypatch):
    monkeypatch.setattr(doctor, "find_library", lambda name: None if "pangoft2" in name else name)
    done = quick(monkeypatch, doctor._native)
    assert done.exit_code == 1
    assert done.stderr == "pangoft2-1.0: install it: sudo apt-get install libpangoft2-1.0-0\n"


def test_a_package_that_is_missing_is_named(monkeypatch):
    monkeypatch.setattr(doctor, "PACKAGES", ("numpy", "no-such-package"))
    done = quick(monkeypatch, doctor._packages)
    assert done.exit_code == 1
    assert "no-such-package: install it" in done.stderr


def test_a_renderer_that_fails_is_a_finding_not_a_traceback(monkeypatch):
    def broken(_):
        raise OSError("cannot load library 'libpango-1.0-0'")

    monkeypatch.setattr("report.typeset.pdf.lay_out", broken)
    done = quick(monkeypatch, doctor._page)
    assert (done.exit_code, done.exception.code) == (1, 1)
    assert "fails: cannot load library 'libpango-1.0-0'" in done.stdout
    assert "Everything" not in done.stdout


def test_a_solver_that_is_wrong_is_found(monkeypatch):
    monkeypatch.setattr(doctor, "_pushed_m", lambda: 0.1)
    done = quick(monkeypatch, doctor._solver)
    assert done.exit_code == 1
    assert "the solver is wrong on this computer" in done.stderr
