"""Fragilities in the formats of the field, as their readers take them."""

import csv
import dataclasses
import importlib.util
import io
import json
import math
import re
import shutil
from statistics import NormalDist

import defusedxml.ElementTree
import numpy as np
import pandas as pd
import pytest
from dlml import vocabulary
from dlml._tabular import load_tabular

from places import ROOT
from report.sheet.schema import UnitsFirst
from report.study.exports import EXPORTS, export_files
from report.study.plan import FRICTION
from report.study.run import planned, run_study
from report.study.template import write_study
from solver.studies.fragility import UNKNOWN, Lognormal

PROJECT = ROOT / "projects" / "study"

# Of openquake.commonlib.nrml and openquake.hazardlib.valid
SIMPLE_ID = re.compile(r"[\w_\-]{1,75}")
IMT = re.compile(r"PGA|PGV|SA\(\d+\.\d+\)")


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


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """The results of the study of the repository, on the slope of its array alone."""
    spec = importlib.util.spec_from_file_location("make_study", PROJECT / "make.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    folder = tmp_path_factory.mktemp("project")
    shutil.copytree(PROJECT / "records", folder / "records")
    given = script.study()
    few = {
        "slopes_deg": "2",
        "intensities": "1 to 2 by 0.25",
        "samples": 10,
        "slope_tolerance_deg": 0.0,
    }
    example = dataclasses.replace(given, study=given.study.model_copy(update=few))
    write_study(folder / "input.xlsx", units=UnitsFirst.US, example=example)
    return run_study(planned(folder)[0], folder / "out")


# The reader sets an option that its pandas no longer needs.
@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")
@pytest.mark.nightly("report/study/exports.py")
def test_the_exports_of_the_project_are_read_by_the_readers_of_pelicun(project, tmp_path):
    assert project.spread.is_one_spectrum
    made = export_files(project)
    assert set(made) == set(EXPORTS)
    (tmp_path / "fragility.csv").write_bytes(made["fragility.csv"])
    row = load_tabular(tmp_path / "fragility.csv").iloc[0]
    demand = row["Demand", "Type"]
    assert vocabulary.EDP_TYPES[demand]["UnitType"] == "acceleration"
    assert row["Demand", "Unit"] == "g"
    (one,) = project.arrays
    assert one.states[2].fragility.fitted.is_known
    for state in one.states:
        if not state.fragility.fitted.is_known:
            assert pd.isna(row[state.name, "Theta_0"])
            continue
        assert row[state.name, "Family"] == "lognormal"
        fitted = state.fragility.fitted
        assert float(row[state.name, "Theta_0"]) == pytest.approx(fitted.theta, rel=1e-5)
        # Entered, in place of that of the motions
        wanted = math.hypot(0.4, state.effects[FRICTION])
        assert float(row[state.name, "Theta_1"]) == pytest.approx(wanted, rel=1e-5)
        assert fitted.beta < 0.2
    (placed,) = csv.DictReader(io.StringIO(made["placement.csv"].decode()))
    about = json.loads(made["fragility.json"])
    assert list(about) == ["_GeneralInformation", placed[""]]
    assert "record-to-record 0.40 (Example: FEMA P695" in about[placed[""]]["Comments"]


@pytest.mark.nightly("report/study/", "solver/studies/", "projects/study/")
def test_the_exports_of_the_project_are_read_by_the_rules_of_openquake(project):
    names, found = read_nrml(export_files(project)["fragility.xml"])
    assert names == ["LS1", "LS2", "LS3"]
    ((imt, limit, x, p),) = found.values()
    assert imt == "PGA"
    assert limit == pytest.approx(1e-3)
    assert x == pytest.approx(project.plan.input.intensities)
    for row, state in zip(p, project.arrays[0].states, strict=True):
        if state.fragility.fitted.is_known:
            total = math.hypot(0.4, state.effects[FRICTION])
            wanted = NormalDist(math.log(state.fragility.fitted.theta), total)
            assert row == pytest.approx([wanted.cdf(math.log(v)) for v in x], abs=1.01e-6)


def test_limit_states_that_cross_have_no_negative_chance_between_them(project):
    """OpenQuake's chance of a damage state is the difference of two limit states."""
    (one,) = project.arrays
    fits = Lognormal(theta=1.0, beta=0.1), Lognormal(theta=1.2, beta=0.8)
    states = tuple(
        dataclasses.replace(
            state, fragility=dataclasses.replace(state.fragility, fitted=fit), effects={}
        )
        for state, fit in zip(one.states[:2], fits, strict=True)
    )
    study = project.plan.input.study.model_copy(update={"record_beta": None, "record_source": ""})
    plan = dataclasses.replace(
        project.plan, input=dataclasses.replace(project.plan.input, study=study)
    )
    crossing = dataclasses.replace(one, states=states)
    changed = dataclasses.replace(project, plan=plan, arrays=(crossing,), allow_matched=True)
    _, found = read_nrml(export_files(changed)["fragility.xml"])
    ((_, _, x, (first, second)),) = found.values()
    alone = [[NormalDist(math.log(f.theta), f.beta).cdf(math.log(v)) for v in x] for f in fits]
    assert second == pytest.approx(alone[1], abs=1.01e-6)
    assert first == pytest.approx(np.max(alone, axis=0), abs=1.01e-6)


def without_lognormal(array, name, **changes):
    """The array under another name, its first limit state undetermined."""
    found = dataclasses.replace(array.states[0].fragility, fitted=UNKNOWN, **changes)
    states = (dataclasses.replace(array.states[0], fragility=found), *array.states[1:])
    row = array.plan.array.model_copy(update={"id": name})
    return dataclasses.replace(
        array, states=states, plan=dataclasses.replace(array.plan, array=row)
    )


def test_an_array_whose_runs_are_censored_has_no_chance_of_zero_in_openquake(project):
    """Of a motion without a value it is not known whether it exceeds: 0 of 0 is no chance."""
    (one,) = project.arrays
    levels = len(project.plan.input.intensities)
    counted = np.array([7] * (levels - 2) + [1, 0])
    lost = without_lognormal(
        one, "A2", counted=counted, exceeded=np.zeros(levels, int), censored=13
    )
    whole = without_lognormal(
        one, "A3", counted=np.full(levels, 7), exceeded=np.minimum(np.arange(levels), 7), censored=0
    )
    made = export_files(dataclasses.replace(project, arrays=(one, lost, whole)))
    _, found = read_nrml(made["fragility.xml"])
    assert list(found) == ["BSA.A1", "BSA.A3"]
    assert (
        "BSA.A2 is left out: LS1 has no lognormal and censored runs."
        in made["fragility.xml"].decode()
    )
    *_, p = found["BSA.A3"]
    wanted = np.maximum(np.minimum(np.arange(levels), 7) / 7.0, p[1])
    assert p[0] == pytest.approx(wanted, abs=1.01e-6)
    assert "fragility.xml" not in export_files(dataclasses.replace(project, arrays=(lost,)))
