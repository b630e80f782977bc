"""The choices that cells offer. Read `report.project.model` first."""

from __future__ import annotations

import re
from enum import StrEnum
from typing import Self

from solver.records.record import UNIT_CHOICES
from solver.rules.hazard import APPROXIMATE_PERIODS, EDITIONS
from solver.rules.provisions import Basis
from solver.rules.rulesets import RULE_SETS

# Words of earlier workbooks, with those that now stand for them.
FORMER_CHOICES = {
    "unlike array": "array of different construction",
    "down": "downslope",
    "up": "upslope",
    "across": "cross-slope",
    "by size": "automatic",
    "rule set": "per rule set",
}


class _Choice(StrEnum):
    """A choice that is also read by its name in earlier workbooks."""

    @classmethod
    def _missing_(cls, value: object) -> Self | None:
        word = FORMER_CHOICES.get(str(value))
        return next((choice for choice in cls if choice.value == word), None)


class YesNo(StrEnum):
    """Yes or no, as shown in a cell."""

    YES = "Yes"
    NO = "No"


class RuleSetName(StrEnum):
    """Rule set to compare with: any of `solver.rules`."""

    _ignore_ = "_rules"
    # A rule set of the solver is a choice of the sheet without a change here. Names in `_ignore_`
    # are no members of an Enum.
    for _rules in RULE_SETS.values():
        vars()[_rules.code.upper().replace("-", "_")] = _rules.name


class EditionName(StrEnum):
    """Edition of ASCE 7 for the seismic parameters: any of `solver.rules.hazard`."""

    _ignore_ = "_name"
    for _name in EDITIONS:
        vars()[_name.upper().replace(" ", "_").replace("-", "_")] = _name


class BuildingCode(StrEnum):
    """Building code that the jurisdiction adopts."""

    IBC = "IBC"
    CBC = "CBC"


class UnitsFirst(StrEnum):
    """System of units printed first."""

    US = "US"
    SI = "SI"

    @property
    def is_us(self) -> bool:
        """Whether inches and pounds come first."""
        return self is UnitsFirst.US


class RiskCategory(StrEnum):
    """Risk category, ASCE 7 Table 1.5-1."""

    I = "I"  # noqa: E741
    II = "II"
    III = "III"
    IV = "IV"

    @classmethod
    def _missing_(cls, value: object) -> RiskCategory | None:
        return dict(zip(("1", "2", "3", "4"), cls, strict=True)).get(str(value))


class SiteClass(StrEnum):
    """Site class, ASCE 7 Chapter 20; BC, CD and DE were added in the 2022 edition."""

    A = "A"
    B = "B"
    BC = "BC"
    C = "C"
    CD = "CD"
    D = "D"
    # Where the soil is not known: F_a is then at least 1.2 (ASCE 7-16, 11.4.4).
    D_DEFAULT = "D (default)"
    DE = "DE"
    E = "E"
    F = "F"


class Sdc(StrEnum):
    """Seismic design category, ASCE 7 Section 11.6."""

    A = "A"
    B = "B"
    C = "C"
    D = "D"
    E = "E"
    F = "F"


class SlopeUnit(StrEnum):
    """Unit of a roof slope."""

    DEGREES = "degrees"
    PERCENT = "percent"
    IN_PER_12 = "in/12"

    @classmethod
    def _missing_(cls, value: object) -> SlopeUnit | None:
        named = {"°": cls.DEGREES, "deg": cls.DEGREES, "%": cls.PERCENT, "in/ft": cls.IN_PER_12}
        return named.get(str(value))


class LayerKind(_Choice):
    """Content of the closed lines on a layer of a roof drawing."""

    ARRAY = "array"
    FIXED = "fixed object"
    UNLIKE_ARRAY = "array of different construction"
    EDGE_WITH_PARAPET = "edge with parapet"
    EDGE_WITHOUT_PARAPET = "edge without parapet"
    ROOF = "roof"
    NOT_READ = "not read"


class ObjectKind(_Choice):
    """Type of item that an array could strike or fall from."""

    FIXED = "fixed object"
    UNLIKE_ARRAY = "array of different construction"
    EDGE_WITH_PARAPET = "edge with parapet"
    EDGE_WITHOUT_PARAPET = "edge without parapet"


class Direction(_Choice):
    """Direction of a clearance from the array."""

    DOWN = "downslope"
    UP = "upslope"
    ACROSS = "cross-slope"
    ANY = "any"


class ClearanceSource(StrEnum):
    """Source of the distance of a clearance, as entered in the workbook."""

    MEASURED = "measured"
    DRAWING = "drawing"


class DistanceBasis(StrEnum):
    """Basis of the distance of a clearance, as the package prints it."""

    ENTERED = "as entered"
    MEASURED = "measured"
    DRAWN = "drawing, not confirmed"
    CONFIRMED = "drawing, confirmed"


class AccelUnit(StrEnum):
    """Unit of a motion record: that of the file, or any of `solver.records.record`."""

    _ignore_ = "_unit"
    FROM_FILE = "from file"
    for _unit in UNIT_CHOICES:
        vars()[_unit.upper().replace("/", "_")] = _unit


class Scaling(StrEnum):
    """How a record is scaled; the PPA is the peak of the horizontal component."""

    AS_RECORDED = "as recorded"
    FACTOR = "factor"
    PPA = "PPA"
    TARGET = "target spectrum"


class RecordedAt(StrEnum):
    """Where a motion was recorded, or for which level it was generated."""

    ROOF = "roof"
    GROUND = "ground"


class Baseline(StrEnum):
    """Baseline fitted to an acceleration and subtracted."""

    NONE = "none"
    MEAN = "mean"
    LINEAR = "linear"
    QUADRATIC = "quadratic"
    CUBIC = "cubic"


class StructureType(StrEnum):
    """Structure type for the approximate period (ASCE 7, Table 12.8-2)."""

    _ignore_ = "_system"
    for _system in APPROXIMATE_PERIODS:
        vars()[re.sub(r"\W", "_", _system).upper()] = _system


class Polarity(StrEnum):
    """Signs of the horizontal component to run."""

    BOTH = "both"
    AS_RECORDED = "as recorded"
    REVERSED = "reversed"


class PackageEdition(StrEnum):
    """Contents of a package."""

    PLAN_CHECK = "plan check"
    COMPLETE = "complete"
    LETTER = "letter"


class PlanPaper(_Choice):
    """Paper of the roof plan; the rest of the package is on Letter, or with A4 and A3 on A4."""

    BY_SIZE = "automatic"
    LETTER = "Letter"
    TABLOID = "11 x 17"
    A4 = "A4"
    A3 = "A3"


class Statistic(_Choice):
    """Statistic that gives the design value from the peaks of all motions."""

    _ignore_ = "_basis"
    RULE_SET = "per rule set"
    for _basis in Basis:
        if _basis is not Basis.TOO_FEW:
            vars()[_basis.name] = _basis.value
