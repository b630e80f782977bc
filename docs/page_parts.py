"""Makes what calc-package.html has that is made beforehand: fonts, and kernels in WebAssembly.

    .venv/bin/python docs/page_parts.py

Needs LLD (`sudo apt-get install lld-14`). numba compiles the kernels for no processor in
particular, llvmlite takes that to WebAssembly, and LLD links it. The same kernels, versions and
fonts give the same bytes. `kernels.sha256` has the hashes of the file, and of what its kernels say
without comments.
"""

from __future__ import annotations

import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import tokenize
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from fontTools import subset
from fontTools.ttLib import TTFont

ROOT = Path(__file__).resolve().parents[1]
PARTS = ROOT / "templates" / "page-file"
SOURCES = ("one_axis.py", "two_axes.py", "cross_slope.py")
FONTS = {"regular": "SourceSans3-Regular.ttf", "semibold": "SourceSans3-Semibold.ttf"}
# Of letters and signs of the package; of a name in other letters the browser has its own.
LETTERS = [*range(0x20, 0x7F), *range(0xA0, 0x100), *map(ord, "ΔΣθμπφ–—‘’“”†‡•…→←↑↓−≈≤≥×")]
# Numba compiles for this processor and with its vectors unless it is told not to, when imported.
PLAIN = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
}
_OF_PROCESSOR = re.compile(r'"(?:target-cpu|target-features|tune-cpu)"="[^"]*"')
# WebAssembly counts no references: nothing is freed before the next run.
_ATOMIC = re.compile(r"llvm\.x86\.atomic\.(\w+)\.cc\.i64")


def font(name: str) -> bytes:
    """Return a font of the package with its Latin letters alone."""
    whole = TTFont(ROOT / "templates" / "fonts" / name, recalcTimestamp=False)
    options = subset.Options(layout_features=["kern", "lnum", "tnum"], hinting=False)
    cut = subset.Subsetter(options)
    cut.populate(unicodes=LETTERS)
    cut.subset(whole)
    whole.flavor = "woff"
    out = io.BytesIO()
    whole.save(out)
    return out.getvalue()


def linker() -> str | None:
    """Return LLD for WebAssembly, if it is installed: other versions give other bytes."""
    return shutil.which("wasm-ld-14")


def statements(path: Path) -> bytes:
    """Return a module without its comments, docstrings and blank lines."""
    kept, is_begin = [], True
    with path.open("rb") as file:
        for kind, text, *_ in tokenize.tokenize(file.readline):
            if kind in (tokenize.COMMENT, tokenize.NL) or (kind == tokenize.STRING and is_begin):
                continue
            kept.append(text)
            is_begin = kind in (
                tokenize.NEWLINE,
                tokenize.INDENT,
                tokenize.DEDENT,
                tokenize.ENCODING,
            )
    return "\n".join(kept).encode()


def hashes(wasm: bytes) -> str:
    """Return the content of `kernels.sha256`."""
    files = {"kernels.wasm": wasm}
    for name in SOURCES:
        files[f"solver/kernels/{name}"] = statements(ROOT / "solver" / "kernels" / name)
    return "".join(f"{hashlib.sha256(data).hexdigest()}  {name}\n" for name, data in files.items())


def entries() -> Sequence[tuple[Callable[..., None], Any]]:
    """Return the functions of the file, each with its signature; pointers are to 8-byte numbers."""
    from numba import carray, types

    from solver.kernels import cross_slope, one_axis, two_axes

    number, count = types.float64, types.int64
    place = types.CPointer(number)

    def bounds(a, n, out, m):  # type: ignore[no-untyped-def]
        found, into = one_axis.bounds(carray(a, n)), carray(out, (2, m))
        for j in range(m):
            into[0, j], into[1, j] = found[0, j], found[1, j]

    def first_slip(ax, ay, az, n, sn, cs, hold, g, scale, out):  # type: ignore[no-untyped-def]
        x, y, z = carray(ax, n), carray(ay, n), carray(az, n)
        carray(out, 1)[0] = cross_slope.first_slip(x, y, z, sn, cs, hold, g, scale)

    def along(ax, az, x, z, n, m, dt, sn, cs, mu, g, scale, out):  # type: ignore[no-untyped-def]
        a, v, into = carray(ax, n), carray(az, n), carray(out, 9)
        of_a, of_v = carray(x, (2, m)), carray(z, (2, m))
        into[7] = one_axis.minimum_normal(a, v, of_a, of_v, dt, sn, cs, g, scale)[0]
        into[8] = one_axis.rounding(of_a, of_v, dt, sn, cs, mu, g, scale, n)
        run = one_axis.slide_exact(a, v, of_a, of_v, dt, sn, cs, mu, g, scale, None)
        into[0], into[1], into[2], into[3] = run[0], run[1], run[2], run[3]
        into[4], into[5], into[6] = run[4], run[5], run[6]

    def level(ax, x, n, m, dt, sn, cs, mu, g, scale, out):  # type: ignore[no-untyped-def]
        a, into, of_a = carray(ax, n), carray(out, 9), carray(x, (2, m))
        into[7] = one_axis.minimum_normal(a, None, of_a, None, dt, sn, cs, g, scale)[0]
        into[8] = one_axis.rounding(of_a, None, dt, sn, cs, mu, g, scale, n)
        run = one_axis.slide_exact(a, None, of_a, None, dt, sn, cs, mu, g, scale, None)
        into[0], into[1], into[2], into[3] = run[0], run[1], run[2], run[3]
        into[4], into[5], into[6] = run[4], run[5], run[6]

    def plane(  # type: ignore[no-untyped-def]
        ax, ay, az, x, y, z, n, m, dt, sn, cs, mu, g, scale, step, degree, most,
        events, n_events, samples, n_samples, top, end, out,
    ):  # fmt: skip
        run = two_axes.slide_plane(
            carray(ax, n), carray(ay, n), carray(az, n),
            carray(x, (2, m)), carray(y, (2, m)), carray(z, (2, m)),
            dt, sn, cs, mu, g, scale, step, degree, most, None,
            carray(events, (n_events, 4)), carray(samples, (4, n_samples)),
            carray(top, 7), carray(end, 4),
        )  # fmt: skip
        into = carray(out, 5)
        into[0], into[1], into[2], into[3], into[4] = run

    def law(  # type: ignore[no-untyped-def]
        ax, ay, az, x, y, z, n, m, dt, sn, cs, fast, drop, rate, still, g, scale, step, degree,
        most, events, n_events, samples, n_samples, top, end, out,
    ):  # fmt: skip
        run = two_axes.slide_plane(
            carray(ax, n), carray(ay, n), carray(az, n),
            carray(x, (2, m)), carray(y, (2, m)), carray(z, (2, m)),
            dt, sn, cs, 1.0, g, scale, step, degree, most, (fast, drop, rate, still),
            carray(events, (n_events, 4)), carray(samples, (4, n_samples)),
            carray(top, 7), carray(end, 4),
        )  # fmt: skip
        into = carray(out, 5)
        into[0], into[1], into[2], into[3], into[4] = run

    records = (place, place, place)
    to_tolerance = (number, count, count, place, count, place, count, place, place, place)
    return [
        (bounds, types.void(place, count, place, count)),
        (first_slip, types.void(*records, count, *[number] * 5, place)),
        (along, types.void(*[place] * 4, count, count, *[number] * 6, place)),
        (level, types.void(place, place, count, count, *[number] * 6, place)),
        (plane, types.void(*records, *records, count, count, *[number] * 6, *to_tolerance)),
        (law, types.void(*records, *records, count, count, *[number] * 9, *to_tolerance)),
    ]


def kernels(folder: Path) -> bytes:
    """Return the kernels as WebAssembly; numba was imported with `PLAIN` in its environment."""
    import llvmlite.binding as llvm
    from numba import cfunc

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    target = llvm.Target.from_triple("wasm32-unknown-unknown")
    machine = target.create_target_machine(opt=3, cpu="generic", features="")
    objects = []
    for function, signature in entries():
        name, compiled = function.__name__, cfunc(signature)(function)
        text = compiled._library.get_llvm_str()
        text = re.sub(
            r'target datalayout = ".*"', f'target datalayout = "{machine.target_data}"', text
        )
        text = re.sub(r'target triple = ".*"', 'target triple = "wasm32-unknown-unknown"', text)
        text = _ATOMIC.sub(r"atomic_\1", _OF_PROCESSOR.sub("", text))
        # Written by a newer LLVM than the parser's.
        text = text.replace(" immarg", "").replace("= common ", "= weak ")
        module = llvm.parse_assembly(text)
        module.verify()
        module.get_function(compiled.native_name).name = f"roofslip_{name}"
        objects.append(folder / f"{name}.o")
        objects[-1].write_bytes(machine.emit_object(module))
    exports = [f"--export=roofslip_{function.__name__}" for function, _ in entries()]
    out = folder / "kernels.wasm"
    options = ["--no-entry", "--allow-undefined", "--gc-sections", "--strip-all", "-O2"]
    command = [str(linker()), *options, *exports, "--export=__heap_base", *map(str, objects)]
    subprocess.run([*command, "-o", str(out)], check=True)
    return out.read_bytes()


def main(folder: Path = PARTS) -> None:
    """Write all parts to a folder, else where the product has them."""
    for part, name in FONTS.items():
        (folder / f"{part}.woff").write_bytes(font(name))
    if linker() is None:
        sys.exit("LLD is not installed: sudo apt-get install lld-14; the kernels stay as they are")
    with TemporaryDirectory() as scratch:
        wasm = kernels(Path(scratch))
    (folder / "kernels.wasm").write_bytes(wasm)
    (folder / "kernels.sha256").write_text(hashes(wasm))


if __name__ == "__main__":
    if not PLAIN.items() <= os.environ.items():
        with TemporaryDirectory() as cache:
            fresh = {**os.environ, **PLAIN, "NUMBA_CACHE_DIR": cache, "PYTHONPATH": str(ROOT)}
            sys.exit(subprocess.run([sys.executable, *sys.argv], env=fresh, check=False).returncode)
    main(*map(Path, sys.argv[1:]))
