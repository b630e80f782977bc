"""Templates are compiled once, and again where they or the code of a filter have changed."""

import pytest

from report.document.templates import rendered, state_of

pytestmark = pytest.mark.quick


def template(folder):
    (folder / "a.html").write_text("{{ 1.5 | number(2) }}")
    return rendered(folder, "a.html", {})


def test_a_template_is_kept_compiled_beside_it(tmp_path):
    assert template(tmp_path) == "1.50"
    (kept,) = (tmp_path / "__pycache__").iterdir()
    assert kept.stat().st_size


def test_where_nothing_can_be_kept_a_template_is_compiled(tmp_path):
    (tmp_path / "__pycache__").symlink_to(tmp_path / "gone" / "away")
    assert template(tmp_path) == "1.50"


def test_the_state_of_code_changes_with_each_module(tmp_path):
    module = tmp_path / "below" / "filters.py"
    module.parent.mkdir()
    states = [state_of(tmp_path)]
    for text in ("a = 1", "a = 22"):
        module.write_text(text)
        states.append(state_of(tmp_path))
    assert len({*states}) == 3
