"""The live formulas beside the inputs: what the package will compute, while the sheet is filled.

Each formula repeats a function of `solver.rules` or `report.assessment` in cells; tests compare
them. Only functions of Excel 2007 to 2016, no array formulas. The reader reads none of them. Read
`site_answers`, then `table_answers`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from report.sheet.conditions import literal
from report.sheet.layout import Layout
from report.words.units import PRESSURES, Quantity
from solver.model import INCH_M
from solver.rules.provisions import Neighbor

STATUS = "status"
"""Name of the first column of every table: see `report.sheet.needs.row_status`."""

STATUS_HEADING = "Status"
STATUS_FORMAT = '[=0]"✓";[<0]"wrong";0" missing"'

IN_DISPLACEMENT, IN_SEPARATION = "in the displacement", "in the separation"
"""Where a rule set applies the importance factor, as written on the sheet Provisions."""

ONE_VALUE, BY_FORMULA = "one value", "the formula"
"""What a rule set prescribes in SDC A, B and C, as written on the sheet Provisions."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulaColumn:
    """A column of formulas in a table.

    Attributes
    ----------
    name, heading : str
    note : str
        Shown above the heading.
    write : callable
        Returns the formula, without its equals sign, from the finished layout.
    number_format : str
    width : int
    is_helper : bool
        Whether it only serves other formulas, and is folded at the right.
    """

    name: str
    heading: str
    note: str
    write: Callable[[Layout], str]
    number_format: str = "General"
    width: int = 11
    is_helper: bool = False


def table_answers(section: str, *, is_us: bool) -> tuple[FormulaColumn, ...]:
    """Return the answers of a table, in the order of its columns."""
    if section == "arrays":
        return _of_arrays(is_us)
    if section == "outlines":
        return (_DOUBLE_AREA,)
    return _of_clearances(is_us) if section == "clearances" else ()


def _label(heading: str) -> str:
    return heading.partition("[")[0].strip().casefold()


def _blank_on_error(formula: str) -> str:
    return f'IFERROR({formula},"")'


def _of_arrays(is_us: bool) -> tuple[FormulaColumn, ...]:
    unit = Quantity.PRESSURE.us if is_us else Quantity.PRESSURE.si
    return (
        FormulaColumn(
            name="slope_deg",
            heading="Slope in degrees",
            note="from slope and its unit",
            write=_slope_deg,
            number_format="0.00",
        ),
        FormulaColumn(
            name="weight_per_area",
            heading=f"Weight per area [{unit.symbol}]",
            note="over the rectangle or outline in plan",
            write=lambda layout: _weight_per_area(layout, unit.symbol),
            number_format=_decimals(unit.decimals),
        ),
        FormulaColumn(
            name="kind_of_array",
            heading="Kind of array",
            note="construction | friction: low, high, rate, static",
            write=_kind_of_array,
            width=40,
            is_helper=True,
        ),
    )


def _decimals(count: int) -> str:
    return f"0.{'0' * count}" if count else "0"


def _slope_deg(layout: Layout) -> str:
    this = layout.tables["arrays"].this
    value, unit = this("slope_value"), this("slope_unit")
    return _blank_on_error(
        f'IF(TRIM({value})="","",IF({unit}="degrees",{value}+0,'
        f'IF({unit}="percent",DEGREES(ATAN({value}/100)),'
        f'IF({unit}="in/12",DEGREES(ATAN({value}/12)),""))))'
    )


def _weight_per_area(layout: Layout, symbol: str) -> str:
    this = layout.tables["arrays"].this
    sides = {
        axis: "({}*unit_arrays_{}-{}*unit_arrays_{})".format(
            this(f"{axis}_to_m"), f"{axis}_to_m", this(f"{axis}_from_m"), f"{axis}_from_m"
        )
        for axis in "xy"
    }
    x, y = sides["x"], sides["y"]
    weight = this("weight_n")
    force = f"{weight}*unit_arrays_weight_n/{PRESSURES[symbol]!r}"
    return _blank_on_error(
        f'IF(TRIM({weight})="","",IF(COUNTIF(live_outlines,{literal(this("id"))})>0,'
        f"{force}/({_outlined_area(layout)}),"
        f'IF(OR({x}<=0,{y}<=0),"",{force}/({x}*{y}))))'
    )


def _outlined_area(layout: Layout) -> str:
    """Return the area within the outline of an array; an error where a row is below the table."""
    name, outlines = layout.tables["arrays"].this("id"), layout.tables["outlines"]
    is_its = f"--(TRIM({outlines.all('name')})=TRIM({name}))"
    return (
        f"ABS(SUMPRODUCT({is_its},{outlines.all('double_area')}))/2"
        "*unit_outlines_x_m*unit_outlines_y_m"
        f"/(SUMPRODUCT({is_its})=COUNTIF(live_outlines,{literal(name)}))"
    )


def _double_area(layout: Layout) -> str:
    """Return twice the area of the triangle from the origin to a vertex and the next one."""
    outlines = layout.tables["outlines"]
    names, name = outlines.all("name"), outlines.this("name")
    number = f"(ROW({name})-ROW({outlines.head('name')}))"
    below = f"INDEX({names},{number}+1):INDEX({names},ROWS({names}))"
    following = f"MATCH({literal(name)},{below},0)+{number}"
    first = f"MATCH({literal(name)},{names},0)"
    after = f"IF({number}=ROWS({names}),{first},IFERROR({following},{first}))"
    x, y = (f"INDEX({outlines.all(axis)},{after})" for axis in ("x_m", "y_m"))
    return _blank_on_error(
        f'IF(TRIM({name})="","",{outlines.this("x_m")}*{y}-{x}*{outlines.this("y_m")})'
    )


_DOUBLE_AREA = FormulaColumn(
    name="double_area",
    heading="Twice the area",
    note="of the triangle to the next vertex",
    write=_double_area,
    is_helper=True,
)


def _kind_of_array(layout: Layout) -> str:
    this = layout.tables["arrays"].this
    slow = this("mu")
    fast, rate, static = (this(name) for name in ("mu_fast", "mu_rate_s_per_m", "mu_static"))
    return _blank_on_error(
        f'IF(TRIM({slow})="","",TRIM({this("construction")})&" | "&({slow}+0)'
        f'&" | "&IF(TRIM({fast})="",{slow}+0,{fast}+0)'
        f'&" | "&IF(TRIM({rate})="",0,{rate}+0)'
        f'&" | "&IF(TRIM({static})="",{slow}+0,{static}+0))'
    )


def _of_clearances(is_us: bool) -> tuple[FormulaColumn, ...]:
    unit = Quantity.SIZE.us if is_us else Quantity.SIZE.si
    return (
        FormulaColumn(
            name="neighbor",
            heading="Neighbor",
            note="as the rule set counts it",
            write=_neighbor,
            width=29,
        ),
        FormulaColumn(
            name="importance",
            heading="I",
            note="importance factor in the separation",
            write=_importance,
            number_format="0.00",
        ),
        FormulaColumn(
            name="required",
            heading=f"Required, prescriptive [{unit.symbol}]",
            note="separation for the prescriptive displacement",
            write=lambda layout: _required(layout, unit.si),
            number_format=_decimals(unit.decimals),
            width=13,
        ),
        FormulaColumn(
            name="demand_capacity",
            heading="D/C, prescriptive",
            note="required / provided, rounded up",
            write=lambda layout: _demand_capacity(layout, unit.si),
            number_format="0.00",
            width=13,
        ),
        FormulaColumn(
            name="array_row",
            heading="Row of array",
            note="in the table on Arrays",
            write=lambda layout: _row_of(layout, "array", "arrays"),
            is_helper=True,
        ),
        FormulaColumn(
            name="other_row",
            heading="Row of other array",
            note="in the table on Arrays",
            write=lambda layout: _row_of(layout, "object", "arrays"),
            is_helper=True,
        ),
        FormulaColumn(
            name="object_row",
            heading="Row of object",
            note="in the table on Objects",
            write=lambda layout: _row_of(layout, "object", "objects"),
            is_helper=True,
        ),
    )


def _row_of(layout: Layout, field: str, section: str) -> str:
    """Return where an id is in another table."""
    name = literal(layout.tables["clearances"].this(field))
    return _blank_on_error(f"MATCH({name},{layout.tables[section].all('id')},0)")


def _neighbor(layout: Layout) -> str:
    this = layout.tables["clearances"].this
    array, other, item = (this(name) for name in ("array_row", "other_row", "object_row"))
    kind = f"INDEX({layout.tables['objects'].all('kind')},{item})"
    edge = (
        f'IF({kind}="edge with parapet",IF({_qualifies(layout, array, item)},'
        f'"{Neighbor.PARAPET}","{Neighbor.EDGE}"),'
        f'IF({kind}="edge without parapet","{Neighbor.EDGE}",{kind}))'
    )
    return _blank_on_error(
        f'IF({array}="","",IF({other}<>"",IF({_are_alike(layout, array, other)},'
        f'"{Neighbor.LIKE}","{Neighbor.UNLIKE}"),IF(TRIM({kind})="","",{edge})))'
    )


def _are_alike(layout: Layout, one: str, other: str) -> str:
    """Return the rule of `report.assessment.clearances.are_alike`."""
    arrays = layout.tables["arrays"]

    def of(name: str, row: str) -> str:
        return f"INDEX({arrays.all(name)},{row})"

    kind = "kind_of_array"
    turn = f"{of('downslope_deg', one)}-{of('downslope_deg', other)}"
    back = f"{of('downslope_deg', other)}-{of('downslope_deg', one)}"
    slopes = f"RADIANS({of('slope_deg', one)}-{of('slope_deg', other)})"
    return (
        f"AND({of(kind, one)}={of(kind, other)},ABS({slopes})<=0.000001,"
        f"MIN(MOD({turn},360),MOD({back},360))<=1)"
    )


def _qualifies(layout: Layout, array: str, item: str) -> str:
    """Return the rule of `solver.rules.provisions.parapet_qualifies`, in inches."""
    height = f"INDEX({layout.tables['objects'].all('height_m')},{item})*unit_objects_height_m"
    center = f"INDEX({layout.tables['arrays'].all('cg_height_m')},{array})*unit_arrays_cg_height_m"
    equal = "(1-0.000000001)"
    return (
        f"AND({height}/{INCH_M!r}>=rule_parapet_height_in*{equal},"
        f"({height}-{center})/{INCH_M!r}>=rule_parapet_over_cg_in*{equal})"
    )


def _importance(layout: Layout) -> str:
    this = layout.tables["clearances"].this
    array, other, item = (this(name) for name in ("array_row", "other_row", "object_row"))
    ours = layout.tables["arrays"].all("i_p")
    theirs = layout.tables["objects"].all("i_p")
    across = f'IF({other}="",MAX(1,INDEX({theirs},{item})),MAX(1,INDEX({ours},{other})))'
    return _blank_on_error(
        f'IF({this("neighbor")}="","",IF(rule_importance="{IN_DISPLACEMENT}",1,'
        f'IF(LEFT({this("neighbor")},4)="edge",live_i_e,MAX(1,INDEX({ours},{array}),{across}))))'
    )


def _required(layout: Layout, unit_m: float) -> str:
    this = layout.tables["clearances"].this
    at = f"MATCH({this('neighbor')},live_neighbors,0)"
    return _blank_on_error(
        f"MAX(INDEX(live_separation_factors,{at})*{this('importance')}*live_prescriptive_in,"
        f"INDEX(live_separation_minima_in,{at}))*{INCH_M!r}/{unit_m!r}"
    )


def _demand_capacity(layout: Layout, unit_m: float) -> str:
    this = layout.tables["clearances"].this
    provided = this("provided_m")
    ratio = f"{this('required')}*{unit_m!r}/({provided}*unit_clearances_provided_m)"
    # Rounded up like `report.words.units.ratio`, so that 1.00 never hides a failure.
    return _blank_on_error(
        f'IF(OR({this("required")}="",TRIM({provided})=""),"",'
        f'IF({provided}>0,MAX(0,ROUNDUP({ratio}-0.000000001,2)),"∞"))'
    )


SITE_FORMAT = "0.000"


def site_answers() -> Mapping[str, tuple[str, str]]:
    """Return the formula and the defined name of the answer beside each field of the site."""
    return {
        "i_e": ('IF(ISNUMBER(site_i_e),site_i_e,"")', "live_i_e"),
        "edition_name": (
            'IF(TRIM(site_edition_name)<>"",site_edition_name,rule_edition)',
            "live_edition",
        ),
        "f_a": (_coefficient("site_s_s_g", "f_a"), "live_f_a"),
        "f_v": (_coefficient("site_s_1_g", "f_v"), "live_f_v"),
        "s_ms_g": (_maximum("site_s_ms_g", "site_s_s_g", "site_f_a", "site_s_ds_g"), "live_s_ms"),
        "s_m1_g": (_maximum("site_s_m1_g", "site_s_1_g", "site_f_v", "site_s_d1_g"), "live_s_m1"),
        "s_ds_g": (_design("site_s_ds_g", "live_s_ms"), "live_s_ds"),
        "s_d1_g": (_design("site_s_d1_g", "live_s_m1"), "live_s_d1"),
        "sdc": (_sdc(), "live_sdc"),
    }


def _coefficient(mapped: str, symbol: str) -> str:
    """Return the site coefficient of the tables, interpolated along the row of the site class."""
    heads, row = f"table_{symbol}_mapped", f"MATCH(site_site_class,table_{symbol}_classes,0)"
    at = f"MIN(MAX({mapped},MIN({heads})),MAX({heads}))"
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


def _maximum(given: str, mapped: str, coefficient: str, design: str) -> str:
    has_both = f"AND(live_edition=table_f_a_edition,ISNUMBER({mapped}),ISNUMBER({coefficient}))"
    return (
        f"IF(ISNUMBER({given}),{given},IF({has_both},{coefficient}*{mapped},"
        f'IF(ISNUMBER({design}),1.5*{design},"")))'
    )


def _design(given: str, maximum: str) -> str:
    return f'IF(ISNUMBER({given}),{given},IF(ISNUMBER({maximum}),2/3*{maximum},""))'


def _sdc() -> str:
    """Return the most severe category: by S_DS, by S_D1, and by S_1."""
    steps = 'MID(IF(site_risk_category="IV","ACDD","ABCD"),1+SUMPRODUCT(--({}>={})),1)'
    short, long = (
        steps.format("live_s_ds", "sdc_limits_s_ds"),
        steps.format("live_s_d1", "sdc_limits_s_d1"),
    )
    near = 'IF(N(site_s_1_g)>=sdc_limit_s_1,CODE(IF(site_risk_category="IV","F","E")),0)'
    return (
        'IF(OR(live_s_ds="",TRIM(site_risk_category)=""),"",'
        f'CHAR(MAX(CODE({short}),IF(live_s_d1="",0,CODE({long})),{near})))'
    )


def prescriptive_formula_in() -> str:
    """Return the formula of the prescriptive displacement [in], before its minimum."""
    inside = f'IF(rule_importance="{IN_DISPLACEMENT}",IF(ISNUMBER(live_i_e),live_i_e,NA()),1)'
    return _blank_on_error(f"rule_prescriptive_factor_in*MAX(live_s_ds-0.4,0)^2*{inside}")


def prescriptive_in() -> str:
    """Return the prescriptive displacement [in]."""
    return _blank_on_error(
        f'IF(AND(rule_low_sdc="{ONE_VALUE}",live_sdc_used<>"",ISNUMBER(FIND(live_sdc_used,"ABC"))),'
        "rule_prescriptive_low_sdc_in+0,"
        "IF(live_prescriptive_formula_in+0>=rule_prescriptive_minimum_in+0,"
        "live_prescriptive_formula_in,rule_prescriptive_minimum_in))"
    )


def prescriptive_basis() -> str:
    """Return what governs the prescriptive displacement, in words."""
    return (
        'IF(live_prescriptive_in="","",'
        f'IF(AND(rule_low_sdc="{ONE_VALUE}",ISNUMBER(FIND(live_sdc_used,"ABC"))),"SDC A, B, C",'
        'IF(live_prescriptive_formula_in>=rule_prescriptive_minimum_in,"formula","minimum")))'
    )


ANSWER_HEADINGS: Mapping[str, frozenset[str]] = {
    section: frozenset(
        _label(heading)
        for heading in (STATUS_HEADING, *(a.heading for a in table_answers(section, is_us=True)))
    )
    for section in ("arrays", "clearances", "outlines")
}
"""Headings of formulas by section, lowercase and without unit; other tables have only the first."""
