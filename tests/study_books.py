"""Study workbooks of tests: written, read, run, and their results altered."""

import csv
import datetime as dt
import io
import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from cells import addressed
from report.cli.main import main
from report.project.model.choices import UnitsFirst
from report.study.exports import export_files
from report.study.plan import plan_study
from report.study.read import read_study, write_study
from report.study.results import LimitState
from report.study.schema import Mat, Study, StudyArray, StudyInput
from report.study.shaking import study_motions
from report.study.tables import study_xlsx
from solver import solve
from solver.model import InputError, coulomb
from solver.records.record import Record, write_record
from solver.studies.capacity import Capacities
from solver.studies.fragility import fragility
from studied import wave

ABOUT = {
    "title": "A study", "date": dt.date(2026, 3, 1), "slopes_deg": "0, 2, 4",
    "intensities": "0.5 to 2 by 0.5", "folder": "records",
}  # fmt: skip


def given(**changes):
    """A complete study; fields of the sheet Study by name, and whole tables."""
    tables = {
        "mats": (Mat(id="A", mu=0.4, tested="0.38, 0.40, 0.42"), Mat(id="B", mu=0.6)),
        "study_arrays": (StudyArray(id="S1", mat="a", slope_deg=2.0, clearance_m=0.3),),
    }
    names = StudyInput.model_fields.keys() - {"study"}
    tables |= {name: changes.pop(name) for name in list(changes) if name in names}
    return StudyInput(study=Study(**{**ABOUT, **changes}), **tables)


def write(folder, study=None, *, motions=3, letters="x"):
    """Write a study and its records; return the folder."""
    records = folder / "records"
    records.mkdir(parents=True, exist_ok=True)
    for number in range(motions):
        for at, letter in enumerate(letters):
            name = f"M{number}-{letter}"
            record = Record(name=name, dt_s=0.02, a_mps2=wave(10 * number + at))
            write_record(records / f"{name}.csv", record)
    write_study(folder / "input.xlsx", units=UnitsFirst.US, example=study or given())
    return folder


def command(source, *options):
    """Do what `roofslip study` does with a folder or a workbook."""
    return CliRunner().invoke(main, ["study", str(source), *map(str, options)])


def with_study(results, **changes):
    """The results of a study whose sheet Study has other values."""
    former = results.plan.input
    study = former.study.model_copy(update=changes)
    altered = former.model_copy(update={"study": study})
    return replace(results, plan=replace(results.plan, input=altered))


def sheet_rows(results, sheet):
    """The rows of a sheet of study.xlsx, each cell by its heading."""
    heads, *rows = load_workbook(io.BytesIO(study_xlsx(results)))[sheet].values
    return [dict(zip(heads, row, strict=True)) for row in rows]


def library(results):
    """The rows of fragility.csv by the ID of their component."""
    content = export_files(results)["fragility.csv"].decode()
    return {row["ID"]: row for row in csv.DictReader(io.StringIO(content))}


def plan(folder):
    sheet = read_study(folder)
    return plan_study(sheet, study_motions(sheet))


def problems(folder):
    with pytest.raises(InputError) as caught:
        plan(folder)
    return "\n".join(caught.value.problems)


@cache
def usual():
    """The bytes of a complete study: its rows and columns are those of every other."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "input.xlsx"
        write_study(path, units=UnitsFirst.US, example=given())
        return path.read_bytes()


def at(text):
    """A line with the addresses of the cells of a study that it names as `<Study/Slopes>`."""
    return addressed(usual(), text)


def small(**changes):
    """A study of six motions that slides, with two arrays and a chance."""
    about = {
        "slopes_deg": "0, 2, 4", "intensities": "0.2 to 2.4 by 0.2", "mus": "0.3, 0.5",
        "allowed_m": 0.1, "site_intensity": 1.0, "intensity_beta": 0.2,
        "slope_tolerance_deg": 0.25, "samples": 20,
    }  # fmt: skip
    arrays = (
        StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.1, reaches="RTU & co"),
        StudyArray(id="S 2", mat="B", slope_deg=0.0, clearance_m=0.02),
    )
    return given(**{**about, "study_arrays": arrays, **changes})


def in_one_go(results):
    """The results of the command that computed every run."""
    return replace(results, manifest={**results.manifest, "taken_over": []})


def peak(plan, motion, building, slope_deg, mu, intensity):
    """PRD of a motion by single runs; NaN for none."""
    one = plan.motions.motions[building][motion]
    one = replace(one, scale=one.scale * intensity)
    found = [
        solve(one.scene(h, slope_rad=math.radians(slope_deg), friction=coulomb(mu))).result
        for h in one.orientations
    ]
    return max(r.prd_m for r in found) if all(r.status == "ok" for r in found) else math.nan


def having(results, *arrays):
    """The results with other arrays."""
    return replace(results, arrays=arrays)


def with_fit(state, fit, **counts):
    """A limit state with another lognormal, and no dispersion beside its own."""
    found = replace(state.fragility, fitted=fit, **counts)
    return replace(state, fragility=found, effects={})


def limit_state(name, capacity, levels, *, words="is so", falls=0, is_censored=False):
    """A limit state of capacities up to 2: the first ones fall again, the last may be censored."""
    x = np.array(capacity)
    found = Capacities(
        intensity=x, is_censored=np.arange(x.size) >= x.size - is_censored,
        end=np.full(x.size, 2.0), falls=np.arange(x.size) < falls, runs=np.zeros(x.size, int),
    )  # fmt: skip
    exceeds = x[:, None] < levels
    fitted = fragility(levels, exceeds, np.ones_like(exceeds), found, seed=1)
    return LimitState(name=name, words=words, limit_m=0.1, fragility=fitted, effects={})
