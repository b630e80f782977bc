"""`roofslip doctor`, with everything and with something missing."""

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


def test_a_package_that_is_missing_is_named(capsys):
    assert not doctor.say(list(doctor.packages(("numpy", "no-such-package"))))
    assert "no-such-package: install it" in capsys.readouterr().err


def test_a_renderer_that_fails_is_a_finding_not_a_traceback():
    def broken(_):
        raise OSError("cannot load library 'libpango-1.0-0'")

    (look,) = doctor.page(broken)
    assert look.found == "fails: cannot load library 'libpango-1.0-0'"
    assert look.remedy


def test_a_solver_that_is_wrong_is_found():
    (look,) = doctor.solver_run(lambda: 0.1)
    assert look.remedy == "the solver is wrong on this computer; report it"
