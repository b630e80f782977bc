"""The public names of the solver, which `import solver` offers."""

from solver.formats import read_record
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
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.sliding.checked import history, scene, slide, slide_history, solve
from solver.sliding.least_model import Model, Settings, Solution
from solver.sliding.sweep import Sweep, sweep

__all__ = [
    "METHODS",
    "Event",
    "EventKind",
    "Friction",
    "InputError",
    "Model",
    "Motion",
    "Record",
    "Scene",
    "Settings",
    "SlideHistory",
    "SlideResult",
    "Solution",
    "Status",
    "Sweep",
    "coulomb",
    "history",
    "read_record",
    "scene",
    "slide",
    "slide_history",
    "solve",
    "sweep",
]
