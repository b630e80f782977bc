"""The lines that `roofslip motion suite` prints: targets, components, fit, acceptance."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from report.suite.suite_components import (
    MAX_MEAN_DIFFERENCE,
    MAX_RATIO,
    MIN_RATIO,
    SuiteComponent,
    suite_acceptance,
    suite_components,
)
from report.suite.targets import SuiteTargets
from report.text.aligned import aligned
from report.text.amounts import limit_texts
from report.text.units import G_MPS2
from solver.rules.limit import Limit
from solver.synthesis.matching import BAND_HZ
from solver.synthesis.suite import SuiteMotion

# Heading of a column, its side, and its text for a component.
_Text = Callable[[SuiteComponent], str]
_COLUMNS: tuple[tuple[str, str, _Text], ...] = (
    ("motion", "<", lambda row: row.motion if row.component == "x" else ""),
    ("", "<", lambda row: row.component),
    ("min", ">", lambda row: f"{row.fit.minimum:.3f}"),
    ("max", ">", lambda row: f"{row.fit.maximum:.3f}"),
    ("mean", ">", lambda row: f"{row.fit.mean:.3f}"),
    ("PGA [g]", ">", lambda row: f"{row.measures.pga_mps2 / G_MPS2:.3f}"),
    ("PGV [cm/s]", ">", lambda row: f"{100.0 * row.measures.pgv_mps:.1f}"),
    ("PGD [cm]", ">", lambda row: f"{100.0 * row.measures.pgd_m:.1f}"),
    ("D5-95 [s]", ">", lambda row: f"{row.measures.d5_95_s:.1f}"),
    ("final v [cm/s]", ">", lambda row: f"{100.0 * row.facts['final_velocity_mps']:.3g}"),
    ("final d [cm]", ">", lambda row: f"{100.0 * row.facts['final_displacement_m']:.3g}"),
    ("correlation", "<", lambda row: f"{row.pair} {row.correlation:+.2f}"),
    ("seed", "<", lambda row: row.seed),
)


def suite_table(suite: Sequence[SuiteMotion], targets: SuiteTargets) -> list[str]:
    """Return the lines to print: targets, components, their fit, and the acceptance."""
    components = suite_components(suite, targets)
    headings, sides, texts = zip(*_COLUMNS, strict=True)
    rows = [headings]
    for component in components:
        rows.append(tuple(text(component) for text in texts))
    lowest_hz = sorted({component.fit.freq_hz[0] for component in components})
    lowest = " and ".join(f"{hz:.3g}" for hz in lowest_hz)
    n_within = sum(component.is_within_limits for component in components)
    return [
        *targets.lines,
        *aligned(rows, sides),
        f"{n_within} of {len(components)} components have spectra of {MIN_RATIO:.2f} to "
        f"{MAX_RATIO:.2f} times the target and a mean ratio within {100 * MAX_MEAN_DIFFERENCE:g}% "
        f"of 1 (1/12 octave, from {lowest} Hz to {BAND_HZ[1]:g} Hz, 5% damping)",
        *acceptance_lines(suite_acceptance(suite, targets).rows),
    ]


def acceptance_lines(rows: Sequence[Limit]) -> list[str]:
    """Return a line for each row: OK or what follows, title, value found, limit, where."""
    lines = []
    for row in rows:
        value, limit = limit_texts(row, us_first=True)  # none is a length
        where = f" ({row.worst})" if row.worst else ""
        ours = "; not a code requirement, limit set by this program"
        lines.append(
            f"{'OK' if row.ok else row.consequence.value}: {row.title}: "
            f"{value}, {'at least' if row.is_at_least else 'at most'} {limit}{where}"
            f"{ours if row.is_program_limit else ''}"
        )
    return lines
