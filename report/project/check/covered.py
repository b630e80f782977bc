"""Record of each confirmation: its date with a short hash of each sheet, in the cell next to it.

Beside the date of review, `2026-03-01: Site 3f2a91, Arrays 01b03f`: once a cell of Arrays is
another one, the review is not of these inputs.

Reads no file and writes none. Read `CONFIRMATIONS`, then `to_record` and `outdated`.
"""

from __future__ import annotations

import datetime as dt
import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set

from report.project.model import ProjectInput
from report.project.model.array import WEIGHT_PARTS
from report.project.model.choices import FORMER_CHOICES, ClearanceSource
from report.project.model.input_rows import Place
from report.project.model.shapes import SIDES
from report.project.model.values import Frozen
from report.project.workbook import SECTION, SECTIONS
from report.project.workbook.earlier_workbooks import ORDERS
from report.text.grouping import grouped_by

_LETTERS = 6  # of a hash
# Choices are hashed by the words of 0.3.0, with which confirmations are on record.
_HASHED = {choice: former for former, choice in FORMER_CHOICES.items()}
# Fields by section.
_Covers = Mapping[str, Set[str]]

# Of what is covered, by sheet.
_Hashes = Mapping[str, str]


def _all_but(**left_out: Iterable[str]) -> _Covers:
    fields = {key: {entry.name for entry in SECTION[key].entries} for key in left_out}
    return {key: fields[key] - {*names} for key, names in left_out.items()}


# What the design displacements follow from.
_ANALYSIS = _all_but(
    site=("hazard_source", "hazard_date", "hazard_covered", "hazard_report", "hazard_printout",
          "building_code", "building_code_year", "jurisdiction", "acceptance_letter",
          "fire_code_section", "fire_lane_m", "latitude_deg", "longitude_deg", "roof_load_pa",
          "seismic_weight_n", "roof_evaluation"),
    arrays=(*SIDES, *WEIGHT_PARTS, "place_from", "interconnection_n", "slack_m",
            "roof_capacity_pa", "wind_weight_pa", "contact_pressure_pa"),
    friction_tests=("tests_covered", "report_file", "contact_pressure_pa"),
    friction_runs=(), motions=(), building=(), spectrum=(), links=(), target=(), overrides=(),
)  # fmt: skip

# Section, fields of the date and of the record, and what is covered.
CONFIRMATIONS: Sequence[tuple[str, str, str, _Covers]] = (
    ("project", "drawing_confirmed_date", "drawing_covered",
     {"clearances": {"array", "object", "direction", "provided_m"}}),
    ("site", "hazard_date", "hazard_covered",
     {"site": {"edition_name", "s_s_g", "s_1_g", "site_class", "f_a", "f_v", "s_ms_g", "s_m1_g",
               "s_ds_g", "s_d1_g", "hazard", "sdc"}}),
    ("friction_tests", "date", "tests_covered", _all_but(friction_runs=())),
    ("options", "peer_date", "peer_covered",
     {**_ANALYSIS, "options": {"statistic"}}),
    ("confirmation", "date", "covered",
     {"site": {"rule_set", "edition_name", "building_code", "building_code_year"},
      **_all_but(confirmation=("date", "covered"), overrides=())}),
)  # fmt: skip

# The fields that are no input: `roofslip report` fills them in.
COVERED = frozenset(covered for *_, covered, _ in CONFIRMATIONS)


def to_record(data: ProjectInput, records: Sequence[str]) -> Mapping[Place, str]:
    """Return the records of confirmations whose date is not yet recorded, by cell, with hashes."""
    return {
        place: f"{date}: {', '.join(f'{sheet} {short}' for sheet, short in hashes.items())}"
        for place, date, recorded, hashes, _ in _dated(data, records)
        if hashes and not recorded
    }


def outdated(data: ProjectInput, records: Sequence[str]) -> ProjectInput:
    """Return an input with the sheets that have changed since a confirmation covered them."""
    changed = {}
    for place, _, recorded, hashes, earlier in _dated(data, records):
        then = dict(part.rpartition(" ")[::2] for part in recorded.split(", "))
        # A record is of its own version, with which it differs least.
        sheets = min(_changed(then, hashes), _changed(then, earlier), key=len)
        if recorded and sheets:
            changed[place.section] = f"worksheet{'s' * (len(sheets) > 1)} {', '.join(sheets)}"
    return data.model_copy(update={"changed_sheets": tuple(changed.items())})


def _changed(then: _Hashes, hashes: _Hashes) -> Sequence[str]:
    titles = dict.fromkeys(section.sheet for section in SECTIONS)
    return [title for title in titles if then.get(title) != hashes.get(title)]


def _dated(
    data: ProjectInput, records: Sequence[str]
) -> Iterator[tuple[Place, dt.date, str, _Hashes, _Hashes]]:
    """Yield the cell and date of each confirmation, its record, and the current hashes.

    Last, the hashes as 0.3 recorded them.
    """
    for section, dated, covered, covers in CONFIRMATIONS:
        block = getattr(data, section)
        date = getattr(block, dated)
        # A review that is not stated covers nothing, whatever its date.
        if date and getattr(block, "peer_reviewed", True):
            recorded_date, _, recorded = getattr(block, covered).partition(": ")
            hashes = _hashes(covers, data, records)
            # In the order of the rows.
            earlier = _hashes(covers, data, records, is_sorted=False)
            # With another date it is another confirmation, of the inputs as they are now.
            recorded = recorded if recorded_date == str(date) else ""
            yield Place(section, 0, covered), date, recorded, hashes, earlier


def _hashes(
    covers: _Covers,
    data: ProjectInput,
    records: Sequence[str],
    *,
    is_sorted: bool = True,
) -> _Hashes:
    """Return the hash of the covered inputs, by sheet."""
    lines: dict[str, list[str]] = {}
    for key, fields in covers.items():
        rows = getattr(data, key) if SECTION[key].is_table else [getattr(data, key)]
        # What was measured or entered needs no confirmation of the drawing.
        if key == "clearances":
            rows = [row for row in rows if row.source is ClearanceSource.DRAWING]
        sheet_of_field = {name: SECTION[key].sheet_of(name) for name in sorted(fields)}
        for sheet, together in grouped_by(sheet_of_field, sheet_of_field.__getitem__).items():
            hashes = [*filter(None, (_line(key, row, together) for row in rows))]
            # The records themselves: a file may change under the same name.
            hashes += records if key == "motions" else ()
            # Sorting a table in Excel changes nothing that was confirmed.
            if hashes:
                rows_of = sorted(hashes) if is_sorted else hashes
                lines.setdefault(sheet, []).extend([key, *rows_of])
    return {
        sheet: hashlib.sha256("\n".join(parts).encode()).hexdigest()[:_LETTERS]
        for sheet, parts in lines.items()
    }


def _line(key: str, row: Frozen, fields: Sequence[str]) -> str:
    # SI with nine digits, so that a change of units is none; without defaults, so that a field that
    # a later version adds is none either.
    values = row.model_dump(include=set(fields), exclude_defaults=True)
    order = {name: number for number, name in enumerate(ORDERS.get(key, ()))}
    return "; ".join(
        f"{name} {value:.9g}" if isinstance(value, float) else f"{name} {_HASHED.get(value, value)}"
        for name, value in sorted(values.items(), key=lambda item: order.get(item[0], len(order)))
    )
