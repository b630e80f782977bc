"""Synthetic roof motions that match a target spectrum.

The public names are listed here. Knows no code rules and no files. Read `suite.make_suite` first.
"""

from solver.synthesis.suite import SuiteMotion, make_suite, synthesize
from solver.synthesis.target import (
    BAND_HZ,
    DAMPING,
    SpectrumFit,
    Target,
    lowest_hz,
    spectrum_fit,
    target_sa_g,
)

__all__ = [
    "BAND_HZ",
    "DAMPING",
    "SpectrumFit",
    "SuiteMotion",
    "Target",
    "lowest_hz",
    "make_suite",
    "spectrum_fit",
    "synthesize",
    "target_sa_g",
]
