"""The site of a workbook as the target of a suite."""

from __future__ import annotations

from typing import Any

from report.project.model.place import Place
from report.project.model.site import site_parameters
from report.project.read.workbook_data import Sheet
from report.suite.targets import CODES, SuiteTargets, ac156_targets
from solver.errors import InputError

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
            f"{cells}: a target spectrum is given, not that of AC156; add --target to the command"
            " motion suite, with that spectrum as CSV"
        )
    if problems:
        raise InputError(problems)
    arguments: dict[str, Any] = {name: value for name, _, value, _ in targets}
    return ac156_targets(**arguments), lines
