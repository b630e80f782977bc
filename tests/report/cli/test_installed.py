"""Every command of `--help` as it is installed: by a wheel without extras, read-only, offline.

Commands that take longer than seconds run by night.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from importlib.metadata import distribution
from pathlib import Path

import click
import pytest
from packaging.requirements import Requirement

from fixtures import dxf, packages, workbooks
from fixtures.paths import ROOT
from report.cli.main import main

RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
MADE = "OUT/made.csv"

# Each with the start of a line that it prints, where extras are not installed.
DAY = {
    "check PROJECT": "Next: ",
    "completion bash": "_roofslip_completion",
    f"motion convert RECORD {MADE}": MADE,
    "motion info RECORD": "RECORD: ",
    "motion info OUT/a.mseed": "  a.mseed: miniSEED is read by ObsPy, which is not installed; ",
    "motion rows RECORDS": "motion     record ",
    "new OUT/new": "then run: ",
    "plan ballast PROJECT/blocks.csv PROJECT --units ft --block-weight 32 lb": "Next: ",
    "plan clearances PROJECT": "Next: ",
    "plan read PROJECT/roof.dxf PROJECT --replace --accept": "Next: ",
    "report OUT/none": "OUT/none: 1 error:",
    "schema": "{",
    "serve --once --port 0": "The page requires starlette, uvicorn, python-multipart: install ",
    "sign RECORD --p12 RECORD --password x": "  ",
    "slide RECORD --slope-deg 2 --mu 0.3": "            prd_m  ",
    "study STUDY --dry-run": "  a study needs the package ",
    "test": "Error: tests are run by the launcher of a checkout",
    "verify-package RECORD": "Differs ",
    "watch OUT/none": "OUT/none: 1 error:",
}
NIGHT = {
    "doctor": "Everything needed to create a package is installed.",
    "motion suite OUT/suite --sds 1 --code asce7-16 --count 1": "Next: ",
    "report PROJECT": "verdict: ",
    "verify --quick --out OUT/verify": "10 checks left out: SciPy is not installed",
    "verify-package PROJECT/out/calc-package.pdf": "Same: ",
}

# Prints how each command ends, and what it prints.
PROGRAM = """
import json, shlex, sys
from click.testing import CliRunner
from report.cli.main import main
for line in json.load(sys.stdin):
    done = CliRunner().invoke(main, shlex.split(line))
    raised = done.exception if not isinstance(done.exception, SystemExit) else None
    print(json.dumps([done.exit_code, done.output, repr(raised)]))
"""


def needed(name, found):
    """Add a distribution to those that are found, with all that it requires, without extras."""
    if name.lower() in found:
        return
    found[name.lower()] = distribution(name)
    for line in found[name.lower()].requires or ():
        requirement = Requirement(line)
        if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
            needed(requirement.name, found)


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A Python with the wheel and what it requires, linked from that of the tests."""
    top = tmp_path_factory.mktemp("installed")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", top], check=True)
    (site,) = top.glob("lib/python*/site-packages")
    found = {}
    needed("roofslip", found)
    del found["roofslip"]
    for each in found.values():
        for name in {file.parts[0] for file in each.files} - {"..", "__pycache__"}:
            if not (site / name).exists():
                (site / name).symlink_to(each.locate_file(name))
    with zipfile.ZipFile(next(packages.built(tmp_path_factory).glob("*.whl"))) as wheel:
        wheel.extractall(site)
    # What is compiled there already: it is for sources of these times.
    kernels = ROOT / "solver" / "kernels"
    for source in kernels.glob("*.py"):
        shutil.copystat(source, site / "solver" / "kernels" / source.name)
    if (kernels / "__pycache__").exists():
        shutil.copytree(kernels / "__pycache__", site / "solver" / "kernels" / "__pycache__")
    return top / "bin" / "python"


@pytest.fixture
def ended(tmp_path):
    """A function that runs commands, and returns how each ends."""
    project, study, out = (tmp_path / name for name in ("project", "study", "out"))
    for folder in (project, study, out):
        folder.mkdir()
    workbooks.make(project, layers=[{"layer": "PV", "kind": "array"}])
    drawing = dxf.Sketch()
    drawing.ring("PV", dxf.BOX_FT, "A1")
    drawing.saved(project)
    (project / "blocks.csv").write_text("x,y,blocks\n30,30,2\n")
    (out / "a.mseed").write_bytes(b"000001D STA" + bytes(600))
    shutil.copy(ROOT / "projects" / "study" / "input.xlsx", study)
    places = {
        "PROJECT": project, "STUDY": study, "OUT": out, "RECORDS": RECORD.parent, "RECORD": RECORD
    }  # fmt: skip

    def placed(text):
        return re.sub("PROJECT|STUDY|OUT|RECORDS?", lambda found: str(places[found[0]]), text)

    def run(program, table):
        done = subprocess.run(
            [*program, "-P", "-c", PROGRAM], input=json.dumps(list(map(placed, table))),
            cwd=tmp_path, capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        answers = [json.loads(line) for line in done.stdout.splitlines()]
        for line, (code, printed, raised) in zip(table, answers, strict=True):
            assert raised == "None", f"{line}: {raised}"
            assert code in (0, 1, 2), f"{line}: {printed}"
        return {
            line: (placed(said), answer[1])
            for (line, said), answer in zip(table.items(), answers, strict=True)
        }

    return run


def in_namespace(kind, script=""):
    """Words before a command that run it, after a script, in a name space of its own."""
    words = ["unshare", f"--{kind}", "sh", "-ec", f'{script}exec "$@"', "sh"]
    if not shutil.which("unshare") or subprocess.run([*words, "true"], check=False).returncode:
        pytest.skip("no name space can be made here")
    return words


TABLES = [DAY, pytest.param(NIGHT, marks=pytest.mark.nightly)]


def test_each_command_of_the_help_is_here():
    def named(group, *words):
        for name, command in group.every().items():
            below = isinstance(command, click.Group)
            yield from named(command, *words, name) if below else [" ".join((*words, name))]

    for name in named(main):
        assert any(f"{line} ".startswith(f"{name} ") for line in DAY | NIGHT), name


@pytest.mark.parametrize("table", TABLES)
def test_each_command_runs_where_the_wheel_is_installed_without_extras(installed, ended, table):
    answers = ended([installed], table).values()
    wrong = [printed for said, printed in answers if f"\n{said}" not in f"\n{printed}"]
    assert wrong == []


@pytest.mark.parametrize("table", TABLES)
def test_each_command_runs_without_a_network(installed, ended, table):
    ended([*in_namespace("net"), installed], table)


# Here with extras: these two do not stop at once.
BRIEF = {line: said for line, said in DAY.items() if not line.startswith(("serve", "study"))}


@pytest.mark.parametrize("table", [BRIEF, pytest.param(DAY | NIGHT, marks=pytest.mark.nightly)])
def test_each_command_runs_where_the_environment_cannot_be_written(ended, table):
    venv = Path(sys.prefix)
    script = f'mount --bind "{venv}" "{venv}"; mount -o remount,ro,bind "{venv}"; '
    assert os.access(venv, os.W_OK)
    ended([*in_namespace("mount", script), sys.executable], table)
