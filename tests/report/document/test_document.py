"""Tables of a document, which rows are one and what a cell takes; and its templates, compiled."""

import math
from dataclasses import replace
from operator import itemgetter

import pytest
from markupsafe import Markup

from fixtures.spaces import spaced
from report.cli.console import plain
from report.document.columns import required, text, words
from report.document.tables import Wide, listed, merged
from report.document.templates import rendered, state_of
from report.text.unit_format import UnitFormat
from report.text.units import Quantity, no_less, pair, with_unit

pytestmark = pytest.mark.quick


COLUMNS = (
    (words("Array", 0.8), itemgetter(0)),
    (text("Limit"), itemgetter(1)),
    (words("Side", 0.5), itemgetter(2)),
)


def rows_of(rows, *fields, style=lambda _: "", once=False):
    table = merged(listed(rows, COLUMNS, style=style), *fields, once=once)
    return [row.cells for row in table.rows], [column.share for column in table.columns]


def test_a_column_has_its_share_or_more_and_only_a_word_too_long_for_its_table_is_broken():
    cells = ("NORTHWEST CORNER, ARRAY 07", "1.5 in", "PENTHOUSE-MECHANICAL")
    table = listed([cells], COLUMNS)
    short = listed([("A1", "1.5 in", "east")], COLUMNS)
    assert [width for *_, width in short.heads] == ["34.78%", "43.48%", "21.74%"]
    # Long names have more room, beside a row that spans columns as well.
    wide = listed([cells, ("B1", Wide("none", 2), "")], COLUMNS)
    assert [width for *_, width in wide.heads] == ["40.51%", "28.33%", "31.16%"]
    ((_, placed),) = table.body
    assert [style for *_, style in placed] == ["left", "right", "left long"]
    ((_, placed),) = replace(table, is_narrow=True).body
    assert [style for *_, style in placed] == ["left long", "right", "left long"]


def test_tags_of_a_cell_take_no_room():
    names = [(Markup("<i>S</i><sub>DS</sub> and <i>S</i>"), "1.5 in", Markup("<b>OK</b>"))]
    plain = [("S_DS and S", "1.5 in", "OK")]
    assert listed(names, COLUMNS).heads == listed(plain, COLUMNS).heads
    ((_, placed),) = replace(listed(names, COLUMNS), is_narrow=True).body
    assert [style for *_, style in placed] == ["left", "right", "left"]


def test_rows_that_differ_in_names_alone_are_one_and_their_column_is_wider():
    rows = [(name, "4" if name == "A2" else "3", "x") for name in ("A1", "A2", "A3", "A4", "A5")]
    cells, _ = rows_of(rows)
    assert cells == [("A1, A3 to A5", "3", "x"), ("A2", "4", "x")]
    rows = [("10", "3", "A"), ("2", "3", "A"), ("1", "3", "B"), ("3", "3", "B"), ("4", "5", "A")]
    cells, _ = rows_of(rows, "Array", "Side")
    assert cells == [("1 to 3, 10", "3", "B, A, B, A"), ("4", "5", "A")]
    rows = [("1", "3", "A"), ("2", "3", "A"), ("1", "4", "B"), ("1", "4", "A"), ("2", "4", "C")]
    cells, _ = rows_of(rows, "Array", "Side")
    assert cells == [("1, 2", "3", "A"), ("1, 2", "4", "B and A, C")]
    rows = [("1", "3", "A2"), ("1", "3", "A1"), ("2", "3", "A3"), ("3", "3", "A2"), ("9", "4", "B")]
    cells, _ = rows_of(rows, "Array", "Side", once=True)
    assert cells == [("1 to 3", "3", "A1 to A3"), ("9", "4", "B")]
    wide = Wide("Mean", 1)
    rows = [("A1", "3", "x"), ("A2", "3", "x"), (wide, "3", "x"), ("A3", "3", "x")]
    cells, _ = rows_of(rows, style=lambda row: "" if row[0] == "A1" else "total")
    assert cells == [("A1", "3", "x"), ("A2, A3", "3", "x"), (wide, "3", "x")]
    assert rows_of([("A1", "3", "x")])[1] == [0.8, 1.0, 0.5]
    two = [(name, "3", "x") for name in ("A1", "A2")]
    many = [(f"A{number}", "3", "x") for number in range(1, 40, 2)]
    (narrow, *others), (wide, *same) = rows_of(two)[1], rows_of(many)[1]
    assert others == same == [1.0, 0.5]
    assert 0.8 == narrow < wide < 2.0


def template(folder):
    (folder / "a.html").write_text("{{ 1.5 | number(2) }}")
    return rendered(folder, "a.html", {})


def test_a_template_is_kept_compiled_until_the_state_of_code_changes(tmp_path):
    assert template(tmp_path) == "1.50"
    (kept,) = (tmp_path / "__pycache__").iterdir()
    assert kept.stat().st_size
    module = tmp_path / "below" / "filters.py"
    module.parent.mkdir()
    states = [state_of(tmp_path)]
    for code in ("a = 1", "a = 22"):
        module.write_text(code)
        states.append(state_of(tmp_path))
    assert len({*states}) == 3


def test_where_nothing_can_be_kept_a_template_is_compiled(tmp_path):
    (tmp_path / "__pycache__").symlink_to(tmp_path / "gone" / "away")
    assert template(tmp_path) == "1.50"


def test_a_page_keeps_a_number_and_its_unit_together_and_the_screen_has_plain_blanks(tmp_path):
    (tmp_path / "page.html").write_text("<b>{{ words }}</b>", encoding="utf-8")
    words = f"{pair(0.3048, Quantity.SIZE)} < 3 inches, {with_unit('1.5', 'g')}"
    page = rendered(tmp_path, "page.html", {"words": words})
    assert page == "<b>12.0\u00a0in (305\u00a0mm) &lt; 3 inches, 1.5\u00a0g</b>"
    assert plain(words) == "12.0 in (305 mm) < 3 inches, 1.5 g"


@pytest.mark.parametrize(
    ("us_first", "cells", "both"),
    [(True, ("19.7†", "500†"), "19.7 in (500 mm)†"),
     (False, ("500†", "19.7†"), "500 mm (19.7 in)†")],
)  # fmt: skip
def test_a_quantity_is_shown_in_both_systems_with_its_mark(us_first, cells, both):
    fmt = UnitFormat(us_first=us_first)
    columns = [(required("Required"), lambda value_m: value_m, lambda _: "†")]
    known, unknown = listed([0.5, math.nan], columns, fmt).rows
    assert known.cells == cells
    assert spaced(fmt.both(0.5, show=no_less, mark="†")) == both
    assert unknown.cells == ("none", "none")
    assert fmt.both(math.nan, mark="†") == "none"
