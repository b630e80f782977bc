"""The version: of the commit, from the repository or from the stamp of an archive."""

import io
import os
import re
import shutil
import subprocess
import sys
import zipfile

import pytest

import roofslip
from fixtures import commands
from fixtures.paths import ROOT
from report.provenance import release
from report.provenance.release import of_folder, version

needs_git = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


def git(folder, *words):
    """Run git in a folder, without the settings of this user."""
    named = ("-c", "user.name=a", "-c", "user.email=a@b")
    env = {"PATH": os.environ["PATH"], "GIT_CONFIG_GLOBAL": os.devnull}
    command = ["git", *named, *words]
    return subprocess.run(command, cwd=folder, env=env, capture_output=True, check=True).stdout


def commit(folder, text="0.4.0.dev"):
    """Commit what is in a folder, with another version to come."""
    (folder / "pyproject.toml").write_text(f'[tool.roofslip]\nversion = "{text}"\n')
    git(folder, "add", ".")
    git(folder, "commit", "--quiet", "--allow-empty", "--message", "one")
    return git(folder, "rev-parse", "HEAD").decode()[:8]


@pytest.fixture
def checkout(tmp_path):
    """A repository with the files that the version is of."""
    folder = tmp_path / "checkout"
    folder.mkdir()
    for name in (".git_archival.json", ".gitattributes"):
        shutil.copy(ROOT / name, folder)
    git(folder, "init", "--quiet")
    return folder


@needs_git
def test_a_checkout_has_the_number_of_its_commit_and_the_commit(checkout):
    first, second = commit(checkout), commit(checkout)
    assert first != second
    assert of_folder(checkout) == f"0.4.0.dev2+{second}"
    git(checkout, "tag", "v0.3.0", "HEAD~1")  # a clone may lack it
    assert of_folder(checkout) == f"0.4.0.dev2+{second}"
    (checkout / "input.xlsx").write_text("not of the program")
    assert of_folder(checkout) == f"0.4.0.dev2+{second}"
    (checkout / ".gitattributes").write_text("edited")
    assert of_folder(checkout) == f"0.4.0.dev2+{second}.dirty"
    commit(checkout, "0.4.0")
    assert of_folder(checkout) == "0.4.0"


@needs_git
def test_an_archive_has_its_commit_and_a_copy_without_one_is_unknown(checkout, tmp_path):
    named = commit(checkout)
    archive = tmp_path / "unpacked"
    zipped = git(checkout, "archive", "--format=zip", "HEAD")
    with zipfile.ZipFile(io.BytesIO(zipped)) as files:
        files.extractall(archive)
    assert of_folder(archive) == f"0.4.0.dev+{named}"
    copy = checkout / "copy"  # the repository above it is another one
    shutil.copytree(checkout, copy, ignore=shutil.ignore_patterns(".git", "copy"))
    assert of_folder(copy) == "0.4.0.dev+unknown"


@needs_git
@pytest.mark.parametrize("missing", ["git", "dunamai"])
def test_without_git_or_its_reader_the_commit_is_unknown(checkout, monkeypatch, missing):
    commit(checkout)
    if missing == "git":
        monkeypatch.setenv("PATH", "")
    else:
        monkeypatch.setitem(sys.modules, "dunamai", None)
    assert of_folder(checkout) == "0.4.0.dev+unknown"


@needs_git
def test_the_release_is_the_commit_that_names_it():
    """A later one that did not name the next release would call itself by this one's version."""
    if not (ROOT / ".git").exists() or of_folder(ROOT).count(".dev"):
        pytest.skip("this is a state between releases, or no checkout")
    last = git(ROOT, "log", "-1", "--format=%H", "-G^version = ", "--", "pyproject.toml")
    assert last == git(ROOT, "log", "-1", "--format=%H")


@pytest.mark.quick
def test_tests_and_docs_have_a_fixed_version_and_a_wheel_its_own(monkeypatch, tmp_path):
    fixed = os.environ["ROOFSLIP_VERSION"]
    assert version() == roofslip.__version__ == fixed
    assert commands.stdout_of("--version") == f"roofslip, version {fixed}\n"
    monkeypatch.delenv("ROOFSLIP_VERSION")
    monkeypatch.setattr(release, "FOLDER", tmp_path)  # where packages are installed, no git is
    monkeypatch.setattr(release.metadata, "version", {"roofslip": "0.4.0.dev7+12345678"}.get)
    assert version.__wrapped__() == "0.4.0.dev7+12345678"


def test_starting_the_program_asks_for_no_version():
    told = (
        "import sys; from report.cli.main import main; main(['schema'], standalone_mode=False); "
        "print('dunamai' in sys.modules, file=sys.stderr)"
    )
    env = {name: text for name, text in os.environ.items() if name != "ROOFSLIP_VERSION"}
    done = subprocess.run(
        [sys.executable, "-c", told], cwd=ROOT, env=env, capture_output=True, text=True, check=True
    )
    assert done.stderr == "False\n"


def test_versions_of_this_form_are_those_of_packaging():
    assert re.fullmatch(
        r"\d+\.\d+\.\d+(\.dev\d*\+(unknown|[0-9a-f]{8}(\.dirty)?))?", of_folder(ROOT)
    )
