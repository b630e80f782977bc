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
from collections.abc import Callable, Iterator
from pathlib import Path

import hypothesis
import pytest

from places import ROOT, TESTS

TESTS_OF = {
    "solver/kernels/one_axis.py": [
        "solver/kernels/test_one_axis_kernel.py",
        "solver/sliding/test_checked.py",
        "solver/sliding/test_uplift.py",
        "solver/sliding/test_sweep.py",
        "-k not (paper or law or scene_is_checked)",  # those of other kernels
    ],
    "solver/kernels/two_axes.py": [
        "solver/sliding/test_two_axes_known.py",
        "solver/kernels/test_two_axes_kernel.py",
        "solver/sliding/test_two_axes_bounds.py",
        "solver/sliding/test_two_axes.py",
        # Of the dear files those that cost little with the compiler off.
        "-k test_two_axes_known or test_two_axes_kernel and not references or mirrored"
        " or crosses_zero_twice or dip_of or presses or before_it_begins or one_axis_allows"
        " or cubics or creeps",
    ],
    "solver/rules": ["solver/rules"],
}
LONGEST_S, TIMES = 3.0, 5.0
"""Processor time after which tests do not end: so much, and so many times that without a change."""

PHASES = hypothesis.Phase.explicit, hypothesis.Phase.generate
"""Of what Hypothesis does: a failure is not made smaller, and none is kept for the next run."""

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


def run(path: Path, tree: ast.Module, tests: list[str], longest_s: float) -> tuple[bool, float]:
    """Return whether every test passes with a module so changed, and the processor time [s].

    In a process of its own; the first failure ends it.
    """
    began = os.times()
    child = os.fork()
    if not child:
        signal.setitimer(signal.ITIMER_PROF, longest_s)
        null = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(null, stream)
        sys.meta_path.insert(0, _Instead(path, tree))
        words = ["-x", "-q", "-W", "ignore", "-m", "not nightly", "--hypothesis-profile=mutants"]
        words += ["-p", "no:cacheprovider", "-p", "no:xdist"]
        files = [name if name.startswith("-k") else str(TESTS / name) for name in tests]
        os._exit(int(pytest.main([*words, *files])))
    _, status = os.waitpid(child, 0)
    return status == 0, os.times().children_user - began.children_user


def main() -> None:
    """Draw mutants of a module or a folder, run its tests with each and print the survivors."""
    parser = argparse.ArgumentParser(description=__doc__.partition(".")[0])
    parser.add_argument("module", choices=TESTS_OF)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=29)
    parser.add_argument("--part", default="1/1", help="2/3: the second third of those drawn")
    asked = parser.parse_args()
    if "kernels" in asked.module:
        os.environ["NUMBA_DISABLE_JIT"] = "1"
    # What takes seconds to load is loaded once; the product is not.
    for name in ("numba", "scipy.integrate", "scipy.signal", "mpmath", "hypothesis", "pandas"):
        importlib.import_module(name)
    hypothesis.settings.register_profile(
        "mutants", deadline=None, database=None, derandomize=True, phases=PHASES
    )
    top = ROOT / asked.module
    tests = TESTS_OF[asked.module]
    changes = []
    for path in sorted(top.rglob("*.py")) if top.is_dir() else [top]:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        changes += [(path, tree, *site) for site in sites(tree, limits="rules" in asked.module)]
    drawn = random.Random(asked.seed).sample(changes, min(asked.count, len(changes)))
    part, parts = map(int, asked.part.split("/"))
    drawn = drawn[part - 1 :: parts]
    passed, took_s = run(*drawn[0][:2], tests, 1200.0)
    assert passed, "the tests fail without a change"
    print(f"{asked.module}: {len(drawn)} of {len(changes)} mutants, seed {asked.seed}", flush=True)
    survivors = 0
    for k, (path, tree, at, change) in enumerate(drawn, start=1):
        changed, told = mutant(tree, at, change)
        if run(path, changed, tests, LONGEST_S + TIMES * took_s)[0]:
            survivors += 1
            print(f"{path.relative_to(ROOT)}:{told}", flush=True)
        print(f"{k} done, {survivors} survive", file=sys.stderr, flush=True)
    print(f"killed: {len(drawn) - survivors} of {len(drawn)}")


if __name__ == "__main__":
    main()
