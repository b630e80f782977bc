"""The commands as a user or a script calls them."""

import json
import os
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

import packages
import report.package.html
from commands import printed, refused, run
from places import ROOT
from sheets import arrays, at, make, project

EXAMPLE = ROOT / "projects" / "example"
MANY = (
    "numpy", "numba", "pandas", "openpyxl", "matplotlib", "ezdxf", "ziamath",
    "ctypes", "importlib.metadata", "tomllib",
)  # fmt: skip


def loaded_by(code):
    """What Python prints, and which modules that are slow to load it has then loaded."""
    code += f"; import sys; print(*sorted({set(MANY)} & set(sys.modules)))"
    command = [sys.executable, "-c", code]
    # Coverage, which the tests of the night start in each process, loads modules of its own.
    plain = {name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=plain)
    *told, loaded = done.stdout.splitlines()
    return "\n".join(told), set(loaded.split())


@pytest.mark.quick
def test_help_and_errors_wait_for_nothing_heavy(tmp_path):
    code = "from report.cli.main import main; main(['--help'], standalone_mode=False)"
    told, loaded = loaded_by(code)
    assert not loaded
    for command in ("new", "check", "motion", "report", "slide", "verify"):
        assert f"\n  {command} " in told
    code = f"from report.cli.main import main; main(['check', {str(tmp_path)!r}])"
    code = f"import contextlib\nwith contextlib.suppress(SystemExit): {code}\nprint()"
    _, loaded = loaded_by(code)
    assert loaded
    assert not loaded & {"numba", "pandas", "matplotlib"}


@pytest.mark.nightly
def test_what_only_the_second_process_needs_is_not_loaded_with_the_tasks_for_it():
    _, loaded = loaded_by("import report.drawing.items, report.package.html, report.results.xlsx")
    assert not loaded & {"ezdxf", "matplotlib", "pandas", "ziamath"}


def test_new_writes_a_workbook_and_never_overwrites_one(tmp_path):
    printed("new", tmp_path / "job")
    assert (tmp_path / "job" / "records").is_dir()
    book = tmp_path / "job" / "input.xlsx"
    before = book.read_bytes()
    assert "already exists" in refused("new", tmp_path / "job", "--units", "si")
    assert book.read_bytes() == before
    (tmp_path / "input.xlsx").symlink_to(tmp_path / "elsewhere.xlsx")
    assert "already exists" in refused("new", tmp_path)
    assert not (tmp_path / "elsewhere.xlsx").exists()


def test_new_example_overwrites_no_records(tmp_path):
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / "mine.csv").write_text("0,0")
    told = refused("new", "--example", tmp_path)
    assert "records: is not empty; choose another folder" in told
    assert not (tmp_path / "input.xlsx").exists()


def test_new_example_writes_the_example_of_the_projects(tmp_path):
    made = tmp_path / "job"
    printed("new", "--example", made)
    names = {path.relative_to(made) for path in made.rglob("*.*")}
    assert len(names) == 22
    for name in names - {Path("input.xlsx")}:
        assert (made / name).read_bytes() == (EXAMPLE / name).read_bytes()
    with ZipFile(made / "input.xlsx") as one, ZipFile(EXAMPLE / "input.xlsx") as other:
        parts = [part for part in one.namelist() if part.endswith(".xml")]
        for part in set(parts) - {"docProps/core.xml"}:
            assert one.read(part) == other.read(part), part
    told = printed("check", made)
    assert "no errors, 3 warnings. 3 arrays, 6 clearances, 7 motions, S_DS 1.566 g" in told


def test_a_blank_workbook_or_a_damaged_former_revision_is_an_input_error(tmp_path):
    printed("new", tmp_path)
    told = refused("check", tmp_path)
    assert at("<Project/Project name>: project name is missing") in told
    assert at("<Arrays/heading/ID>: no array is given") in told
    former = tmp_path / "issued.json"
    former.write_bytes(b'{"schema_version": 2, "arr')
    told = refused("report", tmp_path / "no-such-project", "--since", former)
    assert "issued.json: is no results.json or is damaged" in told
    assert not (tmp_path / "out").exists()


def test_failed_runs_and_internal_errors_leave_the_older_package(tmp_path, monkeypatch):
    monkeypatch.setattr(report.package.html, "pages", lambda *_: 1 / 0)
    done = run("report", make(tmp_path))
    assert done.exit_code == 1
    assert isinstance(done.exception, ZeroDivisionError)
    assert not (tmp_path / "out").exists()
    book, out = make(tmp_path), tmp_path / "out"
    out.mkdir()
    (out / "calc-package.pdf").write_bytes(b"older")
    (tmp_path / "records" / "x3.csv").write_text("time_s,acceleration_g\n0,abc\n")
    told = refused("report", book)
    assert "x3.csv" in told
    assert f"{out / 'calc-package.pdf'} is of an earlier run, " in told
    assert [path.read_bytes() for path in out.iterdir()] == [b"older"]


@pytest.mark.nightly
def test_a_rigid_block_that_is_not_adequate_is_ng(tmp_path):
    given = project().model_dump()
    # Padded, so that every run comes to rest; too steep for the prescriptive route.
    book = make(
        tmp_path,
        links=[{"array": "A2", "friction": "0.30, 0.45, 0.60", "stiffness_n_per_m": 1e3}],
        options={"statistic": "rule set", "peer_reviewed": True},
        motions=[motion | {"pad_s": 20.0} for motion in given["motions"]],
        arrays=[array | {"slope_value": 7.0} for array in given["arrays"]],
    )
    with packages.unlaid():
        told = printed("report", book)
    verdict = "NG: one rigid block has not been shown to be adequate for array A2"
    assert verdict in told
    (line,) = (text for text in told.splitlines() if text.startswith("A2 "))
    assert line.endswith("NG: limits on the motions and 5 more")  # the block, four clearances
    results = json.loads((tmp_path / "out" / "results.json").read_text())
    (row,) = results["linked"]
    assert results["verdict"] == "NG"
    assert row["rigid_is_enough"] is False
    assert row["estimated_m"] > row["design_m"] > 0.0


@pytest.mark.nightly
def test_since_a_former_revision_the_terminal_counts_and_the_package_lists(tmp_path):
    former = tmp_path / "issued.json"
    with packages.unlaid():
        assert "since revision" not in printed("report", make(tmp_path))
        former.write_bytes((tmp_path / "out" / "results.json").read_bytes())
        book = make(tmp_path, arrays=arrays(mu=0.33))
        told = printed("report", book, "--since", former)
        words = packages.words((tmp_path / "out" / "calc-package.pdf").read_text(encoding="utf-8"))
        document = json.loads(former.read_text(encoding="utf-8"))
        document["input"]["project"] |= {"name": "Elsewhere", "number": "99-1"}
        former.write_text(json.dumps(document), encoding="utf-8")
        of_another = printed("report", book, "--since", former)
    (line,) = (text for text in told.splitlines() if text.startswith("since revision"))
    assert line.startswith("since revision 1: ")
    assert "input 1," in line
    assert line.endswith("; the package lists them after its summary")
    assert words.index("Changes since revision 1") < words.index("2 Comparison with the")
    assert "Friction coefficient" in words
    assert "of another project" not in told
    assert "--since is of another project: 99-1, Elsewhere; check that it is" in of_another
