import re

import pytest

from report.typeset.equations import SIZE_PT, formula, fraction, symbol

pytestmark = pytest.mark.quick


def test_a_formula_is_one_outline_without_references():
    made = formula(r"\Delta=\frac{1}{n}\sum_{i=1}^{n}\mathrm{PRD}_i")
    assert made.svg.count("<path") == 1
    assert "<use" not in made.svg
    assert "<text" not in made.svg


def test_a_fraction_bar_is_part_of_the_outline():
    with_bar, without = formula(r"\frac{a}{b}"), formula(r"ab")
    assert "h" in with_bar.svg.split(' d="')[1].split('"')[0]
    assert "h" not in without.svg.split(' d="')[1].split('"')[0]


def test_a_formula_knows_its_size():
    short, long = formula("N"), formula(r"N=m g\cos\theta")
    assert 0 < short.width_pt < long.width_pt
    assert short.height_pt > 0


def test_a_formula_is_made_once():
    assert formula(r"G\leq\mu N") is formula(r"G\leq\mu N")


@pytest.mark.parametrize(
    "latex",
    [
        "N",
        r"\mathrm{PRD}_i",
        r"\overline{\Delta}=\frac{1}{n}\sum_{i=1}^{n}x_i",
        r"m\dot{\mathbf{v}}=\mu\,\frac{\mathbf{v}}{\left|\mathbf{v}\right|},\quad S_{DS}",
        r"S_a=\mathrm{min}\left(S_{DS},\ \frac{S_{D1}T_L}{T^2}\right)",
    ],
)
def test_rows_that_group_nothing_are_left_out_and_change_no_outline(latex):
    made = formula(latex)
    from ziamath.zmath import Latex  # warns where it is imported first

    as_typeset = Latex(latex, size=SIZE_PT).svg()
    size = re.findall(r'(?:width|height)="([\d.]+)"', as_typeset)[:2]
    assert [made.width_pt, made.height_pt] == [float(length) for length in size]
    assert all(path in made.svg for path in re.findall(r'<path d="([^"]+)"', as_typeset))


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("S_DS", "<i>S</i><sub>DS</sub>"),
        ("z", "<i>z</i>"),
        ("a_<b>", "<i>a</i><sub>&lt;b&gt;</sub>"),
    ],
)
def test_a_symbol_has_its_subscript_and_is_escaped(text, html):
    assert symbol(text) == html


def test_both_sides_of_a_fraction_are_escaped():
    assert "&lt;b&gt;" in fraction("<b>", "2")
    assert "<b>" not in fraction("1", "<b>")
