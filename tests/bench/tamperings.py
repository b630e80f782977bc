"""Sixty seeded ways to tamper with a package, each by the command: none may be called the same.

Run from the top: .venv/bin/python tests/bench/tamperings.py [COUNT] [PROJECT ...]
"""

from __future__ import annotations

import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))


def verified(path: Path) -> int:
    """Return the exit code of `roofslip verify-package`."""
    command = [sys.executable, "-m", "report.cli", "verify-package", str(path), "--quiet"]
    return subprocess.run(command, cwd=ROOT, capture_output=True, check=False).returncode


def reported(name: str, out: str) -> bytes:
    """Return the package of a project."""
    project = str(ROOT / "projects" / name)
    command = [sys.executable, "-m", "report.cli", "report", project, "--out", out, "--quiet"]
    subprocess.run(command, cwd=ROOT, check=True)
    return (Path(out) / "calc-package.pdf").read_bytes()


def main() -> None:
    """Verify each package, then tamper with them in turn, and print what was found."""
    import tampering

    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    names = sys.argv[2:] or sorted(p.parent.name for p in ROOT.glob("projects/*/input.xlsx"))
    kinds = (*tampering.OF_THE_FILE, *tampering.OF_THE_INPUT, *tampering.OF_THE_SOFTWARE)
    missed, codes = [], Counter()
    with tempfile.TemporaryDirectory() as out:
        given = Path(out) / "given.pdf"
        packages = {name: reported(name, out) for name in names}
        for name, data in packages.items():
            given.write_bytes(data)
            print(f"{name:12} as written: exit code {verified(given)}", flush=True)
        for seed in range(count):
            kind, name = kinds[seed % len(kinds)], names[seed // len(kinds) % len(names)]
            given.write_bytes(kind(packages[name], random.Random(seed)))
            code = verified(given)
            codes[kind.__name__, code] += 1
            print(f"{seed:12} {kind.__name__}: exit code {code}", flush=True)
            # Other versions may draw otherwise: then it is said that this was not compared.
            may_be_drawn = kind is tampering.drawn_otherwise
            if code not in ((2, 3, 4) if may_be_drawn else (2, 3)):
                missed.append((seed, kind.__name__, name, code))
    for (kind_name, code), found in sorted(codes.items()):
        print(f"{kind_name:22} exit code {code}: {found}")
    print(f"{count - len(missed)} of {count} found; missed: {missed or 'none'}")
    sys.exit(bool(missed))


if __name__ == "__main__":
    main()
