"""What docs/checked.md states of other programs and documents is computed here as it says.

Oracles: the permit sheets as typed on the page, an integration of its own, and figures.csv.
"""

import csv
import re
import shutil

import numpy as np
import pytest

from fixtures import packages
from fixtures.paths import ROOT, TESTS
from report.project.model.choices import RuleSetName
from solver.rules.hazard import EDITIONS, approximate_period_s, component_force, seismic_parameters
from solver.rules.provisions import Neighbor, prescriptive_displacement, required_separation
from solver.rules.rulesets import RULE_SETS
from solver.rules.site_coefficients import BY_DEFAULT, F_A, F_V, site_coefficient

PAGE = (ROOT / "docs" / "checked.md").read_text(encoding="utf-8")
FOOT, INCH, G = 0.3048, 0.0254, 9.80665
EDITION, RULES = EDITIONS["ASCE 7-16"], RULE_SETS[RuleSetName("ASCE 7-16")]
KINDS = (Neighbor.LIKE, Neighbor.FIXED, Neighbor.PARAPET, Neighbor.EDGE)


def tables(heading):
    """The tables below a heading of the second level, as rows of cells."""
    below = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL)[1]
    found = re.findall(r"(?:^\|.+\|\n)+", below, re.MULTILINE)
    return [
        [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]
        for table in found
    ]


def permit_rows(s_s_g, s_1_g, height_ft):
    """What the sheet of a permit states, in the order of the rows of the page."""
    f_a = max(1.2, site_coefficient(F_A, BY_DEFAULT, s_s_g))
    f_v = site_coefficient(F_V, BY_DEFAULT, s_1_g)
    found = seismic_parameters(EDITION, s_s=s_s_g, s_1=s_1_g, f_a=f_a, f_v=f_v)
    force = component_force(
        EDITION, s_ds_g=found.s_ds, factor=1.0, divisor=1.5, i_p=1.0, z_over_h=1.0
    )
    delta = prescriptive_displacement(RULES, s_ds_g=found.s_ds, sdc="D", importance=1.0)
    apart_m = [
        required_separation(RULES, kind, design_m=delta.value_m, importance=1.0) for kind in KINDS
    ]
    return [
        (f_a,), (f_v,), (found.s_ms,), (found.s_ds,), (found.s_m1,), (found.s_d1,),
        (approximate_period_s("other", height_ft * FOOT),), (found.t_s,),
        (force.value,), (force.maximum, force.minimum), (delta.value_m / INCH,),
        *((value_m / FOOT,) for value_m in apart_m),
    ]  # fmt: skip


@pytest.mark.quick
def test_two_permit_sheets_are_reproduced_to_the_last_digit():
    (rows,) = tables("Two permits of the City of Santa Ana")
    head, _, mapped, heights, *rows = rows
    assert head[1::2] == ["370815, sheet 20", "540554, sheet 22"]
    rows = [row for row in rows if row[0] != "SDC"]
    for column, stated in ((1, 12), (3, 8)):
        s_s_g, s_1_g = map(float, mapped[column].split(", "))
        computed = permit_rows(s_s_g, s_1_g, float(heights[column]))
        compared = 0
        for row, values in zip(rows, computed, strict=True):
            sheet, ours = row[column], row[column + 1]
            digits = len(ours.partition(",")[0].partition(".")[2])
            assert ", ".join(f"{value:.{digits}f}" for value in values) == ours, row
            assert sheet in ("", ours), row
            compared += sheet != ""
        assert compared >= stated


def test_the_project_of_the_permit_prints_its_figures(tmp_path_factory):
    made = packages.reported(tmp_path_factory, "permit", packages.results_alone)
    text = packages.words((made.out / "calc-package.pdf").read_text())
    for words in (
        "1.313 g", "0.471 g", "1.829", "1.576 g", "1.050 g", "SDC D", "0.288 s", "0.547 s",
        "computed (lower limit 0.315, upper limit 1.681)", "25.4 in (645 mm)",
    ):  # fmt: skip
        assert words in text, words


def test_agreement_with_other_methods_is_as_it_was_measured():
    rows = csv.DictReader((TESTS / "bench" / "figures.csv").read_text().splitlines())
    printed = [f"{row['value']} {row['unit']}".replace(" %", "%") for row in rows]
    stated = re.findall(r"[\d.e-]+% in the median, [\d.e-]+% at most", PAGE)
    assert len(stated) == 7
    assert [text for text in stated if not any(text in line for line in printed)] == []


def integrated(a_mps2, dt_s, mu, parts=200):
    """The PRD of a block on a level surface [m]: v' = -a - mu g sign v in sub-steps."""
    v = s = peak = 0.0
    h = dt_s / parts
    samples = np.arange(a_mps2.size)
    for a in np.interp(np.arange(0, a_mps2.size - 1, 1 / parts) + 0.5 / parts, samples, a_mps2):
        free = v - a * h
        before, v = v, max(free - mu * G * h, 0.0) + min(free + mu * G * h, 0.0)
        s += 0.5 * (before + v) * h
        peak = max(peak, abs(s))
    return peak


def columns(rows, first, second):
    """The values of two columns of a table below its head, without blank cells."""
    return {float(row[first]): row[second] for row in rows[2:] if row[first]}


@pytest.mark.parametrize("records", ["made", "published"])
def test_the_published_spectra_are_computed_as_the_page_says(
    records, tmp_path, monkeypatch, capsys
):
    (program,) = re.findall(r"```text\n(import numpy.*?)```", PAGE, re.DOTALL)
    names = re.findall(r"\(\"([^\"]+)\", [\d.]+, ", program)
    folder = re.search(r'folder = "(.*?)"', program)[1]
    (tmp_path / folder).mkdir(parents=True)
    dt_s, t_s = 0.01, np.arange(2401, 3200) * 0.01
    made_mps2 = 6.0 * np.sin(7.0 * t_s) * np.sin(0.4 * (t_s - 24.0)) ** 2
    for name in names:
        if records == "made":
            unit = 100.0 if name.endswith(".txt") else 1.0
            np.savetxt(tmp_path / folder / name, np.transpose([t_s, unit * made_mps2]))
        elif not (ROOT / folder / name).is_file():
            pytest.skip("the records are not here; the page says where they are")
        else:
            shutil.copy(ROOT / folder / name, tmp_path / folder / name)
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "page", "exec"), {})
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert len(lines) == 26
    if records == "made":
        for _, mu, prd_m in lines:
            assert float(prd_m) == pytest.approx(integrated(made_mps2, dt_s, float(mu)), abs=2e-4)
        return
    first, second = tables("Two published sliding spectra")
    stated = [columns(first, 0, 2), columns(first, 0, 4), columns(first, 0, 6)]
    stated += [columns(second, 0, 2), columns(second, 3, 5)]
    for name, spectrum in zip(names, stated, strict=True):
        assert {float(mu): prd_m for found, mu, prd_m in lines if found == name} == spectrum
