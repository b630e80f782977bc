"""Compiled kernels on disk: an edited one never runs stale, and a closed folder does no harm.

Nor does a numba that is not among the versions tried.
"""

import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
import test_row_kernel
import test_two_axes_kernel

from fixtures.paths import ROOT
from solver.kernels import row

pytestmark = pytest.mark.nightly

RUN = (
    "import numpy as np; from solver.kernels import one_axis as kernels; "
    "a = np.array([0.0, 4.0, 0.0, 0.0]); a.setflags(write=False); "
    "x = np.array([[0.0] * 3, [4.0] * 3]); "  # its bounds: one kernel less to compile
    "print(kernels.minimum_normal(a, None, x, None, 0.1, 0.0, 1.0, 9.8, 1.0)[0])"
)
NO_FOLDER = "a file where the folder would be: nothing can be written there"


@pytest.fixture
def copied(tmp_path):
    """A copy of the solver, and what runs one of them in a fresh process."""
    without_cache = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "solver", tmp_path / "solver", ignore=without_cache)
    folder = tmp_path / "solver" / "kernels"

    def run(warns="", *flags, program=RUN, **options):
        done = subprocess.run(
            [sys.executable, *flags, "-c", program],
            cwd=tmp_path,
            env=os.environ | {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache")},
            capture_output=True,
            text=True,
            check=True,
            timeout=120,
            **options,
        )
        assert warns in done.stderr
        assert done.stderr.count("UserWarning") == bool(warns), done.stderr
        return float(done.stdout)

    return folder, run


def test_an_edited_kernel_is_compiled_again_whatever_others_are_kept(copied):
    folder, run = copied
    assert run() == 1.0
    assert list(folder.glob("__pycache__/*.nbc"))
    source, former = folder / "one_axis.py", "return -most / g, np.nan"
    assert former in source.read_text()
    source.write_text(source.read_text().replace(former, "return -2.0 * most / g, np.nan"))
    assert run() == 2.0
    _, run = copied
    run()
    kept = "compiler.is_compiled({})".format
    program = (
        "from solver.kernels import compiler, one_axis, two_axes; "
        f"print({kept('one_axis.minimum_normal')} - 2 * {kept('two_axes.slide_plane')})"
    )
    assert run(program=program) == 1.0


@pytest.mark.parametrize("kept", [0.0, 0.3, 0.5, 0.999])
@pytest.mark.parametrize("suffix", ["nbi", "nbc"])
def test_compiled_code_that_is_empty_or_cut_is_compiled_again(copied, suffix, kept):
    folder, run = copied
    assert run() == 1.0
    files = list(folder.glob(f"__pycache__/*.{suffix}"))
    assert files
    for path in files:
        path.write_bytes(path.read_bytes()[: int(kept * path.stat().st_size)])
    damaged = {path: path.read_bytes() for path in files}
    assert (run(), run()) == (1.0, 1.0)
    assert all(path.read_bytes() != damaged[path] for path in files)


def test_without_any_folder_for_its_cache_a_run_goes_on_and_says_how_to_keep_it(copied, tmp_path):
    folder, run = copied
    (folder / "__pycache__").write_text(NO_FOLDER)
    (tmp_path / "cache").write_text(NO_FOLDER)
    assert run("no folder for it can be written), so every run compiles it again; set the") == 1.0
    (tmp_path / "cache").unlink()
    assert run() == 1.0
    assert list(tmp_path.glob("**/*.nbc"))
    assert (folder / "__pycache__").is_file()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows limits no file of a process")
def test_on_a_full_disk_a_run_goes_on_and_says_how_to_keep_its_cache(copied):
    import resource

    _, run = copied
    full = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))}
    # -B: bytecode that Python itself keeps on a full disk may be cut short (CPython gh-126606).
    assert run("(File too large), so every run compiles it again; set the", "-B", **full) == 1.0
    assert (run(), run()) == (1.0, 1.0)


SETTINGS = "import os; open('.numba_config.yaml', 'w').write('cache_dir: brought'); "


@pytest.mark.parametrize(
    "before", [SETTINGS, f"import solver.kernels.one_axis; {SETTINGS}", ""], ids=["", "later", "no"]
)
@pytest.mark.parametrize("chosen", ["", "mine"])
def test_compiled_code_is_kept_where_the_user_says_and_not_where_a_file_says(
    copied, tmp_path, monkeypatch, before, chosen
):
    """A cache holds code that is run: the file of the current folder may be a stranger's."""
    _, run = copied
    if chosen:
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / chosen))
    assert run(program=before + RUN) == 1.0
    (place,) = {path.relative_to(tmp_path).parts[0] for path in tmp_path.glob("**/*.nbc")}
    assert place == (chosen or "solver")


UNTRIED = """
import sys
sys.path += {paths}
import numpy as np, test_row_kernel, test_two_axes_kernel
from solver.kernels import compiler, row
assert not compiler.UNCOUNTED
np.save("row.npy", test_row_kernel.run_all(row.slide_row))
np.save("plane.npy", test_two_axes_kernel.run_all())
print(1.0)
"""


def test_a_numba_that_was_not_tried_finds_the_same_motions(copied, tmp_path):
    """Its functions count references, and no undocumented option is asked for."""
    folder, run = copied
    source = folder / "compiler.py"
    tried = re.sub(r"^TRIED = .*$", 'TRIED = ("0.1",)', source.read_text(), flags=re.MULTILINE)
    source.write_text(tried)
    run(program=UNTRIED.format(paths=sys.path))
    found = test_row_kernel.run_all(row.slide_row), test_two_axes_kernel.run_all()
    np.testing.assert_allclose(np.load(tmp_path / "row.npy"), found[0], rtol=1e-11, atol=1e-13)
    np.testing.assert_array_equal(np.load(tmp_path / "plane.npy"), found[1])
