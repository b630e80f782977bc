"""The sliders and choices of a workbook, and the meaning of their values.

Only those that the cells of the workbook can express are offered. Read `controls`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from report.assessment.design.friction import mu_words
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Polarity, RuleSetName, UnitsFirst
from report.project.model.input_rows import Place
from report.project.read.what_if import retyped
from report.project.read.workbook_data import Sheet
from report.text.grouping import ids_by
from report.text.names import ranged
from report.text.typed_letters import cut
from report.text.units import Quantity, no_more, number, pair
from report.web.values import MUS, UNITS_FIRST, Values, typed
from solver.errors import InputError
from solver.friction_tests import MOST_MU
from solver.model import INCH_M, Motion

if TYPE_CHECKING:
    from report.web.open_project import OpenProject


_LEAST, _MOST = 0.2, 2.0
# Least, greatest and step in inches, and in millimeters.
_TRIM = {True: (-24.0, 24.0, 1.0), False: (-600.0, 600.0, 25.0)}
_TURN_DEG = 5.0
_ENDS = {"least": "Smallest", "greatest": "Largest"}


def controls(opened: OpenProject) -> Mapping[str, Any]:
    """Return the sliders and choices of a workbook for the page."""
    sliders = [item for item in _sliders(opened.sheet) if _is_offered(opened, item)]
    return {
        "sliders": [_stopped(opened, item) for item in sliders],
        "choices": list(_choices(opened)),
    }


def shown(opened: OpenProject) -> Mapping[str, str]:
    """Return what the sliders come to in the workbook, as texts beside them."""
    data = opened.sheet.project
    return {
        "friction": _grouped(data.arrays, lambda array: mu_words(array.friction)),
        "slope": _grouped(data.arrays, lambda a: f"{number(math.degrees(a.slope_rad), 2)}°"),
        "intensity": _factors(opened.shaking.motions),
        "s_ds": f"{number(data.site.s_ds, 3)} g",
        "clearance": _clearances(data),
    }


def check(opened: OpenProject, values: Values) -> None:
    """Reject values that no slider or choice of the workbook has, all in one input error."""
    known = opened.controls
    sliders = {item["id"]: item for item in known["sliders"]}
    choices = {item["id"]: item for item in known["choices"]}
    wrong: list[str] = []
    for name, value in values.items():
        control, has_target, target = name.partition("@")
        slider = sliders.get(control)
        if slider and (not has_target or target in slider["real"]["targets"]):
            span = slider["least"], slider["greatest"]
            if isinstance(value, str) or not span[0] <= value <= span[1]:
                place = f" of {target}" * bool(has_target)
                accepted = f"enter a number from {span[0]:g} to {span[1]:g}"
                why = "".join(f" ({text})" for text in slider["stops"].values())
                wrong.append(f"{slider['label']}{place} is {cut(str(value))}; {accepted}{why}")
        elif name not in choices:
            wrong.append(f"{cut(name)}: the workbook has no such slider; leave it out")
        elif value not in (options := [option["value"] for option in choices[name]["options"]]):
            accepted = f"choose {' or '.join(options)}"
            wrong.append(f"{choices[name]['label']} is {cut(str(value))}; {accepted}")
    if wrong:
        raise InputError(wrong)


def _sliders(sheet: Sheet) -> Iterator[dict[str, Any]]:
    arrays, us_first = sheet.project.arrays, sheet.project.us_first
    mus = [row[name] for row in sheet.inputs["arrays"] for name in MUS if row.get(name)]
    # The cell of a coefficient accepts no more than MOST_MU.
    most_mu = math.floor(100.0 * min(_MOST, MOST_MU / max(mus, default=1.0))) / 100.0
    s_ds = _real("S_DS", "g", 3, {}) | {"all": sheet.project.site.s_ds}
    yield _slider("friction", "Friction", "×", (0.5, most_mu, 0.01),
                  "Factor on every friction coefficient. Velocity-dependent friction is scaled as "
                  "a whole.",
                  _real("μ", "", 3, {array.id: array.mu for array in arrays}))  # fmt: skip
    yield _slider("slope", "Slope", "°", (-_TURN_DEG, _TURN_DEG, 0.1),
                  "Added to the slope of every array; no slope is less than 0.",
                  _real("Slope", "°", 2, {a.id: math.degrees(a.slope_rad) for a in arrays})
                  )  # fmt: skip
    has_motions = bool(sheet.project.motions)
    if has_motions:
        yield _slider("intensity", "Intensity", "×", (_LEAST, _MOST, 0.02),
                      "Factor on all motions, and on S_DS where both change together.",
                      s_ds | {"with_choice": {"together": "yes"}})  # fmt: skip
    apart = {"together": "no"} if has_motions else {}
    yield _slider("s_ds", "S_DS", "×", (_LEAST, _MOST, 0.02),
                  "Factor on S_DS alone.", s_ds) | {"with_choice": apart}  # fmt: skip
    unit, size = ("in", INCH_M) if us_first else ("mm", 1e-3)
    gaps = {str(n): row.provided_m / size for n, row in enumerate(sheet.project.clearances, 1)}
    beside = {"all": None, "is_beside": True, "with_choice": {"clearance": 0.0}}
    yield _slider("clearance", "Clearance", unit, _TRIM[us_first],
                  "Trim arrays: moves every side of every rectangular array inward by this amount. "
                  "Clearances are updated from the plan.",
                  _real("Provided", unit, 1 if us_first else 0, gaps) | beside)  # fmt: skip


def _real(symbol: str, unit: str, digits: int, targets: Mapping[str, float]) -> dict[str, Any]:
    """Return the quantity that a slider changes, as the workbook has it of each target."""
    values = {*targets.values()}
    return {
        "symbol": symbol, "unit": unit, "digits": digits, "targets": targets,
        "all": values.pop() if len(values) == 1 else None,
        "is_beside": False,  # whether the value of a target is beside that of all
        "with_choice": {},
    }  # fmt: skip


def _slider(
    name: str,
    label: str,
    unit: str,
    span: tuple[float, float, float],
    words: str,
    real: Mapping[str, Any],
) -> dict[str, Any]:
    least, greatest, step = span
    return {
        "id": name, "label": label, "unit": unit, "least": least, "greatest": greatest,
        "step": step, "typed": 1.0 if unit == "×" else 0.0, "help": words, "stops": {},
        "real": real,
    }  # fmt: skip


def _stopped(opened: OpenProject, slider: dict[str, Any]) -> dict[str, Any]:
    """Return a slider that stops where the workbook could have no value beyond, and says why."""
    for end in ("least", "greatest"):
        away = round((slider[end] - slider["typed"]) / slider["step"])
        if not _problem_at(opened, slider, away):
            continue
        # The last step without a problem, and the first with one.
        good, bad = 0, away
        while abs(bad - good) > 1:
            middle = (good + bad) // 2
            good, bad = (good, middle) if _problem_at(opened, slider, middle) else (middle, bad)
        why = f"{_ENDS[end]} permitted value: {_problem_at(opened, slider, bad)}"
        slider = slider | {
            end: _value_at(slider, good),
            "stops": slider["stops"] | {end: why},
            "help": f"{slider['help']} {why}.",
        }
    return slider


def _problem_at(opened: OpenProject, slider: Mapping[str, Any], steps: int) -> str:
    values = {slider["id"]: _value_at(slider, steps)}
    return _why_not(opened, values | slider.get("with_choice", {}))


def _value_at(slider: Mapping[str, Any], steps: int) -> float:
    return float(round(slider["typed"] + steps * slider["step"], 6))


def _is_offered(opened: OpenProject, slider: Mapping[str, Any]) -> bool:
    """Whether the workbook has every cell that a slider changes."""
    values = {slider["id"]: _value_at(slider, 1)} | slider.get("with_choice", {})
    return opened.sheet.addresses.keys() >= typed(opened.sheet, opened.scales, values).keys()


def _choices(opened: OpenProject) -> Iterator[Mapping[str, Any]]:
    sheet = opened.sheet
    # Motions may differ: then the workbook has no single choice, and a blank one stands for it.
    first, *others = dict.fromkeys(row["polarity"] for row in sheet.inputs["motions"]) or ("",)
    if first:
        yield _choice("together", "Scale S_DS with the motions", "yes", {"yes": "Yes", "no": "No"},
                      "Whether the intensity slider also scales S_DS.")  # fmt: skip
    places = (Place("motions", i, "polarity") for i in range(len(opened.by_motion)))
    if first and all(place in sheet.addresses for place in places):
        yield _choice("polarity", "Polarity", "" if others else first,
                      ({"": "as in the workbook"} if others else {})
                      | {p.value: p.value for p in Polarity},
                      "Polarities in which each horizontal component is run.")  # fmt: skip
    rules = _choice("rule_set", "Rule set", sheet.project.site.rule_set.value,
                    {rule.value: rule.value for rule in RuleSetName},
                    "The provisions to compare with.")  # fmt: skip
    for option in rules["options"]:
        option["why_not"] = _why_not(opened, {"rule_set": option["value"]})
    yield rules
    if UNITS_FIRST in sheet.addresses:
        yield _choice("units", "Primary units", sheet.inputs["project"][0]["units_first"],
                      {UnitsFirst.US.value: "in", UnitsFirst.SI.value: "mm"},
                      "Of the page, the package and the workbook.")  # fmt: skip


def _choice(
    name: str, label: str, start: str, options: Mapping[str, str], words: str
) -> dict[str, Any]:
    return {
        "id": name, "label": label, "typed": start, "help": words,
        "options": [{"value": v, "label": text, "why_not": ""} for v, text in options.items()],
    }  # fmt: skip


def _why_not(opened: OpenProject, values: Values) -> str:
    """Return the first problem that the workbook would have with values; empty for none."""
    changed = retyped(opened.sheet, typed(opened.sheet, opened.scales, values))
    return next((str(problem) for _, problem in changed.problems), "")


def _grouped(arrays: Sequence[Array], text_of: Callable[[Array], str]) -> str:
    """Return a text for the arrays that share it, such as `0.45 (A1, A2); 0.50 (A3)`."""
    groups = ids_by(arrays, text_of)
    if len(groups) == 1:
        return next(iter(groups))
    return "; ".join(f"{text} ({ranged(ids)})" for text, ids in groups.items())


def _factors(motions: Sequence[Motion]) -> str:
    """Return the factors on the records of the motions."""
    if not motions:
        return ""
    factors = [motion.scale for motion in motions]
    lowest, highest = (number(value, 3) for value in (min(factors), max(factors)))
    return f"× {lowest}" if lowest == highest else f"× {lowest} to {highest}"


def _clearances(data: ProjectInput) -> str:
    """Return the smallest clearance."""
    if not data.clearances:
        return ""
    row = min(data.clearances, key=lambda row: row.provided_m)
    text = pair(row.provided_m, Quantity.SIZE, data.us_first, no_more)
    return f"smallest {text}, {row.array} to {row.object}"
