"""Records as seeds of motions. Oracles: phases against the record's own, zero crossings, energy.

The record is made up: bursts of waves from 12 to 1 Hz within 20 s, after 3 s of silence.
"""

import numba
import numpy as np
import pytest

from solver.model import InputError
from solver.records.record import Record
from solver.records.spectrum import response_spectrum
from solver.rules.hazard import target_sa_g
from solver.synthesis import suite
from solver.synthesis.suite import make_suite

pytestmark = [
    pytest.mark.skipif(
        numba.config.DISABLE_JIT, reason="each motion takes minutes without compiled kernels"
    ),
    pytest.mark.quick,
]

G = 9.80665
BAND = 0.3 * 2.0 ** (np.arange(82) / 12.0)
CORNERS_HZ = np.array([0.1, 1.3, 8.3, 33.3])
HORIZONTAL = CORNERS_HZ, np.array([0.16, 1.6, 1.6, 1.2])
VERTICAL = CORNERS_HZ, np.array([0.067, 0.67, 0.67, 0.27])


@pytest.fixture(scope="module")
def made():
    group = tuple(falling(seed) for seed in (1, 2))
    return group, make_suite(HORIZONTAL, VERTICAL, count=2, seed=7, records=[group])


def falling(seed):
    draw, t = np.random.default_rng(seed), np.arange(2001) * 0.01
    wave = np.sin(2.0 * np.pi * np.cumsum(12.0 * 12.0 ** (-t / 20.0)) * 0.01 + 6.28 * draw.random())
    level = np.exp(-((t - 8.0) ** 2) / 8.0) + 0.2
    a = level * (wave + 0.2 * draw.standard_normal(len(t)))
    return Record(name=f"falling-{seed}", dt_s=0.01, a_mps2=np.append(np.zeros(300), a))


@pytest.mark.nightly
def test_components_keep_to_targets_and_follow_their_records(made):
    for motion in made[1]:
        targets = (HORIZONTAL, HORIZONTAL, VERTICAL)
        for record, wanted in zip(motion.components, targets, strict=True):
            psa = response_spectrum(record.a_mps2, record.dt_s, 1.0 / BAND) / G
            ratio = psa / target_sa_g(wanted, BAND)
            assert 0.90 <= ratio.min() <= ratio.max() <= 1.30
            assert 1.0 <= ratio.mean() <= 1.07
            energy = np.cumsum(record.a_mps2**2)
            strong = np.searchsorted(energy, [0.05 * energy[-1], 0.95 * energy[-1]])
            assert 0.005 * (strong[1] - strong[0]) >= 19.99
            assert abs(np.rint(record.a_mps2 / G * 1e5).sum()) == 0
        assert max(map(abs, motion.correlations)) <= 0.3
    for record in (r for motion in made[1] for r in motion.components):
        early, late = (record.a_mps2[k : k + 1000] for k in (1400, 3800))
        assert share_of_high(early) > 2.0 * share_of_high(late)


@pytest.mark.nightly
def test_phases_are_the_records_own_first_and_turned_where_alike(made):
    (first, second), (own, later) = made
    assert likeness(own.x, first) > 0.6
    assert likeness(own.y, second) > 0.6
    for other, record in ((own.z, first), (later.x, first), (later.y, second), (own.x, second)):
        assert abs(likeness(other, record)) < 0.3
    same = made[0][0]
    motion = make_suite(HORIZONTAL, VERTICAL, count=1, seed=1, records=[(same, same, same)])[0]
    assert motion.seeds[0] == "falling-1"
    assert all(words.startswith("falling-1, ") and "phases" in words for words in motion.seeds[1:])
    assert max(map(abs, motion.correlations)) <= 0.3


def likeness(made, record):
    """Mean cosine of the phase between the two, 1 to 10 Hz, in windows of 2 s."""
    # A record of 23 s stands in the middle of 30 s.
    t = 0.005 * np.arange(6001)
    placed = np.interp(t - 3.5, 0.01 * np.arange(len(record.a_mps2)), record.a_mps2)
    bell, freq_hz = np.hanning(400), np.fft.rfftfreq(400, 0.005)
    part = (freq_hz > 1.0) & (freq_hz < 10.0)
    starts = range(1400, 5000, 200)
    spectrum, other = (
        np.array([np.fft.rfft(bell * a[i : i + 400])[part] for i in starts])
        for a in (made.a_mps2, placed)
    )
    cosine = (spectrum * other.conj()).real / np.abs(spectrum) / np.abs(other)
    return float(cosine.mean(axis=1).mean())


def share_of_high(a):
    """Energy from 3.5 to 12 Hz over that from 0.8 to 3.5 Hz, of 5 s."""
    power = np.abs(np.fft.rfft(np.hanning(1000) * a)) ** 2
    freq_hz = np.fft.rfftfreq(1000, 0.005)
    high, low = ((freq_hz > lower) & (freq_hz <= 12.0) for lower in (3.5, 0.8))
    return float(power[high].sum() / power[low & ~high].sum())


@pytest.mark.nightly
def test_what_a_motion_grew_from_is_told_and_is_the_same_whatever_the_count(made):
    own, later = made[1]
    assert own.seeds == ("falling-1", "falling-2", "falling-1, random phases")
    assert later.seeds == tuple(f"falling-{k}, random phases" for k in (1, 2, 1))
    noise = make_suite(HORIZONTAL, VERTICAL, count=1, seed=1, dt_s=0.01)[0]
    assert noise.seeds == ("noise", "noise", "noise")
    again = make_suite(HORIZONTAL, VERTICAL, count=1, seed=7, records=[made[0]])[0]
    for record, other in zip(again.components, made[1][0].components, strict=True):
        assert np.array_equal(record.a_mps2, other.a_mps2)


def test_long_and_short_records_are_used_at_the_motions_step():
    t = 0.01 * np.arange(10_000)
    weak, strong = 0.1 * np.sin(3.0 * t), np.where((t > 40.0) & (t < 65.0), np.sin(9.0 * t), 0.0)
    seed = suite.strongest(Record(name="long", dt_s=0.01, a_mps2=weak + strong), 0.005, 6001)
    at = 0.005 * np.flatnonzero(np.abs(seed) > 0.5)
    assert at[-1] - at[0] == pytest.approx(25.0, abs=0.5)
    t = 0.02 * np.arange(501)
    seed = suite.strongest(Record(name="short", dt_s=0.02, a_mps2=np.sin(5.0 * t)), 0.005, 6001)
    assert not seed[:2000].any()
    assert not seed[4001:].any()
    exact = np.sin(5.0 * 0.005 * np.arange(2001))
    assert np.corrcoef(seed[2000:4001], exact)[0, 1] > 0.9999


@pytest.mark.parametrize("size", [1e-300, 1e-6, 1e300])
@pytest.mark.nightly
def test_the_size_of_a_record_does_not_matter(made, size):
    first = made[0][0]
    sized = Record(name="falling-1", dt_s=0.01, a_mps2=first.a_mps2 * size)
    seed = suite.strongest(sized, 0.005, 6001)
    assert seed == pytest.approx(suite.strongest(first, 0.005, 6001), abs=1e-12)


@pytest.mark.parametrize(
    ("groups", "expected"),
    [
        ([()], "records of motion 1: found 0; give one, two or three"),
        ([("rest",) * 4], "records of motion 1: found 4; give one, two or three"),
        ([("rest",)], "rest: is constant; give another record as a seed"),
        ([("level",)], "level: is constant"),
        ([("short",)], "short: lasts 4.99 s; give a seed of at least 5 s"),
    ],
)
def test_records_that_cannot_seed_are_refused(groups, expected):
    rest = np.zeros(3000)
    known = {"rest": rest, "level": rest + 2.5, "short": np.sin(np.arange(500.0))}
    named = {name: Record(name=name, dt_s=0.01, a_mps2=a) for name, a in known.items()}
    records = [[named[name] for name in group] for group in groups]
    with pytest.raises(InputError, match=expected):
        make_suite(HORIZONTAL, VERTICAL, count=1, seed=1, records=records)
