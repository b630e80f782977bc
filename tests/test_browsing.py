"""What a browser needs is installed by the launcher; without it tests of the page are skipped."""

import shutil
import subprocess
from pathlib import Path

import playwright
import pytest

from browsing import chromium
from places import ROOT

pytestmark = pytest.mark.quick

# Of packages that debootstrap's minbase has: libc6, libgcc-s1, libstdc++6.
IN_MINBASE = {
    "libc.so.6", "libdl.so.2", "libm.so.6", "libpthread.so.0", "librt.so.1", "libgcc_s.so.1",
    "libstdc++.so.6",
}  # fmt: skip


@pytest.fixture(scope="module")
def libraries():
    """Shared libraries of the node of Playwright, which drives the browser."""
    if shutil.which("ldd") is None:
        pytest.skip("no ldd to list libraries")
    node = Path(playwright.__file__).parent / "driver" / "node"
    done = subprocess.run(["ldd", str(node)], capture_output=True, text=True, check=True)
    return {line.split()[0] for line in done.stdout.splitlines() if "=>" in line}


def test_the_launcher_looks_after_every_library_that_a_bare_debian_lacks(libraries):
    launcher = (ROOT / "roofslip").read_text()
    assert "libc.so.6" in libraries
    assert not [name for name in libraries - IN_MINBASE if f"{name}=" not in launcher]


def test_missing_libraries_and_browsers_are_told_with_what_to_install(
    monkeypatch, tmp_path, libraries
):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(pytest.skip.Exception, match="apt-get install chromium"), chromium():
        pass
    if "libatomic.so.1" not in libraries:
        pytest.skip("the node of Playwright does without libatomic here")
    (tmp_path / "chromium").touch(0o755)  # is not started
    (tmp_path / "libatomic.so.1").touch()  # empty: cannot be loaded
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("LD_LIBRARY_PATH", str(tmp_path))
    with pytest.raises(pytest.skip.Exception, match="apt-get install libatomic1"), chromium():
        pass
