"""Garbage is not looked for while a report is made, and is afterwards where it was before."""

import gc

import pytest

from report.garbage import no_collections


@pytest.mark.parametrize("before", [True, False])
def test_the_search_goes_on_afterwards_where_it_did_before(before):
    was_enabled = gc.isenabled()
    (gc.enable if before else gc.disable)()
    try:
        with no_collections(), no_collections():
            assert not gc.isenabled()
        assert gc.isenabled() == before
    finally:
        (gc.enable if was_enabled else gc.disable)()


def test_the_search_goes_on_after_an_error():
    with pytest.raises(ValueError, match="wrong"), no_collections():
        raise ValueError("wrong")
    assert gc.isenabled()
