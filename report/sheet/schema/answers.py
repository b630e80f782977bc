"""The live formulas beside the inputs: what the package will compute, while the sheet is filled.

Each formula repeats a function of `solver.rules` or `report.assessment` in cells; tests compare
them. Only functions of Excel 2007 to 2016, no array formulas. Read `SITE_ANSWERS`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass

from report.sheet.schema.layout import Tables, literal
from report.text.units import Quantity, Unit
from solver.model import INCH_M
from solver.rules.hazard import LEAST_I_E, MOST_BY_TABLES, HazardBasis
from solver.rules.provisions import Neighbor

# Where a rule set applies the importance factor, as written on the sheet Provisions.
IN_DISPLACEMENT, IN_SEPARATION = "in the displacement", "in the separation"

# What a rule set prescribes in SDC A, B and C, as written on the sheet Provisions.
ONE_VALUE, BY_FORMULA = "one value", "the formula"

_REFERENCE = re.compile(r"(?<!\w)(\w*)\[(#?)(\w+)\]")


@dataclass(frozen=True, slots=True)
class FormulaColumn:
    """A column of formulas in a table, blank where they give an error."""

    name: str
    heading: str
    note: str  # above the heading
    # Without its equals sign; `[field]` is the cell of its row, `table[field]` a whole column, and
    # `table[#field]` a heading.
    formula: str
    _: KW_ONLY
    number_format: str = "General"
    width: int = 11
    is_helper: bool = False  # it only serves other formulas, and is folded at the right

    def written(self, tables: Tables, section: str) -> str:
        """Return the formula with the references of a finished layout."""
        return _blank_on_error(written(self.formula, tables, tables[section].this))


def written(formula: str, tables: Tables, this: Callable[[str], str]) -> str:
    """Return a formula with the references of a finished layout, on one line."""

    def reference(match: re.Match[str]) -> str:
        table, is_heading, field = match.groups()
        if not table:
            return this(field)
        place = tables[table]
        return place.head(field) if is_heading else place.all(field)

    return _REFERENCE.sub(reference, "".join(map(str.strip, formula.splitlines())))


def table_answers(section: str, *, is_us: bool) -> tuple[FormulaColumn, ...]:
    """Return the answers of a table, in the order of its columns."""
    side = 0 if is_us else 1
    match section:
        case "arrays":
            return _of_arrays(Quantity.PRESSURE.value[side])
        case "clearances":
            return _of_clearances(Quantity.SIZE.value[side])
        case "outlines":
            return (_DOUBLE_AREA,)
    return ()


def _blank_on_error(formula: str) -> str:
    return f'IFERROR({formula},"")'


def decimals_format(unit: Unit) -> str:
    """Return the number format with the decimals of a unit."""
    return f"0.{'0' * unit.decimals}".rstrip(".")


# Here and below, +0 makes a number of one that was typed as text, which the reader accepts too.
_SLOPE_DEG = """
    IF(TRIM([slope_value])="","",
    IF([slope_unit]="degrees",[slope_value]+0,
    IF([slope_unit]="percent",DEGREES(ATAN([slope_value]/100)),
    IF([slope_unit]="in/12",DEGREES(ATAN([slope_value]/12)),""))))
"""
# Arrays are alike whose texts are equal: what is blank has the value that it stands for.
_KIND_OF_ARRAY = """
    IF(TRIM([mu])="","",TRIM([construction])&" | "&([mu]+0)
    &" | "&IF(TRIM([mu_fast])="",[mu]+0,[mu_fast]+0)
    &" | "&IF(TRIM([mu_rate_s_per_m])="",0,[mu_rate_s_per_m]+0)
    &" | "&IF(TRIM([mu_static])="",[mu]+0,[mu_static]+0))
"""
_VERTICES = f"COUNTIF(live_outlines,{literal('[id]')})"
_IS_ITS = "--(TRIM(outlines[name])=TRIM([id]))"
# An error where a row is below the table.
_OUTLINED_AREA = f"""
    ABS(SUMPRODUCT({_IS_ITS},outlines[double_area]))/2*unit_outlines_x_m*unit_outlines_y_m
    /(SUMPRODUCT({_IS_ITS})={_VERTICES})
"""


def _weight_per_area(unit: Unit) -> str:
    x, y = (f"([{a}_to_m]*unit_arrays_{a}_to_m-[{a}_from_m]*unit_arrays_{a}_from_m)" for a in "xy")
    parts = "[modules]*[module_weight_n]*unit_arrays_module_weight_n"
    parts += "+[ballast_n]*unit_arrays_ballast_n"
    is_blank = 'TRIM([weight_n])=""'
    force = f"IF({is_blank},{parts},[weight_n]*unit_arrays_weight_n)/{unit.si!r}"
    return f"""
        IF(AND({is_blank},COUNT([modules],[module_weight_n],[ballast_n])<3),"",
        IF({_VERTICES}>0,{force}/({_OUTLINED_AREA}),
        IF(OR({x}<=0,{y}<=0),"",{force}/({x}*{y}))))
    """


def _of_arrays(unit: Unit) -> tuple[FormulaColumn, ...]:
    heading, note = f"Weight per area [{unit.symbol}]", "over the rectangle or outline in plan"
    column = FormulaColumn
    return (
        column("slope_deg", "Slope in degrees", "from slope and its unit", _SLOPE_DEG,
               number_format="0.00"),
        column("weight_per_area", heading, note, _weight_per_area(unit),
               number_format=decimals_format(unit)),
        column("kind_of_array", "Kind of array", "construction | friction: low, high, rate, static",
               _KIND_OF_ARRAY, width=40, is_helper=True),
    )  # fmt: skip


_NUMBER = "(ROW([name])-ROW(outlines[#name]))"
_FIRST = f"MATCH({literal('[name]')},outlines[name],0)"
_FOLLOWING = (
    f"MATCH({literal('[name]')},INDEX(outlines[name],{_NUMBER}+1)"
    f":INDEX(outlines[name],ROWS(outlines[name])),0)+{_NUMBER}"
)
_AFTER = f"IF({_NUMBER}=ROWS(outlines[name]),{_FIRST},IFERROR({_FOLLOWING},{_FIRST}))"
_DOUBLE_AREA = FormulaColumn(
    "double_area",
    "Twice the area",
    "of the triangle to the next vertex",
    f"""
        IF(TRIM([name])="","",
        [x_m]*INDEX(outlines[y_m],{_AFTER})-INDEX(outlines[x_m],{_AFTER})*[y_m])
    """,
    is_helper=True,
)

_OBJECT = "INDEX(objects[kind],[object_row])"
_HEIGHT = "INDEX(objects[height_m],[object_row])*unit_objects_height_m"
_CENTER = "INDEX(arrays[cg_height_m],[array_row])*unit_arrays_cg_height_m"
# As `solver.rules.provisions.parapet_qualifies`, in inches.
_QUALIFIES = f"""
    AND({_HEIGHT}/{INCH_M!r}>=rule_parapet_height_in*(1-0.000000001),
    ({_HEIGHT}-{_CENTER})/{INCH_M!r}>=rule_parapet_over_cg_in*(1-0.000000001))
"""
_ONE, _OTHER = (
    {
        name: f"INDEX(arrays[{name}],[{row}])"
        for name in ("kind_of_array", "slope_deg", "downslope_deg")
    }
    for row in ("array_row", "other_row")
)
# MOD is never negative: the smaller of both ways around is the angle.
_TURN = f"{_ONE['downslope_deg']}-{_OTHER['downslope_deg']}"
_BACK = f"{_OTHER['downslope_deg']}-{_ONE['downslope_deg']}"
# As `report.assessment.clearances.are_alike`.
_ARE_ALIKE = f"""
    AND({_ONE["kind_of_array"]}={_OTHER["kind_of_array"]},
    ABS(RADIANS({_ONE["slope_deg"]}-{_OTHER["slope_deg"]}))<=0.000001,
    MIN(MOD({_TURN},360),MOD({_BACK},360))<=1)
"""
_NEIGHBOR = f"""
    IF([array_row]="","",
    IF([other_row]<>"",IF({_ARE_ALIKE},"{Neighbor.LIKE}","{Neighbor.UNLIKE}"),
    IF(TRIM({_OBJECT})="","",
    IF({_OBJECT}="edge with parapet",IF({_QUALIFIES},"{Neighbor.PARAPET}","{Neighbor.EDGE}"),
    IF({_OBJECT}="edge without parapet","{Neighbor.EDGE}",{_OBJECT})))))
"""
_IMPORTANCE = f"""
    IF([neighbor]="","",
    IF(rule_importance="{IN_DISPLACEMENT}",1,
    IF(LEFT([neighbor],4)="edge",live_i_e,
    MAX(1,INDEX(arrays[i_p],[array_row]),
    IF([other_row]="",MAX(1,INDEX(objects[i_p],[object_row])),
    MAX(1,INDEX(arrays[i_p],[other_row])))))))
"""


def _required_m(displacement_in: str) -> str:
    at = "MATCH([neighbor],live_neighbors,0)"
    return f"""
        MAX(INDEX(live_separation_factors,{at})*[importance]*{displacement_in},
        INDEX(live_separation_minima_in,{at}))*{INCH_M!r}
    """


def _demand_capacity(required_m: str) -> str:
    # Rounded up as by `report.text.units.ratio`, so that 1.00 never hides a failure.
    ratio = f"{required_m}/([provided_m]*unit_clearances_provided_m)"
    return f"""
        IF(OR([required]="",TRIM([provided_m])=""),"",
        IF([provided_m]>0,MAX(0,ROUNDUP({ratio}-0.000000001,2)),"∞"))
    """


def _of_clearances(unit: Unit) -> tuple[FormulaColumn, ...]:
    required = f"{_required_m('live_prescriptive_in')}/{unit.si!r}"
    ratio, of_floor = (
        _demand_capacity(length_m)
        for length_m in (f"[required]*{unit.si!r}", _required_m("live_floor_in"))
    )
    column = FormulaColumn
    return (
        column("neighbor", "Neighbor", "as the rule set counts it", _NEIGHBOR, width=29),
        column("importance", "I", "importance factor in the separation", _IMPORTANCE,
               number_format="0.00"),
        column("required", f"Required, prescriptive [{unit.symbol}]",
               "separation for the prescriptive displacement", required,
               number_format=decimals_format(unit), width=13),
        column("demand_capacity", "D/C, prescriptive", "required / provided, rounded up", ratio,
               number_format="0.00", width=13),
        column("floor_ratio", "D/C, floor", "for the floor of the value from analysis", of_floor,
               number_format="0.00", is_helper=True),
        _row_of("array_row", "array", "array", "arrays"),
        _row_of("other_row", "other array", "object", "arrays"),
        _row_of("object_row", "object", "object", "objects"),
    )  # fmt: skip


def _row_of(name: str, what: str, field: str, section: str) -> FormulaColumn:
    note, row = f"in the table on {section.capitalize()}", f"MATCH({literal(f'[{field}]')}"
    return FormulaColumn(name, f"Row of {what}", note, f"{row},{section}[id],0)", is_helper=True)


SITE_FORMAT = "0.000"


def _coefficient(mapped: str, symbol: str) -> str:
    """Return the site coefficient of the tables, interpolated along the row of the site class."""
    heads, row = f"table_{symbol}_mapped", f"MATCH(site_site_class,table_{symbol}_classes,0)"
    # Beyond the table its first and last columns hold.
    at = f"MIN(MAX({mapped},MIN({heads})),MAX({heads}))"
    # The last column has none after it to interpolate with.
    left = f"MIN(MATCH({at},{heads},1),5)"
    start, end = f"INDEX({heads},1,{left})", f"INDEX({heads},1,{left}+1)"
    low = f"INDEX(table_{symbol},{row},{left})"
    high = f"INDEX(table_{symbol},{row},{left}+1)"
    value = f"IF({at}={start},{low}+0,{low}+({at}-{start})/({end}-{start})*({high}-{low}))"
    return (
        f'IF(OR(TRIM({mapped})="",TRIM(site_site_class)="",live_edition=""),"",'
        f'IF(live_edition<>table_{symbol}_edition,"none in "&live_edition,'
        f'IFERROR({value},"site-specific")))'
    )


# S_MS where F_a is blank and S_DS is not given: as `Site.computed`.
_FROM_TABLE = (
    'IF(AND(TRIM(site_f_a)="",ISNUMBER(live_f_a),'
    f'site_hazard<>"{HazardBasis.SITE_SPECIFIC}"),live_f_a*site_s_s_g,"")'
)


def _maximum(values: str, mapped: str, coefficient: str, design: str, otherwise: str = '""') -> str:
    has_both = f"AND(live_edition=table_f_a_edition,ISNUMBER({mapped}),ISNUMBER({coefficient}))"
    return (
        f"IF(ISNUMBER({values}),{values},IF({has_both},{coefficient}*{mapped},"
        f"IF(ISNUMBER({design}),1.5*{design},{otherwise})))"
    )


def _design(values: str, maximum: str) -> str:
    return f'IF(ISNUMBER({values}),{values},IF(ISNUMBER({maximum}),2/3*{maximum},""))'


# The most severe category: by S_DS, by S_D1, and by S_1.
# One letter on for each limit that is reached; in category IV from C on.
_STEPS = 'MID(IF(site_risk_category="IV","ACDD","ABCD"),1+SUMPRODUCT(--({}>={})),1)'
_BY_S_DS, _BY_S_D1 = (_STEPS.format(f"live_{s}", f"sdc_limits_{s}") for s in ("s_ds", "s_d1"))
_BY_S_1 = 'IF(N(site_s_1_g)>=sdc_limit_s_1,CODE(IF(site_risk_category="IV","F","E")),0)'
# As in `category_lacks`: blank where S_1 or S_D1 is not given and may change it.
_LACKS_S_D1 = f'AND(live_s_d1="",{_BY_S_DS}<>"{MOST_BY_TABLES}",{_BY_S_1}=0)'
_SDC = (
    'IF(OR(live_s_ds="",TRIM(site_risk_category)="",NOT(ISNUMBER(site_s_1_g))),"",'
    f'IF({_LACKS_S_D1},"",CHAR(MAX(CODE({_BY_S_DS}),IF(live_s_d1="",0,CODE({_BY_S_D1})),{_BY_S_1}))))'
)

_LEAST_I_E = "".join(f'IF(TRIM(site_risk_category)="{c}",{v:g},' for c, v in LEAST_I_E.items())
_LEAST_I_E += '""' + ")" * len(LEAST_I_E)
_S_MS = ("site_s_ms_g", "site_s_s_g", "site_f_a", "site_s_ds_g")

# Formula and defined name of the answer beside each field of the site.
SITE_ANSWERS: Mapping[str, tuple[str, str]] = {
    "i_e": (f"IF(ISNUMBER(site_i_e),site_i_e,{_LEAST_I_E})", "live_i_e"),
    "edition_name": (
        'IF(TRIM(site_edition_name)<>"",site_edition_name,rule_edition)',
        "live_edition",
    ),
    "f_a": (_coefficient("site_s_s_g", "f_a"), "live_f_a"),
    "f_v": (_coefficient("site_s_1_g", "f_v"), "live_f_v"),
    "s_ms_g": (_maximum(*_S_MS, _FROM_TABLE), "live_s_ms"),
    "s_m1_g": (_maximum("site_s_m1_g", "site_s_1_g", "site_f_v", "site_s_d1_g"), "live_s_m1"),
    "s_ds_g": (_design("site_s_ds_g", "live_s_ms"), "live_s_ds"),
    "s_d1_g": (_design("site_s_d1_g", "live_s_m1"), "live_s_d1"),
    "sdc": (_SDC, "live_sdc"),
}

_I_E = f'IF(rule_importance="{IN_DISPLACEMENT}",IF(ISNUMBER(live_i_e),live_i_e,NA()),1)'
# The prescriptive displacement [in], before its minimum.
PRESCRIPTIVE_FORMULA_IN = _blank_on_error(
    f"rule_prescriptive_factor_in*MAX(live_s_ds-0.4,0)^2*{_I_E}"
)

PRESCRIPTIVE_IN = _blank_on_error(
    f'IF(AND(rule_low_sdc="{ONE_VALUE}",live_sdc_used<>"",ISNUMBER(FIND(live_sdc_used,"ABC"))),'
    "rule_prescriptive_low_sdc_in+0,"
    "IF(live_prescriptive_formula_in+0>=rule_prescriptive_minimum_in+0,"
    "live_prescriptive_formula_in,rule_prescriptive_minimum_in))"
)
# What governs the prescriptive displacement, in words.
PRESCRIPTIVE_BASIS = (
    'IF(live_prescriptive_in="","",'
    f'IF(AND(rule_low_sdc="{ONE_VALUE}",live_sdc_used<>"",ISNUMBER(FIND(live_sdc_used,"ABC"))),'
    '"SDC A, B, C",'
    'IF(live_prescriptive_formula_in>=rule_prescriptive_minimum_in,"formula","minimum")))'
)

# The floor of the value from analysis without peer review [in]; with it there is none.
FLOOR_IN = _blank_on_error("rule_analysis_floor*live_prescriptive_in")


def worst(column: str) -> tuple[str, str]:
    """Return the largest ratio of a column of the clearances, and of which clearance it is."""
    ratios, at = f"clearances[{column}]", f"MATCH(MAX(clearances[{column}]),clearances[{column}],0)"
    at = f'IF(COUNTIF({ratios},"∞"),MATCH("∞",{ratios},0),{at})'
    of = f'INDEX(clearances[array],{at})&" to "&INDEX(clearances[object],{at})'
    return _blank_on_error(f"INDEX({ratios},{at})"), _blank_on_error(of)


# Headings of formulas by section, lowercase and without unit; other tables have none.
ANSWER_HEADINGS: Mapping[str, frozenset[str]] = {
    section: frozenset(
        answer.heading.partition("[")[0].strip().casefold()
        for answer in table_answers(section, is_us=True)
    )
    for section in ("arrays", "clearances", "outlines")
}
