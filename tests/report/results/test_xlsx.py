"""results.xlsx: its formulas, evaluated by LibreOffice, give its values; what is live in it."""

import io

import openpyxl
import pytest
from xlsxwriter.workbook import Workbook

from fixtures import assessments, project_parts, projects
from fixtures.cells import address, cell
from fixtures.libreoffice import recalculated
from fixtures.spaces import spaced
from fixtures.workbooks import formula_cells
from report.assessment.checks.sentence import alike, found_and_limit
from report.assessment.support.response_spectra import spectra
from report.provenance.package_sources import fingerprint
from report.results.sheet_columns import SheetColumn, SheetLayout, SheetRow, up_column, write_live
from report.results.sheet_pages import Pages
from report.results.xlsx import results_xlsx

GOVERNING = "Governing array"
SEVEN = assessments.motions(7)


def xlsx(assessment):
    return results_xlsx(assessment, spectra(assessment))


def opened(content):
    """The formulas and the values of a workbook."""
    return [openpyxl.load_workbook(io.BytesIO(content), data_only=flag) for flag in (False, True)]


def made(shaking=SEVEN, **changes):
    """An assessment with the formulas and the values of its workbook."""
    assessment = assessments.package(shaking, **changes).assessment
    return assessment, *opened(xlsx(assessment))


def of(book, name):
    """The address of a cell within its sheet."""
    return cell(book, name).coordinate


def valued(book, row, *headings):
    """The values of a row by heading."""
    return [cell(book, f"{row}/{heading}").value for heading in headings]


def rows_of(sheet, head_row=1):
    """The rows of a sheet below its headings, by heading."""
    head, *rows = sheet.iter_rows(min_row=head_row, values_only=True)
    return [dict(zip(head, row, strict=True)) for row in rows]


@pytest.fixture(scope="module")
def content():
    return xlsx(assessments.usual())


@pytest.fixture(scope="module")
def usual(content):
    return opened(content)


SITE = projects.site()
CASES = {
    "PV1": {},
    "PV1, low category": {"site": SITE | {"sdc": "C", "s_ds_g": 0.45}},
    "ASCE 7-16": {"site": SITE | {"rule_set": "ASCE 7-16", "risk_category": "III", "i_e": 1.25}},
    "peer reviewed": {"options": {**project_parts.REVIEW, "statistic": "1.1 x largest"}},
    "a row of linked blocks": {
        "links": [projects.links("A1", "0.40, 0.50", 50), projects.links("A3", "0.55, 0.55", 50)],
        "options": project_parts.REVIEW,
    },
    "prescriptive": {"site": SITE | {"s_ds_g": 1.0}, "options": {"statistic": "mean"}},
}


@pytest.mark.nightly
def test_every_formula_gives_in_libreoffice_the_value_written_with_it(tmp_path):
    """In one start, from copies without the values."""
    books = [made(**changes)[1:] for changes in CASES.values()]
    links = [projects.links("A1", "0.3, 0.3", 50)]
    books.append(opened(xlsx(projects.unpermitted(links=links))))
    paths = [tmp_path / f"{number}.xlsx" for number in range(len(books))]
    for path, (formulas, _) in zip(paths, books, strict=True):
        formulas.save(path)
    for (formulas, values), computed in zip(books, recalculated(paths, tmp_path), strict=True):
        cells = formula_cells(formulas)
        assert len(cells) > 50
        for at in cells:
            found, wanted = (
                book[at.parent.title][at.coordinate].value for book in (computed, values)
            )
            is_text = isinstance(wanted, str)
            assert found == (wanted if is_text else pytest.approx(wanted, rel=1e-12)), at


def test_the_effect_of_links_follows_from_their_runs():
    assessment, formulas, values = made(**CASES["a row of linked blocks"])
    first, second = assessment.linked
    rows = list(values["LinkRuns"].iter_rows(min_row=2, values_only=True))
    assert len(rows) == 2 * 28
    assert rows[0][5] == pytest.approx(first.motions[0].runs[0].prd_m / 0.0254)
    assert rows[0][7].split(", ")[0] == f"{first.motions[0].runs[0].row.prd_m[0] / 0.0254:.2f}"
    wanted = (("A1", first.estimated_m, "NG"), ("A3", second.design.design_m, "OK"))
    for n, (name, linked_m, result) in enumerate(wanted, start=1):
        row = f"Links/{n}"
        linked = cell(values, f"{row}/Design with links, unrounded").value
        assert linked == pytest.approx(linked_m / 0.0254)
        assert valued(values, row, "Array", "Verdict") == [name, result]
        ratio, used = valued(formulas, row, "Ratio, unrounded", "Design used, unrounded")
        assert (
            ratio
            == f"={of(formulas, f'{row}/Row, unrounded')}/{of(formulas, f'{row}/Rigid, unrounded')}"
        )
        assert used == f"={address(formulas, f'Design/{name}/Design, unrounded')}"


def test_values_runs_and_clearances_are_live_and_listed(usual):
    formulas, values = usual
    name = "Design/A1/Prescriptive, unrounded"
    s_ds, factor, i_e, minimum = (
        of(formulas, f"Design/A1/{head}")
        for head in ("S_DS", "Factor", "I_e in displacement", "Minimum")
    )
    assert cell(formulas, name).value == f"=MAX({factor}*{i_e}*MAX({s_ds}-0.4,0)^2,{minimum})"
    assert cell(values, name).value == pytest.approx(81.573, abs=5e-4)
    gap = assessments.usual().clearances[3]
    assert cell(values, f"Clearances/4/{GOVERNING}").value == "A3"
    source = cell(formulas, "Clearances/4/Design, unrounded").value
    assert source.replace("$", "") == f"={address(formulas, 'Design/A3/Design, unrounded')}"
    design = cell(values, "Design/A3/Design, unrounded").value
    assert design == pytest.approx(gap.design_m / 0.0254)
    rows = rows_of(usual[1]["Runs"])
    assert len(rows) == 3 * 7 * 4
    assert sum(row["Governs"] == "yes" for row in rows) == 3 * 7
    assert rows[0]["Model"] == "3, two axes with vertical"
    assert "second horizontal component" in rows[0]["Reason for model"]
    assert rows[0]["Cross-slope [in]"] > 0.0
    head = [at.value for at in usual[1]["Spectra"][1]]
    assert head[:3] == ["Period [s]", "Horizontal, target [g]", "Horizontal, M1 [g]"]
    assert len(head) == 1 + 3 * 8
    assert "Transverse, M7 [g]" in head
    first, *_ = rows_of(usual[1]["Adjacent items"])
    assert [first[name] for name in ("Array", "Adjacent item", "Type", "Clearance", "Remark")] == [
        "A1", "A3", "array", "No. 1", "agrees with plan; more than 2Δ apart",
    ]  # fmt: skip
    assert first["Distance in plan [in]"] == pytest.approx(180.0)
    rows = rows_of(usual[1]["Motions"])
    assert len(rows) == 7 * 3
    motion = ["M1", "transverse", "roof", "as recorded", "as recorded"]
    assert [*rows[1].values()][:5] == motion
    assert rows[0]["PGA [g]"] == pytest.approx(1.7)


def test_the_design_displacement_follows_from_the_runs(usual):
    formulas, values = usual
    item = assessments.usual().arrays[2]
    largest = "Any direction, unrounded"
    first, last = (of(formulas, f"Peaks/{n}/{largest}") for n in (15, 21))  # of the third array
    mean = cell(formulas, "Design/A3/Mean PRD, unrounded").value
    assert mean == f"=AVERAGE(Peaks!{first}:{last})"
    assert cell(formulas, f"Peaks/15/{largest}").value.startswith("=MAX(Runs!")
    found = cell(values, "Design/A3/Mean PRD, unrounded").value
    assert found == pytest.approx(item.analysis.mean_m / 0.0254)


def test_without_a_value_or_a_route_the_workbook_has_no_verdict():
    steep = projects.steep(links=[projects.links("A1", "0.40, 0.50", 50)])
    values = opened(xlsx(projects.assess_input(steep, assessments.motions(2))))[1]
    assert valued(values, "Design/1", "Design [in]", "Verdict") == ["none", "NG"]
    assert valued(values, "Clearances/1", "Required [in]", "Verdict") == ["none", "none"]
    linked = valued(values, "Links/1", "Array", "Design with links", "Verdict")
    assert linked == ["A1", "none", "NG"]
    assert cell(values, "Summary/Verdict").value == "NG"
    rows = list(values["Requirements"].iter_rows(min_row=5, values_only=True))
    assert any(row[1] == "Number of motions" and row[5] == "NG" for row in rows)
    links = [projects.links("A1", "0.3, 0.3", 50)]
    values = opened(xlsx(projects.unpermitted(links=links)))[1]
    headings = ("Design [in]", "Required [in]", "Required [mm]", "D/C", "Verdict")
    first, second, third = rows_of(values["Clearances"], 4)
    for row in (first, second):
        assert row[GOVERNING] == "A1"
        assert [row[heading] for heading in headings] == ["none"] * 5
    assert third["Verdict"] == "OK"
    assert [row["Verdict"] for row in rows_of(values["Design"], 4)] == ["NG", "NG"]
    assert rows_of(values["Links"], 4)[0]["Verdict"] == "NG"


def test_a_number_is_marked_as_changed_only_where_an_override_changes_it():
    # Its slope is beyond the limit of the prescriptive procedure, and nothing is overridden.
    steep = assessments.shipped("school")
    assert not steep.is_overridden
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(steep, spectra(steep))))
    formats = {cell.number_format for row in book["Design"].iter_rows() for cell in row}
    assert not any("‡" in shown for shown in formats)


def test_texts_stay_texts_and_two_runs_give_the_same_bytes(content, usual):
    _, formulas, _ = made(arrays=[projects.array("=1+1", 1.0)], clearances=[])
    for sheet in ("Design", "Runs"):
        name = cell(formulas, f"{sheet}/1/Array")
        assert (name.value, name.data_type) == ("=1+1", "s")
    assert xlsx(assessments.usual()) == content
    assert usual[0].properties.created.date() == assessments.usual().project.project.date


def test_every_requirement_and_limit_and_every_verdict_is_in_the_workbook(usual):
    assessment, values = assessments.usual(), usual[1]
    assert values.sheetnames[:2] == ["Summary", "Design"]
    assert not {"Links", "LinkRuns"} & set(values.sheetnames)  # no row of blocks is asked for
    assert cell(values, "Summary/Verdict").value == assessment.verdict.value
    for item in assessment.arrays:
        verdict = assessment.array_verdict(item)
        assert cell(values, f"Design/{item.id}/Verdict").value == verdict
    rows = [row[:6] for row in values["Requirements"].iter_rows(min_row=5, values_only=True)]
    wanted = [
        (c.subject or "Project", c.title, *found_and_limit(c, True), c.clause, c.verdict)
        for c in alike(c for c in assessment.checks if c.id != "clearance")  # they have a sheet
    ]
    assert rows == spaced(wanted)


@pytest.mark.quick
def test_the_summary_has_every_check_that_is_open_and_no_kind_twice(usual):
    assessment, values = assessments.usual(), usual[1]
    rows = [row for row in values["Summary"].iter_rows(values_only=True) if row[0]]
    heads = [row[0] for row in rows]
    last = rows[heads.index("Not satisfied") + 1 :]
    wanted = alike(check for check in assessment.checks if check.is_open)
    assert sorted((row[0], row[6]) for row in last) == spaced(
        sorted((c.title, c.verdict) for c in wanted)
    )
    assert all(row[4] and row[5] for row in last if row[6] == "Condition")
    governing = rows[heads.index("Governing checks") + 1 : heads.index("Not satisfied")]
    assert len({row[0] for row in governing}) == len(governing)
    ratios = [row[4] for row in governing]
    assert ratios == sorted(ratios, reverse=True)
    head = {row[0]: row[1] for row in rows if row[1]}
    assert head["Hash"] == fingerprint(assessment.source, assessment.shaking)
    assert head["Project number"] == assessment.project.project.number


LAYOUT = SheetLayout(
    "Peaks",
    (
        SheetColumn("motion", "Motion", lambda row: row["motion"]),
        up_column("any_m", "Any direction [in]", lambda row: row["any_m"], 1, "={peak}*10"),
        SheetColumn("twice_m", "Twice [in]", lambda row: 2 * row["any_m"], 1, "=2*{any_m}"),
        SheetColumn("note", "Note", lambda row: row["note"]),
    ),
)


@pytest.mark.quick
def test_a_column_is_said_once_with_its_heading_unit_digits_and_formula():
    row = SheetRow(item={"motion": "M1", "any_m": 0.254, "note": "=1"}, refs={"peak": 1})
    content = io.BytesIO()
    with Workbook(content, {"strings_to_formulas": False}) as workbook:
        workbook.add_worksheet("Peaks")
        write_live(Pages(workbook, "A project"), LAYOUT, [row], "Peaks", "")
    formulas, values = opened(content.getvalue())
    head = next(line for line in values["Peaks"].iter_rows(values_only=True) if "Motion" in line)
    assert head[1:4] == ("Any direction [in]", "Twice [in]", "Note")
    assert head[-1] == "Any direction, unrounded [in]"
    twice, name = (cell(formulas, f"Peaks/1/{heading}") for heading in ("Twice", "Note"))
    assert twice.value == f"=2*{of(formulas, 'Peaks/1/Any direction, unrounded')}"
    assert (twice.number_format, name.value, name.data_type) == ("0.0", "=1", "s")
    assert cell(values, "Peaks/1/Twice").value == pytest.approx(20.0)
