"""Compiled kernels on disk: an edited one never runs stale, and a closed folder does no harm."""

import os
import resource
import shutil
import subprocess
import sys

import pytest

from places import ROOT

pytestmark = pytest.mark.nightly("solver/kernels/cache.py")

RUN = (
    "import numpy as np; from copied import one_axis as kernels; "
    "a = np.array([0.0, 4.0, 0.0, 0.0]); a.setflags(write=False); "
    "x = np.array([[0.0] * 3, [4.0] * 3]); "  # its bounds: one kernel less to compile
    "print(kernels.minimum_normal(a, None, x, None, 0.1, 0.0, 1.0, 9.8, 1.0)[0])"
)
NO_FOLDER = "a file where the folder would be: nothing can be written there"


@pytest.fixture
def copied(tmp_path):
    """A package of the kernels alone, and what runs one of them in a fresh process."""
    folder = tmp_path / "copied"
    folder.mkdir()
    (folder / "__init__.py").write_text("from copied import cache")
    for name in ("cache", "one_axis"):
        shutil.copy(ROOT / "solver" / "kernels" / f"{name}.py", folder)

    def run(warns="", *flags, **options):
        done = subprocess.run(
            [sys.executable, *flags, "-c", RUN],
            cwd=tmp_path,
            env=os.environ | {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache")},
            capture_output=True,
            text=True,
            check=True,
            timeout=60,
            **options,
        )
        assert warns in done.stderr
        assert done.stderr.count("UserWarning") == bool(warns), done.stderr
        return float(done.stdout)

    return folder, run


def test_an_edited_kernel_is_compiled_again(copied):
    folder, run = copied
    assert run() == 1.0
    assert list(folder.glob("__pycache__/*.nbc"))
    source, former = folder / "one_axis.py", "return -most / g, np.nan"
    assert former in source.read_text()
    source.write_text(source.read_text().replace(former, "return -2.0 * most / g, np.nan"))
    assert run() == 2.0


def test_an_install_that_cannot_be_written_keeps_its_cache_elsewhere(copied, tmp_path):
    folder, run = copied
    (folder / "__pycache__").write_text(NO_FOLDER)
    assert run() == 1.0
    assert list(tmp_path.glob("**/*.nbc"))
    assert (folder / "__pycache__").is_file()


def test_without_any_folder_for_its_cache_a_run_goes_on_and_says_how_to_keep_it(copied, tmp_path):
    folder, run = copied
    (folder / "__pycache__").write_text(NO_FOLDER)
    (tmp_path / "cache").write_text(NO_FOLDER)
    assert run("no folder for it can be written), so every run compiles it again; set the") == 1.0
    (tmp_path / "cache").unlink()
    assert run() == 1.0


def test_on_a_full_disk_a_run_goes_on_and_says_how_to_keep_its_cache(copied):
    _, run = copied
    full = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))}
    # -B: bytecode that Python itself keeps on a full disk may be cut short (CPython gh-126606).
    assert run("(File too large), so every run compiles it again; set the", "-B", **full) == 1.0
    assert (run(), run()) == (1.0, 1.0)
