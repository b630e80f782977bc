"""Which cells a begun row or block still lacks, as formulas for the sheet.

The same conditions mark cells red and count them; `checks` applies its own after reading. Read
`layout` first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby

from report.sheet.fields import Entry, entries
from report.sheet.layout import BlockPlace, TablePlace

_SIDES = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
_ANY_SIDE = f'TRIM({"&".join(f"{{{side}}}" for side in _SIDES)})<>""'

CONDITIONS: Mapping[tuple[str, str], str] = {
    ("site", "s_ds_g"): 'live_s_ds=""',
    **{("roof", side): _ANY_SIDE for side in _SIDES},
    **{("arrays", side): "COUNTIF(live_outlines,{id})=0" for side in _SIDES},
    **{("objects", side): _ANY_SIDE for side in _SIDES},
    ("objects", "height_m"): '{kind}="edge with parapet"',
    ("arrays", "mu_fast"): 'TRIM({mu_rate_s_per_m})<>""',
    ("arrays", "mu_rate_s_per_m"): 'TRIM({mu_fast})<>""',
    # A pasted column does not state them.
    ("motions", "units"): 'ISNUMBER(FIND("!",{record}))',
    ("motions", "dt_s"): 'ISNUMBER(FIND("!",{record}))',
    ("motions", "scale_value"): 'OR({scaling}="factor",{scaling}="PPA")',
    ("building", "period_s"): 'AND(live_ground_motions>0,TRIM({structure})="")',
    **{
        ("options", field): f'{{{answer}}}="Yes"'
        for answer, fields in (
            ("peer_reviewed", "peer_reviewer peer_license peer_date"),
            (
                "directional",
                "directional_reason directional_reviewer directional_license directional_date",
            ),
        )
        for field in fields.split()
    },
}
"""When an optional cell is required, in terms of other cells of its row or block."""


def condition(section: str, entry: Entry, refer: Callable[[str], str]) -> str:
    """Return when an optional cell is required, with references to cells; empty for never."""
    text = CONDITIONS.get((section, entry.name), "")
    for name in _names(text):
        text = text.replace(f"{{{name}}}", refer(name))
    return text


def _names(text: str) -> set[str]:
    return {part.split("}")[0] for part in text.split("{")[1:]}


def row_status(place: TablePlace) -> str:
    """Return the number of cells that a begun row lacks; an empty text for a row not begun.

    Negative where a choice among them is none of its list: it is counted as if it were missing.
    """
    fields = entries(place.section.model)
    lacking = [_count(place, run, '=""') for run in _runs(place, _required(fields))]
    for entry in fields:
        needed = condition(place.section.key, entry, place.this)
        if needed:
            lacking.append(f'IF(AND({needed},TRIM({place.this(entry.name)})=""),1,0)')
    begun = "+".join(_count(place, run, '<>""') for run in _runs(place, [e.name for e in fields]))
    missing = "+".join(lacking)
    wrong = "+".join(
        f"IF({is_unknown(place.this(entry.name), entry)},1,0)" for entry in fields if entry.choices
    )
    count = f"IF({wrong}=0,{missing},-({missing}+{wrong}))" if wrong else missing
    return f'IF({begun}=0,"",{count})'


def is_unknown(cell: str, entry: Entry) -> str:
    """Return whether a filled cell has a text that is none of its choices."""
    known = f"|{'|'.join(entry.choices)}|".casefold()
    return f'AND(TRIM({cell})<>"",ISERROR(FIND("|"&LOWER(TRIM({cell}))&"|","{known}")))'


def _required(fields: Sequence[Entry]) -> list[str]:
    return [entry.name for entry in fields if entry.is_required]


def _count(place: TablePlace, run: tuple[str, str], test: str) -> str:
    return f"SUMPRODUCT(--(TRIM({place.these(*run)}){test}))"


def _runs(place: TablePlace, names: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield first and last of the columns that stand side by side."""
    order = {name: count for count, name in enumerate(place.letters)}
    ranked = sorted(names, key=order.__getitem__)
    for _, group in groupby(enumerate(ranked), lambda item: order[item[1]] - item[0]):
        run = [name for _, name in group]
        yield run[0], run[-1]


def block_lacks(place: BlockPlace) -> str:
    """Return the number of cells that a block lacks; empty if it requires none."""
    parts = []
    for entry in entries(place.section.model):
        name = place.section.cell_name(entry.name)
        blank = f'TRIM({name})=""'
        needed = condition(place.section.key, entry, place.section.cell_name)
        if entry.is_required:
            parts.append(f"IF({blank},1,0)")
        elif needed:
            parts.append(f"IF(AND({needed},{blank}),1,0)")
    return "+".join(parts)


def block_wrong(place: BlockPlace) -> str:
    """Return the number of cells of a block with a text that is none of their choices."""
    name = place.section.cell_name
    chosen = [entry for entry in entries(place.section.model) if entry.choices]
    return "+".join(f"IF({is_unknown(name(entry.name), entry)},1,0)" for entry in chosen)


def block_begun(place: BlockPlace) -> str:
    """Return whether any required cell of a block is filled; empty if it requires none."""
    names = _required(entries(place.section.model))
    return f'TRIM({"&".join(place.cell(name) for name in names)})<>""' if names else ""
