"""The displacements of the design event and of smaller ones add to what separate runs give."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.cumulative import cumulative
from report.assessment.evidence import support
from report.results.json import results_json
from sheets import edit, make, problems, read_workbook
from solver.sliding.checked import slide
from solver.sliding.least_model import DEFAULT

FACTORS = "0.50, 0.50, 0.25"
G = 9.80665


def made(events=FACTORS, found=None):
    options = {"peer_reviewed": True, "smaller_events": events}
    return scenes.package(found, options=options).assessment


def test_each_sum_is_that_of_separate_runs():
    assessment = made()
    for item in cumulative(assessment):
        for run, total in zip(item.array.motions, item.sums_m, strict=True):
            peaks = []
            for factor in (1.0, 0.5, 0.5, 0.25):
                alone = []
                for heading in run.motion.headings:
                    pair = (run.motion.ax_mps2, run.motion.ay_mps2)
                    along, across = pair[::-1] if heading.swapped else pair
                    alone.append(
                        slide(
                            factor * run.motion.scale * heading.sign * along,
                            run.motion.dt_s,
                            slope_rad=item.array.array.slope_rad,
                            mu=item.array.array.mu,
                            ay_mps2=factor * run.motion.scale * across if across.size else None,
                            az_mps2=factor * run.motion.scale * run.motion.az_mps2,
                        ).prd_m
                    )
                peaks.append(max(alone))
            assert abs(total - sum(peaks)) <= sum(map(DEFAULT.bound_m, peaks))
        assert item.mean_m == pytest.approx(np.mean(item.sums_m))
        assert item.largest_m == max(item.sums_m)


def test_a_rectangular_pulse_gives_the_closed_form():
    """A level block under one pulse slides v^2 / 2 (1/(mu g) - 1/a) (Newmark 1965)."""
    mu, seconds, dt = 0.45, 0.5, 0.001
    pulse = np.zeros(4001)
    pulse[1000:1500] = 1.0 * G
    motion = replace(stand_in.motion("P", pulse, dt_s=dt, signs=(1,)), scale=1.0)
    assessment = made("0.60", (motion,))
    for item in cumulative(assessment):
        closed = 0.0
        for factor in (1.0, 0.6):
            a, resisting = factor * G, mu * G
            speed = a * seconds
            closed += speed**2 / 2 * (1 / resisting - 1 / a)
        if item.array.array.slope_rad == 0.0:
            assert item.sums_m[0] == pytest.approx(closed, rel=3e-3)


def test_the_sums_carry_the_factor_of_the_design_value_beside_them():
    """Three motions: 1.1 times the largest, which is what a sum is compared with."""
    done = made()
    page = printed(done, "how-sure")
    table = page.table("Cumulative displacement over the motions")
    assert table.headings[1::2] == (
        "1.10 × mean sum [in]", "1.10 × largest sum [in]", "Design displacement [in]",
    )  # fmt: skip
    for item, row in zip(cumulative(done), table.cells, strict=True):
        assert row[1] == f"{1.1 * item.mean_m / 0.0254:.1f}"
        assert row[3] == f"{1.1 * item.largest_m / 0.0254:.1f}"
    assert "carry the factor 1.10† of the value from analysis" in page


def test_a_run_without_a_final_value_leaves_no_sum():
    run = made().arrays[0]
    assert math.isnan(type(cumulative(made())[0])(array=run, sums_m=(1.0, math.nan)).largest_m)


def test_it_is_off_unless_the_workbook_names_events():
    assessment = made("")
    assert cumulative(assessment) == ()
    assert "Cumulative displacement" not in printed(assessment, "how-sure")
    assert "starts from the installed position." in printed(assessment, "basis")


def test_results_have_what_is_added():
    assessment = made()
    document = json.loads(results_json(assessment, support(assessment)))
    assert [item["array"] for item in document["cumulative"]] == [a.id for a in assessment.arrays]
    first = document["cumulative"][0]
    assert first["largest_m"] == max(first["sums_m"].values())
    assert first["mean_m"] > assessment.arrays[0].analysis.mean_m


@pytest.mark.parametrize(
    "typed", ["0.5, 1.2", "0.0", "half", "0,5", "-0.5", ", ".join(["0.5"] * 21)]
)
@pytest.mark.by_day(2)
def test_factors_outside_of_the_range_are_refused_by_cell(tmp_path, typed):
    path = edit(make(tmp_path), lambda book: found(book).__setattr__("value", typed))
    (line,) = problems(path)
    assert line.startswith("Options!")
    assert "give up to 20 factors with decimal points, above 0.0 and up to 1.0" in line


def test_factors_are_read_from_the_sheet(tmp_path):
    path = edit(make(tmp_path), lambda book: found(book).__setattr__("value", FACTORS))
    assert read_workbook(path).input.options.smaller_factors == (0.5, 0.5, 0.25)


def found(book):
    """The cell of the factors."""
    title, cell = book.defined_names["options_smaller_events"].attr_text.split("!")
    return book[title.strip("'")][cell.replace("$", "")]
