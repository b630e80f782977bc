"""Every command and every line of Python in the README runs, in a separate folder."""

import re
import shlex
import shutil
import subprocess
import sys

import pytest

from places import ROOT

README = (ROOT / "README.md").read_text()
COMMANDS = [
    line.split("#")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", README, re.DOTALL)
    for line in block.splitlines()
    if line.startswith("./roofslip")
]


ELSEWHERE = (
    ["test"],  # runs this test
    ["verify", "--quick"],  # run by tests/report/cli/test_verify.py
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The example alone, as in a fresh checkout; a new project is a copy of the example."""
    top = tmp_path_factory.mktemp("checkout")
    ignored = shutil.ignore_patterns("out")
    shutil.copytree(ROOT / "projects" / "example", top / "projects" / "example", ignore=ignored)
    return top


def fill(top):
    """Fill in the new project as a user would, here with the input of the example."""
    example, yours = (top / "projects" / name for name in ("example", "yours"))
    assert (yours / "input.xlsx").is_file()
    shutil.copy(example / "input.xlsx", yours / "input.xlsx")
    shutil.copytree(example / "records", yours / "records", dirs_exist_ok=True)


def test_every_command_of_the_readme_runs(folder):
    assert {command.split()[1] for command in COMMANDS} >= {"report", "test", "new", "check"}
    for command in COMMANDS:
        words = shlex.split(command)[1:]
        if words in ELSEWHERE:
            continue
        done = subprocess.run(
            [sys.executable, "-m", "report.cli", *words],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert done.returncode == 0, command + done.stdout + done.stderr
        if words[0] == "new":
            fill(folder)
    for project in ("example", "yours"):
        assert (folder / "projects" / project / "out" / "calc-package.pdf").is_file()


def test_the_python_of_the_readme_runs(folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MPLBACKEND", "agg")
    blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})
    assert (folder / "prd.png").is_file()


def test_every_picture_and_file_that_the_readme_names_exists():
    names = re.findall(r"\]\((?!http)([^)#]+)\)", README)
    assert [name for name in names if not (ROOT / name).exists()] == []


def test_nothing_is_left_to_fill_in():
    assert "@@" not in README
