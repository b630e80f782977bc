"""calc-package.html says what the package says, and its policy allows nothing else to be loaded."""

import base64
import hashlib
import re
from html import unescape
from itertools import takewhile

import pytest

import report.page_file.page
from fixtures import assessments, packages
from report.page_file.page import SECTIONS, page


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    return packages.reported(tmp_path_factory, "example", packages.results_alone)


def words(markup):
    """The words of a part of a document."""
    bare = re.sub(r"<svg.*?</svg>|<[^>]+>", " ", markup, flags=re.DOTALL)
    return " ".join(unescape(bare).split())


def drawn(*shapes):
    """A package whose plan has the shapes."""
    paths = "".join(f'<g id="{name}"><path d="M0 0"/></g>' for name in shapes)
    plan = f'<svg xmlns="http://www.w3.org/2000/svg"><metadata/>{paths}</svg>'
    source = base64.b64encode(plan.encode()).decode()
    figure = f'<figure><img alt="Plan" src="data:image/svg+xml;base64,{source}"/></figure>'
    heading = '<h1 id="plan"><span class="no">4</span> Plan</h1>'
    return f"<html><body><section>{heading}{figure}</section></body></html>"


def test_the_sections_have_the_words_of_the_package(reported):
    package = (reported.out / "calc-package.pdf").read_text()  # before its layout
    shown = (reported.out / "calc-package.html").read_text()
    package = re.sub(r'<section class="contents">.*?</section>', "", package, flags=re.DOTALL)
    parts = re.split(r"<section[^>]*>", package)
    for id in SECTIONS:
        # A section without a heading belongs to the one before it.
        at = next(k for k, part in enumerate(parts) if f'<h1 id="{id}">' in part)
        given = [parts[at], *takewhile(lambda part: "<h1" not in part, parts[at + 1 :])]
        (found,) = re.findall(rf'<section id="{id}">(.*?)</section>', shown, re.DOTALL)
        legend = r"<figcaption class=.shades.*?</figcaption>"
        of_part = re.sub(legend, "", found, flags=re.DOTALL)
        # Its numbers of sheets are those of sections here.
        of_part = re.sub(r'(<a[^>]*class="at"[^>]*>)\d+', r"\1", of_part)
        of_part = of_part.replace(">Section</th>", ">Sheet</th>")
        assert words(of_part) == words(" ".join(part.partition("</section>")[0] for part in given))
    assert words(shown.partition("<title>")[2]).startswith("OK: Distribution Warehouse")


def test_its_policy_allows_its_own_style_alone_and_it_names_no_address(reported):
    shown = (reported.out / "calc-package.html").read_text()
    (policy,) = map(unescape, re.findall(r'Content-Security-Policy" content="([^"]*)"', shown))
    (css,) = re.findall(r"<style>(.*?)</style>", shown, re.DOTALL)
    own = base64.b64encode(hashlib.sha256(css.encode()).digest()).decode()
    assert policy.startswith("default-src 'none'; ")
    assert f"style-src 'sha256-{own}'" in policy
    assert "unsafe-inline" not in policy
    # Where a browser would load from: an xmlns is a name.
    assert not re.search(r'(?:src|href)="(?!#)', shown)
    assert set(re.findall(r'href="#([^"]*)"', shown)) <= set(SECTIONS)
    assert set(re.findall(r"url\((\w+):", css)) == {"data"}
    assert not re.search(r'<[^>]+ (?:style|on\w+)="', shown)


def test_arrays_are_shaded_by_their_largest_ratio_and_names_are_no_anchors():
    assessment = assessments.usual()
    found = page(drawn("A1", "RTU-1"), assessment, "0" * 12, b"{}").decode()
    ratio = assessment.governing_gap("A1").demand_capacity
    step = sum(ratio > limit for limit in (0.5, 0.8, 1.0))
    assert f'<g class="shade-{step}"><path' in found
    assert 'id="A1"' not in found
    assert 'id="RTU-1"' not in found
    assert "metadata" not in found


def test_a_file_that_would_be_too_large_computes_nothing_and_says_so(monkeypatch):
    monkeypatch.setattr(report.page_file.page, "MOST_BYTES", 200_000)
    with pytest.warns(
        match=r"does not recompute the runs: with their motions, it would be \d\.\d MB, more"
        r" than 0\.2"
    ):
        found = page(drawn("A1"), assessments.usual(), "0" * 12, b"{}").decode()
    assert len(found) < 200_000
    assert "This file computes nothing: with its motions it would have more than 0.2 MB" in found
    assert "<script" not in found
    assert "script-src" not in found


def test_without_motions_there_is_nothing_to_compute():
    found = page(drawn("A1"), assessments.without_motions(), "0" * 12, b"{}").decode()
    assert "<script" not in found
    assert "computes nothing" not in found
