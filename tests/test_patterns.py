"""The time of a pattern grows as its text does, and hostile inputs by seed are read or refused.

Nobody lists the patterns: they are the values of the product's modules and classes, and what its
source gives to calls such as `re.sub`.
"""

import ast
import builtins
import importlib
import re
from collections.abc import Mapping
from functools import partial
from itertools import chain
from pathlib import Path
from re import _parser as parser  # there is no other parser of patterns

import pytest

from fixtures.growth import NOISE_S, grows_faster, seconds
from fixtures.hostile_inputs import trouble
from fixtures.paths import ROOT

METHODS = ("match", "fullmatch", "search", "sub", "split", "findall", "finditer")

UNSAID = ("match", "fullmatch", "search")
"""How a pattern is tried that is given away, or is only kept."""

RUNS = " \t\n0a-([\"'"
"""What every pattern gets long runs of, besides its own letters."""

MEMBERS = "0aA_ \n.-(\"'/é\x01☃"
"""Of which the first that a class has stands for it."""

END = "☄"
"""A letter that no pattern names."""

LENGTHS = (24, 96, 384, 1536, 6144)
"""Letters of a run for which an exponential, a cubic and a quadratic time exceed the noise."""

FILES = [
    path.relative_to(ROOT)
    for folder in ("solver", "report")
    for path in sorted(Path(ROOT, folder).rglob("*.py"))
    if "re." in path.read_text() or ".Pattern" in path.read_text()
]


def within(value, *, is_top=True):
    """Yield the patterns of a value of a module: itself, or in a class or a collection."""
    kind = type(value)  # what only claims a class is none of these
    if kind is re.Pattern:
        yield value
    elif issubclass(kind, Mapping):
        yield from within([*value, *value.values()], is_top=is_top)
    elif issubclass(kind, (list, tuple, set, frozenset)):
        yield from chain.from_iterable(within(each, is_top=is_top) for each in value)
    elif is_top and issubclass(kind, type) and value.__module__.startswith(("report", "solver")):
        yield from within(list(vars(value).values()), is_top=False)


class Names(dict):
    """The names of a module; any other one, which is local, stands for a letter."""

    def __init__(self, module, letter):
        super().__init__(vars(module))
        self.letter = letter

    def __missing__(self, name):
        if hasattr(builtins, name):
            raise KeyError(name)
        return self.letter


def evaluated(node, module):
    """Return what the source of a pattern stands for, with a letter for each local name."""
    code = compile(ast.Expression(node), "<pattern>", "eval")
    try:
        return eval(code, {}, Names(module, "a"))
    except TypeError:
        return eval(code, {}, Names(module, b"a"))


def inline(call, module):
    """Return the pattern that a call of `re` is given; None for one that has no source here."""
    source, *others = call.args
    if isinstance(source, ast.Name) and source.id not in vars(module):
        return None
    pattern = evaluated(source, module)
    if isinstance(pattern, re.Pattern):
        return pattern
    options = [*others, *(one.value for one in call.keywords)]
    is_flag = ("re.A", "re.D", "re.I", "re.M")
    flags = [each for each in options if ast.unparse(each).startswith(is_flag)]
    return re.compile(pattern, evaluated(flags[0], module) if flags else 0)


def used(module, source):
    """Yield each use of a pattern in a module: the pattern, its method, and the line.

    One that is given away is tried by the methods that the module calls on local names.
    """
    tree = ast.parse(source)
    names = {name: value for name, value in vars(module).items() if type(value) is re.Pattern}
    methods = {id(node.value): node.attr for node in ast.walk(tree) if type(node) is ast.Attribute}
    local = {methods[id(node)] for node in ast.walk(tree) if type(node) is ast.Name
             and node.id not in (*names, "re") and id(node) in methods}  # fmt: skip
    unsaid = local.intersection(UNSAID) or UNSAID
    for node in ast.walk(tree):
        found, method = None, methods.get(id(node), "")
        match node:
            case ast.Call(ast.Attribute(ast.Name("re"), "compile"), [_, *_]):
                found = inline(node, module)
                found = None if found in names.values() and not method else found
            case ast.Call(ast.Attribute(ast.Name("re"), method), [_, *_]) if method in METHODS:
                yield inline(node, module), method, node.lineno
            case ast.Name(name, ast.Load()) if name in names:
                found = names[name]
        if found and method in METHODS:
            yield found, method, node.lineno
        elif found and method != "pattern":
            yield from ((found, each, node.lineno) for each in unsaid)


CATEGORIES = {
    "SPACE": str.isspace,
    "DIGIT": str.isdigit,
    "WORD": lambda letter: letter.isalnum() or letter == "_",
}


def is_member(letter, items):
    """Whether a class of letters, as parsed, has one."""
    found = False
    for kind, value in items:
        match str(kind):
            case "LITERAL":
                found |= ord(letter) == value
            case "RANGE":
                found |= value[0] <= ord(letter) <= value[1]
            case "CATEGORY":
                name = str(value).removeprefix("CATEGORY_")
                found |= CATEGORIES[name.removeprefix("NOT_")](letter) != name.startswith("NOT_")
    return found != (str(items[0][0]) == "NEGATE")


def member(items):
    """Return a letter of a class."""
    own = [value if str(kind) == "LITERAL" else value[0]
           for kind, value in items if str(kind) in ("LITERAL", "RANGE")]  # fmt: skip
    return next(letter for letter in (*MEMBERS, *map(chr, own)) if is_member(letter, items))


def pieces(tree, choice, repeated):
    """Return what a parsed pattern matches, piece by piece; note what it may repeat.

    Of alternatives it takes one, by its number.
    """
    found = []
    for kind, value in tree:
        match str(kind):
            case "LITERAL":
                found.append(chr(value))
            case "NOT_LITERAL":
                found.append(member([("NEGATE", None), ("LITERAL", value)]))
            case "IN":
                found.append(member(value))
            case "ANY":
                found.append("a")
            case "MAX_REPEAT" | "MIN_REPEAT" | "POSSESSIVE_REPEAT":
                inner = pieces(value[2], choice, repeated)
                repeated.append("".join(inner))
                found += inner * max(value[0], 1)
            case "BRANCH":
                found += pieces(value[1][choice % len(value[1])], choice, repeated)
            case "SUBPATTERN":
                found += pieces(value[3], choice, repeated)
            case "ATOMIC_GROUP":
                found += pieces(value, choice, repeated)
    return found


def surroundings(pattern):
    """Yield what is before a run, the run, and what is after it."""
    source = pattern.pattern if isinstance(pattern.pattern, str) else pattern.pattern.decode()
    tree = parser.parse(source, pattern.flags & ~re.UNICODE)
    for choice in range(3):
        repeated = []
        sample = pieces(tree, choice, repeated)
        whole = "".join(sample)
        runs = dict.fromkeys([*RUNS, *repeated, *sample, whole, *map(" ".__add__, sample)])
        yield from ((END, run, END) for run in filter(None, runs))
        for at in range(min(len(sample), 40) + 1):
            before, after = "".join(sample[:at]), "".join(sample[at:])
            # Within a word no run can matter that does not matter before it.
            if at and sample[at - 1].isalnum() and sample[at : at + 1] and sample[at].isalnum():
                continue
            for run in filter(None, runs if at == 0 else dict.fromkeys([*RUNS, *repeated])):
                yield from ((before, run, after), (before, run, END), (before, run, ""))


def text(pattern, part, length):
    """Return a run of a length with its surroundings, as the pattern takes it."""
    before, run, after = part
    whole = before + (run * length)[:length] + after
    return whole if isinstance(pattern.pattern, str) else whole.encode("latin-1", "replace")


def tried(pattern, method):
    """Return what tries a pattern on a text to the end."""
    if method == "sub":
        return partial(pattern.sub, "" if isinstance(pattern.pattern, str) else b"")
    if method == "finditer":
        return lambda text: list(pattern.finditer(text))
    return getattr(pattern, method)


def is_too_slow(pattern, method, part):
    """Whether the time grows faster than the text."""
    call = tried(pattern, method)
    for length in LENGTHS:
        if seconds(call, text(pattern, part, length)) > NOISE_S:
            made = partial(text, pattern, part)
            if length == LENGTHS[0] or grows_faster(call, made, length):
                return True
    return False


def slow(uses):
    """Return the uses of patterns whose time grows faster than their text, with such a text."""
    found = []
    for (pattern, method), line in {use[:2]: use[2] for use in uses}.items():
        parts = dict.fromkeys(surroundings(pattern))
        if part := next((part for part in parts if is_too_slow(pattern, method, part)), None):
            found.append(f"{line}: {pattern.pattern!r}.{method} on {part}")
    return found


@pytest.mark.nightly
@pytest.mark.parametrize("path", FILES, ids=str)
def test_the_time_of_each_pattern_of_a_file_grows_as_the_text(path):
    module = importlib.import_module(".".join(path.with_suffix("").parts))
    uses = list(used(module, Path(ROOT, path).read_text()))
    # A pattern that a function gets as text is tried only if the module keeps it compiled.
    assert [line for pattern, _, line in uses if pattern is None] == []
    kept = {pattern for value in vars(module).values() for pattern in within(value)}
    unused = kept - {pattern for pattern, _, _ in uses}
    uses += [(pattern, method, 0) for pattern in unused for method in UNSAID[:2]]
    assert slow(uses) == []


@pytest.mark.parametrize(
    ("source", "method"),
    [
        pytest.param(r"\A[\s\u200b]+|[\s\u200b]+\Z", "sub", marks=pytest.mark.nightly),
        (r"\s+$", "search"),
        (r"(a|aa)+b", "match"),
        (r"UNITS OF[ :]*=?[ :]*x", "search"),
        pytest.param(rb"<(\w*)\s*/?(\s*)>", "findall", marks=pytest.mark.nightly),
    ],
    ids=str,
)
def test_a_pattern_whose_time_grows_faster_is_found(source, method):
    assert len(slow([(re.compile(source), method, 1)])) == 1


# 10^4 cases a night: most on the records and the cells.
CASES = {"record": 7300, "cell": 2000, "argument": 500, "part": 150, "book": 50}


@pytest.mark.parametrize("share", [0.1, pytest.param(1.0, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("kind", CASES)
def test_hostile_inputs_are_read_or_refused(kind, share):
    seeds = range(round(share * CASES[kind]))
    ended = {seed: told for seed in seeds if (told := trouble(kind, seed))}
    assert ended == {}
