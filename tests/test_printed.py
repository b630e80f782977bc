"""A page is read as its reader has it: lines, and tables by their headings."""

import pytest

import printed

pytestmark = pytest.mark.quick

HTML = """<html data-head="24   X" data-foot="Date &#10;Hash 1"><body>
<section class="cover"><h1><span class="no">1</span> Title</h1>
<div class="whole"><p class="caption">Lengths</p><table><thead>
<tr><th>Array</th><th colspan="2">Design</th><th>Verdict</th></tr>
<tr class="units"><td/><td>in</td><td>mm</td><td/></tr></thead><tbody>
<tr><td>A1</td><td>1.0<span class="mark">†</span></td><td>25</td><td><b class="ng">NG</b></td></tr>
<tr class="total"><td colspan="2">Mean of  all</td><td>26</td><td/></tr></tbody></table>
<p class="note">A note.</p></div>
<ul><li>S<sub>DS</sub>, 2<sup>3</sup> and <span class="frac"><span>a + b</span><span>n</span></span>
<ul><li>below <a class="to" href="#part"></a></li></ul></li></ul>
<table class="key"><tbody><tr><th>Slope</th><td>2°</td></tr></tbody></table>
<p>To<br/>whom <img alt="picture"/></p></section></body></html>"""


@pytest.fixture
def page():
    return printed.read(HTML)


def test_the_words_stand_line_by_line(page):
    assert page.splitlines() == [
        "24 X", "Date", "Hash 1", "", "# 1 Title", "Lengths", "Array | Design | Verdict",
        " | in | mm", "A1 | 1.0† | 25 | NG", "Mean of all | 26", "A note.",
        "- SDS, 2^3 and (a + b)/(n)", "- below (#part)", "Slope | 2°", "To", "whom [picture]",
    ]  # fmt: skip


def test_a_cell_is_found_by_caption_row_and_heading(page):
    table = page.table("Lengths")
    assert table.row("A1") == {
        "Array": "A1", "Design [in]": "1.0†", "Design [mm]": "25", "Verdict": "NG",
    }  # fmt: skip
    assert table.column("Design [mm]") == ["25", "26"]
    assert (table.notes, table.kinds) == (("A note.",), ("", "total"))
    assert page.facts == {"Slope": "2°"}
    with pytest.raises(AssertionError, match="no table 'Widths' among"):
        page.table("Widths")
