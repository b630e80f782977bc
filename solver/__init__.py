"""The sliding block: exact response of ballasted arrays, and the code rules it is held against.

Public names are listed here; everything is SI. Imports no files, pages or pictures.
"""

from solver.methods import METHODS
from solver.model import Event, EventKind, InputError, Motion, SlideHistory, SlideResult, Status
from solver.sliding import slide, slide_history
from solver.studies import Sweep, sweep

__all__ = [
    "METHODS",
    "Event",
    "EventKind",
    "InputError",
    "Motion",
    "SlideHistory",
    "SlideResult",
    "Status",
    "Sweep",
    "slide",
    "slide_history",
    "sweep",
]
