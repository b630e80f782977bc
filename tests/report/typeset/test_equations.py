import pytest

from report.typeset.equations import formula, fraction, symbol

pytestmark = pytest.mark.quick


def test_a_formula_is_one_outline_with_its_bars_and_its_size():
    made = formula(r"\Delta=\frac{1}{n}\sum_{i=1}^{n}\mathrm{PRD}_i")
    assert made["svg"].count("<path") == 1
    assert "<use" not in made["svg"]
    assert "<text" not in made["svg"]
    with_bar, without = formula(r"\frac{a}{b}"), formula(r"ab")
    assert "h" in with_bar["svg"].split(' d="')[1].split('"')[0]
    assert "h" not in without["svg"].split(' d="')[1].split('"')[0]
    short, long = formula("N"), formula(r"N=m g\cos\theta")
    assert 0 < short["width_pt"] < long["width_pt"]
    assert short["height_pt"] > 0
    assert "&lt;b&gt;" in fraction("<b>", "2")
    assert "<b>" not in fraction("1", "<b>")


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
