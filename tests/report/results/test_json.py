"""results.json: what a machine reads."""

import json
import math

import pytest

from fixtures import assessments, project_parts, projects
from fixtures.spaces import spaced
from report.assessment.causes import came_to
from report.assessment.checks.sentence import sentence
from report.project.model.choices import Direction
from report.results.results_json import results_json
from report.text.amounts import Amount


def made(assessment):
    return json.loads(results_json(assessment, assessments.evidence(assessment)))


def run(shaking=None, **changes):
    """An assessment with its document."""
    assessment = assessments.package(shaking, **changes).assessment
    return assessment, made(assessment)


@pytest.fixture(scope="module")
def document():
    return made(assessments.usual())


def test_json_has_the_assessment_in_si_with_models_and_peaks(document):
    assessment = assessments.usual()
    designs = [array["design_m"] for array in document["arrays"]]
    assert designs == [item.design_m for item in assessment.arrays]
    assert document["arrays"][0]["prescriptive_m"] == pytest.approx(1.166**2 * 60 * 0.0254)
    assert len(document["arrays"][1]["runs"]) == 28
    assert document["clearances"][4]["required_m"] == assessment.clearances[4].required_m
    assert document["verdict"] == assessment.verdict.value
    assert document["s_ds_g"] == 1.566
    array, item = document["arrays"][2], assessment.arrays[2]
    for direction in Direction:
        peaks = [motion[f"{direction.name.lower()}_m"] for motion in array["peaks"]]
        assert peaks == [motion.peak_m(direction) for motion in item.motions]
    found, solution = array["runs"][0], item.motions[0].runs[0].solution
    assert (found["rung"], found["model"]) == (3, "two axes with vertical")
    assert (found["reason"], found["error_m"]) == (spaced(solution.reason), solution.result.error_m)
    assert found["across_m"] == solution.result.across_m
    assert found["next_effect_m"] is None
    gap = document["clearances"][3]
    assert (gap["governing_array"], gap["design_m"]) == (item.id, item.design_m)
    check_units(document)


def test_quantities_have_ordinary_spaces_and_a_name_stays_as_it_was_typed():
    head = project_parts.HEAD | {"name": "Hall\u00a0A"}
    assessment = assessments.package(project=head).assessment
    text = results_json(assessment, assessments.evidence(assessment)).decode()
    assert json.loads(text)["input"]["project"]["name"] == head["name"]
    assert text.count("\u00a0") == 1


def test_json_has_smaller_events_links_and_prescriptive_values():
    for array in run(assessments.motions(2))[1]["arrays"]:
        assert array["route"] == "prescriptive"
    links = [projects.links("A2", "0.40, 0.50", 50, damping_ratio=0.05)]
    assessment, document = run(links=links)
    (item,), (row,) = assessment.linked, document["linked"]
    assert (row["array"], row["mus"], row["damping_ratio"]) == ("A2", [0.4, 0.5], 0.05)
    assert (row["ratio"], row["estimated_m"]) == (item.ratio, item.estimated_m)
    assert row["design_m"] == document["arrays"][1]["design_m"]
    assert row["rigid_is_enough"] is item.is_rigid_enough
    assert len(row["runs"]) == 12
    assert tuple(row["runs"][5]["prd_m"]) == item.motions[1].runs[1].row.prd_m
    assert max(one["link_force_n"] for one in row["runs"]) == row["link_force_n"]
    check_units(document)
    options = {**project_parts.REVIEW, "smaller_events": "0.50, 0.50, 0.25"}
    assessment, document = run(options=options)
    for row, item in zip(document["cumulative"], assessment.arrays, strict=True):
        assert row["array"] == item.id
        assert row["largest_m"] == max(row["sums_m"].values())
        assert row["mean_m"] > item.analysis.mean_m


def test_json_has_velocities_and_what_the_low_velocity_coefficient_alone_gives():
    arrays = [
        projects.array("A1", 0.5),
        projects.array("A3", 3.0, y=90, mu=0.30, mu_fast=0.45, mu_rate_s_per_m=20.0),
    ]
    gaps = [projects.clearance("A1", "RTU-1", 2.0), projects.clearance("A3", "T-1", 2.0)]
    assessment, document = run(arrays=arrays, clearances=gaps)
    for array in document["arrays"]:
        assert array["peak_speed_mps"] == max(one["peak_speed_mps"] for one in array["runs"])
    laws = [array["friction_as_run"] for array in document["arrays"]]
    assert laws == ["0.45", "0.30–0.45 (velocity-dependent)"]
    (alone,), (gap,) = document["low_velocity"]["arrays"], document["low_velocity"]["clearances"]
    assert (alone["id"], alone["mu"]) == ("A3", 0.30)
    assert alone["design_m"] == assessment.low_velocity.arrays[0].design_m
    assert (gap["array"], gap["object"]) == ("A3", "T-1")


UNITS = ("_m", "_s", "_g", "_n", "_rad", "_deg", "_mps", "_mps2", "_hz", "_percent")
PLAIN = {
    "mu", "scale", "polarity", "n_stops", "factor", "demand_capacity", "npts", "i_e", "f_a",
    "f_v", "stories", "slope_value", "found", "limit", "scale_value", "value",
    "prd_variation", "order", "stiffness_ratio", "n_modes", "next_mode_share",
    "left_out_share", "mu_slow", "mu_fast", "mu_static", "rung", "next_rung", "friction_demand",
    "demand", "capacity", "held_ratio", "sliding_ratio", "times", "mus", "ratio",
    "least_mu", "lowest_mu_tried", "given", "resolution", "verified", "n_values",
    "n_unfinished", "n_runs", "damping_ratio", "schema_version", "i_p", "force_factor",
    "force_divisor", "importance", "decimals",
    "ratio_decimals", "analysis_factor",
}  # fmt: skip


def check_units(value, key=""):
    if isinstance(value, dict):
        for name, item in value.items():
            check_units(item, name)
    elif isinstance(value, list):
        for item in value:
            check_units(item, key)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        assert key.endswith(UNITS) or key in PLAIN, key


def test_a_missing_value_and_infinite_demand_over_zero_clearance_are_null():
    document = made(projects.assess_input(projects.steep(), assessments.motions(2)))
    assert document["arrays"][0]["design_m"] is None
    gap = document["clearances"][0]
    assert (gap["required_m"], gap["verdict"]) == (None, "none")
    assert document["verdict"] == "NG"
    assessment, document = run(clearances=[projects.clearance("A1", "RTU-1", 0.0)])
    assert math.isinf(assessment.clearances[0].demand_capacity)
    (gap,) = document["clearances"]
    assert (gap["demand_capacity"], gap["verdict"]) == (None, "NG")


@pytest.fixture(scope="module")
def supported():
    """A clearance that is NG beside one that contradicts the plan, with the evidence."""
    gaps = [projects.clearance("A1", "RTU-1", 0.5), projects.clearance("A1", "A3", 4.572)]
    assessment = assessments.package(clearances=gaps).assessment
    evidence = assessments.evidence(assessment)
    return assessment, evidence, json.loads(results_json(assessment, evidence))


def test_json_has_what_would_do_margins_angles_and_neighbors(supported):
    assessment, evidence, document = supported
    rows = document["remedies"]
    found = evidence.remedies
    assert [row["change"] for row in rows[: len(found.own)]] == [
        spaced(each.words) for each in found.own
    ]
    for row, each in zip(rows, found.own, strict=False):
        assert row["verdict"] == each.done.verdict
        assert row["quantities"] == [each.kind]
        assert row["governing"] == came_to(each.done)
    assert rows[0]["checks"] == ["Clearance, A1 to RTU-1"]
    check_units(document)
    margins = document["certainty"]["margins"]
    assert [row["array"] for row in margins] == ["A1", "A1", "A3"]
    assert margins[0]["least_mu"] is None  # NG as given
    least = [item.minimum_mu for item in evidence.uncertainty.margins]
    assert [row["least_mu"] for row in margins[1:]] == least[1:]
    angles = document["certainty"]["angles"]
    assert [row["angle_deg"] for row in angles["turned"]][:3] == [22.5, 45.0, 67.5]
    assert len(angles["turned"]) == 12
    runs = [one for motion in assessment.governing.motions for one in motion.runs]
    assert angles["prd_m"] == max(one.prd_m for one in runs)
    assessment, _, document = supported
    rows = {(row["array"], row["other"]): row for row in document["neighbors"]}
    missing = [row["is_missing"] for row in rows.values()]
    assert missing == [near.is_missing for near in assessment.neighbors]
    assert rows["A1", "RTU-1"]["contradictions"]
    rows = document["checks"]
    assert [row["id"] for row in rows] == [check.id for check in assessment.checks]
    for row, check in zip(rows, assessment.checks, strict=True):
        assert (row["is_satisfied"], row["verdict"]) == (check.is_satisfied, check.verdict)
        is_number = isinstance(check.limit, Amount)
        assert row["limit"] == (check.limit.value if is_number else None)
        assert row["limit_text"] in sentence(check, True) or is_number
    assert {"", "m", "s", "deg", "N"} <= {row["unit"] for row in rows}


@pytest.mark.quick
def test_json_has_no_verdict_where_no_route_is_permitted():
    document = made(projects.unpermitted())
    first, _ = document["arrays"]
    assert (first["design_m"], first["design_permitted"], first["verdict"]) == (0.0, False, "NG")
    for gap in document["clearances"][:2]:
        assert [gap[key] for key in ("required_m", "demand_capacity", "design_m")] == [None] * 3
        assert gap["verdict"] == "none"
    assert document["clearances"][2]["verdict"] == "OK"
    assert document["verdict"] == "NG"
