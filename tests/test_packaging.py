"""What is shipped, what is locked, and what tracked files must not hold."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from fnmatch import fnmatch
from itertools import chain

import pytest

from places import ROOT, TESTS
from report.cli.main import main

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
TOP_LEVEL = {
    "pyproject.toml", "requirements.lock", "README.md", "roofslip", "solver", "report", "templates",
    "projects", "tests", "docs", "mkdocs.yml", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md",
    "CITATION.cff", "LICENSE", ".ci", ".gitignore", ".pre-commit-config.yaml", "Dockerfile",
    ".dockerignore", "roofslip.py", "roofslip.cmd", ".gitattributes",
}  # fmt: skip


@pytest.fixture(scope="module")
def tracked():
    """Every tracked file; skipped where there is no git to ask, as in an unpacked archive."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("no git checkout: nothing is tracked here")
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    names = [name for name in listed.stdout.split("\0") if name]
    return [ROOT / name for name in names if (ROOT / name).exists()]


@pytest.mark.quick
def test_benchmarks_and_continuous_integration_are_as_planned():
    """A script finds what is beside it first."""
    tests, bench = ({file.name for file in TESTS.glob(glob)} for glob in ("*.py", "bench/*.py"))
    assert tests.isdisjoint(bench)
    assert "./roofslip test" in (ROOT / ".ci" / "run").read_text()


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The wheel and the sdist, built offline."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "hatchling", "build", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True, timeout=60)
    return folder


def test_wheel_and_sdist_hold_what_is_theirs_and_no_projects(built):
    with zipfile.ZipFile(next(built.glob("*.whl"))) as wheel:
        names = set(wheel.namelist())
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {
        "solver", "report", "roofslip.py"
    }  # fmt: skip
    assert any(re.fullmatch(r"report/templates/.*\.html", name) for name in names)
    assert any(re.fullmatch(r"report/templates/fonts/.*OFL.*", name) for name in names)
    web = ("static/index.html", "static/app.js", "example/input.xlsx", "example/records/RM7-z.csv")
    assert {f"report/web/{name}" for name in web} <= names
    with tarfile.open(next(built.glob("*.tar.gz"))) as sdist:
        names = sdist.getnames()
    assert not [name for name in names if "/projects/" in name and "/projects/example/" not in name]
    assert not [name for name in names if "/projects/example/out" in name]
    assert any(name.endswith("solver/kernels/one_axis.py") for name in names)


def test_the_top_level_is_as_planned_and_every_dependency_imported(tracked):
    assert {path.relative_to(ROOT).parts[0] for path in tracked} <= TOP_LEVEL
    sources = [p.read_text() for p in tracked if p.suffix == ".py" and TESTS not in p.parents]
    lines = {
        line for text in sources for line in re.findall(r"^ *(?:from|import) (\w+)", text, re.M)
    }
    names = map(name_of, PROJECT["project"]["dependencies"])
    assert {name.replace("-", "_") for name in names} <= lines


def name_of(requirement):
    return re.match(r"[\w.-]+", requirement)[0]


def test_every_dependency_is_locked_with_hashes_and_without_addresses():
    lock = (ROOT / "requirements.lock").read_text()
    locked = {m.lower() for m in re.findall(r"^([\w.-]+)==", lock, re.MULTILINE)}
    groups = PROJECT["dependency-groups"]
    extras = PROJECT["project"]["optional-dependencies"].values()
    asked = [*PROJECT["project"]["dependencies"], *groups["dev"], *groups["build"], *chain(*extras)]
    named = [name for name in asked if isinstance(name, str)]
    assert {name_of(name).lower() for name in named} <= locked
    for entry in re.split(r"^(?=[\w.-]+==)", lock, flags=re.MULTILINE)[1:]:
        assert "--hash=sha256:" in entry, entry.splitlines()[0]
    assert "://" not in lock


def test_no_tracked_file_names_a_registry_or_a_path_of_one_machine(tracked):
    hosts = ["py" + "pi.org", "python" + "hosted", "debian" + ".org", "npm" + "js"]
    path = re.compile(r"(?<![\w.])/(?:work|root|home)/\w")
    for file in tracked:
        if file.suffix in {".py", ".md", ".toml", ".lock", ".html", ".css", ".sh", ""}:
            text = file.read_text(errors="replace")
            assert not [host for host in hosts if host in text], file
            assert not path.search(text), file


@pytest.fixture
def launched(tmp_path):
    """A function that runs the launcher where nothing is installed, and returns what it prints."""
    shutil.copytree(ROOT / "docs", tmp_path / "docs")
    for name in ("roofslip", "pyproject.toml", "requirements.lock"):
        shutil.copy(ROOT / name, tmp_path / name)

    def run(*words, program="./roofslip", path=os.environ["PATH"]):
        before = sorted(tmp_path.rglob("*"))
        done = subprocess.run(
            [program, *words],
            cwd=tmp_path,
            env={"PATH": path},
            capture_output=True,
            text=True,
            check=True,
        )
        assert sorted(tmp_path.rglob("*")) == before  # nothing is installed
        assert done.stderr == ""
        return done.stdout

    return run


@pytest.mark.parametrize(
    ("words", "command"),
    [
        (["--help"], "roofslip"),
        (["report", "projects/example", "-h"], "report"),
        (["motion", "--help"], "motion"),
        (["motion", "suite", "--count", "3", "--help"], "motion suite"),
    ],
)
def test_help_needs_nothing_installed(launched, words, command):
    pages = "".join(path.read_text() for path in sorted((ROOT / "docs").glob("commands*.md")))
    (text,) = re.findall(rf"^## {command}\n\n```text\n(.*?)```", pages, re.DOTALL | re.MULTILINE)
    assert launched(*words) == text.replace("Usage: roofslip", "Usage: ./roofslip")


@pytest.mark.quick
def test_the_version_needs_nothing_installed(launched, tmp_path):
    version = PROJECT["project"]["version"]
    assert launched("--version") == f"roofslip, version {version}\n"
    path = f"{tmp_path}:{os.environ['PATH']}"
    assert launched("--help", program=tmp_path / "roofslip", path=path).startswith(
        "Usage: roofslip "
    )


def test_the_image_holds_what_is_installed_and_no_other_project(tracked):
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    rules = [line for line in lines if line and not line.startswith("#")]
    assert rules[0] == "*"
    kept = [rule[1:] for rule in rules if rule.startswith("!")]
    assert {name for name in kept if name.startswith("projects")} == {
        "projects/example", "projects/study",
    }  # fmt: skip
    assert all(list(ROOT.glob(name)) for name in kept)
    targets = PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]
    licenses = PROJECT["project"]["license-files"]
    for name in (*targets["only-include"], "templates", "README.md", *licenses):
        assert any(fnmatch(name, rule) for rule in kept), name


@pytest.mark.parametrize("name", ["roofslip", "tests/bare_debian.sh"])
def test_a_script_of_the_shell_is_posix_sh(name):
    done = subprocess.run(["sh", "-n", str(ROOT / name)], capture_output=True, check=False)
    assert done.returncode == 0
    assert os.access(ROOT / name, os.X_OK)


def test_the_launcher_of_windows_is_as_its_shell_reads_it():
    """It finds no label in a file without its line ends, and reads letters in other code pages."""
    content = (ROOT / "roofslip.cmd").read_bytes()
    assert content.isascii()
    assert content.count(b"\n") == content.count(b"\r\n")
    text = content.decode()
    labels = re.findall(r"^:(\w+)", text, re.MULTILINE)
    jumps = re.findall(r"(?:\bgoto |\bcall :)(\w+)", text)
    assert set(labels) == set(jumps)
    assert len(labels) == len(set(labels))


def test_every_command_that_makes_a_pdf_has_its_libraries_looked_after():
    launcher = (ROOT / "roofslip").read_text()
    names = ("report", "watch", "serve", "study", "verify", "verify-package")
    assert set(names) <= set(main.commands)
    assert f"{' | '.join(names)}) native_libraries" in launcher
