"""The pictures of the package, drawn in a process of their own where that is safe.

Says what each picture is called; `report.figures` draws it.
"""

from __future__ import annotations

import os
import pickle
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence

from report.assess import ArrayAssessment
from report.pages.parts import Picture, Scene
from report.pdf import TEMPLATES
from report.spectra import Spectra

PANELS, CHART_ROWS = 12, 16  # most that one figure holds: it must fit on a page
Pictures = Mapping[str, Sequence[Picture]]


def begin(work: Callable[[], Pictures]) -> Callable[[], Pictures]:
    """Begin some work in a copy of this process; return what waits for its outcome.

    Where a copy is not safe (other threads, other systems) or fails, the work is done here.
    """
    if sys.platform != "linux" or threading.active_count() > 1:
        return work
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        # Later Pythons warn of threads that only wait inside numerical libraries.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        _work_and_exit(work, writing)
    os.close(writing)

    def outcome() -> Pictures:
        with os.fdopen(reading, "rb") as pipe:
            data = pipe.read()
        _, status = os.waitpid(child, 0)
        if status != 0:
            return work()
        pictures: Pictures = pickle.loads(data)
        return pictures

    return outcome


def _work_and_exit(work: Callable[[], Pictures], writing: int) -> None:
    status = 1
    try:
        with os.fdopen(writing, "wb") as pipe:
            pickle.dump(work(), pipe)
        status = 0
    finally:
        os._exit(status)  # without flushing or closing what belongs to the other process


def draw(scene: Scene, found: Sequence[Spectra]) -> Pictures:
    """Return every picture of the package, by the id of the part that it belongs to."""
    from report.figures import charts as figures

    figures.load_fonts(TEMPLATES / "fonts")
    us_first, assessment = scene.say.us_first, scene.assessment
    pictures = {
        "inputs-3": [
            Picture(
                svg=figures.roof_plan(scene.data, us_first),
                caption="Roof plan to scale: arrays with their fall and slope, objects, roof "
                "edges, and the clearances by their numbers in part 8.",
                alt="Roof plan with arrays, objects, edges and clearances",
            )
        ],
        "motions-2": [
            Picture(
                svg=figures.spectra(found),
                caption="Response spectra of the motions as run, 5 % damping, against the AC156 "
                "required response spectrum.",
                alt="Response spectra of all motions, their mean and the target",
            )
        ],
        "comparison": [
            Picture(
                svg=figures.comparison(assessment.arrays[at : at + CHART_ROWS], us_first),
                caption="Prescriptive displacement, floor, peak relative displacement (PRD) of "
                "each motion, their mean, and design displacement.",
                alt="Chart of displacements by array",
            )
            for at in range(0, len(assessment.arrays), CHART_ROWS)
        ],
        "clearances": [
            Picture(
                svg=figures.clearances(
                    assessment.clearances[at : at + CHART_ROWS], us_first, start=at + 1
                ),
                caption="Required against provided separation.",
                alt="Chart of required and provided separations",
            )
            for at in range(0, len(assessment.clearances), CHART_ROWS)
        ],
    }
    for count, one in enumerate(assessment.arrays, start=1):
        pictures[f"results-{count}"] = list(_histories(one, us_first))
    return pictures


def _histories(found: ArrayAssessment, us_first: bool) -> Iterator[Picture]:
    from report.figures.charts import histories

    for start in range(0, len(found.motions), PANELS):
        yield Picture(
            svg=histories(found.motions[start : start + PANELS], us_first),
            caption=f"Array {found.array.id}: displacement u relative to the roof, positive down "
            "the slope, in the polarity that counts. Dot: PRD.",
            alt=f"Relative displacement histories of array {found.array.id}",
        )
