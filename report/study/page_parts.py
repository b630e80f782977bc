"""What several sections of study.pdf share: a level, a length, a chart."""

from __future__ import annotations

import math

from report.manual.blocks import Chart
from report.pages.parts import Picture
from report.study.results import StudyResults
from report.study.tables import length_unit
from report.words.units import measured


def on_building(results: StudyResults, building: int) -> str:
    """Return ", building NAME" in a study with several, else nothing."""
    names = results.plan.motions.buildings
    return f", building {names[building]}" if len(names) > 1 else ""


def axis(results: StudyResults) -> str:
    """Return the name of the measure of intensity."""
    return results.plan.input.study.intensity.value


def level(results: StudyResults, value: float) -> str:
    """Return an intensity with its letters and unit."""
    measure = results.plan.input.study.intensity
    return f"{measure.letters} = {value:g} {measure.unit}"


def length(results: StudyResults, value_m: float) -> str:
    """Return a length in the unit of the study, "none" for no value."""
    return "none" if math.isnan(value_m) else measured(value_m, length_unit(results))


def chart(name: str, svg: str, caption: str) -> Chart:
    """Return a picture with its caption, which is also its alternative text."""
    return Chart(name=name, picture=Picture(svg=svg, caption=caption, alt=caption))
