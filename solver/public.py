"""The public names of the solver, available after `import solver`."""

from solver.building.roof import at_roof
from solver.building.structure import Building, building_of_periods
from solver.errors import InputError
from solver.formats import MotionFile, read_motion_file, read_record
from solver.model import (
    Event,
    EventKind,
    Friction,
    Motion,
    Scene,
    SlideHistory,
    SlideResult,
    Status,
    coulomb,
)
from solver.records.measures import Measures, measures
from solver.records.processing import Processing, process
from solver.records.record import Record, record_from_values, write_record
from solver.records.spectrum import ResponseSpectrum, design_spectrum, factor_to_target, spectrum
from solver.rivals.methods import METHODS
from solver.rules.ac156 import RequiredSpectrum, ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS
from solver.sliding.checked import history, motion, scene, slide, slide_history, solve
from solver.sliding.method import Method, Outcome
from solver.sliding.model_selection import Model, Settings, Solution
from solver.studies.study import StudyRuns, study
from solver.studies.sweep import Sweep, sweep, sweep_all
from solver.synthesis.suite import SuiteMotion, make_suite

__all__ = [
    "EDITIONS",
    "METHODS",
    "Building",
    "Event",
    "EventKind",
    "Friction",
    "InputError",
    "Measures",
    "Method",
    "Model",
    "Motion",
    "MotionFile",
    "Outcome",
    "Processing",
    "Record",
    "RequiredSpectrum",
    "ResponseSpectrum",
    "Scene",
    "Settings",
    "SlideHistory",
    "SlideResult",
    "Solution",
    "Status",
    "StudyRuns",
    "SuiteMotion",
    "Sweep",
    "ac156_horizontal",
    "ac156_vertical",
    "at_roof",
    "building_of_periods",
    "coulomb",
    "design_spectrum",
    "factor_to_target",
    "history",
    "make_suite",
    "measures",
    "motion",
    "process",
    "read_motion_file",
    "read_record",
    "record_from_values",
    "scene",
    "slide",
    "slide_history",
    "solve",
    "spectrum",
    "study",
    "sweep",
    "sweep_all",
    "write_record",
]
