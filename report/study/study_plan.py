"""From the sheet to the runs: which cases belong to curves, fragilities and exceedances.

Slopes 0 to 7 by 1, friction 0.3 to 0.8 by 0.05 and 20 intensities are 1,760 cases of the curves.

Runs nothing. Read `plan_study`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, product
from typing import Any

from report.project.model.finding import Finding
from report.project.model.input_rows import Place
from report.project.read.unseen import warnings
from report.study.design_rule import DesignRule, design_rule
from report.study.hazard_curve import hazard_curves
from report.study.read_study import StudySheet
from report.study.study_input import (
    MOST_CASES,
    MOST_RUNS,
    Intensity,
    Sampling,
    Study,
    StudyArray,
    StudyInput,
)
from report.study.study_motions import StudyMotions
from solver.errors import InputError
from solver.studies.campaign import Campaign, Cases, cases_of, grid, joined
from solver.studies.predictive import Predictive, predictive
from solver.studies.rates import HazardCurve
from solver.studies.uncertainty import Spread, latin_hypercube, one_at_a_time

FRICTION, SLOPE, INTENSITY = "friction coefficient", "slope", "intensity"
Shift = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayPlan:
    """The cases of one array on one building.

    `shifts` has friction and slope [deg] where one of them, by its name, is one standard deviation
    below and above its center; of those alone whose distribution is given.
    """

    array: StudyArray
    building: int
    seed: int
    mu: float
    spreads: Mapping[str, Spread]  # of friction, slope [deg] and intensity
    shifts: Mapping[str, tuple[Shift, Shift]]
    fragility: slice  # cases
    samples: slice  # of its exceedance; empty without an intensity at the site
    bars: slice  # of its tornado chart; the same


@dataclass(frozen=True, kw_only=True)
class StudyPlan:
    """A study ready to run; the first cases are the grid of the curves."""

    workbook: str
    input: StudyInput
    motions: StudyMotions
    campaign: Campaign
    arrays: tuple[ArrayPlan, ...]
    hazard: tuple[HazardCurve, ...]  # of the intensity of the motions; empty for none
    predicted: Mapping[str, Predictive]  # by the folded ID of each mat with tests
    warnings: tuple[tuple[str, str], ...]  # cell and text of each, on the workbook

    @property
    def shape(self) -> tuple[int, int, int, int]:
        """Buildings, slopes, friction coefficients and intensities of the grid."""
        study_input = self.input
        return (
            len(self.motions.buildings),
            len(study_input.slopes_deg),
            len(study_input.mus),
            len(study_input.intensities),
        )

    @cached_property
    def design_rule(self) -> DesignRule:
        """Rule for the design displacement from the PRDs of the motions."""
        return design_rule(self.input, len(self.motions.motions[0]))

    @property
    def about(self) -> dict[str, Any]:
        """Data other than motions and cases that determine the results, for the manifest."""
        return {
            "seed": self.input.study.seed,
            "seeds": {f"array {array.array.id}": array.seed for array in self.arrays},
            "buildings": list(self.motions.buildings),
            "input": self.input.model_dump(mode="json"),
            "hazard_curves": [
                {"intensity": c.intensity.tolist(), "rate": c.rate.tolist(), "beta": c.beta}
                for c in self.hazard
            ],
        }


def plan_study(sheet: StudySheet, motions: StudyMotions) -> StudyPlan:
    """Return the runs of a study.

    Raises `InputError` if they are more than a study may have, at the cell of the intensities.
    """
    study_input = sheet.project
    buildings = len(motions.buildings)
    blocks = [
        grid(
            buildings,
            [math.radians(s) for s in study_input.slopes_deg],
            study_input.mus,
            study_input.intensities,
        )
    ]
    arrays = []
    start = len(blocks[0])
    for number, (array, building) in enumerate(product(study_input.study_arrays, range(buildings))):
        # Arrays draw apart: with one seed, all would be at the same quantiles.
        seed = study_input.study.seed + 1000 * number
        made, parts = _array(study_input, motions, array, building, start, seed)
        arrays.append(made)
        blocks += parts
        start += sum(map(len, parts))
    campaign = Campaign(motions=motions.motions, cases=joined(blocks))
    # Again: the reader knows the grid, but neither the samples nor the orientations.
    sheet.refuse(_too_many(campaign))
    hidden = list(chain.from_iterable(file.unseen for file in motions.files))
    notes = (*warnings([*sheet.unseen, *hidden]), *sheet.warnings)
    return StudyPlan(
        workbook=sheet.path.name,
        input=study_input,
        motions=motions,
        campaign=campaign,
        arrays=tuple(arrays),
        hazard=hazard_curves(sheet),
        predicted=_predicted(sheet),
        warnings=tuple((cell.cell or sheet.where(cell.place), cell.text) for cell in notes),
    )


def _predicted(sheet: StudySheet) -> Mapping[str, Predictive]:
    """Return the predictive distributions of the mats with tests."""
    study_input, by_mat = sheet.project, {}
    has_use = bool(
        # Tested values alone do not ask for it: three may scatter too much for a prediction.
        study_input.friction_runs or study_input.hazard.file or study_input.hazard_points
    )
    for row, mat in enumerate(study_input.mats if has_use else ()):
        if surfaces := study_input.surfaces(mat.id):
            try:
                by_mat[mat.id.casefold()] = predictive(surfaces)
            except InputError as error:
                place = Place("mats", row, "id")
                sheet.refuse([Finding.error(place, p.found, p.remedy) for p in error.parts])
    return by_mat


def _too_many(campaign: Campaign) -> Iterator[Finding]:
    place = Place("study", 0, "intensities")
    if len(campaign.cases) > MOST_CASES:
        accepted = f"enter at most {MOST_CASES:,}"
        yield Finding.error(place, f"make {len(campaign.cases):,} cases", accepted)
    elif campaign.rows > MOST_RUNS:
        yield Finding.error(place, f"make {campaign.rows:,} runs", f"enter at most {MOST_RUNS:,}")


def _array(
    study_input: StudyInput,
    motions: StudyMotions,
    array: StudyArray,
    building: int,
    start: int,
    seed: int,
) -> tuple[ArrayPlan, list[Cases]]:
    study, friction = study_input.study, study_input.friction(array.mat)
    slope = math.radians(array.slope_deg)
    # In this order they are the columns of the samples and the cases of the tornado chart.
    spreads = {
        FRICTION: friction,
        SLOPE: Spread(center=array.slope_deg, half=study.slope_tolerance_deg),
        INTENSITY: Spread(center=study.site_intensity or 1.0, beta=study.intensity_beta),
    }
    levels = [(building, slope, friction.center, x) for x in study_input.intensities]
    # Without an intensity at the site there is no probability, and nothing to vary.
    samples, bars = [], []
    if study.site_intensity:
        samples, bars = (
            [(building, math.radians(slope_deg), mu, x) for mu, slope_deg, x in rows]
            for rows in (_samples(study_input, array, spreads, seed), one_at_a_time(spreads))
        )
    edges = [start]
    for part in (levels, samples, bars):
        edges.append(edges[-1] + len(part))
    return (
        ArrayPlan(
            array=array,
            building=building,
            seed=seed,
            mu=friction.center,
            spreads=spreads,
            shifts=_shifts(study, motions, spreads),
            fragility=slice(edges[0], edges[1]),
            samples=slice(edges[1], edges[2]),
            bars=slice(edges[2], edges[3]),
        ),
        [cases_of([*levels, *samples, *bars])],
    )


def _shifts(
    study: Study, motions: StudyMotions, spreads: Mapping[str, Spread]
) -> Mapping[str, tuple[Shift, Shift]]:
    """Return the shifts of an array; none where its fragility is not exported."""
    if study.intensity is Intensity.S_DS:
        return {}
    is_even = all(len(motion.signs) > 1 for motion in motions.motions[0])
    mu, slope_deg = spreads[FRICTION], spreads[SLOPE]
    shifts: dict[str, tuple[Shift, Shift]] = {}
    if not mu.is_fixed:
        low, high = mu.around
        shifts[FRICTION] = (low, slope_deg.center), (high, slope_deg.center)
    if not slope_deg.is_fixed:
        # With both polarities the roof is the same whichever way it tilts: the capacity depends on
        # the size of the slope, and one below 0 counts as 0.
        low, high = slope_deg.around
        shifts[SLOPE] = (mu.center, max(low, 0.0) if is_even else low), (mu.center, high)
    return shifts


def _samples(
    study_input: StudyInput, array: StudyArray, spreads: Mapping[str, Spread], seed: int
) -> list[list[float]]:
    study = study_input.study
    if study.sampling is Sampling.ALL_COMBINATIONS:
        off = study.slope_tolerance_deg
        slopes = [array.slope_deg + d for d in ((-off, 0.0, off) if off else (0.0,))]
        return [
            *map(list, product(study_input.tests(array.mat), slopes, [spreads[INTENSITY].center]))
        ]
    rows = latin_hypercube(list(spreads.values()), study.samples, seed=seed)
    return [list(map(float, row)) for row in rows]
