"""One word for each concept, as docs/glossary.md has them: what is read says none of the others.

Read are README, docs, the text of templates, and what the program prints: its string literals with
a blank. Known errors name old words, and so do earlier names of provisions.
"""

import ast
import re

import pytest

from fixtures.paths import ROOT

pytestmark = pytest.mark.quick

NOT_SAID = {
    r"route": "procedure",
    r"fire lanes?": "fire pathway",
    r"value (?:from|by) analysis": "analysis displacement",
    r"displacement by analysis": "analysis displacement",
    r"prescriptive value": "prescriptive displacement",
    r"schedule of gaps": "clearance schedule",
    r"the sheet [A-Z][a-z]+": "the ... worksheet",
    r"sheet (?:Project|Site|Arrays|Clearances|Motions|Options|Building|Objects|Start)": "worksheet",
    r"\d+ letters(?! and)": "characters",
    r"typed over": "overwritten",
    r"made again": "regenerated",
    r"in place of": "instead of",
    r"nobody": "name who",
    r"not given": "not entered, not provided, missing",
    r"former": "previous",
    r"parts? \d": "Section",
    r"slides at": "peak sliding velocity",
    r"by velocity": "velocity-dependent",
    r"source of hazard|hazard basis": "... of the seismic parameters",
    r"more than 0 to": "greater than 0 and at most",
    r"the least": "the smallest, lowest or minimum",
    r"everybody|oftener|thereof": "plain words",
}
SAID = re.compile(rf"\b(?:{'|'.join(NOT_SAID)})\b")


def texts_of_docs():
    for path in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
        yield path, path.read_text(encoding="utf-8")


def texts_of_templates():
    for path in (ROOT / "templates").rglob("*.html"):
        source = path.read_text(encoding="utf-8")
        yield path, re.sub(r"\{#.*?#\}|\{%.*?%\}|\{\{.*?\}\}|<[^>]+>", " ", source, flags=re.DOTALL)


def literals(path):
    """The strings of a module that are no docstrings and have a blank, as sentences do."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    expressions = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        is_text = isinstance(node, ast.Constant) and isinstance(node.value, str)
        if is_text and id(node) not in expressions and " " in node.value:
            yield node.value


def texts_of_modules():
    for path in [*(ROOT / "report").rglob("*.py"), *(ROOT / "solver").rglob("*.py")]:
        yield path, "\n".join(literals(path))


def found_in(texts):
    return [
        f"{path.relative_to(ROOT)}: {match[0]}"
        for path, text in texts
        for match in SAID.finditer(" ".join(text.split()))
    ]


KEPT = ("known-errors.md", "architecture.md", "overrides.py")
"""Pages about older versions and about the code, and names that earlier workbooks contain."""


@pytest.mark.parametrize(
    "texts",
    [texts_of_docs, texts_of_templates, texts_of_modules],
    ids=["docs", "templates", "code"],
)
def test_one_word_is_said_for_each_concept(texts):
    read = [(path, text) for path, text in texts() if path.name not in KEPT]
    assert len(read) > 20
    assert found_in(read) == []
    assert found_in([(ROOT / "README.md", "the displacement by analysis, part 6")]) == [
        "README.md: displacement by analysis",
        "README.md: part 6",
    ]
