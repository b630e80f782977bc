"""Results that a warm process keeps: found by the content of their arguments, dropped in time."""

from dataclasses import dataclass

import numpy as np
import pytest

from report.memoized import GENERATIONS, clear, memoized, new_generation


@dataclass(frozen=True)
class Scene:
    samples: np.ndarray
    mu: float


asked = []


@memoized
def largest(scene: Scene, factor: float = 1.0) -> float:
    asked.append(factor)
    return factor * scene.mu * float(np.abs(scene.samples).max())


@memoized
def smallest(scene: Scene, factor: float = 1.0) -> float:
    asked.append(factor)
    return factor * scene.mu * float(np.abs(scene.samples).min())


@memoized
def refuse(scene: Scene) -> float:
    asked.append(0.0)
    raise ValueError("no such scene")


@pytest.fixture(autouse=True)
def nothing_kept():
    asked.clear()
    clear()
    yield
    clear()


def scene(mu=0.5, last=2.0):
    return Scene(samples=np.array([0.1, -1.0, last]), mu=mu)


def test_nothing_is_kept_unless_rounds_have_begun():
    assert [largest(scene()), largest(scene())] == [1.0, 1.0]
    assert len(asked) == 2


def test_equal_content_is_computed_once():
    new_generation()
    assert [largest(scene()), largest(scene())] == [1.0, 1.0]
    new_generation()
    assert largest(scene()) == 1.0
    assert len(asked) == 1


def test_any_change_of_content_is_computed_again():
    new_generation()
    one = scene()
    given = [
        largest(one),
        largest(scene(mu=np.nextafter(0.5, 1.0))),
        largest(scene(last=3.0)),
        largest(one, 2.0),
        largest(one, factor=3.0),
        smallest(one),
    ]
    assert given == [1.0, 2.0 * np.nextafter(0.5, 1.0), 1.5, 2.0, 3.0, 0.05]
    # An array that was written to is another one, although it is the same object.
    one.samples[2] = 4.0
    assert largest(one) == 2.0
    assert len(asked) == 7


def test_a_failure_is_not_kept():
    new_generation()
    for _ in range(2):
        with pytest.raises(ValueError, match="no such scene"):
            refuse(scene())
    assert len(asked) == 2


def test_what_no_recent_round_asked_for_is_dropped():
    new_generation()
    largest(scene())
    for _ in range(GENERATIONS):
        new_generation()
    largest(scene())
    assert len(asked) == 1  # asked for in time
    for _ in range(GENERATIONS + 1):
        new_generation()
    largest(scene())
    assert len(asked) == 2
