"""Mutants of a module: small changes of its source, each of which some test must notice.

`python tests/mutants.py solver/kernels/one_axis.py` draws 300 with a seed, runs the tests of the
module with each and prints those that no test noticed. Kernels run with the compiler off. A
comparison is reversed; that `<` and `<=` differ is asked of `solver/rules` alone, where a limit
itself is a value: in a kernel the two differ on ties of rounded numbers. Read `sites` first.
"""

from __future__ import annotations

import argparse
import ast
import copy
import importlib.abc
import importlib.util
import os
import random
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from places import ROOT, TESTS

TESTS_OF = {
    "solver/kernels/one_axis.py": [
        "solver/kernels/test_one_axis_kernel.py",
        "solver/sliding/test_checked.py",
        "solver/sliding/test_uplift.py",
    ],
    "solver/kernels/two_axes.py": [
        "solver/kernels/test_two_axes_kernel.py",
        "solver/sliding/test_two_axes_bounds.py",
        "solver/sliding/test_two_axes_friction.py",
        "solver/sliding/test_two_axes.py",
    ],
    "solver/rules": [
        "solver/rules",
        "solver/records",
        "report/suite/test_target_table.py",
        "report/sheet/test_site_checks.py",
        "report/motions/test_targets.py",
        "report/assessment/test_clearances.py",
        "report/pages",
    ],
}
LONGEST_S = 240.0
"""A mutant that runs longer is killed: it does not end, or is far slower."""

SWAPPED = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult,
    ast.FloorDiv: ast.Mult, ast.And: ast.Or, ast.Or: ast.And,
    ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Break: ast.Continue,
}  # fmt: skip
AT_THE_LIMIT = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
NAMES = {"min": "max", "max": "min", "sin": "cos", "cos": "sin", "floor": "ceil", "any": "all"}

Change = Callable[[ast.AST], None]


def sites(tree: ast.Module, *, limits: bool) -> list[tuple[int, Change]]:
    """Return each change of the source: a node's place in a walk of its code, and what is done."""
    found = []
    for at, node in enumerate(_code(tree)):
        found += [(at, change) for change in _changes(node, limits=limits)]
    return found


def mutant(tree: ast.Module, at: int, change: Change) -> tuple[ast.Module, str]:
    """Return a changed copy, and the changed line before and after."""
    other = copy.deepcopy(tree)
    node = list(_code(other))[at]
    before = ast.unparse(node)
    change(node)
    return ast.fix_missing_locations(other), f"{node.lineno}: {before} -> {ast.unparse(node)}"


def _code(tree: ast.AST) -> Iterator[ast.AST]:
    """Walk without docstrings, annotations and decorators."""
    for name, value in ast.iter_fields(tree):
        if name in ("annotation", "returns", "decorator_list", "type_comment"):
            continue
        for child in value if isinstance(value, list) else [value]:
            is_text = isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant)
            if isinstance(child, ast.AST) and not is_text:
                if hasattr(child, "lineno"):
                    yield child
                yield from _code(child)


def _changes(node: ast.AST, *, limits: bool) -> Iterator[Change]:
    if isinstance(node, ast.BinOp | ast.AugAssign | ast.BoolOp) and type(node.op) in SWAPPED:
        yield lambda one: setattr(one, "op", SWAPPED[type(one.op)]())
    if isinstance(node, ast.Compare):
        for table in (SWAPPED, AT_THE_LIMIT) if limits else (SWAPPED,):
            if type(node.ops[0]) in table:
                yield lambda one, table=table: one.ops.__setitem__(0, table[type(one.ops[0])]())
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield lambda one: setattr(one, "op", ast.UAdd())
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield lambda one: setattr(one, "operand", ast.UnaryOp(ast.Not(), one.operand))
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield lambda one: setattr(one, "value", one.value * 2 if one.value else type(one.value)(1))
    if isinstance(node, ast.Name) and node.id in NAMES:
        yield lambda one: setattr(one, "id", NAMES[one.id])
    if isinstance(node, ast.Attribute) and node.attr in NAMES:
        yield lambda one: setattr(one, "attr", NAMES[one.attr])


class _Instead(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Gives a module of the product from a changed tree."""

    def __init__(self, path: Path, tree: ast.Module):
        self._path, self._tree = path, tree
        self._name = ".".join(path.relative_to(ROOT).with_suffix("").parts)

    def find_spec(self, name, path, target=None):
        if name == self._name:
            return importlib.util.spec_from_file_location(name, self._path, loader=self)
        return None

    def exec_module(self, module):
        exec(compile(self._tree, str(self._path), "exec"), module.__dict__)


def survives(path: Path, tree: ast.Module, tests: list[str]) -> bool:
    """Whether every test passes with a changed module, in a process of its own."""
    child = os.fork()
    if not child:
        os.setsid()
        null = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(null, stream)
        sys.meta_path.insert(0, _Instead(path, tree))
        import pytest

        words = ["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-W", "ignore"]
        os._exit(int(pytest.main([*words, *(str(TESTS / name) for name in tests)])))
    ends = time.monotonic() + LONGEST_S
    while time.monotonic() < ends:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return status == 0
        time.sleep(0.02)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return False


def main() -> None:
    """Draw mutants of a module or a folder, run its tests with each and print the survivors."""
    parser = argparse.ArgumentParser(description=__doc__.partition(".")[0])
    parser.add_argument("module", choices=TESTS_OF)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=29)
    parser.add_argument("--part", default="1/1", help="2/3: the second third of those drawn")
    given = parser.parse_args()
    if "kernels" in given.module:
        os.environ["NUMBA_DISABLE_JIT"] = "1"
    # What takes seconds to load is loaded once; the product is not.
    for name in ("numba", "scipy.integrate", "scipy.signal", "mpmath", "hypothesis", "pandas"):
        importlib.import_module(name)
    top = ROOT / given.module
    tests = TESTS_OF[given.module]
    found = []
    for path in sorted(top.rglob("*.py")) if top.is_dir() else [top]:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        found += [(path, tree, *site) for site in sites(tree, limits="rules" in given.module)]
    drawn = random.Random(given.seed).sample(found, min(given.count, len(found)))
    part, parts = map(int, given.part.split("/"))
    drawn = drawn[part - 1 :: parts]
    assert survives(*drawn[0][:2], tests), "the tests fail without a change"
    print(f"{given.module}: {len(drawn)} of {len(found)} mutants, seed {given.seed}", flush=True)
    survivors = 0
    for k, (path, tree, at, change) in enumerate(drawn, start=1):
        changed, told = mutant(tree, at, change)
        if survives(path, changed, tests):
            survivors += 1
            print(f"{path.relative_to(ROOT)}:{told}", flush=True)
        print(f"{k} done, {survivors} survive", file=sys.stderr, flush=True)
    print(f"killed: {len(drawn) - survivors} of {len(drawn)}")


if __name__ == "__main__":
    main()
