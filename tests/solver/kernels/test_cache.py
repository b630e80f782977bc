"""Compiled kernels on disk: an edited one never runs stale, and a closed folder does no harm."""

import os
import shutil
import subprocess
import sys

import pytest

from places import ROOT

RUN = (
    "import numpy as np; from copied import one_axis as kernels; "
    "a = np.array([0.0, 4.0, 0.0, 0.0]); a.setflags(write=False); x = kernels.bounds(a); "
    "print(kernels.least_normal(a, None, x, None, 0.1, 0.0, 1.0, 9.8, 1.0)[0])"
)


@pytest.fixture
def copied(tmp_path):
    """A package of the kernels alone, and what runs one of them in a fresh process."""
    folder = tmp_path / "copied"
    folder.mkdir()
    (folder / "__init__.py").touch()
    shutil.copy(ROOT / "solver" / "kernels" / "one_axis.py", folder)

    def run():
        done = subprocess.run(
            [sys.executable, "-c", RUN],
            cwd=tmp_path,
            env=os.environ | {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache")},
            capture_output=True,
            text=True,
            check=True,
            timeout=60,
        )
        return float(done.stdout)

    return folder, run


def test_an_edited_kernel_is_compiled_again(copied):
    folder, run = copied
    assert run() == 1.0
    assert list(folder.glob("__pycache__/*.nbc"))
    source = folder / "one_axis.py"
    edited = source.read_text().replace(
        "return -most / g, np.nan", "return -2.0 * most / g, np.nan"
    )
    assert edited != source.read_text()
    source.write_text(edited)
    assert run() == 2.0


def test_an_install_that_cannot_be_written_keeps_its_cache_elsewhere(copied, tmp_path):
    folder, run = copied
    (folder / "__pycache__").write_text("a file where the folder would be: nothing can be written")
    assert run() == 1.0
    assert list((tmp_path).glob("**/*.nbc"))
    assert (folder / "__pycache__").is_file()
