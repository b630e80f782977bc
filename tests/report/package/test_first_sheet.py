"""The first sheet decides on one page, whatever a project comes to."""

import re
from xml.etree import ElementTree

import pytest

from fixtures import altered_projects
from fixtures.marks import by_day
from report.assessment.design.verdict import Verdict
from report.assessment.support.evidence import support
from report.libraries import load_renderer
from report.package.html import first
from report.pages.registry import package_data
from report.typeset.pdf import _parsed

COPIES = dict(altered_projects.copies())
# With most that is NG, most conditions, none of either, and without motions.
FIRST = ("two causes and a slope", "conditions", "plainly OK", "no motions")


@pytest.mark.parametrize("name", by_day([*FIRST, *(n for n in COPIES if n not in FIRST)], 4))
def test_the_first_sheet_is_one_page_with_all_that_is_ng(name):
    done = COPIES[name]()
    html = first(package_data(done), support(done))
    load_renderer()
    from weasyprint import CSS

    # As in the package, where the contents have the numbers of all sheets.
    numbered = CSS(string=".contents p a::after { content: ': 18' !important }")
    pages = _parsed(ElementTree.fromstring(html)).render(stylesheets=[numbered]).pages
    assert len(pages) == 1
    words = " ".join(re.sub(r"<[^>]+>", " ", html).split())
    opened = done.open
    failed = [check for check in opened if check.verdict is Verdict.NG]
    assert words.count("NG") >= bool(failed)
    left = re.search(r"(\d+) more conditions?:", words)
    table = html.partition("Open conditions")[2].partition("</table>")[0]
    shown = len(re.findall(r'id="open-', table))
    assert shown + int(left[1] if left else 0) == len(opened) - len(failed)
