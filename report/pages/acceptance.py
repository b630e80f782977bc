"""The limits on the motions, their strong motion and correlations, and the events of records.

Formats finished results: `solver.records.acceptance` has the limits. Read `acceptance_table`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from markupsafe import Markup

from report.assessment.spectra import LEAST_MEAN, Spectra
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.pages.parts import OK
from report.sheet.schema import MotionInput
from report.typeset.equations import symbol
from report.words.units import number
from solver.records.acceptance import Acceptance, MotionStrength
from solver.records.acceptance_row import AcceptanceRow, Consequence
from solver.records.spectrum_acceptance import N_AC156, N_SETS, N_SLIDING, POINTS_HZ

_COMPONENTS = ("x", "y", "z")
_PAIRS = ("x-y", "x-z", "y-z")
_PLACES = {"count": 0, "s": 1, "": 2}


def acceptance_table(acceptance: Acceptance, spectra: Sequence[Spectra] = ()) -> Table:
    """Return every limit on the motions: found, limit, where, OK or what follows.

    Parameters
    ----------
    spectra : sequence of Spectra
        Those that the package shows: at more periods than the limits are checked at.
    """
    return Table(
        caption="Limits on the motions for analysis, at the roof as run",
        columns=(
            TableColumn(head="Limit", align="left", share=4.75),
            TableColumn(head="Found", share=0.7),
            TableColumn(head="Limit value", share=0.95),
            TableColumn(head="Worst", align="left", share=1.5),
            TableColumn(head="Result", align="left", share=1.05),
        ),
        rows=tuple(_acceptance_row(row) for row in acceptance.rows),
        notes=tuple(_notes(acceptance, spectra)),
        kind="compact",
    )


def _acceptance_row(row: AcceptanceRow) -> TableRow:
    sign, unit = "≥" if row.is_at_least else "≤", " s" if row.unit == "s" else ""
    return TableRow(
        cells=(
            f"{row.title} *" if row.is_ours else row.title,
            f"{_found(row)}{unit}",
            f"{sign} {number(row.limit, _PLACES[row.unit])}{unit}",
            row.worst or "—",
            _result(row),
        )
    )


def _found(row: AcceptanceRow) -> str:
    """Return the value found, with decimals enough that a miss never rounds onto its limit."""
    least = _PLACES[row.unit]
    apart = (k for k in range(least, 9) if round(row.found, k) != round(row.limit, k))
    return number(row.found, least if row.satisfied else next(apart, 9))


def _result(row: AcceptanceRow) -> Markup:
    if row.satisfied:
        return Markup('<b class="ok">{}</b>').format(OK)
    return Markup('<b class="ng">{}</b>').format(row.consequence.value)


def _notes(acceptance: Acceptance, spectra: Sequence[Spectra]) -> Sequence[str]:
    rows, notes = acceptance.rows, []
    if any(row.is_ours for row in rows):
        notes.append(
            "* Limit of this program, in no code: sliding is driven by periods longer than 0.77 s, "
            "which the acceptance of AC156 from 1.3 Hz does not cover."
        )
    if any("target" in row.title for row in rows):
        notes.append(
            f"Spectra, 5 % damping, are compared at {len(POINTS_HZ)} points at most 1/24 octave "
            f"apart: {N_SLIDING} from 0.1 to 1.3 Hz and {N_AC156} from there to 33.3 Hz, with 1.3 "
            f"Hz in both. Points 1/6 octave apart are every {N_SETS}th of these: of the {N_SETS} "
            "ways to begin, the worst is shown." + _between(acceptance, spectra)
        )
    else:
        notes.append("Spectra are not compared: no target is given.")
    if any(row.consequence is Consequence.CONDITION for row in rows):
        notes.append(
            "A motion whose files do not state that it was generated, or that was cut or carried "
            "through the building, counts as a record: strong motion is its D5-95, and correlation "
            "has no limit."
        )
    return notes


def _between(acceptance: Acceptance, spectra: Sequence[Spectra]) -> str:
    """Say how low the spectra shown fall, where that is lower than at the points of the limits."""
    at_points = [row.found for row in acceptance.rows if row.title.startswith("Spectrum / target")]
    shown = [(*part.lowest, part.title) for part in spectra if not part.is_ground]
    ratio, motion, period_s, component = min(shown, default=(math.inf, "", 0.0, ""))
    if not ratio < min([*at_points, LEAST_MEAN]):
        return ""
    return (
        " Between them, where no limit is compared, a spectrum may be lower: the smallest ratio of "
        f"those shown below is {number(ratio, 2)} ({motion}, {component.lower()}, at "
        f"{frequency(period_s)})."
    )


def frequency(period_s: float) -> str:
    """Return the frequency of a period, which names points that a rounded period does not."""
    return f"{1.0 / period_s:.3g} Hz"


def strength_table(motions: Sequence[MotionStrength]) -> Table:
    """Return Arias intensity, significant duration and correlations of each motion."""
    return Table(
        caption="Strong motion and correlation of the motions as run",
        columns=(
            TableColumn(head="Motion", align="left", share=1.1),
            *(TableColumn(head="Arias intensity, m/s", unit=name) for name in _COMPONENTS),
            *(TableColumn(head="D5-95, s", unit=name) for name in _COMPONENTS),
            *(TableColumn(head="Correlation", unit=pair) for pair in _PAIRS),
            TableColumn(head="Hold", unit="s", share=0.9),
        ),
        rows=tuple(map(_strength_row, motions)),
        notes=(
            "x record, y transverse, z vertical; hold: hold of the envelope that the files state.",
        ),
        kind="compact",
    )


def _strength_row(motion: MotionStrength) -> TableRow:
    measured = [motion.strengths.get(name) for name in _COMPONENTS]
    correlations = [motion.correlations.get(pair) for pair in _PAIRS]
    return TableRow(
        cells=(
            motion.id,
            *("none" if m is None else number(m.arias_mps, 2) for m in measured),
            *("none" if m is None else number(m.d5_95_s, 1) for m in measured),
            *("—" if value is None else number(value, 2) for value in correlations),
            number(motion.hold_s, 1) if motion.is_generated else "record",
        )
    )


def event_table(rows: Sequence[MotionInput]) -> Sequence[Table]:
    """Return the events of the motions, where the workbook gives any."""
    given = [
        row
        for row in rows
        if row.event or any(v is not None for v in (row.magnitude, row.distance_km, row.v_s30_mps))
    ]
    if not given:
        return ()
    return (
        Table(
            caption="Events of the records",
            columns=(
                TableColumn(head="Motion", align="left", share=1.0),
                TableColumn(head="Event", align="left", share=3.0),
                TableColumn(head="M"),
                TableColumn(head="R", unit="km"),
                TableColumn(head=symbol("V_s30"), unit="m/s"),
            ),
            rows=tuple(_event_row(row) for row in given),
            kind="compact",
        ),
    )


def _event_row(row: MotionInput) -> TableRow:
    values = (row.magnitude, row.distance_km, row.v_s30_mps)
    shown = ("not given" if value is None else f"{value:g}" for value in values)
    return TableRow(cells=(row.id, row.event or "not given", *shown))
