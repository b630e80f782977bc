"""The sliding block: exact response of ballasted arrays, and the code rules for their design.

All quantities are SI. Records and motions can be passed directly. Results have `to_frame`, for
plots with pandas. The public names are those of `solver.public`; imports nothing that lays out
pages or draws figures.

Runs:

    slide               Slide a block on a sloped, shaken roof, resisted by friction alone.
    slide_history       Return the motion of a block at the samples of the record, with its events.
    scene               Return one block under one motion, checked, for `solver.solve`.
    solve               Solve a scene with the simplest adequate model.
    history             Return the motion of a solved scene at the samples, by the same model.
    sweep               Run all combinations of slope, friction coefficient and scale of a record.
    sweep_all           Run all combinations for each of several records or motions.
    study               Run every slope, friction and intensity under every motion.

What they take:

    coulomb             Return Coulomb friction with one coefficient.
    motion              Return a motion of one to three components, for a study or for any run.
    read_record         Read one channel of a record file.
    read_motion_file    Read all channels of a record file.
    record_from_values  Create a record from values in memory, such as a pasted column.
    write_record        Write a record as csv of time [s] and acceleration, with a heading line.
    process             Process a record: trim, baseline, filters, resampling, zeros at the end.
    measures            Measure peaks, drift, Arias intensity and duration of a record.
    spectrum            Return the response spectra of a record, or of a motion with its scale.

Targets, suites and buildings:

    design_spectrum     Return the design response spectrum at the ground.
    factor_to_target    Return the factor that scales a motion to a target spectrum.
    ac156_horizontal    Return the horizontal AC156 spectrum, 5% damping.
    ac156_vertical      Return the vertical AC156 spectrum, 5% damping: 0.67 S_DS and 0.27 S_DS.
    make_suite          Generate motions of two horizontal components and a vertical component each.
    building_of_periods Return a uniform building whose first modes have the given periods.
    at_roof             Return the motion of an elastic building's roof under a ground motion.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from solver.public import *  # noqa: F403


def __getattr__(name: str) -> Any:
    """Return a public name. All are loaded with the first: with the kernels that takes 0.4 s."""
    # Not `from solver import public`, which would ask here whether there is such a name.
    return getattr(import_module("solver.public"), name)


def __dir__() -> list[str]:
    """Return the public names, which `help` shows."""
    return list(import_module("solver.public").__all__)
