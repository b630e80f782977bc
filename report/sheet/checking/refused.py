"""What `checks` refuses of a cell in view of other cells, as formulas for the sheet.

In a formula `[field]` is the cell of its row, `table[field]` a whole column, `site_i_e` a single
cell; one that gives an error says nothing of its cell. A test holds them against `checks`, cell by
cell. Read `REFUSED`, then `UNDECIDED`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product

from report.sheet.checking.checks import GAP_TOLERANCE, GAP_TOLERANCES_M
from report.sheet.checking.conditions import MAX_SLOPE_DEG, ORDERED, OTHER_NAMES, REFERENCES, UNIQUE
from report.sheet.checking.site_checks import AGREES_G, LEAST_I_E, ROUNDING_OF_COEFFICIENTS
from report.sheet.schema.layout import literal
from report.sheet.schema.scene import ROOF, SIDES
from report.sheet.schema.shapes import NEAR_M
from solver.building.beam import MOST_STORIES
from solver.rules.hazard import EDITIONS, HazardBasis

_Tests = Iterator[tuple[str, str]]
_PLACED = ("roof", "arrays", "objects")


def _n(cell: str) -> str:
    """Return a number, or an error where a cell has none."""
    return f"{cell}/ISNUMBER({cell})"


def _again(table: str, *fields: str) -> tuple[str, str]:
    """Return whether another row has the same in all of some fields, the first not blank."""
    same = "*".join(f"(TRIM({table}[{field}])=TRIM([{field}]))" for field in fields)
    return f"{table}_{fields[0]}", f'(TRIM([{fields[0]}])<>"")*SUMPRODUCT(--({same}))>1'


def _size(section: str, side: str) -> str:
    cell = f"roof_{side}" if section == "roof" else f"[{side}]"
    return f"{_n(cell)}*unit_{section}_{side}"


def _names() -> _Tests:
    """Yield an id that is given twice, a name of no row of any table, sides in the wrong order."""
    for alike in UNIQUE:
        count = "+".join(f"SUMPRODUCT(--(TRIM({table}[id])=TRIM([id])))" for table in alike)
        yield from ((f"{table}_id", f'(TRIM([id])<>"")*({count})>1') for table in alike)
    for section, (low, high) in product(_PLACED, ORDERED):
        yield f"{section}_{high}", f"{_size(section, low)}>={_size(section, high)}"
    for (table, field), tables in REFERENCES.items():
        given, other = f"TRIM([{field}])", OTHER_NAMES.get((table, field), "")
        count = "+".join(f"SUMPRODUCT(--EXACT(TRIM({known}[id]),{given}))" for known in tables)
        yield f"{table}_{field}", f'({given}<>"")*({count}+(LOWER({given})="{other}")=0)>0'


def _period(mapped: str, factor: str, most: str, design: str) -> _Tests:
    """Yield what is refused of the site at one period: see `site_checks`."""
    live, has_table = f"live_{factor[5:]}", f"live_edition=table_{factor[5:]}_edition"
    product = f"IF({has_table},{_n(factor)}*{_n(mapped)},NA())"
    least = f'IF(TRIM({factor})="",{live}*{mapped},NA())'
    low = f'AND(site_hazard<>"{HazardBasis.SITE_SPECIFIC}",{{}}<{{}}-{{}})'.format
    yield factor, f'AND({_n(factor)}>0,live_edition<>"",NOT({has_table}))'
    yield factor, low(_n(factor), live, ROUNDING_OF_COEFFICIENTS)
    yield most, low(_n(most), least, AGREES_G)
    yield design, low(_n(design), f"2/3*{least}", AGREES_G)
    for cell, other in ((most, product), (design, f"2/3*{_n(most)}"), (design, f"2/3*{product}")):
        yield cell, f"ABS({_n(cell)}-{other})>{AGREES_G}"


def _plan() -> _Tests:
    """Yield sides of rectangles beside an outline or off the roof, and overlaps of arrays."""
    roof = f"COUNT({','.join(f'roof_{side}' for side in SIDES)})=4"
    roof += "".join(f",roof_{low}<roof_{high}" for low, high in ORDERED)
    for section, side in product(_PLACED, SIDES):
        cell, name = (f"roof_{side}", f'"{ROOF}"') if section == "roof" else (f"[{side}]", "[id]")
        outlined = f"LEN({name})*COUNTIF(live_outlines,{literal(name)})"
        yield f"{section}_{side}", f"LEN({cell})*{outlined}>0"
        if section == "arrays":
            off = "<" if "from" in side else ">"
            beyond = f"{_size(section, side)}{off}{_size('roof', side)}"
            yield f"{section}_{side}", f"AND({roof},{beyond})"
    counts = []
    for table in ("arrays", "objects"):
        tests = ['(LEFT(TRIM(objects[kind]),4)<>"edge")'] if table == "objects" else []
        for low, high in ORDERED:
            here, there = (f"[{side}]*unit_arrays_{side}" for side in (low, high))
            tests.append(f"({table}[{low}]<{table}[{high}])")
            tests.append(f"({table}[{low}]*unit_{table}_{low}<{there}-{NEAR_M:f})")
            tests.append(f"({table}[{high}]*unit_{table}_{high}>{here}+{NEAR_M:f})")
        counts.append(f"SUMPRODUCT({'*'.join(tests)})")
    yield "arrays_x_from_m", f"{counts[0]}+{counts[1]}>1"


def _beyond_gap() -> str:
    """Return whether a clearance is more than the distance of two rectangles, and its tolerance."""

    def of(row: str, side: str) -> str:
        table = "objects" if row == "object_row" else "arrays"
        return f"{_n(f'INDEX({table}[{side}],[{row}])')}*unit_{table}_{side}"

    far = []
    for sides in ORDERED:
        a_low, a_high = (of("array_row", side) for side in sides)
        b_low, b_high = (
            f'IF([other_row]="",{of("object_row", side)},{of("other_row", side)})' for side in sides
        )
        far.append(f"MAX({a_low}-{b_high},{b_low}-{a_high})")
    gap = "MIN(MAX({0},{1}),0)+(MAX({0},0)^2+MAX({1},0)^2)^0.5".format(*far)
    given, (least, most) = "[provided_m]*unit_clearances_provided_m", GAP_TOLERANCES_M
    share = f"MIN({given}/{1 + GAP_TOLERANCE},{given}-{least})"
    return f"{gap}<MAX(-0.000000001,{_n(given)}-{most},{share})"


_BY_RISK = (f'IF(TRIM(site_risk_category)="{name}",{i_e},' for name, i_e in LEAST_I_E.items())

SHORT = (*_names(), ("arrays_slope_value", f"{_n('[slope_deg]')}>={MAX_SLOPE_DEG:g}"))
"""Those of `REFUSED` that the formula of a row had in workbooks of 0.2."""

REFUSED = (
    *SHORT,
    *_plan(),
    *_period("site_s_s_g", "site_f_a", "site_s_ms_g", "site_s_ds_g"),
    *_period("site_s_1_g", "site_f_v", "site_s_m1_g", "site_s_d1_g"),
    ("site_i_e", f"{_n('site_i_e')}<{''.join(_BY_RISK)}0{')' * len(LEAST_I_E)}"),
    (
        "site_edition_name",
        f'ISNUMBER(FIND("|"&TRIM(site_rule_set)&"|","|{"|".join(EDITIONS)}|"))'
        '*(TRIM(site_edition_name)<>"")*(TRIM(site_edition_name)<>TRIM(site_rule_set))>0',
    ),
    (
        "site_site_class",
        '(TRIM(site_site_class)<>"")*(live_edition=table_f_a_edition)'
        "*ISERROR(MATCH(TRIM(site_site_class),table_f_a_classes,0))>0",
    ),
    ("site_sdc", "CODE(UPPER(TRIM(site_sdc)))<CODE(live_sdc)"),
    ("site_stories", f"AND(live_ground_motions>0,{_n('site_stories')}>{MOST_STORIES})"),
    ("arrays_mu_static", f"{_n('[mu_static]')}<[mu]"),
    (
        "arrays_model",
        '(TRIM([model])<>"")*(TRIM([model])<>"choose")*((TRIM([mu_fast])<>"")*([mu_fast]<>[mu])'
        '+(TRIM([mu_static])<>"")*([mu_static]<>[mu]))>0',
    ),
    _again("friction_runs", "number", "surface", "report"),
    _again("clearances", "array", "object", "direction"),
    ("clearances_object", "EXACT(TRIM([array]),TRIM([object]))*LEN([object])>0"),
    ("clearances_provided_m", _beyond_gap()),
    ("motions_transverse", "EXACT(TRIM([transverse]),TRIM([record]))*LEN([transverse])>0"),
    ("motions_vertical", "EXACT(TRIM([vertical]),TRIM([record]))*LEN([vertical])>0"),
    ("motions_vertical", "EXACT(TRIM([vertical]),TRIM([transverse]))*LEN([vertical])>0"),
    (
        "motions_scale_value",
        f'(TRIM([scaling])<>"factor")*(TRIM([scaling])<>"PPA")*({_n("[scale_value]")}<>1)>0',
    ),
    ("motions_to_s", f"{_n('[to_s]')}<=N([from_s])"),
    ("motions_lowpass_hz", f"{_n('[lowpass_hz]')}<={_n('[highpass_hz]')}"),
    ("building_period_2_s", f"{_n('building_period_2_s')}>N(building_period_s)"),
    ("spectrum_period_s", "COUNTIF(spectrum[period_s],[period_s])>1"),
    ("spectrum_period_s", "COUNT([period_s])*(COUNT(spectrum[period_s])=1)>0"),
    ("spectrum_vertical_g", "(COUNT([vertical_g])=0)*COUNT(spectrum[vertical_g])>0"),
    ("target_t_l_s", f"{_n('target_t_l_s')}<=live_s_d1/live_s_ds/(COUNT(spectrum[period_s])=0)"),
    ("target_to_s", f"{_n('target_to_s')}<={_n('target_from_s')}"),
    _again("links", "array"),
    _again("overrides", "provision"),
    (
        "overrides_provision",
        'ISERROR(MATCH(TRIM([provision]),rule_names,0))*ISERROR(FIND("_",[provision]))'
        '*ISERROR(FIND("[",[provision]))*(TRIM([provision])<>"")>0',
    ),
    ("outlines_name", 'AND(TRIM([name])<>"",COUNTIF(live_outlines,[name])<3)'),
)
"""Cells by name, which is their section and their field, with a formula that may not hold."""

_SCALED = 'SUMPRODUCT(--(TRIM(motions[scaling])="target spectrum"))>0'

UNDECIDED: Mapping[str, str] = {
    "site": 'AND(TRIM(site_site_class)="",COUNT(site_s_s_g,site_s_1_g)>0)',
    "arrays": "COUNTA(live_outlines)+COUNTA(friction_runs[surface])>0",
    "friction_tests": 'TRIM(friction_tests_report_file)<>""',
    "friction_runs": "COUNTA(friction_runs[report])>0",
    "clearances": "COUNTA(live_outlines)>0",
    "motions": "COUNT(motions[status])>0",
    "spectrum": f"AND(COUNT(spectrum[status])>0,{_SCALED})",
    "links": "COUNT(links[status])>0",
    "options": 'TRIM(options_peer_letter&options_smaller_events)<>""',
    "overrides": "COUNT(overrides[status])>0",
    "outlines": "COUNTA(live_outlines)>0",
}
"""When no formula tells whether `checks` accepts a section: files, lists of numbers, tests of
friction, shapes that are no rectangles, a site class that is assumed."""
