"""A study from its workbook to its files: results against single runs, pages, tables, exports."""

import csv
import dataclasses
import io
import json
import math
import re
import sys

import defusedxml.ElementTree
import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from dlml import get_fragility, get_metadata, vocabulary
from dlml._tabular import load_tabular
from openpyxl import load_workbook
from pypdf import PdfReader
from test_study_exports import read_nrml
from test_study_read import at, given, write

import packages
import printed
from report.cli.main import main
from report.cli.study import make
from report.pages.symbols import with_symbols
from report.results.publish import locked
from report.sheet.schema import UnitsFirst
from report.study import files
from report.study.exports import chances_of, component_id, export_files, known_states
from report.study.files import study_files, study_html
from report.study.prescribed import compare
from report.study.read import read_study
from report.study.run import estimate, planned, run_study
from report.study.schema import Intensity, NoValue, StudyArray, StudyBuilding
from report.study.template import write_study
from report.study.words import design_words, headline
from report.typeset.pdf import lay_out
from report.words.units import digits_down
from solver import solve
from solver.model import InputError, coulomb
from solver.studies.curves import least_friction
from solver.studies.fragility import UNKNOWN, Lognormal


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
        done = CliRunner().invoke(main, ["study", str(folder)])
    assert done.exit_code == 0, done.output
    return folder, done.output


@pytest.fixture
def unlaid(monkeypatch):
    """Have reports written as HTML."""
    monkeypatch.setattr(files, "lay_out", str.encode)


@pytest.fixture
def undrawn(unlaid):
    """Have reports written as HTML, their charts left out."""
    with packages.undrawn():
        yield


@pytest.fixture(scope="module")
def results(made):
    plan, _ = planned(made[0])
    return run_study(plan, made[0] / "out" / "study")


@pytest.fixture
def other(tmp_path):
    """A function that runs another study of the same motions and returns its results."""

    def run(**changes):
        folder = write(tmp_path, small(**changes), motions=6)
        return run_study(planned(folder)[0], tmp_path / "out")

    return run


def peak(plan, motion, building, slope_deg, mu, intensity):
    """PRD of a motion by single runs; NaN for none."""
    one = plan.motions.motions[building][motion]
    one = dataclasses.replace(one, scale=one.scale * intensity)
    found = [
        solve(one.scene(h, slope_rad=math.radians(slope_deg), friction=coulomb(mu))).result
        for h in one.orientations
    ]
    return max(r.prd_m for r in found) if all(r.status == "ok" for r in found) else math.nan


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


def test_the_chance_is_that_of_the_samples(results):
    plan, array = results.plan, results.arrays[0]
    cases = plan.campaign.cases[array.plan.samples]
    over = [
        not peak(plan, k, 0, math.degrees(slope), mu, x) <= 0.1
        for slope, mu, x in zip(cases.slope_rad, cases.mu, cases.intensity, strict=True)
        for k in range(6)
    ]
    assert array.chances[0].value == pytest.approx(np.mean(over), abs=1e-12)
    assert array.chances[0].runs == 120
    assert {bar.name for bar in array.bars} == {"friction coefficient", "slope", "intensity"}


def test_a_chance_without_a_value_at_the_medians_has_no_chart_and_says_so(results):
    """Such as uplift in a motion: a chart over no number would end the report after all runs."""
    one = results.arrays[0]
    bars = tuple(
        dataclasses.replace(bar, prd_low_m=math.nan, prd_high_m=math.nan) for bar in one.bars
    )
    one = dataclasses.replace(one, bars=bars, center_m=math.nan)
    page = printed.study(dataclasses.replace(results, arrays=(one,)))
    _, chances = page.split("no final PRD with all variables at their medians")
    assert "[" not in chances.partition("#")[0]


def test_a_mat_without_tests_has_no_bar_for_friction(results):
    assert {bar.name for bar in results.arrays[1].bars} == {"slope", "intensity"}


def test_least_friction_is_read_off_the_curve(results):
    mus = np.array(results.plan.input.mus)
    found = results.least_frictions(0, "largest PRD", 0.1)
    wanted = least_friction(mus, results.curves.largest_m[0, 1, :, 6], 0.1)
    assert found[1, 6] == pytest.approx(wanted, abs=0.01, nan_ok=True)
    assert not found[1, 6] < wanted


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


def test_the_command_writes_every_file_and_prints_the_results(made, results):
    folder, output = made
    out = folder / "out" / "study"
    for name in ("study.pdf", "curves.csv", "study.xlsx", "fragility.csv", "fragility.xml"):
        assert (out / name).stat().st_size > 100
        assert str(out / name) in output
    assert all(line in output for line in headline(results))
    assert "s of processor time\n" in output
    manifest = json.loads((out / "manifest.json").read_text())
    assert sum(manifest["models"].values()) == manifest["rows"]
    assert manifest["about"]["seed"] == 1
    rows = pd.concat(pd.read_parquet(path) for path in sorted((out / "runs").glob("part-*")))
    assert len(rows) == manifest["rows"]


def test_a_second_run_runs_nothing_and_writes_the_same_bytes(made, results, laid_out, unlaid):
    """Layout is tested for it in tests/report/proof/test_verify_package.py."""
    out = made[0] / "out" / "study"
    written = study_files(results)
    assert [written.pop("study.pdf").decode()] == laid_out
    for name, content in written.items():
        assert (out / name).read_bytes() == content, name


def test_a_dry_run_prints_and_writes_nothing(tmp_path):
    folder = write(tmp_path, small())
    done = CliRunner().invoke(main, ["study", str(folder), "--dry-run"])
    assert done.exit_code == 0
    found = estimate(planned(folder)[0])
    assert f"{found.runs:,} runs" in done.output
    assert "processor time" in done.output
    assert "MB on disk" in done.output
    assert not (folder / "out").exists()


@pytest.mark.parametrize("missing", ["pyarrow", "pyarrow.parquet"])
def test_without_the_extra_the_command_says_what_to_type(tmp_path, monkeypatch, missing):
    monkeypatch.setitem(sys.modules, missing, None)
    done = CliRunner().invoke(main, ["study", str(tmp_path)])
    assert done.exit_code == 2
    assert "pip install 'roofslip[study]'" in done.output
    assert "./roofslip study" in done.output


def test_an_input_error_ends_with_two_and_the_cell(tmp_path):
    folder = write(tmp_path, small(slopes_deg="no"))
    done = CliRunner().invoke(main, ["study", str(folder)])
    assert done.exit_code == 2
    assert at("<Study/Slopes>") in done.output


def test_new_writes_a_blank_study_that_is_read(tmp_path):
    done = CliRunner().invoke(main, ["new", str(tmp_path / "new"), "--study"])
    assert done.exit_code == 0, done.output
    assert "roofslip study" in done.output
    both = CliRunner().invoke(main, ["new", str(tmp_path / "x"), "--study", "--example"])
    assert both.exit_code == 2
    done = CliRunner().invoke(main, ["study", str(tmp_path / "new")])
    assert done.exit_code == 2
    assert "title is missing" in done.output


def test_curves_csv_has_every_case(made, results):
    rows = list(csv.DictReader(io.StringIO((made[0] / "out/study/curves.csv").read_text())))
    assert len(rows) == results.curves.mean_m.size
    means = [float(row["mean_prd_m"] or "nan") for row in rows]
    assert np.array_equal(means, results.curves.mean_m.ravel(), equal_nan=True)
    design = [float(row["design_displacement_before_the_floor_m"] or "nan") for row in rows]
    assert np.array_equal(design, results.design_m.ravel(), equal_nan=True)
    assert list(rows[0])[3] == "intensity (PPA [g])"


def test_the_workbook_holds_summaries_only(made, results):
    book = load_workbook(made[0] / "out/study/study.xlsx")
    assert book.sheetnames == [
        "Study", "Curves", "Least friction", "Largest slope", "Fragility", "Chances", "Formula",
    ]  # fmt: skip
    assert max(sheet.max_row for sheet in book) <= results.curves.mean_m.size * 3 + 1
    heads = [cell.value for cell in book["Curves"][1]]
    for head, values in (
        ("Design displacement before the floor [in]", results.design_m),
        ("Mean PRD [in]", results.curves.mean_m),
    ):
        value = book["Curves"].cell(2 + 11, 1 + heads.index(head)).value
        assert value == pytest.approx(values[0, 0, 0, 11] / 0.0254)
    about = {row[0].value: row[1].value for row in book["Study"]}
    assert about["Design displacement"] == design_words(results)
    theta = [row[6].value for row in book["Fragility"].iter_rows(min_row=2)]
    for found, state in zip(theta[:3], results.arrays[0].states, strict=True):
        wanted = state.fragility.fitted.theta
        assert found == ("none" if math.isnan(wanted) else pytest.approx(wanted))


def text_of(pdf):
    return " ".join(" ".join(page.extract_text() for page in PdfReader(pdf).pages).split())


def test_the_pages_state_what_was_found(made, results):
    text = text_of(made[0] / "out/study/study.pdf")
    assert "1 Results" in text
    assert "Fragility of S1" in text
    assert "of the PRD, not of the design displacement" in text
    assert "RTU & co" in text
    lost = int(results.curves.without_value.sum())
    assert ("Every motion gave a final PRD" in text) == (lost == 0)
    fit = results.fits[0]
    assert f"{results.manifest['rows']:,} runs" in text
    assert "outside" in text or isinstance(fit, str)
    state = results.arrays[0].states[2].fragility
    assert digits_down(state.fitted.theta, 3) in text


def test_the_prescriptive_displacement_is_compared_where_the_intensity_is_s_ds(
    other, results, undrawn
):
    assert compare(results, 0) == ()
    found = other(intensity=Intensity.S_DS, s_ds_g=1.0, intensities="0.2 to 2 by 0.2")
    one = compare(found, 0)[0]
    at = 0, 1, 1, 6
    level = found.plan.input.intensities[6]
    wanted = max(60.0 * 0.0254 * (level - 0.4) ** 2, 6.0 * 0.0254)
    # Six motions: the largest counts.
    ratio = 1.1 * found.curves.largest_m[at] / wanted
    assert one.ratio[1, 1, 6] == pytest.approx(ratio, nan_ok=True)
    written = study_files(found)
    prose = written["study.pdf"].decode()
    text = packages.words(prose)
    assert "Beside the prescriptive displacement" in text
    safe = int((one.ratio <= 1.0).sum())
    assert f"enough in {safe:,} of {one.ratio.size:,} cases" in text
    # Set as a symbol on the pages; the charts write it as the sheet does.
    assert str(with_symbols("S_DS")) in prose
    assert not re.search(r"<(p|li|figcaption)[^>]*>[^<]*S_DS", prose)
    # pelicun and OpenQuake have no measure S_DS.
    assert set(written) == {"study.pdf", "curves.csv", "study.xlsx"}


@pytest.mark.nightly("report/study/", "solver/studies/")
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
    text = packages.words(study_html(found))
    assert "building T1" in text
    assert "building T2" in text


def test_one_case_makes_a_report(other):
    found = other(
        slopes_deg="2", intensities="1", mus="", mats=small().mats[1:], study_arrays=(),
        site_intensity=None, intensity_beta=0.0, allowed_m=None,
    )  # fmt: skip
    assert isinstance(found.fits[0], str)
    assert "None is given" in packages.words(study_html(found))


# The exports


def known(results):
    """The arrays with a lognormal of any limit state."""
    return [a for a in results.arrays if known_states(a)]


# The reader sets an option that its pandas no longer needs.
@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")
def test_pelicun_reads_the_library(made, results, tmp_path):
    path = made[0] / "out/study/fragility.csv"
    found = load_tabular(path)
    theirs = get_fragility(P58)
    assert found.columns.names == theirs.columns.names
    assert [c for c in theirs.columns if c[0] == "LS1" and c not in found.columns] == []
    assert len(found) == len(known(results)) > 0
    row = found.iloc[0]
    assert row["Demand", "Type"] in vocabulary.EDP_TYPES
    assert row["Demand", "Unit"] == "g"
    array = min(known(results), key=lambda one: component_id(results, one))  # the reader sorts
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
def test_an_undetermined_state_leaves_the_others_their_names_in_every_file(results, tmp_path):
    fits = Lognormal(theta=0.5, beta=0.1), UNKNOWN, Lognormal(theta=1.5, beta=0.2)
    states = tuple(
        dataclasses.replace(state, fragility=dataclasses.replace(state.fragility, fitted=fit))
        for state, fit in zip(results.arrays[0].states, fits, strict=True)
    )
    one, _, three = states
    array = dataclasses.replace(results.arrays[0], states=states)
    made = export_files(dataclasses.replace(results, arrays=(array,)))
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
    ("changes", "imt", "per_unit", "said"),
    [({}, "PGA", 1.0, "PGA in g is the peak horizontal acceleration of the roof motion, not of"),
     ({"intensity": Intensity.PPV}, "PGV", 100.0,
      "PGV in cm/s is the peak horizontal velocity of the roof motion, not of the ground."),
     ({"intensity": Intensity.SA1}, "SA(1.0)", 1.0,
      "SA(1.0) in g is the horizontal spectral acceleration at 1 s with 5 % damping of the roof")],
)  # fmt: skip
def test_openquake_takes_the_levels_in_its_unit_and_is_told_that_they_are_of_the_roof(
    results, changes, imt, per_unit, said
):
    study = results.plan.input.study.model_copy(update=changes)
    given_ = dataclasses.replace(results.plan.input, study=study)
    plan = dataclasses.replace(results.plan, input=given_)
    made = export_files(dataclasses.replace(results, plan=plan))
    _, found = read_nrml(made["fragility.xml"])
    for name, _, x, _ in found.values():
        assert name == imt
        assert x == pytest.approx(per_unit * np.array(plan.input.intensities))
    assert said in made["fragility.xml"].decode()
    placed = list(csv.DictReader(io.StringIO(made["placement.csv"].decode())))
    comments = [json.loads(made["fragility.json"])[row[""]]["Comments"] for row in placed]
    for text in (*comments, *(row["Comment"] for row in placed)):
        assert "of the roof motion, not of the ground." in text


def test_pga_of_the_ground_is_told_to_be_of_the_ground(results):
    study = results.plan.input.study.model_copy(update={"intensity": Intensity.PGA})
    plan = dataclasses.replace(
        results.plan, input=dataclasses.replace(results.plan.input, study=study)
    )
    made = export_files(dataclasses.replace(results, plan=plan))
    assert "of the ground motion, not of the roof." in made["fragility.xml"].decode()


def test_openquake_has_the_chances_at_every_intensity(made, results):
    names, found = read_nrml((made[0] / "out/study/fragility.xml").read_bytes())
    assert names == ["LS1", "LS2", "LS3"]
    assert list(found) == ["BSA.S1", "BSA.S-2"]
    for (imt, _, x, p), array in zip(found.values(), results.arrays, strict=True):
        assert imt == "PGA"
        assert x == pytest.approx(results.plan.input.intensities)
        for row, wanted in zip(p, chances_of(results, array), strict=True):
            assert row == pytest.approx(wanted, abs=1.01e-6)
            assert (row >= wanted - 1e-11).all()
            assert (np.diff(row) >= 0.0).all()


def test_without_arrays_there_is_nothing_to_export(other):
    found = other(study_arrays=(), site_intensity=None, intensity_beta=0.0)
    assert export_files(found) == {}


def test_the_workbook_of_a_study_is_the_same_in_si(tmp_path):
    write(tmp_path, small())
    write_study(tmp_path / "input.xlsx", units=UnitsFirst.SI, example=small(units_first="SI"))
    assert read_study(tmp_path).input.study.allowed_m == pytest.approx(0.1)


# What a user may do to the folder of a study


def run_command(folder, *options):
    return CliRunner().invoke(main, ["study", str(folder), *map(str, options)])


def test_a_study_does_not_replace_its_own_workbook(tmp_path):
    folder = write(tmp_path, small())
    book = (folder / "input.xlsx").rename(folder / "study.xlsx")
    content = book.read_bytes()
    done = run_command(book, "--out", folder)
    assert done.exit_code == 2, done.output
    assert "is an input of this run, and would be replaced by its study.xlsx" in done.output
    assert book.read_bytes() == content
    assert not (folder / "runs").exists()


def test_a_study_does_not_begin_in_place_of_a_file(tmp_path):
    folder = write(tmp_path, small())
    (tmp_path / "out").write_text("mine")
    done = run_command(folder)
    assert done.exit_code == 2
    assert "is a file, not a folder; choose another folder" in done.output


def test_a_second_study_in_the_same_folder_waits_and_then_says_so(tmp_path):
    folder = write(tmp_path, small())
    runs = folder / "out" / "study" / "runs"
    runs.mkdir(parents=True)
    plan, _ = planned(folder)
    with locked(runs), pytest.raises(InputError, match="another run has been writing there"):
        make(plan, runs.parent, "", lambda _: None, allow_matched=False, wait_s=0.1)
    assert list(runs.iterdir()) == []


def test_warnings_on_the_workbook_are_printed_with_the_basis(results):
    warned = dataclasses.replace(results.plan, warnings=(("Mats!B8", "cell B8 is struck through"),))
    table = printed.study(dataclasses.replace(results, plan=warned)).table("Warnings on the")
    assert table.cells == (("Mats!B8", "cell B8 is struck through."),)
    assert "Warnings on the workbook" not in printed.study(results)
