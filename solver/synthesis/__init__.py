"""Roof motions made to follow a target spectrum.

Public names are listed here; knows no code rules and no files. Read `suite.make_suite` first.
"""

from solver.synthesis.suite import CORRELATION, SuiteMotion, make_suite, synthesise
from solver.synthesis.target import (
    BAND_HZ,
    DAMPING,
    SpectrumFit,
    Target,
    spectrum_fit,
    target_sa_g,
)

__all__ = [
    "BAND_HZ",
    "CORRELATION",
    "DAMPING",
    "SpectrumFit",
    "SuiteMotion",
    "Target",
    "make_suite",
    "spectrum_fit",
    "synthesise",
    "target_sa_g",
]
