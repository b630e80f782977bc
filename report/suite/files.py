"""Output of `roofslip motion suite`: every file as finished bytes, and the printed table.

Prints nothing and writes no file; `solver.synthesis` generates the motions. Read
`suite_files` first.

The acceptance of a generated suite: its rows as text and as data.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from report.assessment.support.spectra import Spectra
from report.figures.base import png_bytes
from report.figures.spectra import spectra
from report.motions.history import TargetSpectrum
from report.motions.measured import facts, without_noise
from report.provenance.release import version
from report.suite.inputs import Seeds, SuiteTargets
from report.text.amounts import limit_texts
from report.text.formats import aligned
from report.text.units import G_MPS2
from solver.model import Floats
from solver.records.acceptance import Acceptance, acceptance
from solver.records.measures import Measures, measures
from solver.records.record import Record, record_csv
from solver.rules.hazard import Target, target_sa_g
from solver.rules.limit import Limit
from solver.sliding.checked import motion
from solver.synthesis.matching import BAND_HZ, SpectrumFit, spectrum_fit
from solver.synthesis.suite import SuiteMotion, make_suite


def suite_acceptance(suite: Sequence[SuiteMotion], targets: SuiteTargets) -> Acceptance:
    """Compare a suite with its targets as the motions of an analysis; motions count from 1."""
    return acceptance(
        [motion(m.x, m.y, m.z, id=f"motion-{k:02d}") for k, m in enumerate(suite, start=1)],
        [m.hold_s for m in suite],
        partial(target_sa_g, targets.horizontal),
        partial(target_sa_g, targets.vertical),
    )


def acceptance_lines(rows: Sequence[Limit]) -> list[str]:
    """Return a line for each row: OK or what follows, title, value found, limit, where."""
    lines = []
    for row in rows:
        found, limit = limit_texts(row, us_first=True)  # none is a length
        where = f" ({row.worst})" if row.worst else ""
        ours = "; not a code requirement, limit set by this program"
        lines.append(
            f"{'OK' if row.ok else row.consequence.value}: {row.title}: "
            f"{found}, {'at least' if row.is_at_least else 'at most'} {limit}{where}"
            f"{ours if row.is_program_limit else ''}"
        )
    return lines


def acceptance_facts(rows: Sequence[Limit]) -> list[dict[str, Any]]:
    """Return the rows for suite.json."""
    return [
        {
            "title": row.title,
            "found": row.found,
            "limit": row.limit,
            "unit": row.measure.value,
            "is_at_least": row.is_at_least,
            "satisfied": row.ok,
            "worst": row.worst,
            "is_ours": row.is_program_limit,
            "consequence": row.consequence.value,
        }
        for row in rows
    ]


# Limits on every component's ratios to its target, at 1/12 octave. AC156 allows 90 % at 1/6-octave
# points; here at 1/12, with a largest ratio as well.
LEAST, GREATEST, MEAN_OFF = 0.90, 1.30, 0.07

# Of three components and their three pairs, one each stands in a row of the table.
_PAIRS = ("x-y", "x-z", "y-z")
_DRAWN_HZ: Floats = np.geomspace(0.1, 50.0, 180)


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteComponent:
    """One component of a generated motion, as reported."""

    motion: str
    component: str
    grew_from: str
    record: Record
    fit: SpectrumFit
    measures: Measures
    # Of two components of its motion: their names, and the coefficient.
    pair: str
    correlation: float

    @property
    def is_within_limits(self) -> bool:
        """Whether the ratios to the target satisfy the limits."""
        fit = self.fit
        # A mean above 1 pays with displacements that the target does not ask for.
        in_range = fit.minimum >= LEAST and fit.maximum <= GREATEST
        return in_range and abs(fit.mean - 1.0) <= MEAN_OFF

    @property
    def facts(self) -> Mapping[str, float]:
        """Its measures, in SI except g; 0 at the end of the record for rounding error."""
        return without_noise(facts(self.measures))


def components(suite: Sequence[SuiteMotion], targets: SuiteTargets) -> tuple[SuiteComponent, ...]:
    """Return every component of a suite with its fit and measures."""
    return tuple(
        SuiteComponent(
            motion=f"motion-{k:02d}",
            component=name,
            grew_from=grew_from,
            record=record,
            fit=spectrum_fit(record, targets.of(name)),
            measures=measures(record),
            pair=pair,
            correlation=correlation,
        )
        for k, motion in enumerate(suite, start=1)
        for name, record, grew_from, pair, correlation in zip(
            "xyz", motion.components, motion.seeds, _PAIRS, motion.correlations, strict=True
        )
    )


def generate(
    targets: SuiteTargets, count: int, seed: int, seeds: Seeds, progress: Callable[[str], None]
) -> tuple[Sequence[SuiteMotion], dict[str, bytes]]:
    """Return a suite and its files; `progress` is told of each motion and of the chart."""
    # Each motion has a seed of its own: more of them leave the first ones as they were.
    suite = make_suite(
        targets.horizontal,
        targets.vertical,
        count=count,
        seed=seed,
        records=seeds.groups,
        progress=progress,
    )
    progress("plotting the spectra")
    return suite, suite_files(suite, targets, seed=seed, records=seeds.sha256)


def suite_files(
    suite: Sequence[SuiteMotion], targets: SuiteTargets, *, seed: int, records: Mapping[str, str]
) -> dict[str, bytes]:
    """Return every file of a suite by name: the records, suite.json and suite.png.

    `records` are the seed files with their SHA-256.
    """
    parts = components(suite, targets)
    # In memory first: the hashes in suite.json are those of what is written.
    files = {
        f"{record.name}.csv": record_csv(record, hold_s=motion.hold_s).encode()
        for motion in suite
        for record in motion.components
    }
    document = _document(suite, targets, parts, seed, records, files)
    files["suite.json"] = json.dumps(document, indent=1, ensure_ascii=False).encode() + b"\n"
    files["suite.png"] = spectra([_spectra(suite, targets, name) for name in "xyz"], png_bytes)
    return files


def _document(
    suite: Sequence[SuiteMotion],
    targets: SuiteTargets,
    parts: Sequence[SuiteComponent],
    seed: int,
    records: Mapping[str, str],
    files: Mapping[str, bytes],
) -> dict[str, Any]:
    record, hold_s = suite[0].x, suite[0].hold_s
    duration_s = (len(record.a_mps2) - 1) * record.dt_s
    return {
        "roofslip_version": version(),
        "seed": seed,
        "source": targets.source(seed),
        "seed_records": [{"file": name, "sha256": digest} for name, digest in records.items()],
        "dt_s": record.dt_s,
        "duration_s": duration_s,
        # AC156: rise, strong motion, decay; both ramps are equal.
        "envelope_s": [(duration_s - hold_s) / 2.0, hold_s, (duration_s - hold_s) / 2.0],
        "damping": 0.05,
        "target": {
            **targets.facts,
            "horizontal": _corners(targets.horizontal),
            "vertical": _corners(targets.vertical),
        },
        "limits": {
            "least_ratio": LEAST,
            "greatest_ratio": GREATEST,
            "mean_ratio_off": MEAN_OFF,
            "to_hz": BAND_HZ[1],
            "points_per_octave": 12,
        },
        "acceptance": acceptance_facts(suite_acceptance(suite, targets).rows),
        "motions": [
            # Three components for each motion, in the order of `components`.
            _motion(motion, parts[3 * k : 3 * k + 3], files)
            for k, motion in enumerate(suite)
        ],
    }


def _corners(target: Target) -> dict[str, list[float]]:
    freq_hz, sa_g = target
    return {"freq_hz": freq_hz.tolist(), "sa_g": sa_g.tolist()}


def _motion(
    motion: SuiteMotion, parts: Sequence[SuiteComponent], files: Mapping[str, bytes]
) -> dict[str, Any]:
    xy, xz, yz = motion.correlations
    return {
        "id": parts[0].motion,
        "correlation_xy": xy,
        "correlation_xz": xz,
        "correlation_yz": yz,
        "components": [_component(part, files) for part in parts],
    }


def _component(part: SuiteComponent, files: Mapping[str, bytes]) -> dict[str, Any]:
    name = f"{part.record.name}.csv"
    return {
        "component": part.component,
        "file": name,
        "sha256": hashlib.sha256(files[name]).hexdigest(),
        "grew_from": part.grew_from,
        "npts": len(part.record.a_mps2),
        "from_hz": float(part.fit.freq_hz[0]),
        "least_ratio": part.fit.minimum,
        "greatest_ratio": part.fit.maximum,
        "mean_ratio": part.fit.mean,
        **part.facts,
    }


def _spectra(suite: Sequence[SuiteMotion], targets: SuiteTargets, name: str) -> Spectra:
    target, kind = targets.of(name), "vertical" if name == "z" else "horizontal"
    records = [motion.components["xyz".index(name)] for motion in suite]
    return Spectra(
        ids=tuple(record.name for record in records),
        # Periods increase as frequencies fall.
        periods_s=1.0 / _DRAWN_HZ[::-1],
        sa_g=np.array([spectrum_fit(r, target, _DRAWN_HZ[::-1]).achieved_g for r in records]),
        target=TargetSpectrum(
            name="5 % damping", at=partial(target_sa_g, target), from_s=0.0, to_s=math.inf
        ),
        title=f"{name}, {kind}",
        is_ground=False,
    )


# Heading of a column, its side, and its text for a component.
_Text = Callable[[SuiteComponent], str]
_COLUMNS: tuple[tuple[str, str, _Text], ...] = (
    ("motion", "<", lambda part: part.motion if part.component == "x" else ""),
    ("", "<", lambda part: part.component),
    ("min", ">", lambda part: f"{part.fit.minimum:.3f}"),
    ("max", ">", lambda part: f"{part.fit.maximum:.3f}"),
    ("mean", ">", lambda part: f"{part.fit.mean:.3f}"),
    ("PGA [g]", ">", lambda part: f"{part.measures.pga_mps2 / G_MPS2:.3f}"),
    ("PGV [cm/s]", ">", lambda part: f"{100.0 * part.measures.pgv_mps:.1f}"),
    ("PGD [cm]", ">", lambda part: f"{100.0 * part.measures.pgd_m:.1f}"),
    ("D5-95 [s]", ">", lambda part: f"{part.measures.d5_95_s:.1f}"),
    ("final v [cm/s]", ">", lambda part: f"{100.0 * part.facts['final_velocity_mps']:.3g}"),
    ("final d [cm]", ">", lambda part: f"{100.0 * part.facts['final_displacement_m']:.3g}"),
    ("correlation", "<", lambda part: f"{part.pair} {part.correlation:+.2f}"),
    ("seed", "<", lambda part: part.grew_from),
)


def suite_table(suite: Sequence[SuiteMotion], targets: SuiteTargets) -> list[str]:
    """Return the lines to print: targets, components, their fit, and the acceptance."""
    parts = components(suite, targets)
    headings, sides, texts = zip(*_COLUMNS, strict=True)
    rows = [headings, *(tuple(text(part) for text in texts) for part in parts)]
    lowest = " and ".join(f"{hz:.3g}" for hz in sorted({part.fit.freq_hz[0] for part in parts}))
    n_within = sum(part.is_within_limits for part in parts)
    return [
        *targets.lines,
        *aligned(rows, sides),
        f"{n_within} of {len(parts)} components have spectra of {LEAST:.2f} to {GREATEST:.2f} "
        f"times the target and a mean ratio within {100 * MEAN_OFF:g} % of 1 (1/12 octave, "
        f"from {lowest} Hz to {BAND_HZ[1]:g} Hz, 5 % damping)",
        *acceptance_lines(suite_acceptance(suite, targets).rows),
    ]
