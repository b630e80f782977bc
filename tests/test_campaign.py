"""A campaign of hostile inputs; `tests/bench/campaign.py` runs a longer one."""

import pytest
from mutations import trouble

# 10^4 cases, most on the records.
CASES = {"record": 9000, "argument": 800, "part": 200}


@pytest.mark.parametrize("kind", CASES)
def test_hostile_inputs_are_read_or_refused(kind):
    ended = {seed: told for seed in range(CASES[kind]) if (told := trouble(kind, seed))}
    assert ended == {}
