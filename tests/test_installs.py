"""The ways of the install page for those who know Python, and the floors of the dependencies."""

import json
import os
import re
import shlex
import shutil
import subprocess
import tomllib

import pytest

from fixtures import packages
from fixtures.paths import ROOT
from report.proof.differences import differences

pytestmark = pytest.mark.nightly

PAGE = (ROOT / "docs" / "install.md").read_text()
OWN_UV = ROOT / ".uv" / "bin" / "uv"


@pytest.fixture(scope="module")
def tools(tmp_path_factory):
    """A function that runs a command with tools, their homes and a copy of what is shipped."""
    uv = shutil.which("uv") or (str(OWN_UV) if OWN_UV.exists() else None)
    if uv is None:
        pytest.skip("uv is not installed")
    top = tmp_path_factory.mktemp("installs")
    here = top / "roof slip"
    shutil.copytree(ROOT, here, ignore=shutil.ignore_patterns(".*", "out", "__pycache__"))
    (top / "bin").mkdir()
    (top / "bin" / "pipx").write_text(f'#!/bin/sh\nexec {shlex.quote(uv)} tool run pipx "$@"\n')
    (top / "bin" / "pipx").chmod(0o755)
    env = {name: text for name, text in os.environ.items() if name != "VIRTUAL_ENV"}
    env |= {
        "PATH": f"{top / 'bin'}:{os.path.dirname(uv)}:{os.environ['PATH']}",
        "UV_TOOL_DIR": str(top / "tools"), "UV_TOOL_BIN_DIR": str(top / "uv-bin"),
        "PIPX_HOME": str(top / "pipx"), "PIPX_BIN_DIR": str(top / "pipx-bin"),
    }  # fmt: skip

    def run(command):
        done = subprocess.run(
            command, shell=True, cwd=here, env=env, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return run


def commands_of(head):
    section = PAGE.partition(f"## {head}\n")[2].partition("\n## ")[0]
    return [
        line.partition("  #")[0].strip()
        for block in re.findall(r"```text\n(.*?)```", section, re.DOTALL)
        for line in block.splitlines()
    ]


def test_each_way_for_those_who_know_python_has_the_program(tools):
    ways = commands_of("For those who know Python")
    assert [way.split()[0] for way in ways] == ["pipx", "uv", "uvx", "uv", "uv"]
    for way in ways:
        told = tools(way)
        if way.startswith("uvx"):
            assert told.startswith("roofslip, version ")
        for name in ("pipx-bin", "uv-bin"):
            program = f"../{name}/roofslip"
            if name.startswith(way.split()[0]) and " install " in way:
                assert tools(f"{program} --version").startswith("roofslip, version ")
                assert tools(f"{program} slide projects/example/records/RM1-x.csv "
                             "--slope-deg 2 --mu 0.3")  # fmt: skip


def test_no_command_takes_the_name_from_a_registry():
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")]
    taken = re.compile(r"(?:pip|pipx|tool|add) install (?:-\S+ )*['\"]?roofslip|uvx roofslip")
    named = {path.name: taken.findall(path.read_text()) for path in pages}
    assert {name: found for name, found in named.items() if found and name != "CHANGELOG.md"} == {}


def test_the_floors_of_all_dependencies_give_the_package_that_the_lock_gives(
    tools, tmp_path_factory
):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert [line for line in project["dependencies"] if ">=" not in line] == []
    tools("uv venv --quiet ../floors")
    tools("uv pip install --quiet --python ../floors --resolution lowest-direct .")
    tools("../floors/bin/roofslip report projects/conditions --out ../floors/out")
    floors = json.loads(tools("cat ../floors/out/results.json"))
    locked = packages.reported(tmp_path_factory, "conditions").out / "results.json"
    assert list(differences(json.loads(locked.read_text()), floors, shared=True)) == []
