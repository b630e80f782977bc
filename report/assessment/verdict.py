"""The three verdicts, and the requirements that lead to them beside the numeric limits.

What follows from a requirement is stated where it is made. Read `Requirement`, then `worst`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from enum import StrEnum
from functools import partial
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationInfo, field_validator
from pydantic.json_schema import SkipJsonSchema

from report.sheet.schema import Override, ProjectInput, provision_name, provision_unit
from report.sheet.schema.choices import RuleSetName, Statistic
from report.sheet.schema.fields import Place
from report.text.counts import grouped_by, lowered, ranged
from solver.rules.hazard import REFERENCED
from solver.rules.limit import Consequence
from solver.rules.provisions import RULE_SETS, Basis, RuleSet
from solver.rules.rulesets import ALLOWED, IBC_SECTION, IBC_SLOPE


class Verdict(StrEnum):
    """Verdict on a project, an array or a clearance.

    NONE is of a clearance beside an array without a permitted route, whose own verdict is NG. NOTE
    is of a requirement on what no design displacement follows from. CONDITIONS is of a project,
    CONDITION of anything in it.
    """

    # From the mildest to the most severe: `worst` takes them in this order.
    NONE = "none"
    NOTE = "note"
    OK = "OK"
    CONDITION = "Condition"
    CONDITIONS = "OK with conditions"
    NG = "NG"

    @property
    def is_permitted(self) -> bool:
        """Whether it is not NG."""
        return self is not Verdict.NG


# Verdict in a project; results.json of version 0.2 has the project's word for a condition.
ItemVerdict = Annotated[
    Verdict, AfterValidator(lambda read: Verdict.CONDITION if read is Verdict.CONDITIONS else read)
]

BY_CONSEQUENCE = {
    Consequence.NG: Verdict.NG,
    Consequence.CONDITION: Verdict.CONDITION,
    Consequence.NOTE: Verdict.NOTE,
}


def _all_are_written(schema: dict[str, Any]) -> None:
    schema["required"] = list(schema["properties"])


def _verdict(fields: dict[str, Any]) -> Verdict:
    return Verdict.OK if fields["is_satisfied"] else BY_CONSEQUENCE[fields["consequence"]]


class Requirement(BaseModel):
    """A requirement compared with the project, as results.json has it."""

    model_config = ConfigDict(frozen=True, json_schema_extra=_all_are_written)

    id: str
    """Kind of requirement."""
    title: str
    """As printed."""
    found: str
    """As printed."""
    limit: str
    """As printed."""
    basis: str
    """Document and clause, or whose practice it is."""
    is_satisfied: bool
    """Whether the project satisfies it."""
    consequence: Consequence
    """Where it is not satisfied."""
    subject: str = ""
    """Id of the array or motion that it concerns; empty for the project."""
    remedy: str = ""
    """What the engineer must do where it is not satisfied, as a sentence."""
    outcome: str = ""
    """What another input in its place comes to, as a sentence."""
    verdict: ItemVerdict = Field(default_factory=_verdict)
    """Of this requirement alone."""
    # what the verdict of the subject calls it; empty for its title
    cause: SkipJsonSchema[str] = Field(default="", exclude=True)
    # the cells to fill in or to change; none of what `check` does not know
    places: SkipJsonSchema[tuple[Place, ...]] = Field(default=(), exclude=True)

    @field_validator("remedy", "outcome")
    @classmethod
    def _only_where_it_is_needed(cls, text: str, fields: ValidationInfo) -> str:
        return "" if fields.data["is_satisfied"] else text

    @property
    def asked(self) -> tuple[str, ...]:
        """What is printed of it beside its subject and what is found there."""
        if self.id == PLAN_ROW:
            return self.consequence.value, self.found, self.limit, self._cell_and_words[1]
        return self.consequence.value, self.title, self.limit, self.remedy

    @property
    def _cell_and_words(self) -> tuple[str, ...]:
        return tuple(self.remedy.split(": ", 1))


def as_one(rows: Sequence[Requirement]) -> Requirement:
    """Return rows that ask the same as one; what only some find has their subject before it."""
    if rows[0].id == PLAN_ROW and rows[1:]:  # named in the title, with cells before the remedy
        names = ", ".join(row.title.removeprefix("Clearance ") for row in rows)
        cells, words = zip(*(row._cell_and_words for row in rows), strict=True)
        text = f"{', '.join(dict.fromkeys(cells))}: {words[0]}"
        return rows[0].model_copy(
            update={"subject": "", "title": f"Clearances {names}", "remedy": text}
        )
    # What is found has parts: those that all rows share are said once.
    parts = [row.found.split("; ") for row in rows]
    alike = [part for part in parts[0] if all(part in others for others in parts)]
    own = grouped_by(
        zip(rows, parts, strict=True),
        lambda pair: ", ".join(part for part in pair[1] if part not in alike),
    )
    others = [f"{ranged(row.subject for row, _ in of)}: {text}" for text, of in own.items() if text]
    outcomes = " ".join(row.outcome for row in rows if row.outcome)
    return rows[0].model_copy(update={"found": "; ".join([*alike, *others]), "outcome": outcomes})


# A requirement that is a condition where it is not satisfied.
condition = partial(Requirement, consequence=Consequence.CONDITION)


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the most severe verdict; OK for none."""
    return max(verdicts, key=severity, default=Verdict.OK)


def severity(verdict: Verdict) -> int:
    """Return a sort key of verdicts, the largest for NG."""
    return list(Verdict).index(verdict)


# Fraction by which the friction coefficients are decreased and increased; a verdict that less
# friction changes is a condition.
SHIFT = 0.05

NOT_GIVEN = "not given"
NO_DESIGN = "unknown without a permitted design displacement"
# Id of the limits on the motions.
MOTIONS_ID = "motions"
# Id of the requirement on friction beyond the velocities tested.
VELOCITY_ROW = "friction_velocity"
# Id of the requirement that clearances are given as the plan has them.
PLAN_ROW = "neighbors"
# Id of the requirement on the strength between the parts of an array.
STRENGTH_ROW = "interconnection"
# Of a remedy whose outcome the workbook has no cell for: no input takes the condition away.
STAYS = "The condition stays for the plan checker."


def stated(section: str, **parts: tuple[str, object]) -> Mapping[str, Any]:
    """Return what a block states of several parts, name and value by field, and what it lacks."""
    parts_stated = [str(value) for _, value in parts.values() if value]
    missing = {field: name for field, (name, value) in parts.items() if not value}
    lacks = [f"{', '.join(missing.values())} {NOT_GIVEN}"] if missing else []
    return {
        "found": "; ".join([*parts_stated, *lacks]) if parts_stated else NOT_GIVEN,
        "is_satisfied": not missing,
        "places": tuple(Place(section, 0, field) for field in missing),
    }


# Mark of a number that an override or a departure changes.
OVERRIDDEN = "‡"

MEANING = f"{OVERRIDDEN}: changed by an override or a departure"

OVERRIDE_ID = "override"
# Ids of the rows here.
LOWERING = (OVERRIDE_ID, "statistic")

CONSENT = f"Obtain the consent of the authority having jurisdiction. {STAYS}"


def override_rows(data: ProjectInput) -> tuple[Requirement, ...]:
    """Return what requires less than the rule set: each override that does, and each departure."""
    rules = RULE_SETS[data.site.rule_set]
    overrides = (
        _override(rules, index, row)
        for index, row in enumerate(data.overrides)
        if (rule := rules.values.get(row.provision)) is not None
        # One on the safe side needs nobody's consent.
        and ALLOWED[row.provision].lowers(row.value, rule.value)
    )
    return (*overrides, *_departures(data, rules))


def rule_set_of(data: ProjectInput) -> RuleSet:
    """Return the rule set of a project with its overrides, as it was confirmed.

    Raises `InputError` for an override of a provision that the rule set does not have.
    """
    changes = {row.provision: (row.value, row.reason) for row in data.overrides}
    rules = RULE_SETS[data.site.rule_set].overridden(changes)
    code, year = data.site.building_code, data.site.building_code_year
    if code:  # the slope limit of the IBC by the code that is adopted
        limit = replace(rules.values[IBC_SLOPE], clause=f"{code} {IBC_SECTION}, {year}")
        rules = replace(rules, values={**rules.values, IBC_SLOPE: limit})
    return rules.confirmed() if data.confirmed else rules


def as_adopted(data: ProjectInput) -> ProjectInput:
    """Return an input without its overrides and departures; the input itself if it has none."""
    chosen = data.options
    # PV1-2012 states 1.1 x the mean or the largest; ASCE 7 states no statistic to depart from.
    statistic = Statistic.RULE_SET if _takes_plain_mean(data) else chosen.statistic
    if not data.overrides and statistic is chosen.statistic:
        return data
    options = chosen.model_copy(update={"statistic": statistic})
    return data.model_copy(update={"overrides": (), "options": options})


def under_code(data: ProjectInput) -> ProjectInput:
    """Return an input under the rule set of its building code as adopted; itself if it has that."""
    site = data.site
    name = REFERENCED.get(site.code_text, site.rule_set)
    if name == site.rule_set:
        return data
    values = {f"{symbol}_g": value for symbol, value in asdict(site.parameters).items()}
    # With what it derives: another edition may not.
    other = site.model_copy(update=values | {"rule_set": RuleSetName(name), "edition_name": None})
    return as_adopted(data.model_copy(update={"site": other}))


def nan_is_worst(value: float) -> float:
    """Return a sort key in which NaN is the largest."""
    return math.inf if math.isnan(value) else value


def mark_of(value: float, adopted: float) -> str:
    """Return the mark of a number that is another under the rule set as adopted; none for NaN."""
    return "" if math.isnan(value) or value == adopted else OVERRIDDEN


def _override(rules: RuleSet, index: int, row: Override) -> Requirement:
    rule, unit = rules.values[row.provision], provision_unit(row.provision)
    value, adopted = (f"{v:.4g} {unit}".rstrip() for v in (row.value, rule.value))
    sign = "≤" if ALLOWED[row.provision].is_maximum else "≥"
    return _row(
        title=f"Override of the {lowered(provision_name(row.provision))}",
        id=OVERRIDE_ID,
        found=f"{value}{OVERRIDDEN}, {row.reason}",
        limit=f"{sign} {adopted}",
        basis=rule.clause,
        places=(Place("overrides", index, "value"),),
    )


def _departures(data: ProjectInput, rules: RuleSet) -> Iterator[Requirement]:
    if _takes_plain_mean(data):
        yield _row(
            id="statistic",
            title="Design value statistic",
            found=f"{data.options.statistic}{OVERRIDDEN}",
            limit="statistic of the rule set, with its factor",
            basis=rules.values["analysis_factor"].clause,
            places=(Place("options", 0, "statistic"),),
        )


def _takes_plain_mean(data: ProjectInput) -> bool:
    """Whether the workbook requests a mean without factor where the rule set has one."""
    is_stated = RULE_SETS[data.site.rule_set].statistic_is_stated
    return is_stated and data.options.statistic.value == Basis.MEAN.value


_row = partial(condition, is_satisfied=False, remedy=CONSENT)
