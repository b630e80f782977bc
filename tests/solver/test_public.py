"""The public names of the solver: there, described whole, and free before one is asked for."""

import doctest
import inspect
import pydoc
import re
import subprocess
import sys

import pytest

import report
import solver
from fixtures.marks import nightly
from fixtures.paths import ROOT
from solver import public

pytestmark = pytest.mark.quick

FUNCTIONS = {
    name: getattr(package, name)
    for package in (public, report)
    for name in package.__all__
    if inspect.isfunction(getattr(package, name))
}
LONG = {"make_suite", "assess_project"}
SECTIONS = ("Parameters", "Returns", "Raises", "Examples")


def test_public_names_are_those_of_the_solver_and_no_others():
    assert dir(solver) == sorted(public.__all__)
    for name in public.__all__:
        assert getattr(solver, name) is getattr(public, name), name
    told = pydoc.plain(pydoc.render_doc(solver))
    listed = dict(re.findall(r"^ {8}(\w+) +(\S.*\.)$", told.partition("PACKAGE CONTENTS")[0], re.M))
    functions = {name: FUNCTIONS[name] for name in public.__all__ if name in FUNCTIONS}
    assert listed == {name: inspect.getdoc(f).partition("\n")[0] for name, f in functions.items()}
    assert len(listed) == 24
    assert set(re.findall(r"^ {4}(\w+)\(", told.partition("\nFUNCTIONS\n")[2], re.M)) == {*listed}
    with pytest.raises(AttributeError):
        _ = solver.slope
    with pytest.raises(ImportError):
        from solver import slope  # noqa: F401


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_public_function_has_every_section_and_each_of_its_parameters(name):
    text = inspect.getdoc(FUNCTIONS[name])
    assert re.match(r"[A-Z].*\.(\n\n|$)", text), "a sentence"
    places = [text.find(f"\n{each}\n{'-' * len(each)}\n") for each in SECTIONS]
    assert places == sorted(places)
    assert places[0] > 0
    listed = re.findall(r"^([\w*][\w, *]*?)(?: :.*)?$", text[places[0] : places[1]], re.M)
    named = {each.strip("* ") for line in listed for each in line.split(",")}
    assert set(inspect.signature(FUNCTIONS[name]).parameters) <= named


@pytest.mark.parametrize("name", [nightly(n) if n in LONG else n for n in FUNCTIONS])
def test_the_example_of_a_public_function_is_true(name, monkeypatch):
    monkeypatch.chdir(ROOT)
    function = FUNCTIONS[name]
    known = dict(vars(sys.modules[function.__module__]))
    (test,) = doctest.DocTestFinder(recurse=False).find(function, name, globs=known)
    assert test.examples
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE, verbose=False)
    told = []
    assert runner.run(test, out=told.append).failed == 0, "".join(told)


def test_docstrings_of_public_names_point_to_public_names():
    parts = {
        f"{name}.{part}": member
        for name in public.__all__
        if inspect.isclass(found := getattr(public, name))
        for part, member in [("", found), *vars(found).items()]
        if not part.startswith("_") and (inspect.isroutine(member) or not part)
    }
    wrong = [
        (name, path)
        for name, each in (FUNCTIONS | parts).items()
        for path in re.findall(r"`([a-z_]+\.(?!xlsx)[\w.]+)`", inspect.getdoc(each) or "")
        if path.partition(".")[2] not in public.__all__
    ]
    assert len(parts) > 30
    assert wrong == []


def test_kernels_are_loaded_with_the_first_name_and_scipy_is_not():
    program = (
        "import sys, solver.model; assert 'numba' not in sys.modules; "
        "from solver import slide; assert 'numba' in sys.modules; "
        "assert not {'scipy.integrate', 'scipy.stats', 'pandas', 'xarray'} & sys.modules.keys()"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)
