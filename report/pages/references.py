"""The documents that a package cites: codes and standards, and publications, each in full.

A document is listed only where the package cites it. Read `codes`, then `references`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from report.pages.parts import PackageData

_STANDARD = re.compile(r"\bASTM[\s-]*G[\s-]*115\b", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Document:
    """A cited document: as the text names it, and in full."""

    cited: str
    full: str


_PV1 = Document(
    "SEAOC PV1-2012",
    "Structural Engineers Association of California, Structural Seismic Requirements and "
    "Commentary for Rooftop Solar Photovoltaic Arrays, Report SEAOC PV1-2012, 2012.",
)
_ASCE = {
    "ASCE 7-16": Document(
        "ASCE 7-16",
        "American Society of Civil Engineers, Minimum Design Loads and Associated Criteria for "
        "Buildings and Other Structures, ASCE/SEI 7-16, 2017.",
    ),
    "ASCE 7-22": Document(
        "ASCE 7-22",
        "American Society of Civil Engineers, Minimum Design Loads and Associated Criteria for "
        "Buildings and Other Structures, ASCE/SEI 7-22, 2022.",
    ),
}
# The editions of the code that refer to each edition of ASCE 7.
_IBC = {
    "ASCE 7-16": Document(
        "IBC 1613.3",
        "International Code Council, International Building Code, Section 1613.3, 2018 or 2021.",
    ),
    "ASCE 7-22": Document(
        "IBC 1613.3",
        "International Code Council, International Building Code, Section 1613.3, 2024.",
    ),
}
# AC156-24 has the height factor of ASCE 7-22, the former one that of ASCE 7-16.
_AC156 = {
    "ASCE 7-16": Document(
        "AC156",
        "ICC Evaluation Service, Acceptance Criteria for Seismic Certification by Shake-Table "
        "Testing of Nonstructural Components, AC156, 2010, with the height factor of ASCE/SEI "
        "7-16.",
    ),
    "ASCE 7-22": Document(
        "AC156",
        "ICC Evaluation Service, Acceptance Criteria for Seismic Certification by Shake-Table "
        "Testing of Nonstructural Components, AC156-24, 2024.",
    ),
}
_PAPER = Document(
    "Eqs. 6 to 18",
    "Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to Seismic Motion.",
)
_TIPPING = (
    Document(
        "Housner, 1963",
        "G. W. Housner, The Behavior of Inverted Pendulum Structures during Earthquakes, Bulletin "
        "of the Seismological Society of America 53, 403–417, 1963.",
    ),
    Document(
        "Ishiyama, 1982",
        "Y. Ishiyama, Motions of Rigid Bodies and Criteria for Overturning by Earthquake "
        "Excitations, Earthquake Engineering and Structural Dynamics 10, 635–650, 1982.",
    ),
)
_BY_VELOCITY = Document(
    "Constantinou, Mokha, Reinhorn 1990",
    "M. Constantinou, A. Mokha, A. Reinhorn, Teflon Bearings in Base Isolation II: Modeling, "
    "Journal of Structural Engineering 116, 455–474, 1990.",
)


def codes(package: PackageData) -> tuple[Document, ...]:
    """Return the codes and standards that the package applies, the rule set first."""
    return tuple(_codes(package))


def _codes(package: PackageData) -> Iterator[Document]:
    edition = package.data.site.edition.name
    if package.assessment.rules.name not in _ASCE:
        yield _PV1
    yield _ASCE[edition]
    yield _IBC[edition]
    yield _AC156[edition]  # its acceptance of motions applies to every target
    standard = package.data.friction_tests.standard
    if _STANDARD.search(standard):
        yield Document(
            standard,
            f"ASTM International, {standard}, Standard Guide for Measuring and Reporting Friction "
            "Coefficients.",
        )


def references(package: PackageData) -> tuple[Document, ...]:
    """Return every document that the package cites."""
    by_velocity = any(not array.friction.is_constant for array in package.data.arrays)
    return (*codes(package), _PAPER, *_TIPPING, *((_BY_VELOCITY,) if by_velocity else ()))
