"""The live formulas of the sheet, recalculated by LibreOffice, equal the package's numbers."""

import itertools
import math
import random
import re
from dataclasses import dataclass
from types import SimpleNamespace

import pytest
from openpyxl import Workbook, load_workbook
from openpyxl.formula.translate import Translator
from openpyxl.utils.cell import get_column_letter

from fixtures import project_parts
from fixtures.cells import cell
from fixtures.libreoffice import Cell, Sheets, recalculated_sheets
from fixtures.paths import ROOT
from fixtures.project_parts import INCH
from fixtures.workbooks import formula_cells, project, retitle, site
from report.assessment.design.arrays import Displacement
from report.assessment.design.clearances import check_clearance
from report.project.model import ProjectInput
from report.project.model.choices import (
    EditionName,
    RiskCategory,
    RuleSetName,
    SiteClass,
    UnitsFirst,
)
from report.project.model.site_input import categories, category_lacks, edition_of, site_parameters
from report.project.read.cells import blank_value
from report.project.read.read import read
from report.project.workbook import SECTION
from report.project.write.template import template, write_template
from report.text.units import Quantity, number, ratio
from solver.rules import hazard, provisions
from solver.rules.provisions import Neighbor
from solver.rules.rulesets import RULE_SETS, RuleSet
from solver.rules.site_coefficients import F_A, F_V, site_coefficient

MOST, LONGEST = 20, 249
N_INPUTS = 200


@pytest.mark.quick
def test_a_workbook_has_few_and_short_formulas(tmp_path):
    path = tmp_path / "input.xlsx"
    path.write_bytes(template(UnitsFirst.SI, project()))
    found = [(str(each.value), each.coordinate) for each in formula_cells(load_workbook(path))]
    assert max(len(text) for text, _ in found) <= LONGEST
    # As it would be in one cell, the same formula of another row is the same text.
    alike = {Translator(text, at).translate_formula("AA600") for text, at in found}
    assert 15 < len(alike) <= MOST


def overridden(data: ProjectInput) -> RuleSet:
    changes = {row.provision: (row.value, row.reason) for row in data.overrides}
    return RULE_SETS[data.site.rule_set].overridden(changes)


def random_sites() -> list[dict[str, object]]:
    """Sites with and without each value; accelerations are at and beside limits, too."""
    pick = random.Random(1)
    mapped = (None, 0.04, 0.1, 0.25, 0.3, 0.5, 0.6, 0.7499, 0.75, 1.25, 1.5, 2.0)
    short = (None, None, 0.1669, 0.167, 0.33, 0.4, 0.5, 0.9, 1.566)
    at_1_s = (None, None, 0.0669, 0.067, 0.133, 0.1995, 0.2, 0.6)
    choices = {
        "rule_set": list(RuleSetName),
        "edition_name": [None, None, *EditionName],
        "risk_category": [*RiskCategory],
        "site_class": [None, *SiteClass],
        "hazard": [*hazard.HazardBasis],
        "s_s_g": mapped, "s_1_g": mapped,
        "f_a": (None, None, 1.2), "f_v": (None, 1.7),
        "s_ms_g": (None, None, 1.345), "s_m1_g": (None, None, 0.71),
        "s_ds_g": short, "s_d1_g": at_1_s,
        "i_e": (None, None, 1.0, 1.25), "sdc": (None, None, None, *"ABCDEF"),
    }  # fmt: skip
    return [
        {name: pick.choice([*values]) for name, values in choices.items()} for _ in range(N_INPUTS)
    ]


def names_of(book: Workbook) -> dict[str, tuple[str, str]]:
    """Return the sheet and the cell of each defined name of one cell."""
    texts = {name: item.attr_text.replace("$", "") for name, item in book.defined_names.items()}
    split = {name: text.rpartition("!") for name, text in texts.items() if re.search(r"\d$", text)}
    return {name: (sheet.strip("'"), at) for name, (sheet, _, at) in split.items() if ":" not in at}


def add_sites(book: Workbook, sites: list[dict[str, object]]) -> list[str]:
    """Write the formulas of single cells once more for each of some sites; return their names."""
    places = names_of(book)
    for row in range(10, 14):
        places[f"separation_{book['Start'][f'D{row}'].value}"] = "Start", f"C{row}"
    places["floor"] = "Start", "C9"
    of_place = {place: name for name, place in places.items()}
    formulas = {
        name: book[title][at].value
        for name, (title, at) in places.items()
        if str(book[title][at].value).startswith("=")
    }
    names = [*formulas, *(f"site_{field}" for field in sites[0])]
    columns = {name: get_column_letter(k) for k, name in enumerate(names, start=1)}
    sheet = book.create_sheet("Sites")
    for row, given in enumerate(sites, start=1):
        for field, value in given.items():
            sheet[f"{columns[f'site_{field}']}{row}"] = value
        for name, formula in formulas.items():
            title = places[name][0]

            def reference(match, title=title, row=row):
                at = match[0].replace("$", "")
                if at in columns:
                    return f"{columns[at]}{row}"
                if not re.fullmatch(r"[A-Z]{1,2}\d+", at):
                    return match[0]
                known = of_place.get((title, at))
                return f"{columns[known]}{row}" if known in columns else f"'{title}'!{match[0]}"

            here = re.sub(r"(?<![\w:.$])\$?[A-Za-z_]\w*\$?\d*\b(?![(\[])", reference, formula)
            sheet[f"{columns[name]}{row}"] = here
    return names


@pytest.fixture(scope="module")
def at_sites(tmp_path_factory):
    """The project, its sites, and what the formulas show at each by their names."""
    folder = tmp_path_factory.mktemp("sites")
    given = project().model_dump()
    data = project(
        arrays=[given["arrays"][0] | {"i_p": 1.5}, given["arrays"][1]],
        overrides=[
            {"provision": key, "value": value, "reason": "agreed"}
            for key, value in (("separation_edge", 2.5), ("prescriptive_factor_in", 50.0))
        ],
    )
    path = folder / "input.xlsx"
    write_template(path, units=UnitsFirst.US, example=data)
    book, sites = load_workbook(path), random_sites()
    names = add_sites(book, sites)
    book.save(path)
    (sheets,) = recalculated_sheets([path], folder)
    return data, [
        (given, dict(zip(names, row, strict=False)))
        for given, row in zip(sites, sheets["Sites"], strict=True)
    ]


def known(given: dict[str, object]) -> dict[str, object]:
    """Return a site with what the package computes where a cell is blank."""
    site = SECTION["site"]
    row = dict.fromkeys(entry.name for entry in site.entries) | given
    for name in ("i_e", "f_a", "sdc"):
        row[name] = blank_value(site.entry(name), row) if row[name] is None else row[name]
    return row


def shown(value: Cell) -> Cell:
    return None if value == "" else value


@pytest.mark.nightly
def test_the_parameters_and_the_category_of_a_site_are_those_of_the_package(at_sites):
    seen = set()
    for given, found in at_sites[1]:
        row = known(given)
        edition = edition_of(given["rule_set"], given["edition_name"])
        assert found["live_edition"] == edition.name
        assert found["live_i_e"] == row["i_e"]
        for table, name, mapped in ((F_A, "live_f_a", "s_s_g"), (F_V, "live_f_v", "s_1_g")):
            wanted = math.nan
            has_table = edition.has_site_coefficients and given["site_class"] in table.rows
            if has_table and given[mapped]:
                wanted = site_coefficient(table, given["site_class"], given[mapped])
            if math.isnan(wanted):
                assert shown(found[name]) == (given[mapped] and "not in table"), given
            else:
                assert found[name] == pytest.approx(wanted, rel=1e-12), given
        values = site_parameters(row)
        for name in ("s_ms", "s_m1", "s_ds", "s_d1"):
            wanted = getattr(values, name)
            assert shown(found[f"live_{name}"]) == (wanted and pytest.approx(wanted, rel=1e-12))
        least = "" if category_lacks(row) or values.s_ds is None else max(categories(row))
        assert (found["live_sdc"] or "") == least, given
        assert (found["live_sdc_used"] or "") == (given["sdc"] or least)
        seen.add(least)
    assert seen == {"", *"ABCDEF"}


@pytest.mark.nightly
def test_displacement_floor_and_separations_at_a_site_are_those_of_the_package(at_sites):
    data, sites = at_sites
    governs = set()
    for given, found in sites:
        row = known(given)
        values = site_parameters(row)
        if values.s_ds is None or row["sdc"] is None:
            continue
        rules = overridden(data.model_copy(update={"site": SimpleNamespace(**row)}))
        wanted = provisions.prescriptive_displacement(
            rules, s_ds_g=values.s_ds, sdc=row["sdc"], importance=row["i_e"]
        )
        governs.add(wanted.governs)
        in_inches = pytest.approx(wanted.value_m / INCH, rel=1e-12)
        assert found["live_prescriptive"] == in_inches, given
        floor_m = provisions.analysis_floor_m(rules, wanted)
        assert found["floor"] == pytest.approx(floor_m / INCH, rel=1e-12)
        neighbors = (Neighbor.LIKE, Neighbor.FIXED, Neighbor.PARAPET, Neighbor.EDGE)
        for count, neighbor in enumerate(neighbors, start=1):
            required_m = provisions.required_separation(
                rules, neighbor, design_m=wanted.value_m,
                importance=_importance(rules, row["i_e"] if neighbor.is_edge else 1.5),
            )  # fmt: skip
            separation = found[f"separation_{count}"]
            assert separation == pytest.approx(required_m / INCH, rel=1e-12), given
    assert governs == set(provisions.PrescriptiveBasis)


def _importance(rules: RuleSet, importance: float) -> float:
    return importance if rules.importance_in_separation else 1.0


def random_rows(pick: random.Random) -> dict[str, list[dict[str, object]]]:
    """Arrays that are alike or not, objects of every kind, and clearances between them."""
    slopes = ((2.0, "degrees"), (100 * math.tan(math.radians(2.0)), "percent"),
              (12 * math.tan(math.radians(2.0)), "in/12"), (3.0, "percent"))  # fmt: skip
    frictions = ({}, {"mu_static": 0.45}, {"mu_fast": 0.5, "mu_rate_s_per_m": 20.0})
    arrays = []
    for name in ("A*", "A?~", *(f"A{k}" for k in range(6))):
        value, unit = pick.choice(slopes)
        arrays.append(
            project_parts.array(
                name, value, slope_unit=unit, construction=pick.choice(["Tray", "TRAY", "Rail"]),
                # Within half a degree of north in both.
                downslope_deg=pick.choice([0.0, 0.3, 359.8, 90.0]),
                cg_height_m=pick.choice([9.0, 12.0]) * INCH, i_p=pick.choice([1.0, 1.0, 1.5]),
            ) | pick.choice(frictions)
        )  # fmt: skip
    kinds = (
        "fixed object",
        "array of different construction",
        *["edge with parapet"] * 2,
        "edge without parapet",
    )
    heights = (17.9, 18.0, 23.9, 24.0, 36.0)
    objects = [
        project_parts.roof_object(f"O{k}", pick.choice(kinds), height=pick.choice(heights) * INCH)
        | {"i_p": pick.choice([1.0, 1.0, 1.25])}
        for k in range(8)
    ]
    ids = [str(row["id"]) for row in arrays]
    pairs = [*itertools.combinations(ids, 2)]
    pairs += [*itertools.product(ids, [str(row["id"]) for row in objects])]
    clearances = [
        project_parts.clearance(*pair, pick.choice([0.0, 6.0, 24.0, 40.0, 81.6, 240.0]) * INCH)
        for pair in pick.sample(pairs, N_INPUTS // 5)
    ]
    return {"arrays": arrays, "objects": objects, "clearances": clearances}


SITES = {
    "pv1": site(i_e=1.25, risk_category="III"),
    "pv1 in C, in SI": site(s_ds_g=0.45, s_1_g=None, sdc="C"),
    "7-16": site(rule_set="ASCE 7-16", s_ds_g=1.2, i_e=1.25, risk_category="III"),
    "7-22, in SI": site(rule_set="ASCE 7-22", s_ds_g=1.4, site_class="CD"),
    "pv1 with other units": site(),
}
SHIPPED = ("example",)


@dataclass(frozen=True)
class Filled:
    """A project and the values of its sheets, recalculated."""

    data: ProjectInput
    sheets: Sheets

    def column(self, heading: str) -> tuple[str, list[Cell]]:
        """Return the unit and the values of a column of the sheet Clearances."""
        top, *rows = self.sheets["Clearances"][6:]
        (at,) = (k for k, head in enumerate(top) if str(head).partition(" [")[0] == heading)
        return str(top[at]).partition("[")[2].rstrip("]"), [row[at] for row in rows]


@pytest.fixture(scope="module")
def filled(tmp_path_factory):
    """The projects that are shipped, and 200 random clearances in five workbooks."""
    folder = tmp_path_factory.mktemp("answers")
    pick, data, paths = random.Random(2), {}, []
    for name in SHIPPED:
        data[name] = read(ROOT / "projects" / name).project
        paths.append(folder / f"{name}.xlsx")
        paths[-1].write_bytes((ROOT / "projects" / name / "input.xlsx").read_bytes())
    for name, at in SITES.items():
        data[name] = project(site=at, **random_rows(pick))
        paths.append(folder / f"{name}.xlsx")
        units = UnitsFirst.SI if "in SI" in name else UnitsFirst.US
        write_template(paths[-1], units=units, example=data[name])
    book = load_workbook(paths[-1])
    for row, gap in enumerate(data[name].clearances, start=1):
        cell(book, f"Clearances/{row}/Provided clearance").value = gap.provided_m / 0.3048
    retitle(book, "Clearances", "Provided clearance", "Provided clearance [ft]")
    for row, array in enumerate(data[name].arrays, start=1):
        cell(book, f"Arrays/{row}/CG height").value = array.cg_height_m / 0.01
    retitle(book, "Arrays", "CG height", "CG height [cm]")
    book.save(paths[-1])
    sheets = recalculated_sheets(paths, folder)
    return {
        name: Filled(each, found) for (name, each), found in zip(data.items(), sheets, strict=True)
    }


@pytest.fixture(params=[*SHIPPED, *SITES])
def case(request, filled):
    return filled[request.param]


@pytest.mark.nightly
def test_required_separation_and_ratio_of_each_clearance_are_those_of_the_package(case):
    data, rules = case.data, overridden(case.data)
    prescriptive = provisions.prescriptive_displacement(
        rules, s_ds_g=data.site.s_ds, sdc=data.site.sdc, importance=data.site.i_e
    )
    slides = {each.id: Displacement(prescriptive.value_m) for each in data.arrays}
    checks = [check_clearance(data, rules, slides, row) for row in data.clearances]
    unit, required = case.column("Required, prescriptive")
    size = next(each for each in Quantity.SIZE.value if each.symbol == unit)
    columns = (case.column(head)[1] for head in ("Type", "I", "D/C, prescriptive"))
    ratios = []
    rows = zip(checks, required, *columns, strict=False)
    for check, length, neighbor, importance, shown_ratio in rows:
        assert neighbor == check.neighbor.value, check
        assert importance == check.importance, check
        assert length == pytest.approx(check.required_m / size.si, rel=1e-12), check
        ratios.append(shown_ratio if shown_ratio == "∞" else number(shown_ratio, 2))
        assert ratios[-1] == ratio(check.demand_capacity), check
    worst = max(ratios, key=lambda text: math.inf if text == "∞" else float(text))
    (found,) = (row[6] for row in case.sheets["Start"] if row[1] == "Prescriptive displacement")
    assert (found if found == "∞" else number(found, 2)) == worst


@pytest.mark.nightly
def test_no_formula_gives_an_error(case):
    cells = [cell for rows in case.sheets.values() for row in rows for cell in row]
    assert len(cells) > 1000
    # As LibreOffice writes them in a file of text: #N/A, #VALUE!, Err:522.
    assert [cell for cell in cells if str(cell).startswith(("#", "Err:"))] == []


@pytest.mark.nightly
def test_the_random_clearances_have_every_neighbor(filled):
    neighbors = [each for name in SITES for each in filled[name].column("Type")[1] if each]
    assert len(neighbors) == N_INPUTS
    assert {*neighbors} == {each.value for each in Neighbor}
