"""A study from its workbook to its files: results against single runs, pages, tables, exports."""

import csv
import dataclasses
import io
import json
import math
import re
import sys

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from fixtures import pages
from fixtures.spaces import spaced
from fixtures.study_workbooks import (
    cell_address,
    command,
    having,
    in_one_go,
    peak,
    sheet_rows,
    small,
    study_input,
    with_study,
    write,
)
from report.cli.main import main
from report.study import study_charts
from report.study.exports import export_files
from report.study.outputs import study_html
from report.study.prescribed import compare
from report.study.run_study import planned, run_study
from report.study.sentences import design, headline
from report.study.study_input import Intensity, NoValue, StudyArray, StudyBuilding
from report.study.study_tables import curves_csv, study_xlsx
from report.text.units import Quantity


@pytest.mark.nightly
def test_the_last_steps_say_how_many_arrays_are_done_and_the_time_left(results, steps):
    assert steps[0] == "computing the curves"  # every run is there
    first, second, *_ = [step for step in steps if "capacities" in step]
    start, count = "computing the capacities of arrays", len(results.plan.arrays)
    assert first == f"{start}: 0 of {count}"
    assert re.fullmatch(rf"{start}: 1 of {count}, \d+ s left", second)


@pytest.mark.nightly
def test_curves_are_those_of_single_runs(results):
    plan = results.plan
    for s, slope in enumerate(plan.input.slopes_deg):
        for m, mu in enumerate(plan.input.mus):
            for x in (0, 5, 11):
                level = plan.input.intensities[x]
                prd = np.array([peak(plan, k, 0, slope, mu, level) for k in range(6)])
                at = 0, s, m, x
                assert results.curves.mean_m[at] == pytest.approx(
                    prd.mean(), rel=1e-13, nan_ok=True
                )
                largest = np.nan if np.isnan(prd).any() else prd.max()
                assert results.curves.largest_m[at] == pytest.approx(largest, nan_ok=True)


@pytest.mark.nightly
def test_fragilities_are_those_of_single_runs(results):
    plan = results.plan
    array = results.arrays[0]
    levels = plan.input.intensities
    for state, limit in zip(array.states[1:], (0.05, 0.1), strict=True):
        counts = [sum(not peak(plan, k, 0, 2.0, 0.4, x) <= limit for k in range(6)) for x in levels]
        assert state.fragility.exceeded.tolist() == counts
        found = state.fragility.capacities
        for k, x in enumerate(found.intensity):
            assert peak(plan, k, 0, 2.0, 0.4, x) <= limit
            if found.is_censored[k]:
                assert x == levels[-1]
            else:
                assert not peak(plan, k, 0, 2.0, 0.4, 1.00011 * x) <= limit
        known = np.log(found.intensity[~found.is_censored])
        if known.size == 6:
            assert math.log(state.fragility.fitted.theta) == pytest.approx(known.mean(), rel=1e-9)
            assert state.fragility.fitted.beta == pytest.approx(known.std(ddof=1), rel=1e-9)
    slips = [sum(peak(plan, k, 0, 2.0, 0.4, x) != 0.0 for k in range(6)) for x in levels]
    assert array.states[0].fragility.exceeded.tolist() == slips


@pytest.mark.nightly
def test_the_chance_is_that_of_the_samples(results):
    plan, array = results.plan, results.arrays[0]
    cases = plan.campaign.cases[array.plan.samples]
    over = [
        not peak(plan, k, 0, math.degrees(slope), mu, x) <= 0.1
        for slope, mu, x in zip(cases.slope_rad, cases.mu, cases.intensity, strict=True)
        for k in range(6)
    ]
    assert array.exceedances[0].value == pytest.approx(np.mean(over), abs=1e-12)
    assert array.exceedances[0].runs == 120
    bars = [{bar.name for bar in one.bars} for one in results.arrays]
    assert bars == [{"friction coefficient", "slope", "intensity"}, {"slope", "intensity"}]


@pytest.mark.nightly
def test_a_chance_without_a_value_at_the_medians_has_no_chart_and_says_so(results):
    """Such as uplift in a motion: a chart over no number would end the report after all runs."""
    one = results.arrays[0]
    bars = tuple(
        dataclasses.replace(bar, prd_low_m=math.nan, prd_high_m=math.nan) for bar in one.bars
    )
    one = dataclasses.replace(one, bars=bars, center_m=math.nan)
    page = pages.study(having(results, one))
    _, chances = page.split("no final PRD with all variables at their medians")
    assert "[" not in chances.partition("#")[0]


@pytest.mark.quick
def test_a_sheet_is_drawn_where_cases_without_a_value_leave_a_contour_no_line():
    """Such as uplift on one slope: the end of a study whose runs are done."""
    design_m = np.array([[0.1, 0.2, 0.3], [np.nan] * 3, [3.0] * 3])
    inch, x = Quantity.DISPLACEMENT.us, np.arange(3.0)
    drawn = study_charts.contours(x, x, design_m, design_m, inch, along="PPA [g]", allowed_m=1.0)
    assert ">PPA [g]<" in drawn


@pytest.mark.nightly
def test_motions_without_a_final_prd_are_counted(results):
    lost = dataclasses.replace(results.curves, without_value=results.curves.without_value + 1)
    cases, said = lost.mean_m.size, pages.study(dataclasses.replace(results, curves=lost))
    assert int(results.curves.without_value.sum()) == 0
    assert f"{cases} of {6 * cases} pairs of case and motion have no final PRD" in said


@pytest.mark.nightly
def test_censored_and_exceeding_runs_without_a_value_differ_as_stated(other):
    """A friction below the slope never lets the block stop: no value at any intensity."""
    arrays = (StudyArray(id="S", mat="A", slope_deg=30.0, clearance_m=0.1),)
    common = {"study_arrays": arrays, "site_intensity": None, "intensity_beta": 0.0}
    one = other(no_value=NoValue.EXCEEDANCE, **common).arrays[0].states[2].fragility
    two = other(no_value=NoValue.CENSORED, **common).arrays[0].states[2].fragility
    assert one.exceeded.tolist() == [6] * 12
    assert (one.censored, two.censored) == (0, 72)
    assert two.counted.tolist() == [0] * 12


@pytest.mark.nightly
def test_the_command_writes_every_file_and_prints_the_results(made, results):
    folder, output = made
    out = folder / "out" / "study"
    for name in ("study.pdf", "curves.csv", "study.xlsx", "fragility.csv"):
        assert (out / name).stat().st_size > 100
        assert str(out / name) in output
    assert all(line in output for line in spaced(headline(in_one_go(results))))
    assert "s of processor time\n" in output
    manifest = json.loads((out / "manifest.json").read_text())
    assert sum(manifest["models"].values()) == manifest["rows"]
    assert manifest["about"]["seed"] == 1
    rows = pd.concat(pd.read_parquet(path) for path in sorted((out / "runs").glob("part-*")))
    assert len(rows) == manifest["rows"]


@pytest.mark.nightly
def test_a_second_run_writes_the_same_bytes_but_for_what_it_took_over(made, results, laid_out):
    """Layout is tested for it in tests/report/proof/test_verify_package.py."""
    once = in_one_go(results)
    assert [study_html(once)] == laid_out
    tables = {"curves.csv": curves_csv(results), "study.xlsx": study_xlsx(once)}
    for name, content in {**tables, **export_files(results)}.items():
        assert (made[0] / "out" / "study" / name).read_bytes() == content, name


@pytest.mark.parametrize("missing", ["pyarrow", "pyarrow.parquet", "scipy"])
def test_without_the_extra_the_command_says_what_to_type(tmp_path, monkeypatch, missing):
    monkeypatch.delitem(sys.modules, "pyarrow.parquet", raising=False)  # of another test
    monkeypatch.setitem(sys.modules, missing, None)
    done = command(tmp_path)
    assert done.exit_code == 2
    assert "pip install '.[study]' in its folder" in done.output
    assert "./roofslip study" in done.output


def test_new_writes_a_blank_study_that_is_read(tmp_path):
    done = CliRunner().invoke(main, ["new", str(tmp_path / "new"), "--study"])
    assert done.exit_code == 0, done.output
    assert "roofslip study" in done.output
    both = CliRunner().invoke(main, ["new", str(tmp_path / "x"), "--study", "--example"])
    assert both.exit_code == 2
    done = command(tmp_path / "new")
    assert done.exit_code == 2
    assert f"{cell_address('<Study/Title>')}: title is missing" in done.output


@pytest.mark.nightly
def test_curves_csv_has_every_case(made, results):
    rows = list(csv.DictReader(io.StringIO((made[0] / "out/study/curves.csv").read_text())))
    assert len(rows) == results.curves.mean_m.size
    means = [float(row["mean_prd_m"] or "nan") for row in rows]
    assert np.array_equal(means, results.curves.mean_m.ravel(), equal_nan=True)
    design = [float(row["design_displacement_before_the_floor_m"] or "nan") for row in rows]
    assert np.array_equal(design, results.design_m.ravel(), equal_nan=True)
    assert list(rows[0])[3] == "intensity (PPA [g])"


@pytest.mark.nightly
def test_the_workbook_holds_summaries_only(made, results):
    book = load_workbook(made[0] / "out/study/study.xlsx")
    assert book.sheetnames == [
        "Study", "Curves", "Least friction", "Largest slope", "Fragility", "Probabilities",
        "Formula",
    ]  # fmt: skip
    assert max(sheet.max_row for sheet in book) <= results.curves.mean_m.size * 3 + 1
    curve = sheet_rows(results, "Curves")[11]
    for head, values in (
        ("Design displacement before the floor [in]", results.design_m),
        ("Mean PRD [in]", results.curves.mean_m),
    ):
        assert curve[head] == pytest.approx(values[0, 0, 0, 11] / 0.0254)
    about = {row["What"]: row["Value"] for row in sheet_rows(results, "Study")}
    assert about["Design displacement"] == design(results.plan.design_rule)
    for row, state in zip(sheet_rows(results, "Fragility"), results.arrays[0].states, strict=False):
        wanted = state.fragility.fitted.theta
        assert row["Median theta"] == ("none" if math.isnan(wanted) else pytest.approx(wanted))


LIVE = [
    "=1+1", "{=1+1}", "-1+1", "@SUM(A1)", "http://a.test", "mailto:a@b.test", "internal:Study!A1",
    "file:///etc/passwd", r"\\server\share", "1e3", "-0.5", "#N/A",
]  # fmt: skip


@pytest.mark.parametrize("name", LIVE)
@pytest.mark.nightly
def test_a_name_is_text_in_the_tables_whatever_it_looks_like(results, name):
    plan = results.plan
    buildings = dataclasses.replace(plan.motions, buildings=(name,))
    array = results.arrays[0].plan
    own = dataclasses.replace(array, array=array.array.model_copy(update={"id": name}))
    altered = dataclasses.replace(
        with_study(results, title=name), arrays=(dataclasses.replace(results.arrays[0], plan=own),)
    )
    plan = dataclasses.replace(altered.plan, motions=buildings)
    altered = dataclasses.replace(altered, plan=plan)
    book = load_workbook(io.BytesIO(study_xlsx(altered)))
    named = [cell for sheet in book for row in sheet.iter_rows() for cell in row]
    assert {"Study", "Curves", "Fragility"} <= {c.parent.title for c in named if c.value == name}
    assert {c.data_type for c in named} == {"s", "n"}
    assert not any(cell.hyperlink for cell in named)
    shown = name if name in ("-0.5", "1e3") or name[0] not in "=+-@" else f"'{name}"
    rows = list(csv.DictReader(io.StringIO(curves_csv(altered).decode())))
    assert {row["building"] for row in rows} == {shown}


@pytest.mark.nightly
def test_the_prescriptive_displacement_is_compared_where_the_intensity_is_s_ds(other, results):
    """There pelicun has no measure. Of six motions the largest counts."""
    assert compare(results, 0) == ()
    found = other(intensity=Intensity.S_DS, s_ds_g=1.0, intensities="0.2 to 2 by 0.2")
    (one,) = compare(found, 0)
    level = found.plan.input.intensities[6]
    wanted = max(60.0 * 0.0254 * (level - 0.4) ** 2, 6.0 * 0.0254)
    ratio = 1.1 * found.curves.largest_m[0, 1, 1, 6] / wanted
    assert one.ratio[1, 1, 6] == pytest.approx(ratio, nan_ok=True)
    safe = int((one.ratio <= 1.0).sum())
    assert f"sufficient in {safe:,} of {one.ratio.size:,} cases" in pages.study(found)
    assert export_files(found) == {}


@pytest.mark.nightly
def test_a_family_of_buildings_has_curves_each(other):
    buildings = (StudyBuilding(id="T1", period_s=0.2), StudyBuilding(id="T2", period_s=1.0))
    found = other(
        intensity=Intensity.PGA, recorded_at="ground", buildings=buildings, site_intensity=None,
        intensity_beta=0.0, intensities="0.4, 0.8", slopes_deg="0, 3", mus="",
    )  # fmt: skip
    assert found.curves.mean_m.shape == (2, 2, 2, 2)
    assert len(found.arrays) == 4
    for b in (0, 1):
        prd = [peak(found.plan, k, b, 3.0, 0.4, 0.8) for k in range(6)]
        assert found.curves.mean_m[b, 1, 0, 1] == pytest.approx(np.mean(prd), nan_ok=True)
    said = pages.study(found)
    assert "Design curves, building T1" in said
    assert "Design curves, building T2" in said


def test_one_case_makes_a_report(other):
    found = other(
        slopes_deg="2", intensities="1", mus="", mats=small().mats[1:], study_arrays=(),
        site_intensity=None, intensity_beta=0.0, allowed_m=None,
    )  # fmt: skip
    assert isinstance(found.fits[0], str)
    assert "None is given" in pages.study(found)


def test_two_axes_say_how_large_the_error_of_a_displacement_is(tmp_path):
    one = study_input(slopes_deg="2", intensities="1", study_arrays=())
    said = {
        letters: pages.study(
            run_study(planned(str(write(tmp_path / letters, one, motions=1, letters=letters)))[0],
                      str(tmp_path / f"out-{letters}"))
        )
        for letters in ("x", "xy")
    }  # fmt: skip
    wanted = "In two axes the error of a displacement is at most 0.01% of the PRD."
    assert [wanted in text for text in said.values()] == [False, True]


@pytest.mark.nightly
def test_warnings_on_the_workbook_are_printed_with_the_basis(results):
    warned = dataclasses.replace(results.plan, warnings=(("Mats!B8", "cell B8 is struck through"),))
    table = pages.study(dataclasses.replace(results, plan=warned)).table("Warnings on the")
    assert table.cells == (("Mats!B8", "cell B8 is struck through."),)
    assert "Warnings on the workbook" not in pages.study(results)


CHANGING = (
    (r"Program( \|)? Roofslip.*", "Program <versions>"),
    (r"Study( \|)? [0-9a-f]{16}", "Study <hash>"),
    (r"all batches ran on .*?: a repetition produces the same bits", "<machine>"),
)


def test_a_study_has_the_words_that_it_had(golden, tmp_path):
    """Taken over by `./roofslip test --golden`: of S_DS, tests, a clearance and a tolerance."""
    study = small(intensity=Intensity.S_DS, s_ds_g=1.0, intensities="0.2 to 2 by 0.2")
    folder = write(tmp_path, study, motions=4)
    text = pages.study(run_study(planned(str(folder))[0], str(tmp_path / "out")))
    for pattern, placeholder in CHANGING:
        text = re.sub(pattern, placeholder, text)
    golden("study.txt", text)
