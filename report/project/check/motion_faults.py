"""Faults of motions, building and target spectrum.

Works on values as read, and reads no record.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from report.project.model.choices import RecordedAt, Scaling
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs, Place, Where
from report.project.model.site_input import site_parameters
from report.text.units import digits_up
from solver.building.structure import MOST_STORIES

# Fields of a motion that name a record, each with the name of its component.
LABELS = {"record": "horizontal", "transverse": "transverse", "vertical": "vertical"}

# The same by component.
FIELDS = {label: field for field, label in LABELS.items()}

# Begins the source of a motion that was generated.
GENERATED = "Generated, seed "

# Duration [s] below which a motion is refused: no earthquake record is as short.
SHORTEST_S = 1.0


def motion_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield all inconsistencies in the motions."""
    for index, row in enumerate(inputs["motions"]):
        yield from _same_component(index, row)
        yield from _scale_value(index, row)
        yield from _processing(index, row)
    yield from _building(inputs, where)
    yield from _own_spectrum(inputs, where)
    yield from _scaled_to_target(inputs, where)


def _same_component(index: int, row: InputRow) -> Iterator[Finding]:
    seen: dict[str, str] = {}
    for field, label in LABELS.items():
        if not row.get(field):
            continue
        # Two components from one record move as one: their sum is a motion along the diagonal, 1.4
        # times as strong.
        first = seen.setdefault(" ".join(row[field].split()), label)
        if first != label:
            text = f"{label} record is '{row[field]}', the same as the {first} record"
            yield Finding.error(Place("motions", index, field), text, "use another record")


def _scale_value(index: int, row: InputRow) -> Iterator[Finding]:
    scaling, place = row.get("scaling"), Place("motions", index, "scale_value")
    value = row.get("scale_value")
    # A factor that is not applied: the engineer who typed 1.5 believes that the motion has it.
    if scaling in (Scaling.AS_RECORDED, Scaling.TARGET) and value not in (None, 1.0):
        text = f"factor or PPA is {value:g}, but scaling is '{scaling}'"
        yield Finding.error(place, text, "change the scaling or leave this blank")


def _processing(index: int, row: InputRow) -> Iterator[Finding]:
    start, end = row.get("from_s"), row.get("to_s")
    if end is not None and end <= (start or 0.0):
        remedy = f"enter {(start or 0.0) + SHORTEST_S:g} s or more"
        yield Finding.error(Place("motions", index, "to_s"), f"end time is {end:g} s", remedy)
    high, low = row.get("highpass_hz"), row.get("lowpass_hz")
    if high is not None and low is not None and low <= high:
        text = f"low-pass corner is {low:g} Hz"
        remedy = f"enter more than the high-pass corner, {high:g} Hz"
        yield Finding.error(Place("motions", index, "lowpass_hz"), text, remedy)


def _building(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for row in inputs["building"]:
        first, second = row.get("period_s"), row.get("period_2_s")
        # The first mode has the longest period.
        if second is not None and (first is None or second > first):
            longest = "period T1 as well" if first is None else f"at most period T1, {first:g} s"
            text, remedy = f"period T2 is {second:g} s", f"enter {longest}, or leave it blank"
            yield Finding.error(Place("building", 0, "period_2_s"), text, remedy)
    # Only a ground motion passes through the model of the building.
    grounds = (row.get("recorded_at") is RecordedAt.GROUND for row in inputs["motions"])
    for row in inputs["site"] if any(grounds) else ():
        count = row.get("stories", 1)
        if count > MOST_STORIES:
            text = (
                f"number of stories is {count}, more than the {MOST_STORIES} of the building model"
            )
            yield Finding.error(Place("site", 0, "stories"), text, "use roof motions")


def _own_spectrum(inputs: Inputs, where: Where) -> Iterator[Finding]:
    rows = inputs["spectrum"]
    if len(rows) == 1:
        yield Finding.error(Place("spectrum"), "one row is entered", "enter at least two, or none")
    periods = [(row["period_s"], index) for index, row in enumerate(rows) if "period_s" in row]
    for (before, first), (after, second) in pairwise(sorted(periods)):
        # The spectrum has no line between two points at one period.
        if after - before <= 1e-9 * after:
            address = where(Place("spectrum", first, "period_s"))
            text = f"period is {after:g} s, already entered at {address}"
            yield Finding.error(
                Place("spectrum", second, "period_s"), text, "enter each period once"
            )
    verticals = [row["vertical_g"] is None for row in rows if "vertical_g" in row]
    if any(verticals) and not all(verticals):
        index = next(i for i, row in enumerate(rows) if row.get("vertical_g", 0.0) is None)
        remedy = "enter it in every row, or in none"
        yield Finding.error(Place("spectrum", index, "vertical_g"), "vertical is missing", remedy)


def _scaled_to_target(inputs: Inputs, where: Where) -> Iterator[Finding]:
    row = inputs["target"][0] if inputs["target"] else {}
    start, end = row.get("from_s"), row.get("to_s")
    if start is None or end is None:
        return
    if end <= start:
        text = f"longest scaling period is {end:g} s"
        remedy = f"enter more than the shortest, {start:g} s"
        yield Finding.error(Place("target", 0, "to_s"), text, remedy)
        return
    scaled = [i for i, m in enumerate(inputs["motions"]) if m.get("scaling") is Scaling.TARGET]
    for index in scaled:
        corner = inputs["motions"][index].get("highpass_hz")
        # No factor brings back the periods that a high-pass has removed.
        if corner is not None and corner * end > 1.0 + 1e-9:
            text = (
                f"high-pass corner is {corner:g} Hz, a period of {1.0 / corner:.3g} s, but the"
                f" longest scaling period is {end:g} s"
            )
            yield Finding.error(Place("motions", index, "highpass_hz"), text, "reduce one of them")
    if scaled and inputs["spectrum"]:
        yield from _covered(inputs, start, end)
    ground = [i for i in scaled if inputs["motions"][i].get("recorded_at") is RecordedAt.GROUND]
    if not inputs["spectrum"]:
        yield from _design_spectrum(inputs, ground, where)


def _covered(inputs: Inputs, start_s: float, end_s: float) -> Iterator[Finding]:
    periods = [row["period_s"] for row in inputs["spectrum"] if "period_s" in row]
    if len(periods) < 2 or (min(periods) <= start_s and end_s <= max(periods)):
        return
    text = (
        f"periods range from {min(periods):g} to {max(periods):g} s, but motions are scaled over "
        f"{start_s:g} to {end_s:g} s"
    )
    yield Finding.error(Place("spectrum"), text, "add rows, or change the scaling periods")


def _design_spectrum(inputs: Inputs, ground: list[int], where: Where) -> Iterator[Finding]:
    """Yield missing inputs of the design spectrum if a motion is scaled to it, and a short T_L."""
    site = inputs["site"][0] if inputs["site"] else {}
    parameters = site_parameters(site)
    # NaN stands for what could not be read: it is neither missing nor too small.
    s_d1_g = math.nan if parameters is None else parameters.s_d1
    t_l_s = inputs["target"][0].get("t_l_s", math.nan)
    lacking = [name for name in ("s_1_g", "f_v") if site.get(name) is None]
    field = lacking[0] if len(lacking) == 1 else "s_d1_g"
    label = {"s_1_g": "S_1", "f_v": "F_v", "s_d1_g": "S_D1"}[field]
    for place, name, value in (
        (Place("site", 0, field), label, s_d1_g),
        (Place("target", 0, "t_l_s"), "long-period transition T_L", t_l_s),
    ):
        if ground and value is None:
            address = where(Place("motions", ground[0], "scaling"))
            remedy = f"{address} scales a ground motion to the design spectrum, which requires"
            remedy += " S_D1, or S_1 and F_v, and T_L"
            yield Finding.error(place, f"{name} is missing", remedy)
    t_s = None if parameters is None else parameters.t_s
    # The design spectrum falls as 1/T between T_S and T_L.
    if t_s is not None and t_l_s is not None and t_l_s <= t_s:
        text = f"long-period transition T_L is {t_l_s:g} s"
        remedy = f"enter more than T_S = S_D1/S_DS = {digits_up(t_s, 3)} s"
        yield Finding.error(Place("target", 0, "t_l_s"), text, remedy)
