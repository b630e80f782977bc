"""The live formulas of the sheet, recalculated by LibreOffice, equal the package's numbers."""

import importlib
import itertools
import math
import random
import re
from dataclasses import dataclass
from types import SimpleNamespace

import pytest
from openpyxl import Workbook, load_workbook
from openpyxl.utils.cell import coordinate_to_tuple, get_column_letter

from cells import cell
from inputs import FT, INCH, NO_SIDES
from places import ROOT
from recalculated import Cell, Sheets, recalculated_sheets
from report.assessment.clearances import ClearanceCheck, check_clearance
from report.sheet.reading.read import read
from report.sheet.reading.what_if import retyped
from report.sheet.schema import ProjectInput
from report.sheet.schema.answers import SITE_ANSWERS
from report.sheet.schema.choices import SiteClass, UnitsFirst
from report.sheet.schema.fields import Place, entries
from report.sheet.schema.project import Site
from report.sheet.writing.template import write_template
from report.text.units import PRESSURES, Quantity, number, ratio
from sheets import formula_cells, project, retitle, same, site, type_into
from solver.rules import hazard, provisions
from solver.rules.rulesets import RULE_SETS, RuleSet
from solver.rules.site_coefficients import F_A, F_V, site_coefficient

pytestmark = pytest.mark.nightly
SITE_LABELS = {entry.name: entry.cell.label for entry in entries(Site)}
PROJECTS = ("example", "school", "conditions", "campus")


L_FT = ((20, 15), (100, 15), (100, 45), (60, 45), (60, 75), (20, 75))
"""An array of 3,600 ft2 around a corner."""


def edge_cases() -> dict[str, ProjectInput]:
    """Values at limits, both unit systems, every rule set, I_p, overrides, outlines, odd ids.

    A book takes a second of LibreOffice: one has a case of its site and another of its rows.
    """
    given = project().model_dump()
    arrays, gaps = given["arrays"], given["clearances"]
    alike = arrays[1] | {"slope_value": math.tan(math.radians(0.5)) * 12, "slope_unit": "in/12"}
    return {
        "threshold and turned": project(
            site=site(s_ds_g=0.5, s_1_g=None, sdc="D"),
            arrays=[arrays[0] | {"downslope_deg": 359.5}, alike | {"downslope_deg": 0.4}],
        ),
        "low-category": project(site=site(s_ds_g=0.45, s_1_g=None, sdc="C")),
        "below-0.4": project(site=site(s_ds_g=0.33, s_1_g=None, sdc="D")),
        "near-fault and no room at two of five clearances": project(
            site=site(s_1_g=0.75, risk_category="IV", i_e=1.5, sdc="F"),
            clearances=[gap | {"provided_m": gap["provided_m"] * (k % 2 == 0)}
                        for k, gap in enumerate(gaps)],
        ),
        "asce-16 and overrides": project(
            site=site(
                rule_set="ASCE 7-16", i_e=1.25, risk_category="III", s_ds_g=None, s_s_g=1.313,
                f_a=1.2, s_1_g=0.455, f_v=1.845, site_class="D (default)", sdc="D",
            ),
            overrides=[
                {"provision": key, "value": value, "reason": "agreed"}
                for key, value in (("separation_edge", 2.5), ("prescriptive_factor_in", 50.0))
            ],
        ),
        "asce-22 and odd ids": project(
            site=site(rule_set="ASCE 7-22", s_ds_g=1.4, site_class="CD"),
            arrays=[arrays[0] | {"id": "A*"} | NO_SIDES, arrays[1] | {"id": "A?~"}],
            outlines=[{"name": "A*", "x_m": x * FT, "y_m": y * FT} for x, y in L_FT],
            clearances=[gap | {"array": {"A1": "A*", "A2": "A?~"}[gap["array"]]}
                        for gap in gaps[1:]],
        ),
        "pv1-by-22 and friction": project(
            site=site(edition_name="ASCE 7-22", s_ds_g=0.7, site_class="DE"),
            arrays=[arrays[0] | {"mu_fast": 0.5, "mu_rate_s_per_m": 20.0}, alike],
        ),
        "given-twice and importance": project(
            arrays=[arrays[0] | {"i_p": 1.5}, alike],
            site=site(s_ms_g=2.349, s_ds_g=1.566, s_m1_g=1.19, i_e=1.25, risk_category="III"),
            objects=[row | {"i_p": 1.25} for row in given["objects"]],
        ),
    }  # fmt: skip


HEAD_ROW = 7


@dataclass(frozen=True)
class Filled:
    """A project and the values of its sheets, recalculated."""

    data: ProjectInput
    places: dict[str, tuple[str, str]]
    sheets: Sheets

    @property
    def rules(self) -> RuleSet:
        changes = {row.provision: (row.value, row.reason) for row in self.data.overrides}
        return RULE_SETS[self.data.site.rule_set].overridden(changes)

    @property
    def prescriptive(self) -> provisions.Prescriptive:
        site = self.data.site
        return provisions.prescriptive_displacement(
            self.rules, s_ds_g=site.s_ds, sdc=site.sdc, importance=site.i_e
        )

    def checks(self, design_m: float) -> list[ClearanceCheck]:
        """Return the clearances for a design displacement of every array."""
        same = {"adopted": None, "opened_mark": "", "is_permitted": True,
                "permitted_m": design_m}  # fmt: skip
        arrays = [SimpleNamespace(id=each.id, array=each, **same) for each in self.data.arrays]
        rows = self.data.clearances
        return [check_clearance(self.data, self.rules, arrays, row) for row in rows]

    def named(self, name: str) -> Cell:
        sheet, address = self.places[name]
        row, column = coordinate_to_tuple(address)
        return self.sheets[sheet][row - 1][column - 1]

    def headings(self, sheet: str) -> list[str]:
        return [str(cell) for cell in self.sheets[sheet][HEAD_ROW - 1]]

    def column(self, sheet: str, heading: str) -> list[Cell]:
        at = [head.partition(" [")[0] for head in self.headings(sheet)].index(heading)
        return [row[at] for row in self.sheets[sheet][HEAD_ROW:]]

    def panel(self, label: str) -> list[Cell]:
        """Return the row of the sheet Start with a label."""
        return next(row for row in self.sheets["Start"] if row[1] == label)

    def lengths(self, label: str) -> list[Cell]:
        return sorted(self.panel(label)[2:4])


def in_both_units(length_m: float) -> object:
    return pytest.approx([length_m / INCH, length_m / 1e-3], rel=1e-12)


def names_of(book: Workbook) -> dict[str, tuple[str, str]]:
    """Return the sheet and the cell of each defined name of one cell."""
    texts = {name: item.attr_text.replace("$", "") for name, item in book.defined_names.items()}
    split = {name: text.rpartition("!") for name, text in texts.items() if ":" not in text}
    return {name: (sheet.strip("'"), at) for name, (sheet, bang, at) in split.items() if bang}


BLANK = "computed"
"""Its I_e, F_a and SDC are blank in the workbook."""
COMPUTED = {
    "i_e": 1.25, "risk_category": "III", "s_s_g": 0.6, "s_1_g": 0.05, "site_class": "D",
    "f_a": site_coefficient(F_A, "D", 0.6), "f_v": 2.4, "sdc": "D",
    **dict.fromkeys(("s_ds_g", "s_ms_g", "s_m1_g", "s_d1_g", "edition_name")),
}  # fmt: skip
CASES = {**dict.fromkeys(PROJECTS), **edge_cases(), BLANK: project(site=site(**COMPUTED))}
CHANGED = "low-category"
IN_SI = {f"{name} in SI": name for name in ("given-twice and importance", "asce-16 and overrides")}


S_S_G = (0.1, 0.2, 0.25, 0.5, 0.6, 0.75, 0.9, 1.0, 1.25, 1.4, 1.5, 2.0)
GRID = tuple(itertools.product([c for c in SiteClass if c.value in F_A.rows], S_S_G))
"""Site classes and values of S_S; S_1 is S_S / 2.5."""


def add_grid(book: Workbook) -> None:
    """Write the formulas of F_a and F_v once more for each site class and mapped value."""
    grid = book.create_sheet("Grid")
    for row, (site_class, s_s) in enumerate(GRID, start=1):
        grid.append([site_class.value, s_s, s_s / 2.5])
        for label, mapped, at in (("F_a", "site_s_s_g", "B"), ("F_v", "site_s_1_g", "C")):
            formula = str(cell(book, f"Site/{label}/Computed").value)
            for name, place in (("site_site_class", f"A{row}"), (mapped, f"{at}{row}")):
                assert name in formula
                formula = formula.replace(name, place)
            grid[f"{'D' if at == 'B' else 'E'}{row}"] = formula


def weigh_in_kips(book: Workbook) -> None:
    for name in ("Arrays/A1/Weight", "Arrays/A2/Weight"):
        cell(book, name).value /= 1000
    retitle(book, "Arrays", "Weight", "Weight [kip]")
    for found in formula_cells(book):
        found.value = str(found.value).replace("Weight '[lb']", "Weight '[kip']")


def weigh_by_modules(book: Workbook) -> None:
    """Give the weight of the first array by its modules, in lb, and its ballast."""
    weight = cell(book, "Arrays/A1/Weight")
    cell(book, "Arrays/A1/Modules").value = 20
    for heading, share in (("Module weight", 30.0), ("Ballast weight", 400.0)):
        cell(book, f"Arrays/A1/{heading}").value = share * weight.value
    weight.value = None


def is_si(name: str, case: ProjectInput) -> bool:
    return name in IN_SI or case.project.units_first is UnitsFirst.SI


@pytest.fixture(scope="module")
def filled(tmp_path_factory):
    """Every case; that of `CHANGED` with the grid, weights in kips and one by modules."""
    folder = tmp_path_factory.mktemp("answers")
    data = {
        name: case or importlib.import_module(f"projects.{name}.make").project()
        for name, case in CASES.items()
    }
    data |= {name: data[case] for name, case in IN_SI.items()}
    paths = [folder / f"{name}.xlsx" for name in data]
    for (name, case), path in zip(data.items(), paths, strict=True):
        if name in PROJECTS:  # the files that projects/*/make.py writes
            path.write_bytes((ROOT / "projects" / name / "input.xlsx").read_bytes())
        else:
            units = UnitsFirst.SI if is_si(name, case) else UnitsFirst.US
            write_template(path, units=units, example=case)
    changed = folder / f"{CHANGED}.xlsx"
    book = load_workbook(changed)
    us, si = names_of(book), names_of(load_workbook(folder / f"{next(iter(IN_SI))}.xlsx"))
    add_grid(book)
    weigh_in_kips(book)
    weigh_by_modules(book)
    book.save(changed)
    names = ("Importance factor I_e", "F_a", "Seismic design category")
    type_into(folder / f"{BLANK}.xlsx", dict.fromkeys(f"Site/{name}" for name in names))
    assert same(read(folder / f"{BLANK}.xlsx").project, data[BLANK])
    sheets = recalculated_sheets(paths, folder)
    return {
        name: Filled(case, si if is_si(name, case) else us, of_case)
        for (name, case), of_case in zip(data.items(), sheets, strict=True)
    }


@pytest.fixture(params=[*CASES, *IN_SI])
def case(request, filled):
    return filled[request.param]


def test_no_formula_gives_an_error(case):
    cells = [cell for rows in case.sheets.values() for row in rows for cell in row]
    assert len(cells) > 1000
    # As LibreOffice writes them in a file of text: #N/A, #VALUE!, Err:522.
    assert [cell for cell in cells if str(cell).startswith(("#", "Err:"))] == []


def test_seismic_parameters_category_and_floor_are_those_of_the_package(case):
    values = case.data.site.parameters
    for name in ("s_ms", "s_m1", "s_ds", "s_d1"):
        wanted, found = getattr(values, name), case.named(f"live_{name}")
        if wanted is None:
            assert found in (None, "")
        else:
            assert number(found, 3) == number(wanted, 3)
            assert found == pytest.approx(wanted, rel=1e-12)
    values, data = case.data.site.parameters, case.data.site
    is_essential = data.risk_category == "IV"
    categories = hazard.design_categories(
        s_ds_g=values.s_ds, s_d1_g=values.s_d1, s_1_g=data.s_1_g, is_essential=is_essential
    )
    assert (case.named("live_sdc") or "") == ("" if data.sdc_lacks else max(categories))
    floor_m, reviewed_m = (
        provisions.analysis_floor_m(case.rules, case.prescriptive, is_reviewed=reviewed)
        for reviewed in (False, True)
    )
    assert case.lengths("Floor of the value from analysis") == in_both_units(floor_m)
    saved = case.lengths("Peer review of the analysis saves, at most")
    assert saved == in_both_units(floor_m - reviewed_m)


@pytest.mark.parametrize(
    ("table", "name", "mapped"), [(F_A, "live_f_a", "s_s_g"), (F_V, "live_f_v", "s_1_g")]
)
def test_site_coefficients_are_those_of_the_tables(case, table, name, mapped):
    data, found = case.data.site, case.named(name)
    at = getattr(data, mapped)
    if at is None or data.site_class is None:
        assert found in (None, "")
    elif not data.edition.has_site_coefficients:
        assert found == "none in ASCE 7-22"
    else:
        wanted = site_coefficient(table, data.site_class.value, at)
        assert number(found, 3) == number(wanted, 3)


def test_what_is_used_where_a_cell_is_blank_is_that_of_the_package(filled):
    blank, site = filled[BLANK], filled[BLANK].data.site
    assert blank.named("live_i_e") == site.i_e
    assert blank.named("live_sdc_used") == site.sdc
    assert blank.named("live_s_ds") == pytest.approx(site.s_ds, rel=1e-12)


SHORT = {
    "s_ds_g": lambda s_ds: {"s_ds_g": s_ds},
    "s_ms_g": lambda s_ds: {"s_ms_g": 1.51 * s_ds},
    "s_s_g, f_a": lambda s_ds: {"s_s_g": 0.63 * s_ds, "f_a": 2.4},
    "s_s_g": lambda s_ds: {"s_s_g": s_ds, "site_class": "C"},
    "of ASCE 7-22": lambda s_ds: {"s_ms_g": 1.51 * s_ds, "edition_name": "ASCE 7-22"},
}
AT_1_S = (
    {}, {"s_d1_g": 0.0669}, {"s_d1_g": 0.067}, {"s_d1_g": 0.2}, {"s_m1_g": 0.15},
    *({"s_1_g": s_1} for s_1 in (0.04, 0.3, 0.7499, 0.75, 1.1)),
    *({"s_1_g": 0.02, "s_d1_g": s_d1} for s_d1 in (0.05, 0.067, 0.1329, 0.133, 0.3)),
    {"s_1_g": 0.8, "s_d1_g": 0.95},
)  # fmt: skip
"""What is given at the short period and at 1 s; S_DS below is at and beside the limits."""
S_DS_G = (0.1, 0.1669, 0.167, 0.3299, 0.33, 0.49, 0.5, 1.2)
FORMS = itertools.product(SHORT.values(), S_DS_G, AT_1_S, ("II", "IV"))
SITES = [
    {"risk_category": category} | short(s_ds) | at_1_s for short, s_ds, at_1_s, category in FORMS
]


def add_sites(book: Workbook, sites: list[dict[str, object]]) -> None:
    """Write the formulas of the site once more for each of some sites, the categories first."""
    sheet = book.create_sheet("Sites")
    names = [f"site_{field}" for field in SITE_LABELS]
    formulas = {name: formula for formula, name in SITE_ANSWERS.values()}
    formulas = {"live_sdc": formulas.pop("live_sdc"), **formulas}
    columns = {name: get_column_letter(k) for k, name in enumerate([*formulas, *names], start=1)}
    for row, given in enumerate(sites, start=1):
        for name, formula in formulas.items():
            here = formula
            for known in re.findall(r"\b(?:site|live)_\w+", formula):
                here = re.sub(rf"\b{known}\b", f"{columns[known]}{row}", here)
            sheet[f"{columns[name]}{row}"] = f"={here}"
        for field, value in given.items():
            sheet[f"{columns[f'site_{field}']}{row}"] = value


@pytest.fixture(scope="module")
def of_sites(tmp_path_factory):
    """Some of the sites, a workbook without one, and the category that its formula has for each."""
    folder = tmp_path_factory.mktemp("sites")
    sites = random.Random(1).sample(SITES, 200)
    blank = dict.fromkeys(name for name in SITE_ANSWERS if name != "edition_name")
    path = folder / "input.xlsx"
    write_template(path, units=UnitsFirst.US, example=project(site=site(**COMPUTED)))
    fields = {*blank, "s_s_g", "s_1_g", "site_class"}
    type_into(path, {f"Site/{SITE_LABELS[name]}": None for name in fields})
    book = load_workbook(path)
    add_sites(book, sites)
    book.save(folder / "sites.xlsx")
    (sheets,) = recalculated_sheets([folder / "sites.xlsx"], folder)
    return sites, read(path), [row[0] or "" for row in sheets["Sites"]]


def test_the_category_that_a_formula_shows_is_that_of_check(of_sites):
    sites, sheet, shown = of_sites
    assert len(shown) == len(sites)
    said = []
    for given in sites:
        typed = {Place("site", 0, field): value for field, value in given.items()}
        tried = retyped(sheet, typed)
        found = [problem for problem in tried.problems if "category" in str(problem)]
        assert len(found) == len(tried.problems), tried.problems
        said.append("" if found else tried.project.site.sdc.value)
    assert [(given, text) for given, text in zip(sites, shown, strict=True)] == [
        (given, text) for given, text in zip(sites, said, strict=True)
    ]
    assert set(said) == {"", *"ACDEF"} | {"B"}


def test_displacement_ratios_and_weight_are_those_of_the_package(case):
    wanted = case.prescriptive.value_m
    assert number(case.named("live_prescriptive_in"), 1) == number(wanted / INCH, 1)
    assert case.lengths("Prescriptive displacement") == in_both_units(wanted)
    heading = next(h for h in case.headings("Clearances") if h.startswith("Required"))
    unit = Quantity.SIZE.us if "[in]" in heading else Quantity.SIZE.si
    neighbors, required, ratios = (
        case.column("Clearances", name)
        for name in ("Neighbor", "Required, prescriptive", "D/C, prescriptive")
    )
    for count, wanted in enumerate(case.checks(case.prescriptive.value_m)):
        wanted_length = number(wanted.required_m / unit.si, unit.decimals)
        assert neighbors[count] == wanted.neighbor.value
        assert number(required[count], unit.decimals) == wanted_length
        shown = ratios[count]
        assert (shown if shown == "∞" else number(shown, 2)) == ratio(wanted.demand_capacity)
    is_psf = "Weight per area [psf]" in case.headings("Arrays")
    unit = Quantity.PRESSURE.us if is_psf else Quantity.PRESSURE.si
    found = case.column("Arrays", "Weight per area")
    for array, value in zip(case.data.arrays, found, strict=False):
        wanted = array.weight_pa / PRESSURES[unit.symbol]
        assert number(value, unit.decimals) == number(wanted, unit.decimals)


def test_the_four_separations_are_those_of_the_package(case):
    data = case.data
    largest = max(row.i_p for row in (*data.arrays, *data.objects))
    for neighbor, what in (
        (provisions.Neighbor.LIKE, "like arrays"),
        (provisions.Neighbor.FIXED, "fixed object or unlike array"),
        (provisions.Neighbor.PARAPET, "edge with qualifying parapet"),
        (provisions.Neighbor.EDGE, "edge without qualifying parapet"),
    ):
        importance = data.site.i_e if neighbor.is_edge else largest
        wanted = provisions.required_separation(
            case.rules, neighbor, design_m=case.prescriptive.value_m, importance=importance
        )
        assert case.lengths(f"Separation, {what}") == in_both_units(wanted)


@pytest.mark.parametrize("label", ["Prescriptive displacement", "Floor of the value from analysis"])
def test_the_worst_clearance_is_the_first_of_the_largest_ratio(case, label):
    floor_m = provisions.analysis_floor_m(case.rules, case.prescriptive)
    checks = case.checks(floor_m if "Floor" in label else case.prescriptive.value_m)
    ratios = [ratio(check.demand_capacity) for check in checks]
    worst = max(ratios, key=lambda text: math.inf if text == "∞" else float(text))
    row = case.data.clearances[ratios.index(worst)]
    found, of = case.panel(label)[6:8]
    assert (found if found == "∞" else number(found, 2)) == worst
    assert of == f"{row.array} to {row.object}"


def test_weight_per_area_of_an_outlined_array_is_over_its_outline(filled):
    outlined, rectangle = filled["asce-22 and odd ids"].column("Arrays", "Weight per area")[:2]
    assert outlined == pytest.approx(42000 / 3600, rel=1e-12)
    assert rectangle == pytest.approx(42000 / (90 * 60), rel=1e-12)


def test_every_site_class_and_interval_of_the_tables(filled):
    rows = filled[CHANGED].sheets["Grid"]
    for (site_class, s_s), (name, *_, f_a, f_v) in zip(GRID, rows, strict=True):
        assert name == site_class.value
        for table, at, found in ((F_A, s_s, f_a), (F_V, s_s / 2.5, f_v)):
            wanted = site_coefficient(table, site_class.value, at)
            if math.isnan(wanted):
                assert found == "site-specific", (site_class, at)
            else:
                assert found == pytest.approx(wanted, abs=1e-12), (site_class, at)


def test_other_units_in_the_headings_change_no_answer(filled):
    changed = filled[CHANGED]
    assert "Weight [kip]" in changed.headings("Arrays")
    first, second = changed.column("Arrays", "Weight per area")[:2]
    assert first == pytest.approx(42000 / (80 * 60))
    assert second == pytest.approx(42000 / (90 * 60))
