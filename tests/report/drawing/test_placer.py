"""Labels on a drawing: near what they name, inside, and free of one another."""

import itertools

import pytest

from report.drawing.placer import Frame, Placer, centered

pytestmark = pytest.mark.quick

PAGE = Frame(0.0, 0.0, 3.0, 2.0)
NEAR = (1.5, 1.0)


def apart(a, b):
    """The distance of two frames along the axis that separates them; negative if they overlap."""
    across = max(a.x0 - b.x1, b.x0 - a.x1)
    return max(across, a.y0 - b.y1, b.y0 - a.y1)


@pytest.fixture
def placer():
    return Placer(PAGE)


def test_labels_are_placed_near_free_of_one_another_and_inside(placer):
    placer.take_segment((0.0, 1.0), (3.0, 1.0))
    line = Frame(0.0, 1.0, 3.0, 1.0)
    tried = [placer.place(0.6, 0.3, NEAR) for _ in range(40)]
    found = [frame for frame in tried if frame is not None]
    assert len(found) > 4
    for frame in found:
        assert (frame.wide, frame.tall) == pytest.approx((0.6, 0.3))
        assert min(frame.x0, frame.y0, 3.0 - frame.x1, 2.0 - frame.y1) >= 0.0
        assert apart(frame, line) > 0.03
    assert all(apart(a, b) > 0.03 for a, b in itertools.combinations(found, 2))
    assert abs(found[0].middle[1] - 1.0) < 0.3


def test_a_frame_that_is_given_back_is_free_again(placer):
    whole = centered(*NEAR, 2.9, 1.9)
    placer.take(whole)
    assert placer.place(0.6, 0.3, NEAR) is None
    placer.release(whole)
    assert placer.place(0.6, 0.3, NEAR).middle == pytest.approx(NEAR)


def test_a_label_is_not_farther_than_it_may_be(placer):
    placer.take(centered(*NEAR, 0.2, 0.2))
    assert placer.place(0.6, 0.3, NEAR, maximum=0.2) is None
    assert placer.place(0.6, 0.3, NEAR, maximum=0.4) is not None


def test_a_line_is_covered_only_where_there_is_no_other_room(placer):
    placer.avoid(centered(*NEAR, 0.1, 0.1))
    assert apart(placer.place(0.6, 0.3, NEAR), centered(*NEAR, 0.1, 0.1)) > 0.0
    narrow = centered(*NEAR, 0.7, 0.4)
    only = Placer(PAGE)
    only.avoid(centered(*NEAR, 0.1, 0.1))
    assert only.place(0.6, 0.3, NEAR, within=narrow) is not None
