"""Counts the lines of the core by folder, and of its extras.

    .venv/bin/python docs/core.py

An extra is what a contract of `pyproject.toml` named so protects; the core is all the rest of
`solver` and `report`. Lines are those of Python, with comments and blanks. `docs/architecture.md`
has the table as it was printed last.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
_EXTRA = "Extra: "


def extras() -> dict[str, list[str]]:
    """Return the modules and packages of each extra, by its name."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        contracts = tomllib.load(file)["tool"]["importlinter"]["contracts"]
    return {
        each["name"].removeprefix(_EXTRA): each["protected_modules"]
        for each in contracts
        if each["name"].startswith(_EXTRA)
    }


def counted() -> tuple[Counter[str], Counter[str]]:
    """Return the lines of the core by folder, and of the extras by name."""
    names = {module: name for name, modules in extras().items() for module in modules}
    core, beside = Counter[str](), Counter[str]()
    for path in [*ROOT.glob("solver/**/*.py"), *ROOT.glob("report/**/*.py")]:
        parts = path.relative_to(ROOT).with_suffix("").parts
        lines = len(path.read_text(encoding="utf-8").splitlines())
        # A module is protected by its own name or by that of a package above it.
        above = [".".join(parts[:end]) for end in range(1, len(parts) + 1)]
        extra = next((names[module] for module in above if module in names), "")
        if extra:
            beside[extra] += lines
        else:
            core["/".join(parts[:-1][:2])] += lines
    return core, beside


def table() -> str:
    """Return what is counted as a table of Markdown."""
    core, beside = counted()
    rows = [
        "| core folder, or extra | lines |",
        "|---|---:|",
        *(f"| `{folder}` | {lines:,} |" for folder, lines in sorted(core.items())),
        f"| core, total | **{core.total():,}** |",
        *(f"| {name} | {lines:,} |" for name, lines in sorted(beside.items())),
        f"| extras, total | **{beside.total():,}** |",
    ]
    return "\n".join(rows)


if __name__ == "__main__":
    print(table())
