"""What is shipped and locked; what `import roofslip` offers; the launcher, its set-up and tests."""

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

import report
import roofslip
import solver
from fixtures import packages
from fixtures.commands import no_override
from fixtures.marks import by_day
from fixtures.paths import ROOT, TESTS
from report.cli.main import main

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
TOP_LEVEL = {
    "pyproject.toml", "requirements.lock", "README.md", "roofslip", "solver", "report", "templates",
    "projects", "tests", "docs", "mkdocs.yml", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md",
    "CITATION.cff", "LICENSE", ".ci", ".gitignore", ".pre-commit-config.yaml", "Dockerfile",
    ".dockerignore", "roofslip.py", "roofslip.cmd", ".gitattributes", ".git_archival.json",
    ".github",
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


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The wheel and the sdist."""
    return packages.built(tmp_path_factory)


def test_wheel_and_sdist_hold_what_is_theirs_and_no_projects(built):
    with zipfile.ZipFile(next(built.glob("*.whl"))) as wheel:
        names = set(wheel.namelist())
    tops = {name.split("/")[0] for name in names}
    ours = {top for top in tops if not top.endswith(".dist-info")}
    assert ours == {"solver", "report", "roofslip.py"}
    assert any(re.fullmatch(r"report/templates/.*\.html", name) for name in names)
    assert any(re.fullmatch(r"report/templates/fonts/.*OFL.*", name) for name in names)
    web = (
        "static/index.html",
        "static/app.js",
        "example/input.xlsx",
        "example/records/RM7-z.csv",
        "example/documents/hazard.pdf",
    )
    assert {f"report/web/{name}" for name in web} <= names
    with tarfile.open(next(built.glob("*.tar.gz"))) as sdist:
        names = sdist.getnames()
    assert not [name for name in names if "/projects/" in name and "/projects/example/" not in name]
    assert not [name for name in names if "/projects/example/out" in name]
    for held in ("solver/kernels/one_axis.py", "projects/example/documents/hazard.pdf"):
        assert any(name.endswith(held) for name in names)


def test_the_top_level_and_benchmarks_are_as_planned_and_every_dependency_imported(tracked):
    assert {path.relative_to(ROOT).parts[0] for path in tracked} <= TOP_LEVEL
    sources = [p.read_text() for p in tracked if p.suffix == ".py" and TESTS not in p.parents]
    lines = {
        line for text in sources for line in re.findall(r"^ *(?:from|import) (\w+)", text, re.M)
    }
    names = map(name_of, PROJECT["project"]["dependencies"])
    assert {name.replace("-", "_") for name in names} <= lines
    tests, bench = ({file.name for file in TESTS.glob(glob)} for glob in ("*.py", "bench/*.py"))
    assert tests.isdisjoint(bench)
    assert "./roofslip test" in (ROOT / ".ci" / "run").read_text()


def test_the_subjects_of_commits_fit_a_line(tracked):
    """Of those after November 2026: some before are longer."""
    log = ["git", "log", "--since=2026-12-01", "--no-merges", "--format=%s"]
    said = subprocess.run(log, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert [subject for subject in said.splitlines() if len(subject) > 72] == []


def test_files_of_tests_have_names_of_their_own():
    """Of two with one name pytest refuses the second, and all others with it."""
    names = [path.name for path in TESTS.rglob("test_*.py")]
    assert [name for name in set(names) if names.count(name) > 1] == []


def name_of(requirement):
    return re.match(r"[\w.-]+", requirement)[0]


def test_every_dependency_is_locked_with_hashes_and_without_addresses():
    lock = (ROOT / "requirements.lock").read_text()
    locked = {m.lower() for m in re.findall(r"^([\w.-]+)==", lock, re.MULTILINE)}
    groups = PROJECT["dependency-groups"]
    extras = PROJECT["project"]["optional-dependencies"].values()
    sets = (groups[name] for name in ("build", "test", "docs", "launch"))
    asked = [*PROJECT["project"]["dependencies"], *chain(*extras), *chain(*sets)]
    named = [name for name in asked if isinstance(name, str)]
    assert {name_of(name).lower() for name in named} <= locked
    # From there it follows no link, and up to there it removes the file that it locks.
    assert "filelock>=3.20.3,<3.26" in PROJECT["project"]["dependencies"]
    for entry in re.split(r"^(?=[\w.-]+==)", lock, flags=re.MULTILINE)[1:]:
        assert "--hash=sha256:" in entry, entry.splitlines()[0]
    assert "://" not in lock


def test_no_tracked_file_names_a_registry_or_machine_and_the_image_no_other_project(tracked):
    hosts = ["py" + "pi.org", "python" + "hosted", "debian" + ".org", "npm" + "js"]
    path = re.compile(r"(?<![\w.])/(?:work|root|home)/\w")
    for file in tracked:
        if file.suffix in {".py", ".md", ".toml", ".lock", ".html", ".css", ".sh", ""}:
            text = file.read_text(errors="replace")
            assert not [host for host in hosts if host in text], file
            assert not path.search(text), file
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    rules = [line for line in lines if line and not line.startswith("#")]
    assert rules[0] == "*"
    kept = [rule[1:] for rule in rules if rule.startswith("!")]
    projects = {name for name in kept if name.startswith("projects")}
    assert projects == {"projects/example", "projects/study"}
    assert all(list(ROOT.glob(name)) for name in kept)
    targets = PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]
    licenses = PROJECT["project"]["license-files"]
    for name in (*targets["only-include"], "templates", "README.md", *licenses):
        assert any(fnmatch(name, rule) for rule in kept), name


@pytest.fixture
def launched(tmp_path):
    """A function that runs the launcher where nothing is installed, and returns what it prints."""
    shutil.copytree(ROOT / "docs", tmp_path / "docs")
    for name in ("roofslip", "pyproject.toml", "requirements.lock"):
        shutil.copy(ROOT / name, tmp_path / name)

    def run(*words, program="./roofslip", path=os.environ["PATH"]):
        before = sorted(tmp_path.rglob("*"))
        command, env = [program, *words], {"PATH": path}
        done = subprocess.run(
            command, cwd=tmp_path, env=env, capture_output=True, text=True, check=True
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
        (["motion", "suite", "--count", "3", "--help"], "motion suite"),
        (["test", "tests/solver", "--help"], "test"),
        (["completion", "zsh"], "completion-zsh"),
    ],
)
def test_help_needs_nothing_installed(launched, words, command):
    text = (ROOT / "docs" / "help" / f"{command.replace(' ', '-')}.txt").read_text()
    assert launched(*words) == text.replace("Usage: roofslip", "Usage: ./roofslip")


@pytest.mark.quick
def test_the_version_needs_nothing_installed(launched, tmp_path):
    version = PROJECT["tool"]["roofslip"]["version"]
    assert launched("--version") == f"roofslip, version {version}\n"
    path = f"{tmp_path}:{os.environ['PATH']}"
    told = launched("--help", program=tmp_path / "roofslip", path=path)
    assert told.startswith("Usage: roofslip ")


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


SLIDE = "roofslip.slide([0, 4, -4, 0, 0, 0], 0.1, slope_rad=0, mu=0.2)"
SLID = f"import roofslip; print({SLIDE}.status)"


def run(folder, program):
    """Run a program in a folder, whose modules it finds first."""
    path = [folder, ROOT]
    told = f"import sys; sys.path[:0] = {list(map(str, path))}; {program}"
    command = [sys.executable, "-P", "-c", told]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_a_hidden_package_is_named_and_every_public_name_offered(tmp_path):
    assert set(dir(roofslip)) == {*solver.__all__, *report.__all__}
    for package in (solver, report):
        for name in package.__all__:
            assert getattr(roofslip, name) is getattr(package, name), name
    (tmp_path / "report").mkdir()
    places = {"solver": tmp_path / "solver.py", "report": tmp_path / "report" / "__init__.py"}
    for name, place in places.items():
        place.write_text("")
        done = run(tmp_path, f"import {name}; {SLID}")
        said = "hides a package of Roofslip: rename it, or import roofslip first"
        assert done.stderr.endswith(f"ImportError: {place} {said}\n")


@pytest.mark.nightly
def test_a_file_beside_a_notebook_hides_neither_package(tmp_path):
    for name in ("solver", "report"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('the wrong one')\n")
    assert "the wrong one" in run(tmp_path, "import solver").stderr
    assert run(tmp_path, SLID).stdout == "ok\n"


def test_the_launcher_looks_for_no_package_where_it_is_called_and_for_libraries_of_pdfs():
    launcher = (ROOT / "roofslip").read_text()
    run = re.findall(r'"\$venv/bin/python" (?:-P )?(?:-m|"\$venv)', launcher)
    assert len(run) == 3
    assert all(" -P " in call for call in run)
    assert '"$venv/bin/roofslip" "$@"' in launcher
    names = ("report", "watch", "serve", "study", "verify", "verify-package")
    assert set(names) <= set(main.every())
    assert f"case $1 in {' | '.join(names)} | test)\n    look_up libpango" in launcher


TOOLS = (
    "uv", "python", "apt-get", "ldconfig", "ruff", "codespell", "oxlint", "mypy", "lint-imports",
    "hadolint", "pytest", "coverage", "sudo",
)  # fmt: skip


NOTING = """#!/bin/sh
for last; do :; done
echo "$(basename -- "$0") $*" >>"$ROOM/seen"
others=${PYTHONHOME-}${PYTHONINSPECT-}${PYTHONPLATLIBDIR-}${UV_SYSTEM_PYTHON-}${UV_PYTHON-}${PIP_TARGET-}
echo "$PWD: ${PYTHONPATH-no path} $others" >>"$ROOM/where"
[ "$(basename -- "$0") $1" != "uv venv" ] || { mkdir -p "$last" && cp -R "$ROOM/bin" "$last"; }
"""


def launcher(tmp_path, name="copy", stamp=""):
    """A copy of the launcher, in a room with tools that only note how they are called."""
    folder = tmp_path / name / "checkout"
    for bin_ in (folder / ".venv" / "bin", folder.parent / "bin"):
        bin_.mkdir(parents=True)
        for tool in TOOLS:
            (bin_ / tool).write_text(NOTING)
            (bin_ / tool).chmod(0o755)
    for file in ("roofslip", "pyproject.toml", "requirements.lock", "tests/run.sh"):
        (folder / file).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / file, folder / file)
    (folder / ".venv" / ".set-up-from").write_text(stamp)
    return folder


def failing(folder, tool, condition="false"):
    """Have a tool fail, after it has noted how it is called."""
    for bin_ in (folder / ".venv" / "bin", folder.parent / "bin"):
        (bin_ / tool).write_text(f"{NOTING}{condition}\n")


def called(folder, *words, program=None, **more):
    """Call the launcher; return how it ends."""
    path = f"{folder.parent / 'bin'}:{os.environ['PATH']}"
    env = {"PATH": path, "ROOM": str(folder.parent), **more.pop("env", {})}
    command = [program or folder / "roofslip", *(words or ("check", "x"))]
    return subprocess.run(command, env=env, capture_output=True, text=True, check=False, **more)


def calls(folder):
    """What the tools were called with until now."""
    path = folder.parent / "seen"
    return path.read_text().splitlines() if path.exists() else []


def calls_of(folder, *words, status=0, **more):
    before = len(calls(folder))
    done = called(folder, *words, **more)
    assert done.returncode == status, done.stderr
    return calls(folder)[before:]


def test_the_launcher_follows_its_own_link(tmp_path):
    folder = launcher(tmp_path)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "one").symlink_to("two")
    (tmp_path / "bin" / "two").symlink_to("../copy/checkout/roofslip")
    run = f"python -P {folder}/.venv/bin/roofslip check x"
    assert calls_of(folder, program=tmp_path / "bin" / "one")[-1] == run


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (["stdy", "x"], 2, "roofslip: no such command 'stdy'; "),
        (["study", "no.xlsx"], 1, "no.xlsx: no such file or folder"),
        (["slide"], 2, "roofslip slide [OPTIONS] RECORD\n"),
        (["report"], 2, "roofslip report [OPTIONS] DIR|WORKBOOK...\n"),
        (["motion"], 2, "roofslip motion [OPTIONS] COMMAND [ARGS]...\n"),
        (["motion", "info"], 2, "roofslip motion info [OPTIONS] FILE\n"),
        (["completion"], 2, "roofslip completion [OPTIONS] {bash|zsh|fish}\n"),
        (["motion", "rows", "x", "--without"], 0, ""),
        (["verify", "--quick"], 0, ""),
        (["check", "--", "-h"], 0, ""),
    ],
)
def test_the_launcher_checks_arguments_before_it_installs_anything(tmp_path, words, status, said):
    folder = launcher(tmp_path)
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("pictures"))
    done = called(folder, *words, cwd=folder)
    assert (done.returncode, said in done.stderr) == (status, True), done.stderr
    assert any(call.startswith("uv ") for call in calls(folder)) == (status == 0)


def test_a_shell_that_completes_a_word_is_answered_by_the_program_once_it_is_set_up(tmp_path):
    folder = launcher(tmp_path)
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("pictures"))
    complete = {"_ROOFSLIP_COMPLETE": "bash_complete"}
    assert (called(folder, "--help", env=complete).stdout, calls(folder)) == ("", [])
    calls_of(folder, "schema")
    run = f"python -P {folder}/.venv/bin/roofslip --help"
    assert calls_of(folder, "--help", env=complete) == [run]
    assert calls_of(folder, "--help") == []


def test_an_environment_that_was_copied_runs_the_code_where_it_is_with_all_of_its_sets(tmp_path):
    folder = launcher(tmp_path)
    shutil.rmtree(folder / ".venv")
    first = calls_of(folder, "study", "x")
    assert any(call.startswith("uv venv --quiet --allow-existing ") for call in first)
    assert calls_of(folder) == [f"python -P {folder}/.venv/bin/roofslip check x"]
    other = launcher(tmp_path, "other", stamp=(folder / ".venv" / ".set-up-from").read_text())
    again = calls_of(other)
    assert not any(call.startswith("uv venv") for call in again)
    assert any("--extra study -r" in call for call in again)
    assert any(call.endswith(f"-e {other}") for call in again)


SETS = {
    "report": ["check", "x"], "web": ["serve"], "verify": ["verify"], "sign": ["sign", "x"],
    "study": ["study", "x"], "test": ["test", "x"], "seismic": ["motion", "info", "x.mseed"],
    "night": ["test", "--nightly"],
}  # fmt: skip

HAVE = {
    "test": {"web", "verify", "sign", "study"},
    "seismic": {"web", "verify", "sign", "study"},
    "night": {"web", "verify", "sign", "study", "seismic"},
}
"""Beside what `report` needs, the sets that have others."""


@pytest.mark.parametrize("had", by_day(SETS, 3))
def test_a_set_that_is_there_is_enough_and_is_kept_and_another_one_is_added_to_it(tmp_path, had):
    folder = launcher(tmp_path)
    stamp = folder / ".venv" / ".set-up-from"
    calls_of(folder, *SETS[had])
    first = stamp.read_text()
    for need, words in SETS.items():
        stamp.write_text(first)
        installing = [call for call in calls_of(folder, *words) if call.startswith("uv pip ")]
        is_there = need in {had, "report"} | HAVE.get(had, set())
        assert bool(installing) != is_there, need
        assert stamp.read_text().startswith(first)
        for extra in re.findall(r"--extra \w+", first) if installing else ():
            assert extra in installing[0]


def test_a_set_up_that_fails_leaves_what_was_set_up(tmp_path):
    folder = launcher(tmp_path)
    calls_of(folder)
    stamp = folder / ".venv" / ".set-up-from"
    before = stamp.read_text()
    failing(folder, "uv", '[ "$2" != install ]')
    done = called(folder, "verify")
    assert done.returncode == 1
    assert "the packages for verify could not be installed: connect to the network" in done.stderr
    assert done.stderr.endswith("The existing installation still works\n")
    assert stamp.read_text() == before
    assert calls_of(folder) == [f"python -P {folder}/.venv/bin/roofslip check x"]
    failing(folder, "uv", "true")
    assert not [call for call in calls_of(folder, "verify") if call.startswith("uv venv")]
    assert stamp.read_text() == f"{before} --extra verify"
    assert calls_of(folder) == [f"python -P {folder}/.venv/bin/roofslip check x"]


def test_settings_of_uv_and_pip_lead_no_package_elsewhere(tmp_path):
    folder = launcher(tmp_path)
    env = {"UV_SYSTEM_PYTHON": "1", "UV_PYTHON": "3.9", "PIP_TARGET": "elsewhere"}
    installed = [call for call in calls_of(folder, env=env) if call.startswith("uv pip ")]
    assert len(installed) == 2
    assert all(f"--python {folder}/.venv " in call for call in installed)
    *set_up, _ = (folder.parent / "where").read_text().splitlines()
    assert set(set_up) == {f"{folder}: no path "}


@pytest.mark.parametrize("name", [".", ".venv"])
def test_what_cannot_be_written_is_named_before_anything_is_downloaded(tmp_path, name):
    folder = launcher(tmp_path)
    calls_of(folder)
    before = len(calls(folder))
    closed = folder / name
    closed.chmod(0o555)
    try:
        done = called(folder, "verify", preexec_fn=no_override)
        ready = called(folder, preexec_fn=no_override)
    finally:
        closed.chmod(0o755)
    assert done.returncode == 1
    told = f"packages for verify are not installed, and {folder}/.venv cannot be written: have its"
    assert told in done.stderr
    assert ready.returncode == 0
    run = f"python -P {folder}/.venv/bin/roofslip check x"
    assert calls(folder)[before:] == [run]


@pytest.mark.skipif(sys.platform != "linux", reason="they are looked up as on Linux")
def test_system_packages_are_looked_for_before_anything_is_downloaded(tmp_path):
    folder = launcher(tmp_path)
    for tool in ("apt-get", "sudo"):
        failing(folder, tool)
    done = called(folder, "report", "x")
    assert done.returncode == 1
    assert "Run: sudo apt-get install libpango-1.0-0 libpangoft2-1.0-0 " in done.stderr
    assert "check, slide and motion do without them" in done.stderr
    assert not [call for call in calls(folder) if call.startswith("uv ")]


def test_the_launchers_install_with_the_same_version_of_uv(tmp_path):
    lock = (ROOT / "requirements.lock").read_text()
    (uv,) = re.findall(r"^uv==(\S+)((?: \\\n +--hash=sha256:\w+)+)", lock, re.MULTILINE)
    windows = (ROOT / "roofslip.cmd").read_text()
    assert f'set "version={uv[0]}"' in windows
    assert re.search(r"uv==%version% --hash=(\S+)", windows)[1] in uv[1]
    folder = launcher(tmp_path)
    (folder.parent / "bin" / "uv").unlink()
    (folder.parent / "bin" / "python3").write_text(f'{NOTING}cat >"$ROOM/given"\n')
    (folder.parent / "bin" / "python3").chmod(0o755)
    called(folder, stdin=subprocess.DEVNULL, env={"PATH": f"{folder.parent / 'bin'}:/usr/bin:/bin"})
    assert any("pip install -qq --require-hashes " in call for call in calls(folder))
    assert (folder.parent / "given").read_text() == f"uv=={uv[0]}{uv[1]}\n"


@pytest.mark.parametrize(
    ("words", "chosen"),
    [
        ([], "-m not nightly"),
        (["--quick"], "-m quick and not nightly"),
        (["-x", "tests/solver"], "-x tests/solver"),
        (["--nightly", "tests/solver"], "-m nightly tests/solver"),
    ],
)
def test_the_launcher_runs_the_tests_of_a_path_a_day_or_a_minute(tmp_path, words, chosen):
    folder = launcher(tmp_path)
    run = f"pytest --numprocesses 2 --dist worksteal {chosen}"
    assert calls_of(folder, "test", *words)[-1] == run


@pytest.mark.parametrize("part", ["run", "report", "none"])
def test_the_night_fails_where_a_test_or_the_coverage_does(tmp_path, part):
    folder = launcher(tmp_path)
    failing(folder, "coverage", f'[ "$1" != {part} ]')
    seen = calls_of(folder, "test", "--nightly", status=int(part != "none"))
    done = [call.split()[1] for call in seen if call.startswith("coverage ")]
    assert done == ["erase", "run", "run", "combine", "report", "report"]
    assert seen[-1] == "coverage report"


def test_the_launcher_takes_nothing_from_where_it_is_called(tmp_path):
    """Tools of the set-up take modules and settings of the current folder, and so does a path."""
    folder, here = launcher(tmp_path), tmp_path / "here"
    here.mkdir()
    others = {"PYTHONHOME": "/opt/other", "PYTHONINSPECT": "1", "PYTHONPLATLIBDIR": "lib32"}
    calls_of(folder, cwd=here, env={"PYTHONPATH": f"{ROOT}:", **others})
    *set_up, last = (folder.parent / "where").read_text().splitlines()
    assert (set(set_up), last) == ({f"{folder}: no path "}, f"{here}: no path ")


@pytest.mark.parametrize("tool", ["ruff", "lint-imports"])
def test_what_a_linter_finds_ends_the_tests(tmp_path, tool):
    folder = launcher(tmp_path)
    failing(folder, tool)
    assert calls_of(folder, "test", status=1)[-1].startswith(tool)
