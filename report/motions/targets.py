"""The target spectra of motions, for comparison and scaling, as a project requests them.

Owns which spectrum applies where; the formulas are those of `solver.rules.provisions` and
`solver.records.scaling`. Read `targets` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from report.sheet.schema import ProjectInput
from report.sheet.schema.building import SpectrumPoint
from report.sheet.schema.choices import RecordedAt
from solver.model import Floats
from solver.records.scaling import Target, design_spectrum
from solver.rules.spectra import (
    RequiredSpectrum,
    Tail,
    ac156_horizontal,
    ac156_vertical,
    target_sa_g,
)

OWN = "project-specific"


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetSpectrum:
    """A target spectrum, 5 % damping."""

    name: str  # empty if there is no target; the ordinates are then NaN
    # spectral acceleration [g] at frequencies [Hz]; a target given by points is constant beyond
    # them. Not a closure, so that it can be pickled
    at: Target
    # range of periods for which it is given [s]
    from_s: float
    to_s: float

    def ordinates(self, periods_s: Floats) -> Floats:
        """Return accelerations [g] at periods [s]; NaN outside its range."""
        given = (periods_s >= self.from_s * (1.0 - 1e-9)) & (periods_s <= self.to_s * (1.0 + 1e-9))
        return np.where(given, self.at(1.0 / periods_s), math.nan)


@dataclass(frozen=True, slots=True, kw_only=True)
class Targets:
    """Target spectra of the roof components, and of the horizontal ground components."""

    roof: TargetSpectrum
    vertical: TargetSpectrum
    ground: TargetSpectrum

    def horizontal(self, at: RecordedAt) -> TargetSpectrum:
        """Return the target at the recording level of a motion."""
        return self.ground if at is RecordedAt.GROUND else self.roof


def _nowhere(freq_hz: Floats) -> Floats:
    return np.full(freq_hz.shape, math.nan)


NO_TARGET = TargetSpectrum(name="", at=_nowhere, from_s=0.0, to_s=math.inf)


def targets(data: ProjectInput) -> Targets:
    """Return the targets of a project: its own table if given, or else those of its rule set."""
    roof, vertical = ac156(data)
    own = data.spectrum
    across = _own(own, [row.horizontal_g for row in own]) if own else None
    upward = [row.vertical_g for row in own if row.vertical_g is not None]
    has_ground = any(row.recorded_at is RecordedAt.GROUND for row in data.motions)
    return Targets(
        # If there are ground motions, the project-specific spectrum applies at the ground.
        roof=across if across and not has_ground else _ac156(roof),
        vertical=_own(own, upward) if upward else _ac156(vertical),
        ground=across or _design(data),
    )


def ac156(data: ProjectInput) -> tuple[RequiredSpectrum, RequiredSpectrum]:
    """Return the AC156 spectra at the roof, horizontal and vertical."""
    site, tail = data.site, Tail(data.target.tail)
    horizontal = ac156_horizontal(
        site.edition,
        s_ds_g=site.s_ds,
        z_over_h=site.roof_height_m / site.structure_height_m,
        tail=tail,
    )
    return horizontal, ac156_vertical(s_ds_g=site.s_ds, tail=tail)


def _ac156(spectrum: RequiredSpectrum) -> TargetSpectrum:
    return TargetSpectrum(name="AC156", at=spectrum.at, from_s=0.0, to_s=1.0 / spectrum.freq_hz[0])


def _own(rows: Sequence[SpectrumPoint], sa_g: Sequence[float]) -> TargetSpectrum:
    order = np.argsort([-row.period_s for row in rows])
    freq = 1.0 / np.array([row.period_s for row in rows])[order]
    return TargetSpectrum(
        name=OWN,
        at=partial(target_sa_g, (freq, np.array(sa_g)[order])),
        from_s=float(1.0 / freq[-1]),
        to_s=float(1.0 / freq[0]),
    )


def _design(data: ProjectInput) -> TargetSpectrum:
    site, t_l_s = data.site, data.target.t_l_s
    if site.s_d1 is None or t_l_s is None:
        return NO_TARGET
    at = design_spectrum(s_ds_g=site.s_ds, s_d1_g=site.s_d1, t_l_s=t_l_s)
    return TargetSpectrum(name="ASCE 7 design spectrum", at=at, from_s=0.0, to_s=math.inf)
