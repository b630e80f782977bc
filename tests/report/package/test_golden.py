"""The words of each page, as they were read and taken over last.

`./roofslip test --golden` shows what changed and takes it over.
"""

import re
from functools import cache, partial

import pytest

from fixtures import assessments, pages
from fixtures.paths import GOLDEN
from report.pages.registry import package_data
from report.project.model.choices import PackageEdition


@cache
def permit():
    """The example without motions, in the edition letter."""
    return package_data(assessments.without_motions(), edition=PackageEdition.LETTER)


SETS = {
    "": assessments.usual,
    "unpermitted": assessments.unpermitted,
    "departing": assessments.departing,
    "school": partial(assessments.shipped, "school"),
    "conditions": partial(assessments.shipped, "conditions"),
    "campus": partial(assessments.shipped, "campus"),
    "without-motions": assessments.without_motions,
    "permit": permit,
}
ALIKE = {"contents", "plan", "echo", "symbols"}
"""Parts that other projects print as the first one does."""

SHIPPED = {"summary", "basis", "inputs", "motions", "comparison", "limits", "model"}

CHANGING = (
    (r"\b[0-9a-f]{64}\b", "<SHA-256>"),
    (r"\b[0-9a-f]{12}\b", "<hash>"),
    (r"Software: roofslip .*", "Software: <versions>"),
)
"""What changes with versions, files and machines."""

KEYS = (*pages.FRONT, *pages.IDS)
CHOSEN = {
    "": KEYS,
    "unpermitted": [key for key in KEYS if key not in ALIKE],
    "departing": [*(key for key in KEYS if key not in ALIKE), "changes"],
    "school": [key for key in KEYS if key in SHIPPED],
    "conditions": [key for key in KEYS if key in SHIPPED],
    "campus": ["results", "limits"],
    "without-motions": ["cover", "contents", "letter", "summary", "basis", "inputs", "method",
                        "limits", "records", "notes"],
    "permit": ["permit", "permit-plan"],
}  # fmt: skip
PAGES = [(name, key) for name, keys in CHOSEN.items() for key in keys]


@pytest.mark.parametrize(("name", "key"), PAGES, ids=lambda word: word or "usual")
def test_a_page_has_the_words_that_it_had(golden, name, key):
    text = pages.page_of(SETS[name](), key)
    for pattern, placeholder in CHANGING:
        text = re.sub(pattern, placeholder, text)
    golden(f"{name}/{key}.txt" if name else f"{key}.txt", text)


@pytest.mark.quick
def test_each_golden_text_is_that_of_a_page():
    names = {path.relative_to(GOLDEN).with_suffix("").as_posix() for path in GOLDEN.rglob("*.txt")}
    assert names == {"study", *(f"{name}/{key}".lstrip("/") for name, key in PAGES)}
