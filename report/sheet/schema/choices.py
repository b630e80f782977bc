"""The choices that cells offer, and the kinds of text and number that they take.

Owns no fields and no labels. Read `report.sheet.schema` first.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from pydantic import Field

MAX_TEXT = 2000


Text = Annotated[str, Field(max_length=MAX_TEXT)]
RequiredText = Annotated[str, Field(min_length=1, max_length=MAX_TEXT)]
Id = Annotated[str, Field(min_length=1, max_length=40)]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]


class RuleSetName(StrEnum):
    """Rule set to compare with."""

    PV1_2012 = "SEAOC PV1-2012"
    ASCE_7_16 = "ASCE 7-16"
    ASCE_7_22 = "ASCE 7-22"


class UnitsFirst(StrEnum):
    """System of units printed first."""

    US = "US"
    SI = "SI"


class RiskCategory(StrEnum):
    """Risk category, ASCE 7 Table 1.5-1."""

    I = "I"  # noqa: E741
    II = "II"
    III = "III"
    IV = "IV"


class SiteClass(StrEnum):
    """Site class, ASCE 7 chapter 20; the halves came with the 2022 edition."""

    A = "A"
    B = "B"
    BC = "BC"
    C = "C"
    CD = "CD"
    D = "D"
    D_DEFAULT = "D (default)"
    DE = "DE"
    E = "E"
    F = "F"


class Sdc(StrEnum):
    """Seismic design category, ASCE 7 section 11.6."""

    A = "A"
    B = "B"
    C = "C"
    D = "D"
    E = "E"
    F = "F"


class SlopeUnit(StrEnum):
    """How a roof slope is written."""

    DEGREES = "degrees"
    PERCENT = "percent"
    IN_PER_12 = "in/12"


class ObjectKind(StrEnum):
    """What an array could strike or fall from."""

    FIXED = "fixed object"
    UNLIKE_ARRAY = "unlike array"
    EDGE_WITH_PARAPET = "edge with parapet"
    EDGE_WITHOUT_PARAPET = "edge without parapet"


class Model(StrEnum):
    """Model of an array's motion: the least that answers, or one that is asked for."""

    CHOOSE = "choose"
    ONE_AXIS = "one axis"
    ONE_AXIS_VERTICAL = "one axis with vertical"
    TWO_AXES = "two axes with vertical"


class Direction(StrEnum):
    """Where a clearance lies, seen from the array."""

    DOWN = "down"
    UP = "up"
    ACROSS = "across"
    ANY = "any"


class AccelUnit(StrEnum):
    """Unit of a motion record."""

    FROM_FILE = "from file"
    G = "g"
    M_S2 = "m/s2"
    CM_S2 = "cm/s2"
    MM_S2 = "mm/s2"
    GAL = "gal"


class Scaling(StrEnum):
    """How a record is scaled; a PPA is a peak of the horizontal component."""

    AS_RECORDED = "as recorded"
    FACTOR = "factor"
    PPA = "PPA"
    TARGET = "target spectrum"


class RecordedAt(StrEnum):
    """Where a motion was recorded, or made for."""

    ROOF = "roof"
    GROUND = "ground"


class Baseline(StrEnum):
    """What is fitted to an acceleration and taken off."""

    NONE = "none"
    MEAN = "mean"
    LINEAR = "linear"
    QUADRATIC = "quadratic"
    CUBIC = "cubic"


class StructureType(StrEnum):
    """Seismic system, as far as its approximate period knows it (ASCE 7, Table 12.8-2)."""

    STEEL_MOMENT_FRAME = "steel moment frame"
    CONCRETE_MOMENT_FRAME = "concrete moment frame"
    STEEL_BRACES = "steel eccentric or buckling-restrained braces"
    OTHER = "other"


class TailRule(StrEnum):
    """How an AC156 spectrum falls below 1.3 Hz."""

    AC156 = "AC156"
    RECIPROCAL = "1/T"


class Polarity(StrEnum):
    """Signs of the horizontal component to run."""

    BOTH = "both"
    AS_RECORDED = "as recorded"
    REVERSED = "reversed"


class Statistic(StrEnum):
    """From the peaks of all motions to one value."""

    RULE_SET = "rule set"
    MEAN_1_1 = "1.1 x mean"
    LARGEST_1_1 = "1.1 x largest"
    MEAN = "mean"
