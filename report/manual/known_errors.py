"""Errors of released versions that could change a result or lose one, with what to do about them.

Data only. An entry is added with the correction, and stays.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownError:
    """An error of a released version.

    Attributes
    ----------
    version : str
        The last version that has it.
    what : str
        What went wrong, and when.
    effect : str
        On a package, and whether it is on the safe side.
    action : str
        What a user of that version does.
    """

    version: str
    what: str
    effect: str
    action: str


_AGAIN = "compute it again"

KNOWN_ERRORS = (
    KnownError(
        version="0.1.0",
        what="Rows of a workbook were not read if another program than Excel had written its parts "
        "under other spellings of their names, or in UTF-16.",
        effect="Arrays, objects, clearances, spectrum or links are missing. Not conservative.",
        action="Compare arrays and clearances with the workbook; if one is missing, compute the "
        "package again.",
    ),
    KnownError(
        version="0.1.0",
        what="A clearance took the displacement in its own direction, not the full design "
        "displacement.",
        effect="Required separations may be too small. Not conservative.",
        action=f"Check each clearance for the full design displacement, or {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="A run that still slid at the end of its record gave a design value.",
        effect="The PRD may be too small. Not conservative.",
        action=f"If the package notes sliding at the end of a record, {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="The choice of model could neglect a cross-slope component whose effect accumulates "
        "along the path.",
        effect="The PRD of model 1 or 2 may be too small. Not conservative.",
        action=f"If the package uses model 1 or 2 for a motion with three components, {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="Two axes did not end, failed, or exceeded their stated error for rare motions: equal "
        "samples, accelerations equal to the yield acceleration, zero normal force, steep "
        "dependence of friction on velocity.",
        effect="No result, or an error of the PRD greater than stated.",
        action="If friction depends on velocity, or a motion was not recorded in an earthquake, "
        f"{_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="Response spectra, and the part of a building that the modes neglect, were evaluated "
        "at the samples only.",
        effect="Spectra at short periods are too small: motions scaled to them are too large, and "
        "limits on motions may be misjudged.",
        action=f"If a motion is scaled to a spectrum, or comes from a building model, {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="Damaged records were read without a note: a file cut off within its channels, and a "
        "CSMIP file without one line of its heading.",
        effect="A shorter or another motion: channels are missing, or the time step is off by a "
        "few percent. May be not conservative.",
        action="Compare samples and time steps in the appendix with the heading of each record; if "
        f"they differ, replace the file and {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="A motion of zeros or of two samples was accepted.",
        effect="The mean of the peaks is too small. Not conservative.",
        action="Check peak and duration of every motion in the package.",
    ),
    KnownError(
        version="0.1.0",
        what="Overrides took any number, such as an analysis factor of -1.",
        effect="A wrong design displacement, with the override printed.",
        action="Check every override that the package prints.",
    ),
    KnownError(
        version="0.1.0",
        what="SEAOC PV1-2012: an edge without a qualifying parapet took 2.0 instead of 1.5; the "
        "importance factor of the building, not of array and object, entered separations "
        "between arrays and from objects.",
        effect="Conservative at edges; not conservative where I_p exceeds I_e.",
        action=f"Check I_p against I_e; if it is greater, {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="Arrays with different slope, friction or downslope direction could count as like "
        "arrays, with half of the separation.",
        effect="Separations between them are too small. Not conservative.",
        action=f"Check each clearance to an array; if it is unlike, enter it as such, or {_AGAIN}.",
    ),
    KnownError(
        version="0.1.0",
        what="ASCE 7-16 and 7-22 on roofs steeper than 1 in 20, and roofs steeper than 1 in 12, "
        "were not limited by SDC and peer review.",
        effect="A package may be OK outside of the scope of the standard.",
        action="Check slope, SDC and peer review of every array steeper than 1 in 20.",
    ),
    KnownError(
        version="0.1.0",
        what="report, new, motion convert and motion info --plot could leave half of a file after "
        "a full disk or a kill, or files of two runs beside each other.",
        effect="A cut record reads as a valid shorter one; package and tables may be of two runs.",
        action="Convert such records again; run report again before a package is issued.",
    ),
    KnownError(
        version="0.1.0",
        what="report --out could replace its own input, if that had the name of an output.",
        effect="The workbook is lost.",
        action="Keep inputs out of the folder of the outputs, or use this version.",
    ),
    KnownError(
        version="0.1.0",
        what="From Python, dates, Booleans, text and masked samples were taken as accelerations.",
        effect="A displacement without meaning.",
        action="Check the types of arrays in scripts.",
    ),
)
