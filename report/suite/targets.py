"""Targets of a generated suite: by code, by table, or by the site of a workbook.

With S_DS = 1.0 g at the roof, by ASCE 7-16: A_FLX 1.6 g and A_RIG 1.2 g.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from report.project.check.motion_faults import GENERATED
from report.project.model.input_rows import Place
from report.project.model.site_input import site_parameters
from report.project.read.typed_text import choice_in
from report.project.read.workbook_data import Sheet
from report.suite.target_table import TargetTable
from solver.errors import InputError
from solver.rules.ac156 import RequiredSpectrum, Tail, Target, ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS
from solver.rules.rulesets import RULE_SETS

# Rule sets by their names on the command line.
CODES = {rules.code: rules.name for rules in RULE_SETS.values()}

# As of the Site worksheet (`Site.s_ds_g`).
_MAX_S_DS_G = 5.0

# Records are written to 0.00001 g: 0.25 % of the smallest peak below.
_MIN_S_DS_G = 0.01
_MIN_PEAK_G = 0.004


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteTargets:
    """Target spectra of x and y, and of z, and their description."""

    horizontal: Target
    vertical: Target
    lines: tuple[str, ...]  # printed description
    facts: Mapping[str, Any]  # for suite.json

    def source(self, seed: int) -> str:
        """Return what the Motions worksheet says of motions with these targets."""
        basis = self.lines[0].removeprefix("target: ").partition(": ")[0]
        return f"{GENERATED}{seed}; {basis}"

    def of(self, component: str) -> Target:
        """Return the target of x, y or z."""
        return self.vertical if component == "z" else self.horizontal


def ac156_targets(
    code: str, *, s_ds_g: float, z_over_h: float, tail: Tail, edition: str = ""
) -> SuiteTargets:
    """Return the AC156 spectra of a code, a key of `CODES`, at a height.

    The edition of ASCE 7 is empty for that of the code. Raises `InputError` if a number is out of
    range.
    """
    problems = _s_ds_problems(s_ds_g)
    if not 0.0 <= z_over_h <= 1.0:
        problems.append(f"z/h is {z_over_h:g}; enter a number from 0 (ground) to 1 (roof)")
    if problems:
        raise InputError(problems)
    named = {name: key for key, name in CODES.items()}
    # By its name as well, as a workbook has it.
    code = named.get(choice_in(code, named), code.casefold())
    if code not in CODES:
        raise InputError(f"--code is {code!r}; enter one of {', '.join(CODES)}")
    rules = RULE_SETS[CODES[code]]
    across = ac156_horizontal(
        EDITIONS[edition or rules.edition], s_ds_g=s_ds_g, z_over_h=z_over_h, tail=tail
    )
    upward = ac156_vertical(s_ds_g=s_ds_g, tail=tail)
    return SuiteTargets(
        horizontal=(across.freq_hz, across.sa_g),
        vertical=(upward.freq_hz, upward.sa_g),
        lines=(
            f"target: AC156 with {rules.name}, S_DS {s_ds_g:g} g, z/h {z_over_h:g}: "
            f"A_FLX {across.sa_g[1]:.4g} g, A_RIG {across.sa_g[3]:.4g} g; "
            f"vertical {_plateaus(upward)}",
            f"tail: {tail.sentence}",
        ),
        facts={
            "source": "AC156",
            "code": rules.name,
            "s_ds_g": s_ds_g,
            "z_over_h": z_over_h,
            "tail": tail.value,
            "tail_rule": tail.sentence,
        },
    )


def table_targets(table: TargetTable, *, s_ds_g: float, tail: Tail) -> SuiteTargets:
    """Return the targets of a table; if it has no vertical, the vertical is AC156 for S_DS.

    Raises `InputError` if the table has no vertical and S_DS is NaN.
    """
    slowest_s = 1.0 / table.freq_hz[0]
    lines = [
        f"target: {table.source}, {len(table.freq_hz)} points, periods up to {slowest_s:.4g} s"
    ]
    facts: dict[str, Any] = {"source": table.source}
    if table.has_vertical:
        vertical = (table.freq_hz, table.vertical_g)
    else:
        if math.isnan(s_ds_g):
            raise InputError(
                f"{table.source}: has no vertical column; add vertical [g], or use --sds for the "
                "AC156 vertical spectrum"
            )
        problems = _s_ds_problems(s_ds_g)
        if problems:
            raise InputError(problems)
        upward = ac156_vertical(s_ds_g=s_ds_g, tail=tail)
        vertical = (upward.freq_hz, upward.sa_g)
        lines += [
            f"vertical: AC156, S_DS {s_ds_g:g} g: {_plateaus(upward)}",
            f"vertical tail: {tail.sentence}",
        ]
        facts |= {"vertical_source": "AC156", "s_ds_g": s_ds_g, "tail": tail.value}
    horizontal = (table.freq_hz, table.horizontal_g)
    _check_level("horizontal", horizontal)
    _check_level("vertical", vertical)
    return SuiteTargets(horizontal=horizontal, vertical=vertical, lines=tuple(lines), facts=facts)


def _s_ds_problems(s_ds_g: float) -> list[str]:
    if _MIN_S_DS_G <= s_ds_g <= _MAX_S_DS_G:
        return []
    return [f"S_DS is {s_ds_g:g} g; enter {_MIN_S_DS_G:g} to {_MAX_S_DS_G:g} g"]


def _check_level(name: str, target: Target) -> None:
    """Refuse a target whose motions would be lost in the rounding of their files."""
    peak_g = float(max(target[1]))
    if peak_g < _MIN_PEAK_G:
        raise InputError(
            f"the {name} target reaches {peak_g:.3g} g; enter one of {_MIN_PEAK_G:g} g or more:"
            " records are written to 0.00001 g"
        )


def _plateaus(upward: RequiredSpectrum) -> str:
    return f"{upward.sa_g[1]:.4g} and {upward.sa_g[3]:.4g} g"


_CODE_OF = {name: code for code, name in CODES.items()}


def site_targets(sheet: Sheet) -> tuple[SuiteTargets, list[str]]:
    """Return the AC156 spectra of the site of a workbook, and what of them is from which cells.

    Raises `InputError` with the cells of each value that the workbook does not give, or is out of
    range.
    """
    site, target = ([*sheet.inputs[key], {}][0] for key in ("site", "target"))
    parameters = site_parameters(site)
    z_m, h_m = site.get("roof_height_m"), site.get("structure_height_m")
    stated = [(name,) for name in ("s_ds_g", "s_ms_g") if site.get(name) is not None]
    targets = (
        ("s_ds_g", "S_DS", parameters and parameters.s_ds, [*stated, ("s_s_g", "f_a")][0]),
        ("z_over_h", "z/h", None if z_m is None or h_m is None else z_m / h_m,
         ("roof_height_m", "structure_height_m")),
        ("code", "code", _CODE_OF.get(site.get("rule_set", "")), ("rule_set",)),
        ("edition", "edition", site.get("edition_name") or "", ("edition_name",)),
        ("tail", "tail", target.get("tail"), ("tail",)),
    )  # fmt: skip
    lines, problems = [], []
    for name, label, value, fields in targets:
        key = "target" if name == "tail" else "site"
        cells = " and ".join(sheet.where(Place(key, 0, field)) for field in fields)
        if value is None:
            problems.append(f"{cells}: {label} is missing or cannot be read; fill it in")
        # An edition may be left blank: it is that of the rule set.
        elif value != "":
            number = f"{value:.4g}" if isinstance(value, float) else value
            lines.append(f"{label} {number}{' g' if label == 'S_DS' else ''} from {cells}")
    if sheet.inputs["spectrum"]:
        cells = sheet.where(Place("spectrum"))
        problems.append(
            f"{cells}: the workbook has its own target spectrum instead of AC156; add --target"
            " to the command"
            " motion suite, with that spectrum as CSV"
        )
    if problems:
        raise InputError(problems)
    arguments: dict[str, Any] = {name: value for name, _, value, _ in targets}
    return ac156_targets(**arguments), lines
