"""Every file of a suite as finished bytes: the records, suite.json and suite.png.

Writes no file; `solver.synthesis` generates the motions. Read `suite_files`.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from report.assessment.support.response_spectra import Spectra
from report.figures.base import png_bytes
from report.figures.spectrum_charts import spectra
from report.motions.history import TargetSpectrum
from report.provenance.release import version
from report.suite.seed_records import Seeds
from report.suite.suite_components import (
    MAX_MEAN_DIFFERENCE,
    MAX_RATIO,
    MIN_RATIO,
    SuiteComponent,
    suite_acceptance,
    suite_components,
)
from report.suite.targets import SuiteTargets
from report.text.units import spaced
from solver.errors import InputError
from solver.model import Floats
from solver.records.record import record_csv
from solver.rules.ac156 import Target, target_sa_g
from solver.rules.limit import Limit
from solver.synthesis.matching import BAND_HZ, spectrum_fit
from solver.synthesis.suite import SuiteMotion, make_suite

_DRAWN_HZ: Floats = np.geomspace(0.1, 50.0, 180)
_RECORD_NAME = re.compile(r"motion-\d{2,}-[xyz]\.csv")


def check_folder(folder: Path, count: int) -> None:
    """Refuse a folder in which motions of an earlier suite would remain beside the new ones.

    Raises `InputError` with their names.
    """
    names = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []
    names_of_suite: set[str] = set()
    for number in range(1, count + 1):
        names_of_suite |= {f"motion-{number:02d}-{axis}.csv" for axis in "xyz"}
    # Fewer motions than before: the last ones would pass for motions of this suite.
    remaining = [
        name for name in names if _RECORD_NAME.fullmatch(name) and name not in names_of_suite
    ]
    if remaining:
        raise InputError(
            f"{folder}: {remaining[0]} and {len(remaining) - 1} other files of an earlier suite "
            "would remain; delete them, or choose another folder"
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
    components = suite_components(suite, targets)
    # In memory first: the hashes in suite.json are those of what is written.
    files = {}
    for motion in suite:
        for record in motion.components:
            files[f"{record.name}.csv"] = record_csv(record, hold_s=motion.hold_s).encode()
    document = _document(suite, targets, components, seed, records, files)
    text = spaced(json.dumps(document, indent=1, ensure_ascii=False))
    files["suite.json"] = text.encode() + b"\n"
    files["suite.png"] = spectra([_spectra(suite, targets, name) for name in "xyz"], png_bytes)
    return files


def _document(
    suite: Sequence[SuiteMotion],
    targets: SuiteTargets,
    components: Sequence[SuiteComponent],
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
            "least_ratio": MIN_RATIO,
            "greatest_ratio": MAX_RATIO,
            "mean_ratio_off": MAX_MEAN_DIFFERENCE,
            "to_hz": BAND_HZ[1],
            "points_per_octave": 12,
        },
        "acceptance": acceptance_facts(suite_acceptance(suite, targets).rows),
        "motions": [
            # Three components for each motion, in the order of `suite_components`.
            _motion(motion, components[3 * k : 3 * k + 3], files)
            for k, motion in enumerate(suite)
        ],
    }


def _corners(target: Target) -> dict[str, list[float]]:
    freq_hz, sa_g = target
    return {"freq_hz": freq_hz.tolist(), "sa_g": sa_g.tolist()}


def _motion(
    motion: SuiteMotion, components: Sequence[SuiteComponent], files: Mapping[str, bytes]
) -> dict[str, Any]:
    xy, xz, yz = motion.correlations
    return {
        "id": components[0].motion,
        "correlation_xy": xy,
        "correlation_xz": xz,
        "correlation_yz": yz,
        "components": [_component(component, files) for component in components],
    }


def _component(component: SuiteComponent, files: Mapping[str, bytes]) -> dict[str, Any]:
    name = f"{component.record.name}.csv"
    return {
        "component": component.component,
        "file": name,
        "sha256": hashlib.sha256(files[name]).hexdigest(),
        "grew_from": component.seed,
        "npts": len(component.record.a_mps2),
        "from_hz": float(component.fit.freq_hz[0]),
        "least_ratio": component.fit.minimum,
        "greatest_ratio": component.fit.maximum,
        "mean_ratio": component.fit.mean,
        **component.facts,
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
            name="5% damping", at=partial(target_sa_g, target), from_s=0.0, to_s=math.inf
        ),
        title=f"{name}, {kind}",
        is_ground=False,
    )


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
