"""Exports of a study, read by the libraries of the field or as they read."""

import csv
import dataclasses
import io
import json
import math
import re
from statistics import NormalDist
from types import SimpleNamespace

import defusedxml.ElementTree
import numpy as np
import pandas as pd
import pytest
from dlml import get_fragility, get_metadata, vocabulary
from dlml._tabular import load_tabular

from report.study.exports import (
    component_id,
    export_files,
    has_probabilities,
    known_states,
    probabilities_of,
)
from report.study.schema import Intensity
from solver.studies.fragility import UNKNOWN, Lognormal
from study_books import having, with_fit, with_study

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
