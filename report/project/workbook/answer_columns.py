"""The live formulas next to the inputs: results of the package while the workbook is filled in.

Each formula repeats a function of `solver.rules` or `report.assessment` in cells, which a test
compares: at most 20 different ones, each shorter than 250 characters. Only functions of Excel 2007
to 2016, no array formulas. Read `SITE_ANSWERS`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from report.project.model.choices import ObjectKind, SlopeUnit
from report.project.workbook.earlier_workbooks import FORMER_ANSWERS
from report.project.workbook.layout import Tables
from report.text.units import Quantity, Unit
from solver.model import INCH_M
from solver.rules.hazard import NEAR_FAULT_S_1_G, HazardBasis
from solver.rules.provisions import Neighbor
from solver.rules.site_coefficients import F_A

# Where a rule set applies the importance factor, as written on the Provisions worksheet.
IN_DISPLACEMENT, IN_SEPARATION = "displacement", "separation"

# What a rule set prescribes in SDC A, B and C, as written on the Provisions worksheet.
ONE_VALUE, BY_FORMULA = "one value", "the formula"

# Defined names of columns, by table and column.
COLUMNS: Mapping[str, tuple[str, str]] = {
    "arrays_id": ("arrays", "id"),
    "arrays_kind": ("arrays", "kind_of_array"),
    "arrays_cg": ("arrays", "cg_height_m"),
    "arrays_i_p": ("arrays", "i_p"),
    "objects_id": ("objects", "id"),
    "objects_kind": ("objects", "kind"),
    "objects_height": ("objects", "height_m"),
    "objects_i_p": ("objects", "i_p"),
}

# Rows of `rule_separations` by neighbor; the last one has the minimum of the rule set, too. Arrays
# are the first and the third, by which `_NEIGHBOR` names them.
SEPARATION_ROWS: Mapping[Neighbor, int] = {
    Neighbor.LIKE: 1,
    Neighbor.FIXED: 2,
    Neighbor.UNLIKE: 2,
    Neighbor.PARAPET: 3,
    Neighbor.EDGE: 4,
}

# What an object of a kind counts as, where no parapet qualifies and where one does.
KINDS: Mapping[ObjectKind, tuple[Neighbor, Neighbor]] = {
    ObjectKind.FIXED: (Neighbor.FIXED, Neighbor.FIXED),
    ObjectKind.UNLIKE_ARRAY: (Neighbor.UNLIKE, Neighbor.UNLIKE),
    ObjectKind.EDGE_WITH_PARAPET: (Neighbor.EDGE, Neighbor.PARAPET),
    ObjectKind.EDGE_WITHOUT_PARAPET: (Neighbor.EDGE, Neighbor.EDGE),
}

_REFERENCE = re.compile(r"(?<!\w)(\w*)\[(#?)(\w+)\]")


@dataclass(frozen=True, slots=True)
class FormulaColumn:
    """A column of formulas in a table."""

    name: str
    heading: str
    note: str  # above the heading
    # Without its equals sign; `[field]` is the cell of its row, `[#field]` and `table[#field]` a
    # heading, and `table[field]` a whole column.
    formula: str
    number_format: str = "General"
    width: int = 11
    is_rare: bool = False  # folded at the right

    def written(self, tables: Tables, section: str, row: int) -> str:
        """Return the formula of a row with the references of a finished layout."""
        return written(self.formula, tables, section, row)


def written(formula: str, tables: Tables, section: str, row: int) -> str:
    """Return a formula with the references of a finished layout, on one line."""

    def reference(match: re.Match[str]) -> str:
        table, is_heading, field = match.groups()
        place = tables[table or section]
        if is_heading:
            return place.heading_cell(field, is_own=not table)
        return place.all(field) if table else f"${place.letters[field]}{row}"

    return _REFERENCE.sub(reference, "".join(map(str.strip, formula.splitlines())))


def table_answers(section: str, *, is_us: bool) -> tuple[FormulaColumn, ...]:
    """Return the answers of a table, in the order of its columns."""
    if section == "arrays":
        return (_KIND_OF_ARRAY,)
    if section == "clearances":
        return _of_clearances(Quantity.SIZE.value[0 if is_us else 1])
    return ()


def _blank_on_error(formula: str) -> str:
    return f'IFERROR({formula},"")'


def decimals_format(unit: Unit) -> str:
    """Return the number format with the decimals of a unit."""
    return f"0.{'0' * unit.decimals}".rstrip(".")


def _times(unit: Unit) -> str:
    """Return the factor from inches to a unit as text: nothing, or `*25.4`."""
    factor = f"{INCH_M / unit.si:.12g}"
    return "" if factor == "1" else f"*{factor}"


# As `report.assessment.design.separation.are_alike`, in words: arrays of the same words are alike.
# Of what is nearly the same (slopes to 0.0001 deg, directions to 1 deg) some words may still
# differ, which asks for the larger separation. A row without friction is of its own kind.
_KIND_OF_ARRAY = FormulaColumn(
    "kind_of_array",
    "Array type",
    "same text, similar arrays: construction, slope, direction, friction low, high, rate, static",
    f"""
        IF([id]="","",IFERROR(TRIM([construction])&" "&ROUND(IF([slope_unit]="{SlopeUnit.DEGREES}",
        [slope_value],DEGREES(ATAN([slope_value]/IF([slope_unit]="{SlopeUnit.PERCENT}",100,12))))
        /([mu]>0),4)&"° "&MOD(ROUND([downslope_deg],0),360)&" "&[mu]&" "
        &IF([mu_fast]="",[mu],[mu_fast])&" "&[mu_rate_s_per_m]&" "
        &IF([mu_static]="",[mu],[mu_static]),[id]))
    """,
    width=40,
    is_rare=True,
)

# LOOKUP takes the row in which its second argument is no error, and knows no wildcards.
# By how much an object is higher than the least parapet that qualifies, as
# `solver.rules.provisions.parapet_qualifies`.
_OVER_PARAPET = """
    IFERROR(IF([object]="","",LOOKUP(2,1/(objects_id=[object]),objects_height)
    *VLOOKUP(objects[#height_m],inches,2,0)-MAX(rule_parapet_height_in,
    LOOKUP(2,1/(arrays_id=[array]),arrays_cg)*VLOOKUP(arrays[#cg_height_m],inches,2,0)
    +rule_parapet_over_cg_in)),"")
"""
# In the order of the package: an object by its kind, and whether its parapet qualifies; else an
# array, alike or not by the text of its column. 1e-8 in is rounding of a change of units.
_NEIGHBOR = """
    IFERROR(IF([object]="","",IFERROR(VLOOKUP(LOOKUP(2,1/(objects_id=[object]),objects_kind),kinds,
    IF(MAX([over_parapet],-1)<-0.00000001,2,3),0),
    INDEX(neighbors,IF(LOOKUP(2,1/(arrays_id=[object]),arrays_kind)
    =LOOKUP(2,1/(arrays_id=[array]),arrays_kind),1,3),1))),"")
"""
# SUMPRODUCT takes a product of columns without being typed as an array formula. All edges begin
# with `edge`, and have I_e.
_IMPORTANCE = f"""
    IFERROR(IF([neighbor]="","",IF(rule_importance="{IN_DISPLACEMENT}",1,IF(LEFT([neighbor],4)="edge",
    live_i_e,MAX(1,SUMPRODUCT(MAX(((arrays_id=[array])+(arrays_id=[object]))*arrays_i_p)),
    SUMPRODUCT(MAX((objects_id=[object])*objects_i_p)))))),"")
"""


def _of_clearances(unit: Unit) -> tuple[FormulaColumn, ...]:
    times = _times(unit)
    # N makes 0 of the dash that stands for the minimum of a rule set without one.
    required = f"""
        IFERROR(MAX(INDEX(rule_separations,VLOOKUP([neighbor],neighbors,2,0))*[importance]*live_prescriptive,
        (VLOOKUP([neighbor],neighbors,2,0)={SEPARATION_ROWS[Neighbor.EDGE]})
        *N(rule_separation_edge_min_in){times}),"")
    """
    # Rounded up as by `report.text.units.ratio`, so that 1.00 never hides a failure.
    ratio = f"""
        IFERROR(IF(OR([required]="",TRIM([provided_m])=""),"",IF([provided_m]>0,MAX(0,ROUNDUP(
        [required]/([provided_m]*VLOOKUP([#provided_m],inches,2,0){times})-0.000000001,2)),"∞")),"")
    """
    column, length = FormulaColumn, decimals_format(unit)
    return (
        column("over_parapet", "Height over the lowest parapet [in]",
               "edge with parapet qualifies at 0 or more", _OVER_PARAPET,
               "0.0", 13, is_rare=True),
        column("neighbor", "Type", "as defined by the rule set", _NEIGHBOR, width=29),
        column("importance", "I", "importance factor in the separation", _IMPORTANCE, "0.00"),
        column("required", f"Required, prescriptive [{unit.symbol}]",
               "separation for the prescriptive displacement", required, length, 13),
        column("demand_capacity", "D/C, prescriptive", "required / provided, rounded up", ratio,
               "0.00", 13),
    )  # fmt: skip


SITE_FORMAT = "0.000"
_HAS_TABLES = f'live_edition="{F_A.edition}"'


def _coefficient(mapped: str, symbol: str) -> str:
    """Return the site coefficient of the tables, interpolated along the row of the site class."""
    # The columns go down, from one above all to one at 0: the first of the two is at or above.
    pair = f"MATCH({mapped},{symbol}_at,-1)-1,1,2"
    row = f"MATCH(site_site_class,{symbol}_class,0)"
    # FORECAST through two points is linear interpolation. Outside of the edition with tables it
    # divides by FALSE, an error, which leaves the cell blank.
    value = f"FORECAST({mapped},OFFSET({symbol}_at,{row},{pair}),OFFSET({symbol}_at,0,{pair}))"
    return f'IFERROR({value}/({_HAS_TABLES}),IF(COUNT({mapped}),"not in table",""))'


# S_MS where F_a is blank and S_DS is not given: as `Site.computed`.
_FROM_TABLE = (
    f'IF(AND(site_f_a="",site_hazard<>"{HazardBasis.SITE_SPECIFIC}"),live_f_a*site_s_s_g,"")'
)


def _maximum(maximum: str, mapped: str, coefficient: str, design: str, otherwise: str) -> str:
    return _blank_on_error(
        f"IF(COUNT({maximum}),{maximum},IF(({_HAS_TABLES})*COUNT({mapped},{coefficient})=2,"
        f"{coefficient}*{mapped},IF(COUNT({design}),1.5*{design},{otherwise})))"
    )


# S_DS and S_D1: two rows below S_MS and S_M1, whose computed value they take.
_DESIGN = 'IF(COUNT(B{row}),B{row},IF(COUNT(D{above}),2/3*D{above},""))'

# The most severe category by S_DS, S_D1 and S_1. In the second half of the letters are those
# without S_D1: as in `category_lacks`, blank where it may change the category.
_STEP = (
    f"MAX(MATCH(live_s_ds,sdc_s_ds),IF(site_s_1_g<{NEAR_FAULT_S_1_G},1,5),"
    'IF(live_s_d1="",1,MATCH(live_s_d1,sdc_s_d1)))+5*(live_s_d1="")'
)
_SDC = _blank_on_error(
    f"IF(COUNT(site_s_1_g),INDEX(sdc_letters,MATCH(site_risk_category,sdc_categories,0),{_STEP})"
    '&"","")'
)

# Formula and defined name of the answer beside each field of the site.
SITE_ANSWERS: Mapping[str, tuple[str, str]] = {
    "i_e": (
        _blank_on_error(
            "IF(COUNT(site_i_e),site_i_e,VLOOKUP(site_risk_category,risk_categories,2,0))"
        ),
        "live_i_e",
    ),
    "edition_name": (
        'IF(TRIM(site_edition_name)<>"",site_edition_name,rule_edition)',
        "live_edition",
    ),
    "f_a": (_coefficient("site_s_s_g", "f_a"), "live_f_a"),
    "f_v": (_coefficient("site_s_1_g", "f_v"), "live_f_v"),
    "s_ms_g": (
        _maximum("site_s_ms_g", "site_s_s_g", "site_f_a", "site_s_ds_g", _FROM_TABLE),
        "live_s_ms",
    ),
    "s_m1_g": (
        _maximum("site_s_m1_g", "site_s_1_g", "site_f_v", "site_s_d1_g", '""'),
        "live_s_m1",
    ),
    "s_ds_g": (_DESIGN, "live_s_ds"),
    "s_d1_g": (_DESIGN, "live_s_d1"),
    "sdc": (_SDC, "live_sdc"),
}

CATEGORY_USED = 'IF(TRIM(site_sdc)<>"",UPPER(TRIM(site_sdc)),live_sdc)'


def prescriptive(unit: Unit) -> str:
    """Return the formula of the prescriptive displacement."""
    return _blank_on_error(
        f'IF(AND(rule_low_sdc="{ONE_VALUE}",live_sdc_used>"",live_sdc_used<"D"),'
        "rule_prescriptive_low_sdc_in,MAX(rule_prescriptive_factor_in*MAX(live_s_ds-0.4,0)^2"
        f'*IF(rule_importance="{IN_DISPLACEMENT}",live_i_e,1),rule_prescriptive_minimum_in))'
        f"{_times(unit)}"
    )


# The floor of the value from analysis without peer review; with it there is none.
FLOOR = _blank_on_error("rule_analysis_floor*live_prescriptive")


def separation(unit: Unit, row: int) -> str:
    """Return the formula of a separation, whose row of `rule_separations` is in column D."""
    edge = SEPARATION_ROWS[Neighbor.EDGE]
    return _blank_on_error(
        f"MAX(INDEX(rule_separations,$D{row})*live_prescriptive*IF("
        f'rule_importance="{IN_SEPARATION}",IF($D{row}>{SEPARATION_ROWS[Neighbor.FIXED]},live_i_e,'
        f"MAX(1,arrays_i_p,objects_i_p)),1),($D{row}={edge})*N(rule_separation_edge_min_in)"
        f"{_times(unit)})"
    )


# The largest ratio of the clearances.
WORST = (
    'IF(COUNTIF(clearances[demand_capacity],"∞"),"∞",IF(COUNT(clearances[demand_capacity]),'
    'MAX(clearances[demand_capacity]),""))'
)

# Headings of formulas by section, lowercase and without unit; other tables have none.
ANSWER_HEADINGS: Mapping[str, frozenset[str]] = {
    section: FORMER_ANSWERS.get(section, frozenset())
    | {
        answer.heading.partition("[")[0].strip().casefold()
        for answer in table_answers(section, is_us=True)
    }
    for section in ("arrays", "clearances", "outlines")
}
