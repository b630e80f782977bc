"""Known errors: each says what to do, and is told of the packages that may have it."""

import re

import pytest
from packaging.version import Version

from fixtures.paths import ROOT
from report.provenance.known_errors import known_errors, touching
from report.results.results_schema import schema

pytestmark = pytest.mark.quick

LOG = (ROOT / "CHANGELOG.md").read_text()
OUTPUTS = {"package", "study", "page", "design curves", "python", "commands"}


def test_each_names_its_effect_an_action_and_the_lines_of_the_change_log():
    released = set(re.findall(r"^## (\d\S*)", LOG, re.MULTILINE))
    for error in known_errors():
        for text in (error.error, error.effect, error.action):
            assert text.endswith("."), error
        assert error.of in OUTPUTS
        assert error.until in released or Version(error.until).is_devrelease
        for change in error.changes:
            assert LOG.count(f"\n- {change}") == 1, change


DECIDES, OTHER = "Numbers, verdicts and refusals", "Words, pages and commands"


def test_each_correction_of_a_number_a_verdict_or_a_refusal_is_a_known_error():
    """Each line below Fixed stands under one of two heads: under the first, an entry names it."""
    starts = [change for error in known_errors() for change in error.changes]
    later = LOG.partition("\n## 0.1.0")[0]  # no version before it had the errors
    fixed = re.findall(r"^### Fixed\n(.*?)(?=^###? |\Z)", later, re.MULTILINE | re.DOTALL)
    assert len(fixed) == later.count("\n### Fixed\n") >= 3
    for section in fixed:
        above, *heads = re.split(r"^#### ", section, flags=re.MULTILINE)
        assert above.strip() == "", f"is it below '{DECIDES}' or '{OTHER}'?"
        for part in heads:
            head, _, text = part.partition("\n")
            assert head in (DECIDES, OTHER)
            for line in re.findall(r"^- (.*)", text, re.MULTILINE):
                is_listed = any(line.startswith(start) for start in starts)
                assert is_listed == (head == DECIDES), line


def test_what_they_need_are_places_of_results_json():
    """A place that is spelled in another way would be empty in every package."""
    document = schema()
    for error in known_errors():
        held = document
        for key in filter(None, error.needs.split(".")):
            if "$ref" in held:
                held = document["$defs"][held["$ref"].rpartition("/")[2]]
            held = held["properties"][key]


RECORDS = {"records": [{"name": "a.csv"}], "input": {"spectrum": []}}


def told(made_by, results):
    return [error.error for error in touching(made_by, results)]


def test_a_package_is_told_those_of_its_version_and_of_what_it_has():
    assert told("0.4.0", RECORDS) == told("0.4.0.dev9999+12345678", RECORDS) == []
    plain, moved = told("0.3.0", {"records": []}), told("0.3.0", RECORDS)
    assert any("A peer review removed" in error for error in told("0.3.0", reviewed()))
    assert not any("A peer review removed" in error for error in plain)
    assert 0 < len(plain) < len(moved) < len(told("0.2.0", RECORDS))
    assert not any("Studies: events" in error for error in moved)
    # What cannot be read says nothing of its version, or of what it has.
    assert told("own build", RECORDS) == told("0.1.0", RECORDS)
    assert told("0.3.0", {"records": [], "input": 7}) == plain


def reviewed():
    return {"input": {"options": {"peer_reviewed": True}}}
