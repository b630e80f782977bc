"""The sliding block: exact response of ballasted arrays, and the code rules it is held against.

Public names are listed here; everything is SI. Imports no files, pages or pictures.
"""

from solver.model import (
    Event,
    EventKind,
    Friction,
    InputError,
    Motion,
    Scene,
    SlideHistory,
    SlideResult,
    Status,
    coulomb,
)
from solver.rivals.methods import METHODS
from solver.sliding.checked import scene, slide, slide_history
from solver.sliding.least_model import Rung, Settings, Solution, solve
from solver.sliding.sweep import Sweep, sweep

__all__ = [
    "METHODS",
    "Event",
    "EventKind",
    "Friction",
    "InputError",
    "Motion",
    "Rung",
    "Scene",
    "Settings",
    "SlideHistory",
    "SlideResult",
    "Solution",
    "Status",
    "Sweep",
    "coulomb",
    "scene",
    "slide",
    "slide_history",
    "solve",
    "sweep",
]
