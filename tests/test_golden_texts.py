"""Golden texts are compared, and taken over where that is asked for."""

import pytest

import golden_texts

pytestmark = pytest.mark.quick


def test_a_golden_text_is_shown_as_a_difference_and_taken_over_where_asked_for(tmp_path):
    path = tmp_path / "golden" / "page.txt"
    shown = golden_texts.difference(path, "a\nb\n", is_taken_over=False)
    assert shown.splitlines()[-2:] == ["+a", "+b"]
    assert not path.exists()
    golden_texts.difference(path, "a\nb\n", is_taken_over=True)
    assert golden_texts.difference(path, "a\nb\n", is_taken_over=False) == ""
    assert golden_texts.difference(path, "a\nc\n", is_taken_over=False).splitlines() == [
        "--- before/page.txt", "+++ now/page.txt", "@@ -1,2 +1,2 @@", " a", "-b", "+c",
    ]  # fmt: skip
