"""What changed since a former revision: found from results.json, printed, and marked."""

import json
import re
from dataclasses import replace
from functools import reduce
from operator import getitem
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fixtures import assessments, projects
from fixtures import project_parts as parts_of
from fixtures.pages import IDS, page_of
from fixtures.spaces import spaced
from report.assessment.design.verdict import Verdict
from report.assessment.revision_changes import ChangeKind
from report.pages.registry import package_data, parts
from report.project.read.documents import Document
from report.results.results_json import AGAIN, former_from, read_former, results_json
from report.results.revision_comparison import MOST_CHANGES, changes, check_listed, with_reissue
from solver.errors import InputError


def made(**project):
    return assessments.package(assessments.motions(3, 4.0), **project).assessment


@pytest.fixture(scope="module")
def assessment():
    return made()


@pytest.fixture(scope="module")
def content(assessment):
    return results_json(assessment, assessments.evidence(assessment))


@pytest.fixture
def document(content):
    """The results as data, for a test to edit."""
    return json.loads(content)


def put(document, where, value):
    """Replace the value at a place of a document; return the former one."""
    above = reduce(getitem, where[:-1], document)
    former, above[where[-1]] = above[where[-1]], value
    return former


def former(document):
    return former_from(json.dumps(document).encode(), "x")


def inputs(found):
    return {(i.title, i.before, i.now) for i in found.items if i.kind is ChangeKind.INPUT}


def test_nothing_changed_since_itself_nor_by_the_word_of_version_0_2(assessment, document):
    found = changes(former(document), assessment)
    assert found.items == ()
    assert found.arrays == found.values == found.clearances == frozenset()
    assert found.revision == assessment.project.project.revision
    count = json.dumps(document).count('"Condition"')
    assert count
    text = json.dumps(document).replace('"Condition"', '"OK with conditions"')
    assert changes(former(json.loads(text)), assessment).items == ()


def test_an_input_with_its_results_and_verdicts_is_found(assessment, document):
    # A2 weighs more; A3 has less friction; the clearance of A1 to RTU-1 is 6 in.
    arrays = [
        projects.array("A1", 0.5),
        projects.array("A2", 2.0, x=120, weight_n=50000 * 4.4482216152605),
        projects.array("A3", 3.0, mu=0.30, y=90),
    ]
    gaps = [row.model_dump() for row in assessment.project.clearances]
    gaps[1]["provided_m"] = 6 * projects.INCH
    found = changes(former(document), made(arrays=arrays, clearances=gaps))
    assert spaced(inputs(found)) == {
        ("Arrays, A2: Weight", "42000 lb", "50000 lb"),
        ("Arrays, A3: Friction coefficient", "0.55", "0.3"),
        ("Clearances, A1 RTU-1 any: Provided clearance", "84 in", "6 in"),
    }
    assert {"A1", "A3"} <= found.arrays  # the clearance of A1 is NG now
    assert ("A3", "M1") in found.values
    assert not [key for key in found.values if key[0] in ("A1", "A2")]
    assert 2 in found.clearances
    assert 5 not in found.clearances
    verdicts = {(i.title, i.now) for i in found.items if i.kind is ChangeKind.VERDICT}
    assert ("Clearance A1 to RTU-1", "NG") in verdicts
    # What moved is listed with its value before and now: a checker of a revision asks for it.
    titles = {kind: {i.title for i in found.items if i.kind is kind} for kind in ChangeKind}
    assert titles[ChangeKind.ANALYSIS] == {"Array A3"}
    assert "A1 to RTU-1, D/C" in titles[ChangeKind.CLEARANCE]
    (value,) = (i for i in found.items if i.kind is ChangeKind.ANALYSIS)
    assert spaced(value.before).endswith(" mm)")
    assert value.before != value.now


def reissue(done, document):
    rows = with_reissue(done, former(document)).checks
    return [row for row in rows if row.id == "revision"]


@pytest.mark.parametrize(
    ("change", "is_said"),
    [
        ({}, False),
        ({"options": {"peer_covered": "2026-03-01: Site 3f2a91"}}, False),  # no input
        ({"arrays": [projects.array("A1", 0.5, mu=0.42)], "clearances": []}, True),
        ({"site": projects.site(s_ds_g=1.5)}, True),
    ],
)
def test_a_revision_that_was_issued_with_other_inputs_is_a_condition(document, change, is_said):
    done = made(**change)
    found = reissue(done, document)
    assert len(found) == is_said
    for row in found:
        assert row.verdict is Verdict.CONDITION
        assert (row.title, row.found) == ("Revision 0", "issued with other inputs, 2026-03-05")
        assert row.remedy.startswith("Raise the revision on the Project worksheet")
    raised = made(**change, project=parts_of.HEAD | {"revision": "1"})
    assert reissue(raised, document) == []


def test_a_revision_with_another_record_is_a_condition(assessment, document):
    document["records"][0]["sha256"] = "00" * 32
    assert len(reissue(assessment, document)) == 1


def test_rows_records_and_digits_that_differ_are_named(assessment, document):
    gaps = [row.model_dump() for row in assessment.project.clearances][1:]
    gaps.append(projects.clearance("A2", "RTU-1", 30 * projects.FOOT))
    found = changes(former(document), made(clearances=gaps))
    assert spaced(inputs(found)) == {
        ("Clearances, A1 A3 any", "given", "removed"),
        ("Clearances, A2 RTU-1 any", "—", "added"),
    }
    assert 5 in found.clearances
    design = document["arrays"][0]["design_m"]
    document["arrays"][0]["design_m"] = design * (1.0 + 1e-5)
    (item,) = changes(former(document), assessment).items
    assert item.before != item.now
    assert spaced(item.now) == f"{design:.7g} m"


def test_other_primary_units_are_one_change(assessment, document):
    head = parts_of.HEAD | {"units_first": "SI"}
    (found,) = changes(former(document), made(project=head)).items
    assert (found.title, found.before, found.now) == ("Primary units", "US", "SI")


def test_a_record_with_another_hash_the_rule_set_and_the_version_are_found(assessment, document):
    document["records"][0]["sha256"] = "00" * 32
    document["rule_set"] = "another"
    document["roofslip_version"] = "0.0.1"
    document["arrays"][0]["design_m"] *= 1.1
    document["arrays"][1]["design_m"] *= 1.0 + 1e-9  # rounding on another machine
    found = changes(former(document), assessment)
    kinds = [item.kind for item in found.items]
    assert kinds == [
        ChangeKind.RULES, ChangeKind.SOFTWARE, ChangeKind.RECORD, ChangeKind.DESIGN,
    ]  # fmt: skip
    assert "00" * 32 in found.items[2].before
    assert "ab" * 32 in found.items[2].now
    assert found.items[3].title == "Array A1"
    assert found.values == {("A1", "design_m")}


def test_a_document_with_another_hash_is_found_unless_the_former_file_does_not_say(assessment):
    letter = {"label": "Letter of review", "path": "r.pdf", "size": 9, "sha256": "ab" * 32}
    source = replace(assessment.source, documents=(Document(**letter),))
    now = replace(assessment, source=source)
    document = json.loads(results_json(now, assessments.evidence(now)))
    assert document["documents"] == [letter]
    assert not changes(former(document), now).items
    document["documents"][0]["sha256"] = "00" * 32
    (found,) = changes(former(document), now).items
    assert (found.kind, found.title) == (ChangeKind.DOCUMENT, "Letter of review")
    assert ("00" * 32 in found.before, "ab" * 32 in found.now) == (True, True)
    del document["documents"]  # as of an earlier version
    assert not changes(former(document), now).items


def test_the_page_and_the_bars_are_there_only_if_asked_for(assessment, document):
    document["input"]["site"]["stories"] = 3
    document["input"]["project"]["revision"] = "<B>"
    document["clearances"][2]["verdict"] = "NG"
    document["arrays"][0]["design_m"] *= 1.1
    package = package_data(assessment, changes(former(document), assessment))
    assert "Changes since revision <B>" in page_of(package, "contents")
    assert "Number of stories" in page_of(package, "changes").table("Changes").column("Quantity")
    usual = package_data(assessment)
    listed, plain = (parts(one) for one in (package, usual))
    first, *others = plain
    assert [part.id for part in listed] == [first.id, "changes", *(part.id for part in others)]
    assert [part.number for part in listed] == ["1", "", *(part.number for part in others)]
    # Summary: A1; results: the design of A1; comparison: A1; schedule: clearance 3.
    assert marked(package, "summary") == ["A1"]
    assert marked(package, "results") == ["Design"]
    assert marked(package, "comparison") == ["A1"]
    assert marked(package, "plan") == ["3"]
    assert not any(marked(usual, id) for id in IDS)


def marked(package, id):
    """The first cell of each row of a page that has a bar in the margin."""
    return [
        row[0]
        for table in page_of(package, id).tables
        for row, kind in zip(table.cells, table.kinds, strict=True)
        if "changed" in kind
    ]


def test_results_of_version_0_3_are_compared_without_their_checks(assessment, document):
    """It wrote limits and requirements in other words, and no `checks`."""
    del document["checks"]
    document |= {"schema_version": 2, "requirements": [], "building_checks": [], "acceptance": []}
    document["verdict"] = "OK"
    found = changes(former(document), assessment)
    assert [item.kind for item in found.items] == [ChangeKind.VERDICT]


@pytest.mark.parametrize(
    ("version", "found"),
    [(4, "is 4"), ("2", "is '2'"), (True, "is True"), (None, "is missing")],
)
def test_another_version_is_named(document, version, found):
    document["schema_version"] = version
    with pytest.raises(
        InputError, match=rf"schema_version {found}.*reads 2 and 3[\s\S]*recreate it"
    ):
        former(document)


@pytest.mark.parametrize(
    ("where", "value"),
    [
        (("arrays", 0, "design_m"), "1.0"),
        (("arrays", 0, "peaks"), {}),
        (("arrays",), None),
        (("input", "site", "stories"), "many"),
        (("clearances", 0), "gap"),
    ],
)
def test_a_wrong_type_is_named_with_its_place(document, where, value):
    put(document, where, value)
    place = r"\.".join(map(str, where))
    with pytest.raises(
        InputError,
        match=rf"^x: {place} is not in the form that `report` writes; the file is"
        r" damaged",
    ):
        former(document)


@pytest.mark.parametrize("letter", ["\ufffe", "\x00", "\x7f", "\u202e"])
@pytest.mark.parametrize(
    "where", [("input", "project", "revision"), ("arrays", 0, "peaks", 0, "motion")]
)
def test_a_character_that_no_page_can_print_is_named(document, where, letter):
    assert isinstance(put(document, where, f"a{letter}b"), str)
    with pytest.raises(InputError, match=r"'a\?b' has the character U\+") as error:
        former(document)
    assert f"U+{ord(letter):04X}, which cannot be printed" in str(error.value)
    assert letter not in str(error.value)


def test_letters_without_a_font_and_millions_of_rows_are_refused(document):
    put(document, ("input", "project", "revision"), "a\u0378b")  # assigned to no letter
    with pytest.raises(InputError, match=r"^x: no font of this machine has .* \(U\+0378\)"):
        former(document)
    with pytest.raises(InputError, match=r"^x: has 1,000,000 objects; at most 100,000 are"):
        former_from(b"[" + b"{}," * 1_000_000 + b"]", "x")


@pytest.mark.quick
def test_what_is_no_file_or_beyond_25_mb_is_refused_before_it_is_read(tmp_path):
    for path, what in (
        (tmp_path / "none.json", "no such file"),
        (tmp_path, "is a folder"),
        (Path("/dev/zero"), "is a pipe or a device"),
    ):
        with pytest.raises(InputError, match=f"{path}: {what}"):
            read_former(path)
    large = tmp_path / "large.json"
    with large.open("wb") as file:
        file.truncate(25_000_001)
    with pytest.raises(InputError, match=r"large\.json: larger than 25 MB"):
        read_former(large)


@pytest.mark.parametrize(
    "text",
    [b"", b"[]", b"null", b"{", b"\xff\xfe", b"[" * 100000, b"1" * 9999, b'{"a": NaN}', b"1e999"],
)
def test_what_is_not_json_is_an_input_error_without_the_words_of_its_reader(text):
    with pytest.raises(InputError) as caught:
        former_from(text, "x")
    assert re.fullmatch(
        rf"x: not a results.json file, or damaged( \(not an object\))?; {AGAIN}", str(caught.value)
    )


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_damaged_bytes_are_read_or_refused_and_never_crash(assessment, content, data):
    damaged = bytearray(content)
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(damaged) - 1))
        length = data.draw(st.integers(0, 40))
        damaged[start : start + length] = data.draw(st.binary(max_size=8))
    try:
        read = former_from(bytes(damaged), "x")
    except InputError:
        return
    package_data(assessment, changes(read, assessment))


@pytest.mark.quick
def test_a_verdict_that_is_lost_with_the_route_is_named():
    """A former version took the displacement of 0 and called the clearance OK."""
    now = projects.unpermitted()
    document = json.loads(results_json(now, assessments.evidence(now)))
    document["clearances"][0] |= {"required_m": 0.0, "verdict": "OK"}
    found = changes(former(document), now)
    shown = {(item.kind, item.title): (item.before, item.now) for item in found.items}
    assert spaced(shown) == {
        (ChangeKind.CLEARANCE, "A1 to RTU-1, required"): ("0.0 in (0 mm)", "none"),
        (ChangeKind.VERDICT, "Clearance A1 to RTU-1"): ("OK", "none"),
    }
    assert found.clearances == {1}


def test_an_array_that_is_new_and_has_no_value_has_none():
    now = projects.assess_input(projects.steep(), assessments.motions(2))
    document = json.loads(results_json(now, assessments.evidence(now)))
    first = document["arrays"].pop(0)["id"]
    found = changes(former(document), now)
    shown = {(item.kind, item.title): (item.before, item.now) for item in found.items}
    assert shown == {
        (ChangeKind.DESIGN, f"Array {first}"): ("—", "none"),
        (ChangeKind.VERDICT, f"Array {first}"): ("—", "NG"),
    }


@pytest.mark.nightly
def test_more_changes_than_can_be_laid_out_are_refused_with_both_limits(assessment, document):
    row = next(row for row in document["checks"] if row["id"] == "max_stories")
    document["checks"] += [row | {"title": f"T{k}"} for k in range(MOST_CHANGES)]
    check_listed(changes(former(document), assessment))
    document["checks"] += [row | {"title": f"U{k}"} for k in range(58_000)]
    with pytest.raises(
        InputError, match=r"--since: .* 60,000 rows of .*; at most 2,000 of .*; use"
    ):
        check_listed(changes(former(document), assessment))
    document["checks"] = [row | {"found_text": "x " * 2_500_000}]
    with pytest.raises(InputError, match=r"--since: .* rows of 5,\d\d\d,\d\d\d characters"):
        check_listed(changes(former(document), assessment))
