"""A study from its workbook to its files: results against single runs, pages, tables, exports."""

import csv
import dataclasses
import html
import io
import json
import math
import re
import shutil
import sys
from statistics import NormalDist
from types import SimpleNamespace

import defusedxml.ElementTree
import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from dlml import get_fragility, get_metadata, vocabulary
from dlml._tabular import load_tabular
from openpyxl import load_workbook
from test_study_read import at, command, given, sheet_rows, with_study, write

import printed
import stranger
from report.cli.main import main
from report.cli.study import make
from report.study import figures, files
from report.study.curves import compare
from report.study.exports import (
    component_id,
    export_files,
    has_probabilities,
    known_states,
    probabilities_of,
)
from report.study.files import study_html
from report.study.run import estimate, planned, run_study
from report.study.schema import Intensity, NoValue, StudyArray, StudyBuilding
from report.study.tables import curves_csv, study_xlsx
from report.study.wording import headline, sentence
from report.text.units import Quantity
from report.typeset.pdf import lay_out
from solver import solve
from solver.files import LOCK, locked
from solver.model import InputError, coulomb
from solver.studies.fragility import UNKNOWN, Lognormal
from studied import forged


def small(**changes):
    """A study of six motions that slides, with two arrays and a chance."""
    about = {
        "slopes_deg": "0, 2, 4",
        "intensities": "0.2 to 2.4 by 0.2",
        "mus": "0.3, 0.5",
        "allowed_m": 0.1,
        "site_intensity": 1.0,
        "intensity_beta": 0.2,
        "slope_tolerance_deg": 0.25,
        "samples": 20,
    }
    arrays = (
        StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.1, reaches="RTU & co"),
        StudyArray(id="S 2", mat="B", slope_deg=0.0, clearance_m=0.02),
    )
    return given(**{**about, "study_arrays": arrays, **changes})


@pytest.fixture(scope="module")
def laid_out():
    """The HTML of the study that is laid out."""
    return []


@pytest.fixture(scope="module")
def made(tmp_path_factory, laid_out):
    folder = write(tmp_path_factory.mktemp("study"), small(), motions=6)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(files, "lay_out", lambda html: laid_out.append(html) or lay_out(html))
        done = command(folder)
    assert done.exit_code == 0, done.output
    return folder, done.output


@pytest.fixture(scope="module")
def steps():
    """What the study says of its progress."""
    return []


@pytest.fixture(scope="module")
def results(made, steps):
    plan, _ = planned(made[0])
    return run_study(plan, made[0] / "out" / "study", progress=steps.append)


@pytest.mark.nightly
def test_the_last_steps_say_how_many_arrays_are_done_and_the_time_left(results, steps):
    assert steps[0] == "computing the curves"  # every run is there
    first, second, *_ = [step for step in steps if "capacities" in step]
    start, count = "computing the capacities of arrays", len(results.plan.arrays)
    assert first == f"{start}: 0 of {count}"
    assert re.fullmatch(rf"{start}: 1 of {count}, \d+ s left", second)


@pytest.fixture
def other(tmp_path):
    """A function that runs another study of the same motions and returns its results."""

    def run(**changes):
        folder = write(tmp_path, small(**changes), motions=6)
        return run_study(planned(folder)[0], tmp_path / "out")

    return run


def in_one_go(results):
    """The results of the command that computed every run."""
    return dataclasses.replace(results, manifest={**results.manifest, "taken_over": []})


def peak(plan, motion, building, slope_deg, mu, intensity):
    """PRD of a motion by single runs; NaN for none."""
    one = plan.motions.motions[building][motion]
    one = dataclasses.replace(one, scale=one.scale * intensity)
    found = [
        solve(one.scene(h, slope_rad=math.radians(slope_deg), friction=coulomb(mu))).result
        for h in one.orientations
    ]
    return max(r.prd_m for r in found) if all(r.status == "ok" for r in found) else math.nan


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
    for k, x in enumerate(array.states[0].fragility.capacities.intensity):
        assert peak(plan, k, 0, 2.0, 0.4, (1.0 - 1e-9) * x) == 0.0
        assert peak(plan, k, 0, 2.0, 0.4, (1.0 + 1e-3) * x) > 0.0


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
    assert {bar.name for bar in array.bars} == {"friction coefficient", "slope", "intensity"}


@pytest.mark.nightly
def test_a_chance_without_a_value_at_the_medians_has_no_chart_and_says_so(results):
    """Such as uplift in a motion: a chart over no number would end the report after all runs."""
    one = results.arrays[0]
    bars = tuple(
        dataclasses.replace(bar, prd_low_m=math.nan, prd_high_m=math.nan) for bar in one.bars
    )
    one = dataclasses.replace(one, bars=bars, center_m=math.nan)
    page = printed.study(having(results, one))
    _, chances = page.split("no final PRD with all variables at their medians")
    assert "[" not in chances.partition("#")[0]


@pytest.mark.quick
def test_a_sheet_is_drawn_where_cases_without_a_value_leave_a_contour_no_line():
    """Such as uplift on one slope: the end of a study whose runs are done."""
    design_m = np.array([[0.1, 0.2, 0.3], [np.nan] * 3, [3.0] * 3])
    inch, x = Quantity.DISPLACEMENT.us, np.arange(3.0)
    drawn = figures.contours(x, x, design_m, design_m, inch, along="PPA [g]", allowed_m=1.0)
    assert ">PPA [g]<" in drawn


@pytest.mark.nightly
def test_motions_without_a_final_prd_are_counted(results):
    lost = dataclasses.replace(results.curves, without_value=results.curves.without_value + 1)
    cases, said = lost.mean_m.size, printed.study(dataclasses.replace(results, curves=lost))
    assert int(results.curves.without_value.sum()) == 0
    assert f"{cases} of {6 * cases} pairs of case and motion have no final PRD" in said


@pytest.mark.nightly
def test_a_mat_without_tests_has_no_bar_for_friction(results):
    assert {bar.name for bar in results.arrays[1].bars} == {"slope", "intensity"}


def test_censored_and_exceeding_runs_without_a_value_differ_as_stated(other):
    """A friction below the slope never lets the block stop: no value at any intensity."""
    arrays = (StudyArray(id="S", mat="A", slope_deg=30.0, clearance_m=0.1),)
    common = {"study_arrays": arrays, "site_intensity": None, "intensity_beta": 0.0}
    one = other(no_value=NoValue.EXCEEDANCE, **common).arrays[0].states[2].fragility
    two = other(no_value=NoValue.CENSORED, **common).arrays[0].states[2].fragility
    assert one.exceeded.tolist() == [6] * 12
    assert (one.censored, two.censored) == (0, 72)
    assert two.counted.tolist() == [0] * 12


# The files


@pytest.mark.nightly
def test_the_command_writes_every_file_and_prints_the_results(made, results):
    folder, output = made
    out = folder / "out" / "study"
    for name in ("study.pdf", "curves.csv", "study.xlsx", "fragility.csv", "fragility.xml"):
        assert (out / name).stat().st_size > 100
        assert str(out / name) in output
    assert all(line in output for line in headline(in_one_go(results)))
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


def test_a_dry_run_prints_and_writes_nothing(tmp_path):
    folder = write(tmp_path, small())
    done = command(folder, "--dry-run")
    assert done.exit_code == 0
    found = estimate(planned(folder)[0])
    assert f"{found.runs:,} runs" in done.output
    assert "MB on disk" in done.output
    assert not (folder / "out").exists()


@pytest.mark.parametrize("missing", ["pyarrow", "pyarrow.parquet", "scipy"])
def test_without_the_extra_the_command_says_what_to_type(tmp_path, monkeypatch, missing):
    monkeypatch.delitem(sys.modules, "pyarrow.parquet", raising=False)  # of another test
    monkeypatch.setitem(sys.modules, missing, None)
    done = command(tmp_path)
    assert done.exit_code == 2
    assert "pip install 'roofslip[study]'" in done.output
    assert "./roofslip study" in done.output


def test_an_input_error_ends_with_two_and_the_cell(tmp_path):
    folder = write(tmp_path, small(slopes_deg="no"))
    done = command(folder)
    assert done.exit_code == 2
    assert at("<Study/Slopes>") in done.output


def test_new_writes_a_blank_study_that_is_read(tmp_path):
    done = CliRunner().invoke(main, ["new", str(tmp_path / "new"), "--study"])
    assert done.exit_code == 0, done.output
    assert "roofslip study" in done.output
    both = CliRunner().invoke(main, ["new", str(tmp_path / "x"), "--study", "--example"])
    assert both.exit_code == 2
    done = command(tmp_path / "new")
    assert done.exit_code == 2
    assert "title is missing" in done.output


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
    assert about["Design displacement"] == sentence(results, "design")
    for row, state in zip(sheet_rows(results, "Fragility"), results.arrays[0].states, strict=False):
        wanted = state.fragility.fitted.theta
        assert row["Median theta"] == ("none" if math.isnan(wanted) else pytest.approx(wanted))


LIVE = [
    "=1+1", "{=1+1}", "+1+1", "-1+1", "@SUM(A1)", "http://a.test", "mailto:a@b.test",
    "internal:Study!A1", "external:a.xlsx", "file:///etc/passwd", r"\\server\share",
    '=HYPERLINK("http://a.test")', "1e3", "-0.5", "#N/A",
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
    """There pelicun and OpenQuake have no measure. Of six motions the largest counts."""
    assert compare(results, 0) == ()
    found = other(intensity=Intensity.S_DS, s_ds_g=1.0, intensities="0.2 to 2 by 0.2")
    (one,) = compare(found, 0)
    level = found.plan.input.intensities[6]
    wanted = max(60.0 * 0.0254 * (level - 0.4) ** 2, 6.0 * 0.0254)
    ratio = 1.1 * found.curves.largest_m[0, 1, 1, 6] / wanted
    assert one.ratio[1, 1, 6] == pytest.approx(ratio, nan_ok=True)
    safe = int((one.ratio <= 1.0).sum())
    assert f"sufficient in {safe:,} of {one.ratio.size:,} cases" in printed.study(found)
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
    said = printed.study(found)
    assert "Design curves, building T1" in said
    assert "Design curves, building T2" in said


def test_one_case_makes_a_report(other):
    found = other(
        slopes_deg="2", intensities="1", mus="", mats=small().mats[1:], study_arrays=(),
        site_intensity=None, intensity_beta=0.0, allowed_m=None,
    )  # fmt: skip
    assert isinstance(found.fits[0], str)
    assert "None is given" in printed.study(found)


# The exports

# Of openquake.commonlib.nrml and openquake.hazardlib.valid
SIMPLE_ID = re.compile(r"[\w_\-]{1,75}")
IMT = re.compile(r"PGA|PGV|SA\(\d+\.\d+\)")
ROOF, GROUND = "roof motion, not of the ground.", "ground motion, not of the roof."


def read_nrml(content):
    """Read a discrete fragility model of NRML 0.5 as OpenQuake does, which reads no unit.

    Its functions have (imt, limit of no damage, levels, chances by limit state).
    """
    space = "{http://openquake.org/xmlns/nrml/0.5}"
    root = defusedxml.ElementTree.fromstring(content)
    assert root.tag == f"{space}nrml"
    (model,) = root
    assert model.tag == f"{space}fragilityModel"
    assert set(model.attrib) == {"id", "assetCategory", "lossCategory"}
    assert SIMPLE_ID.fullmatch(model.attrib["id"])
    description, states, *functions = model
    assert (description.tag, states.tag) == (f"{space}description", f"{space}limitStates")
    assert description.text.strip()
    names = states.text.split()
    assert all(SIMPLE_ID.fullmatch(name) for name in names)
    found = {}
    for function in functions:
        assert function.tag == f"{space}fragilityFunction"
        assert function.attrib["format"] == "discrete"
        levels, *chances = function
        assert levels.tag == f"{space}imls"
        assert set(levels.attrib) == {"imt", "noDamageLimit"}
        assert IMT.fullmatch(levels.attrib["imt"])
        x = np.array(levels.text.split(), float)
        assert x[0] > 0.0
        assert (np.diff(x) > 0.0).all()
        limit = float(levels.attrib["noDamageLimit"])
        assert 0.0 < limit < x[0]  # 0 is warned of; without one nothing is known below x[0]
        assert [c.attrib["ls"] for c in chances] == names
        p = np.array([c.text.split() for c in chances], float)
        assert p.shape == (len(names), x.size)
        assert (np.diff(p, axis=0) <= 0.0).all()  # a damage state is the difference of two
        assert ((p >= 0.0) & (p <= 1.0)).all()
        assert function.attrib["id"] not in found
        found[function.attrib["id"]] = levels.attrib["imt"], limit, x, p
    return names, found


def having(results, *arrays):
    """The results with other arrays."""
    return dataclasses.replace(results, arrays=arrays)


def with_fit(state, fit, **counts):
    """A limit state with another lognormal, and no dispersion beside its own."""
    found = dataclasses.replace(state.fragility, fitted=fit, **counts)
    return dataclasses.replace(state, fragility=found, effects={})


# The reader sets an option that its pandas no longer needs.
@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")
@pytest.mark.nightly
def test_pelicun_reads_the_library(made, results, tmp_path):
    path = made[0] / "out/study/fragility.csv"
    found = load_tabular(path)
    theirs = get_fragility(P58)
    assert found.columns.names == theirs.columns.names
    assert [c for c in theirs.columns if c[0] == "LS1" and c not in found.columns] == []
    known = [one for one in results.arrays if known_states(one)]
    assert len(found) == len(known) > 0
    row = found.iloc[0]
    assert row["Demand", "Type"] in vocabulary.EDP_TYPES
    assert row["Demand", "Unit"] == "g"
    array = min(known, key=lambda one: component_id(results, one))  # the reader sorts
    for state in known_states(array):
        name, fitted = state.name, state.fragility.fitted
        assert row[name, "Family"] == "lognormal"
        assert float(row[name, "Theta_0"]) == pytest.approx(fitted.theta, rel=1e-5)
        assert float(row[name, "Theta_0"]) <= fitted.theta * (1 + 1e-9)
        total = math.hypot(fitted.beta, *state.effects.values())
        assert float(row[name, "Theta_1"]) == pytest.approx(total, rel=1e-5)
        assert float(row[name, "Theta_1"]) >= total * (1 - 1e-9)


# The reader sets an option that its pandas no longer needs.
@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")
@pytest.mark.nightly
def test_an_undetermined_state_leaves_the_others_their_names_in_every_file(results, tmp_path):
    fits = Lognormal(theta=0.5, beta=0.1), UNKNOWN, Lognormal(theta=1.5, beta=0.2)
    states = one, _, three = tuple(map(with_fit, results.arrays[0].states, fits))
    made = export_files(having(results, dataclasses.replace(results.arrays[0], states=states)))
    (tmp_path / "fragility.csv").write_bytes(made["fragility.csv"])
    row = load_tabular(tmp_path / "fragility.csv").iloc[0]
    for state in (one, three):
        theta = float(row[state.name, "Theta_0"])
        assert theta == pytest.approx(state.fragility.fitted.theta, rel=1e-5)
        assert row[state.name, "Description"] == f"{state.words[:1].upper()}{state.words[1:]}."
    assert pd.isna(row["LS2", "Family"])
    assert pd.isna(row["LS2", "Theta_0"])
    assert row["LS2", "Description"] == "Half the clearance is used. Not determined."
    entry = json.loads(made["fragility.json"])["BSA.S1"]
    assert list(entry["LimitStates"]) == ["LS1", "LS3"]
    about = defusedxml.ElementTree.fromstring(made["fragility.xml"])[0][0].text
    assert "BSA.S1: LS1: Slip begins. LS2: Half the clearance is used. Not determined." in about
    assert "Fractions of the motions, without any dispersion. LS3: RTU & co is" in about


P58 = "seismic/building/component/FEMA P-58 2nd Edition"


@pytest.mark.nightly
def test_the_metadata_have_the_keys_of_fema_p58(made, results):
    ours = json.loads((made[0] / "out/study/fragility.json").read_text())
    theirs = get_metadata(P58, "fragility")
    example = next(entry for key, entry in theirs.items() if not key.startswith("_"))
    for key, entry in ours.items():
        if key.startswith("_"):
            assert entry.keys() <= theirs[key].keys() | {"ComponentGroups"}
            continue
        assert entry.keys() <= example.keys() | {"Comments", "Description"}
        assert set(entry["LimitStates"]) <= {"LS1", "LS2", "LS3"}
    header, *rows = csv.reader(io.StringIO((made[0] / "out/study/placement.csv").read_text()))
    assert header == ["", "Units", "Location", "Direction", "Theta_0", "Blocks", "Comment"]
    assert [row[0] for row in rows] == [key for key in ours if not key.startswith("_")]
    assert all(row[1] == "ea" for row in rows)


@pytest.mark.parametrize(
    ("changes", "imt", "per_unit", "said", "which"),
    [({}, "PGA", 1.0, "PGA in g is the peak horizontal acceleration of the roof", ROOF),
     ({"intensity": Intensity.PGA}, "PGA", 1.0, "PGA in g is the peak horizontal", GROUND),
     ({"intensity": Intensity.PPV}, "PGV", 100.0, "PGV in cm/s is the peak horizontal velo", ROOF),
     ({"intensity": Intensity.SA1}, "SA(1.0)", 1.0,
      "SA(1.0) in g is the horizontal spectral acceleration at 1 s with 5 % damping", ROOF)],
)  # fmt: skip
@pytest.mark.nightly
def test_openquake_takes_the_levels_in_its_unit_and_each_file_says_of_which_motion_they_are(
    results, changes, imt, per_unit, said, which
):
    made = export_files(with_study(results, **changes))
    _, found = read_nrml(made["fragility.xml"])
    for name, limit, x, _ in found.values():
        assert name == imt
        assert limit == pytest.approx(1e-3 * x[0])
        assert x == pytest.approx(per_unit * np.array(results.plan.input.intensities))
    assert said in made["fragility.xml"].decode()
    placed = list(csv.DictReader(io.StringIO(made["placement.csv"].decode())))
    comments = [json.loads(made["fragility.json"])[row[""]]["Comments"] for row in placed]
    for text in (*comments, *(row["Comment"] for row in placed), made["fragility.xml"].decode()):
        assert which in text


@pytest.mark.nightly
def test_openquake_has_the_chances_at_every_intensity(made, results):
    names, found = read_nrml((made[0] / "out/study/fragility.xml").read_bytes())
    assert names == ["LS1", "LS2", "LS3"]
    assert list(found) == ["BSA.S1", "BSA.S-2"]
    for (imt, _, x, p), array in zip(found.values(), results.arrays, strict=True):
        assert imt == "PGA"
        assert x == pytest.approx(results.plan.input.intensities)
        for row, wanted in zip(p, probabilities_of(results, array), strict=True):
            assert row == pytest.approx(wanted, abs=1.01e-6)
            assert (row >= wanted - 1e-11).all()
            assert (np.diff(row) >= 0.0).all()


@pytest.mark.nightly
def test_limit_states_that_cross_have_no_negative_chance_between_them(results):
    """OpenQuake's chance of a damage state is the difference of two limit states."""
    one = results.arrays[0]
    fits = Lognormal(theta=1.0, beta=0.1), Lognormal(theta=1.2, beta=0.8)
    crossing = dataclasses.replace(one, states=tuple(map(with_fit, one.states[:2], fits)))
    _, found = read_nrml(export_files(having(results, crossing))["fragility.xml"])
    ((_, _, x, (first, second)),) = found.values()
    alone = [[NormalDist(math.log(f.theta), f.beta).cdf(math.log(v)) for v in x] for f in fits]
    assert second == pytest.approx(alone[1], abs=1.01e-6)
    assert first == pytest.approx(np.max(alone, axis=0), abs=1.01e-6)


@pytest.mark.nightly
def test_an_array_whose_runs_are_censored_has_no_chance_of_zero_in_openquake(results):
    """Of a motion without a value it is not known whether it exceeds: 0 of 0 is no chance."""
    one, levels = results.arrays[0], len(results.plan.input.intensities)

    def without_lognormal(name, **counts):
        first = with_fit(one.states[0], UNKNOWN, **counts)
        array = one.plan.array.model_copy(update={"id": name})
        plan = dataclasses.replace(one.plan, array=array)
        return dataclasses.replace(one, states=(first, *one.states[1:]), plan=plan)

    counted, exceeded = np.array([7] * (levels - 2) + [1, 0]), np.minimum(np.arange(levels), 7)
    lost = without_lognormal("A2", counted=counted, exceeded=0 * exceeded, censored=13)
    whole = without_lognormal("A3", counted=np.full(levels, 7), exceeded=exceeded, censored=0)
    made = export_files(having(results, one, lost, whole))["fragility.xml"]
    _, found = read_nrml(made)
    assert list(found) == ["BSA.S1", "BSA.A3"]
    assert "BSA.A2 is left out: LS1 has no lognormal and censored runs." in made.decode()
    *_, p = found["BSA.A3"]
    assert p[0] == pytest.approx(np.maximum(exceeded / 7.0, p[1]), abs=1.01e-6)
    assert "fragility.xml" not in export_files(having(results, lost))


@pytest.mark.nightly
def test_without_arrays_there_is_nothing_to_export(results):
    assert export_files(having(results)) == {}


# What a user may do to the folder of a study


@pytest.mark.quick
def test_a_study_does_not_replace_its_own_workbook(tmp_path):
    folder = write(tmp_path, small())
    book = (folder / "input.xlsx").rename(folder / "study.xlsx")
    content = book.read_bytes()
    done = command(book, "--out", folder)
    assert done.exit_code == 2, done.output
    assert "is an input of this run, and would be replaced by its study.xlsx" in done.output
    assert book.read_bytes() == content
    assert not (folder / "runs").exists()


def test_a_study_does_not_begin_in_place_of_a_file(tmp_path):
    folder = write(tmp_path, small())
    (tmp_path / "out").write_text("mine")
    done = command(folder)
    assert done.exit_code == 2
    assert "is a file, not a folder, and is not written to" in done.output


@pytest.mark.nightly
def test_a_study_does_not_replace_the_results_of_another_workbook(made, tmp_path):
    out = shutil.copytree(made[0] / "out", tmp_path / "out")
    book = (write(tmp_path, small()) / "input.xlsx").rename(tmp_path / "b.xlsx")
    done = command(book)
    assert done.exit_code == 2
    told = done.output.splitlines()
    assert told[1].startswith(f"  {out / 'study'}: has the results of input.xlsx, not of b.xlsx;")
    assert told[2].startswith(f"{out / 'study' / 'study.pdf'} and ")
    study, before = (folder / "study.xlsx" for folder in (out / "study", made[0] / "out" / "study"))
    assert study.read_bytes() == before.read_bytes()


def test_a_second_study_in_the_same_folder_waits_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.files.WAIT_S", 0.1)
    folder = write(tmp_path, small())
    runs = folder / "out" / "study" / "runs"
    runs.mkdir(parents=True)
    plan, _ = planned(folder)
    with locked(runs), pytest.raises(InputError, match="another command has been writing there"):
        make(plan, runs.parent, lambda _: None)
    assert list(runs.iterdir()) == []


@pytest.mark.nightly
def test_warnings_on_the_workbook_are_printed_with_the_basis(results):
    warned = dataclasses.replace(results.plan, warnings=(("Mats!B8", "cell B8 is struck through"),))
    table = printed.study(dataclasses.replace(results, plan=warned)).table("Warnings on the")
    assert table.cells == (("Mats!B8", "cell B8 is struck through."),)
    assert "Warnings on the workbook" not in printed.study(results)


@pytest.mark.parametrize(
    ("censored", "is_known", "has"), [(0, False, True), (2, True, True), (2, False, False)]
)
@pytest.mark.quick
def test_an_array_has_probabilities_where_each_state_has_a_lognormal_or_all_its_runs(
    censored, is_known, has
):
    fitted = Lognormal(theta=0.5, beta=0.4) if is_known else UNKNOWN
    state = SimpleNamespace(name="S1", fragility=SimpleNamespace(censored=censored, fitted=fitted))
    array = SimpleNamespace(states=(state,))
    assert has_probabilities(array) == has
    assert known_states(array) == ((state,) if is_known else ())


# Parts of another user or machine


@pytest.fixture
def forged_study(made, tmp_path):
    """A plan, the folder of its outputs, and its study after part 0 was forged."""
    out = shutil.copytree(made[0] / "out" / "study", tmp_path / "out")
    forged(out / "runs" / "part-00000.parquet")
    return planned(made[0])[0], out


@pytest.mark.nightly
def test_runs_that_are_taken_over_are_stated_with_their_dates(made, results):
    """The first study took over nothing; that which went on with its parts says so."""
    today = json.loads((made[0] / "out/study/manifest.json").read_text())["taken_over"]
    rows = results.manifest["rows"]
    (one,) = today
    assert one == {**one, "runs": rows, "on_the_word_of": "the key of this user"}
    told = (
        f"{rows:,} of the {rows:,} runs were taken over from parts that are signed with the key of"
        f" this user and were computed on {one['from']} (UTC)"
    )
    assert told in headline(results)
    assert "taken over" not in made[1]
    assert {"What": "Runs taken over", "Value": told} in sheet_rows(results, "Study")


@pytest.mark.nightly
def test_a_forged_part_is_computed_again_and_the_user_is_told(forged_study, results):
    plan, out = forged_study
    with pytest.warns(
        UserWarning, match=r": 1 part \([0-9,]+ runs\) without .*--trust-parts takes"
    ):
        found = run_study(plan, out)
    assert np.array_equal(found.curves.mean_m, results.curves.mean_m, equal_nan=True)
    (own,) = found.manifest["taken_over"]
    assert 0 < own["runs"] < found.manifest["rows"]


@pytest.mark.nightly
def test_a_forged_part_is_taken_over_on_the_word_of_the_option_and_every_file_says_so(
    forged_study, results
):
    plan, out = forged_study
    found = run_study(plan, out, trust_parts=True, allow_matched=True)
    slid = results.curves.mean_m > 0.0
    shares = found.curves.mean_m[slid] / results.curves.mean_m[slid]
    assert shares.min() == pytest.approx(0.25)
    own, other = found.manifest["taken_over"]
    assert own["runs"] + other["runs"] == found.manifest["rows"]
    assert other["on_the_word_of"] == "--trust-parts"
    told = (
        f"{other['runs']:,} of the {found.manifest['rows']:,} runs were taken over on the word of"
        " --trust-parts: their parts are not signed with the key of this user and state that they"
        " were computed on 2001-02-03 (UTC)"
    )
    assert json.loads((out / "manifest.json").read_text())["taken_over"] == [own, other]
    assert told in printed.study(found)
    assert {"What": "Runs taken over", "Value": told} in sheet_rows(found, "Study")
    exports = export_files(found)
    assert len(exports) == 4
    for content in exports.values():
        text = content.decode() if isinstance(content, bytes) else content
        assert f"{told}." in html.unescape(text)
    with pytest.warns(UserWarning, match="computed again"):
        run_study(plan, out)  # taken over, it is not signed


@pytest.mark.filterwarnings("always::UserWarning")  # the command prints them
@pytest.mark.nightly
def test_the_command_takes_forged_parts_over_only_when_told_to(made, tmp_path):
    folder = shutil.copytree(made[0], tmp_path / "job")
    forged(folder / "out/study/runs/part-00000.parquet")
    done = command(folder, "--trust-parts")
    assert done.exit_code == 0, done.output
    assert "on the word of --trust-parts" in done.output
    done = command(folder)
    assert done.exit_code == 0, done.output
    assert "warning: computed again: 1 part (" in done.output
    assert "on the word of" not in done.output


STUDY = ("out", "out/study", "out/study/runs", "out/study/manifest.json", "out/study/study.xlsx",
         "out/study/runs/part-00000.parquet", f"out/study/runs/{LOCK}")  # fmt: skip


@pytest.mark.parametrize(
    ("place", "kind"),
    [(place, kind) for place in STUDY for kind in ("link", "dangling link", "pipe", "device")]
    + [(place, "hard link") for place in STUDY if place.endswith(LOCK)],
)
def test_a_study_is_not_written_through_what_is_in_its_place(tmp_path, place, kind):
    outside = tmp_path / "outside"
    outside.write_bytes(b"theirs")
    job = write(tmp_path / "job", small())
    (job / place).parent.mkdir(parents=True, exist_ok=True)
    stranger.occupied(job / place, kind, outside)
    before = stranger.state(tmp_path)
    told = command(job).output
    assert f"{job / place}: is a" in told
    assert stranger.state(tmp_path) == before
