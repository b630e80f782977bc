"""A project open on the page: its motions and runs, at any values of its controls.

A value is nothing but other contents of cells: values make another project of the same workbook,
and `report.assessment` does the rest. Read `OpenProject`, then `report.web.controls`.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from report.assessment.assess import Extent, assess
from report.assessment.assessment import Assessment
from report.motions.components import Components
from report.motions.prepare import Shaking, read_records, shaking, stiff_links
from report.project.model.input_rows import Place
from report.project.read.read import read
from report.project.read.what_if import Typed, retyped
from report.project.read.workbook_data import Sheet
from report.runs import Runs, scene_key
from report.typeset.letters import check_letters
from report.web.controls import check, controls
from report.web.values import Values, typed
from solver.records.acceptance import Acceptance

# Of the PRD, while a slider moves: the bound of the error. The PRDs of three projects are within
# 3e-5, less than is printed, and runs to 1e-6 take twice as long.
PASSING = 1e-2

# While a slider moves, an orientation is run if it had the largest PRD at rest; the more the
# largest has changed since, the farther below it; and the second one where it changed by more than
# `_FAR`. Of 2,107 mean PRDs of four projects, at 255 values over the spans of friction, slope and
# intensity, 10 were low by more than 0.1 %, at most 1.03 %, with 58 % of the runs. Without `_FAR`
# 28 were, at most 25 %.
_PER_CHANGE, _FAR = 0.4, 1.35

KEPT_VALUES = 8
"""Values at which a project is kept, with its assessments."""


Reference = Mapping[str, Mapping[str, Mapping[str, float]]]
"""PRDs [m] by array, motion and orientation, of the last complete answer: data for JSON."""


@dataclass(eq=False)
class SharedRuns:
    """What projects with the same motions share: it does not follow from their other values."""

    acceptance: Acceptance | None = None  # of the motions, once it is known
    moving: Runs | None = None  # of the last move, of arrays with these keys
    scenes: frozenset[Hashable] = frozenset()


@dataclass(frozen=True, kw_only=True, eq=False)
class OpenProject:
    """A workbook at values of its controls, its motions, and the runs of its arrays.

    Attributes
    ----------
    typed : mapping
        What the values put into cells of the file; the sheet is as if it had been typed there.
    by_motion : sequence
        The records of each motion as read, whatever the values say.
    """

    sheet: Sheet
    by_motion: Sequence[Components]
    shaking: Shaking
    runs: Runs
    typed: Mapping[Place, Typed] = field(default_factory=dict)
    shared: SharedRuns = field(default_factory=SharedRuns)
    _others: dict[frozenset[tuple[Place, Typed]], OpenProject] = field(default_factory=dict)
    _done: dict[Extent, Assessment] = field(default_factory=dict)

    @property
    def id(self) -> str:
        """Name of the project in addresses, which no other workbook or records have."""
        whole = "\n".join((self.sheet.sha256, *self.shaking.hashes))
        return hashlib.sha256(whole.encode()).hexdigest()[:12]

    @property
    def scales(self) -> dict[str, float]:
        """Factor on the records of each motion."""
        return {motion.id: motion.scale for motion in self.shaking.motions}

    @cached_property
    def controls(self) -> Mapping[str, Any]:
        """The sliders and choices of the workbook, for the page."""
        return controls(self)

    def at(self, values: Values) -> OpenProject:
        """Return the project as if values had been typed into the workbook as it is opened.

        Raises `InputError` for values that no control has, or that the workbook could not have.
        """
        check(self, values)
        cells = typed(self.sheet, self.scales, values)
        if not cells:
            return self
        key = frozenset(cells.items())
        # The last one that was asked for is dropped last.
        known = self._others.pop(key) if key in self._others else self._having(cells)
        self._others[key] = known
        if len(self._others) > KEPT_VALUES:
            self._others.pop(next(iter(self._others)))
        return known

    def _having(self, cells: Mapping[Place, Typed]) -> OpenProject:
        sheet = retyped(self.sheet, cells)
        sheet.refuse(())
        known = (self, *self._others.values())
        alike = [other for other in known if _has_same_motions(other.sheet, sheet)]
        if not alike:
            motions = shaking(sheet, self.by_motion)
            return OpenProject(
                sheet=sheet, by_motion=self.by_motion, shaking=motions, runs=Runs(), typed=cells
            )
        # Records that stay as they are need not be processed again.
        first = alike[0]
        sheet.refuse(stiff_links(sheet.project, first.shaking.motions))
        # Of clearances that differ, all runs; of friction or slope, those that are there.
        keys = set(map(scene_key, sheet.project.arrays))
        of_arrays = (o for o in alike if set(map(scene_key, o.sheet.project.arrays)) == keys)
        runs = next((other.runs for other in of_arrays), None)
        return OpenProject(
            sheet=sheet,
            by_motion=self.by_motion,
            shaking=first.shaking,
            runs=runs or first.runs.copy(),
            typed=cells,
            shared=first.shared,
        )

    def assessed(self, extent: Extent = Extent.WHOLE) -> Assessment:
        """Return the assessment, with the requested extent or more."""
        known = next((done for of, done in self._done.items() if of >= extent), None)
        self._done[extent] = known or self._assessed(self.runs, extent)
        return self._done[extent]

    def moving(self, reference: Reference) -> Assessment:
        """Return a provisional assessment, from the orientations that may govern."""
        scenes = frozenset(map(scene_key, self.sheet.project.arrays))
        former = self.shared.moving
        # Where clearances move, or units, all runs are there: 0.1 s of the example.
        if former is None or self.shared.scenes != scenes:
            self.shared.moving = former.copy(scenes) if former else Runs(PASSING)
            self.shared.scenes = scenes
        return self.of_governing(reference, self.shared.moving)

    def of_governing(self, reference: Reference, runs: Runs | None = None) -> Assessment:
        """Return the same from its own runs: none is larger than in the full assessment."""
        arrays, motions, runs = self.sheet.project.arrays, self.shaking.motions, runs or self.runs
        near = runs.knowing(
            {
                array: {motion: may_govern(prds_m, 1.0) for motion, prds_m in of.items()}
                for array, of in reference.items()
            }
        )
        near.begin(arrays, motions)
        known: dict[str, dict[str, list[str]]] = {}
        for array in arrays:
            former = reference.get(array.id, {})
            known[array.id] = {
                run.motion.id: may_govern(prds_m, run.governing.prd_m / max(prds_m.values()))
                for run in near.of(array, motions)
                if (prds_m := former.get(run.motion.id))
            }
        return self._assessed(runs.knowing(known), Extent.ALONE)

    def _assessed(self, runs: Runs, extent: Extent) -> Assessment:
        known = self.shared.acceptance
        done = assess(self.sheet, self.shaking, runs, acceptance=known, extent=extent)
        self.shared.acceptance = done.acceptance
        return done


def open_project(path: Path) -> OpenProject:
    """Read a workbook and its records, or raise an input error with every problem."""
    sheet = read(path)
    check_letters(sheet)
    by_motion = read_records(sheet)
    sheet.book.files.clear()  # for a package, which another process makes
    sheet.book.records.clear()
    run = shaking(sheet, by_motion)
    return OpenProject(sheet=sheet, by_motion=by_motion, shaking=run, runs=Runs())


def _has_same_motions(before: Sheet, after: Sheet) -> bool:
    """Whether two sheets have the same motions: only units, arrays and clearances differ."""
    return all(
        rows == after.inputs[key]
        for key, rows in before.inputs.items()
        if key not in ("project", "arrays", "clearances", "links")
    )


def reference_of(done: Assessment) -> Reference:
    """Return the PRDs by which the orientations are chosen that run while a slider moves."""
    found: dict[str, dict[str, dict[str, float]]] = {}
    for item in done.arrays:
        found[item.id] = {
            motion.motion.id: {run.orientation.name: run.prd_m for run in motion.runs}
            for motion in item.motions
            # Of one that does not slide, or has a run without a PRD, nothing can be left out.
            if 0.0 < motion.governing.prd_m < math.inf
        }
    return found


def may_govern(prds_m: Mapping[str, float], change: float) -> list[str]:
    """Return the orientations that may govern where the largest PRD has changed; none for all."""
    if not 0.0 < change < math.inf:
        return []
    first, *others = sorted(prds_m, key=prds_m.__getitem__, reverse=True)
    factor = max(change, 1.0 / change)
    least_m = factor**-_PER_CHANGE * prds_m[first]
    return [
        first,
        *(
            name
            for place, name in enumerate(others)
            if prds_m[name] >= least_m or (place == 0 and factor > _FAR)
        ),
    ]
