"""Spectra of the motions as run, and how the page on motions sums them up."""

from dataclasses import replace

import numpy as np
import pytest

from fixtures import assessments, projects
from fixtures.pages import page_of
from report.assessment.support.response_spectra import Spectra, spectra
from report.motions.history import TargetSpectrum
from report.project.model.choices import RecordedAt
from solver.records.spectrum import response_spectrum

G = 9.80665


@pytest.fixture(scope="module")
def assessment():
    return assessments.package(spectrum=[]).assessment


def ordinates(assessment, *parts):
    """The table of these spectra."""
    return page_of(assessment, "spectra", spectra=parts).table("Pseudo-acceleration")


HALVED = tuple(replace(motion, scale=0.5) for motion in assessments.motions())


def under(assessment, motions=HALVED, places=()):
    """An assessment as if it were of other motions."""
    book = projects.book(shaking=tuple(motions)).having(prepared=tuple(places))
    return replace(assessment, shaking=book.shaking)


def of_rows(rows, motions=HALVED):
    """An assessment with a project-specific spectrum."""
    return projects.assessed(projects.book(projects.project(spectrum=rows), motions))


@pytest.mark.quick
def test_all_three_components_are_taken_as_run(assessment):
    parts = spectra(under(assessment))
    assert [part.title for part in parts] == ["Horizontal", "Transverse", "Vertical"]
    for part, name in zip(parts, ("ax_mps2", "ay_mps2", "az_mps2"), strict=True):
        for motion, row in zip(HALVED, part.sa_g, strict=True):
            alone = response_spectrum(0.5 * getattr(motion, name), motion.dt_s, part.periods_s)
            assert np.array_equal(row, alone / G)
    assert parts[0].target is parts[1].target is assessment.targets.roof
    assert parts[2].target is assessment.targets.vertical


def test_ordinates_are_of_mean_and_single_motions_that_have_the_component(assessment):
    first, second, third = HALVED
    bare = [replace(first, ay_mps2=np.empty(0), az_mps2=np.empty(0)), second, third]
    parts = spectra(under(assessment, bare))
    assert [part.ids for part in parts] == [("M1", "M2", "M3"), ("M2", "M3"), ("M2", "M3")]
    assert [part.title for part in spectra(under(assessment, bare[:1]))] == ["Horizontal"]
    part = spectra(under(assessment))[0]
    head, target, mean, over, least, largest = ordinates(assessment, part).rows
    assert part.title in head["Period"]
    at = int(np.argmin(np.abs(part.periods_s - 1.0)))
    assert target["1 s [1 Hz]"] == f"{part.target_g[at]:.3f}"
    assert mean["1 s [1 Hz]"] == f"{part.sa_g[:, at].mean():.3f}"
    for row, fold in ((over, np.mean), (least, np.min), (largest, np.max)):
        assert row["1 s [1 Hz]"] == f"{fold(part.sa_g[:, at]) / part.target_g[at]:.2f}"


def test_a_project_spectrum_applies_only_where_it_is_given():
    rows = [{"period_s": t, "horizontal_g": a} for t, a in ((0.1, 2.0), (2.0, 0.5))]
    done = of_rows(rows, assessments.motions())
    part = spectra(under(done))[0]
    periods = part.periods_s[np.isfinite(part.target_g)]
    assert 0.1 <= periods.min() <= 0.11
    assert 1.9 <= periods.max() <= 2.0
    table = ordinates(done, part)
    shown_s = [float(heading.partition(" s ")[0]) for heading in table.headings[1:]]
    _, target, _, over, *_ = table.cells
    for row in (target, over):
        assert [cell != "—" for cell in row[1:]] == [0.1 <= t <= 2.0 for t in shown_s]


@pytest.mark.quick
def test_ground_motions_are_shown_where_they_were_recorded_with_or_without_a_target():
    preparations = [projects.prepared(m, recorded_at=RecordedAt.GROUND) for m in HALVED]
    done = of_rows([])
    *_, across, transverse = spectra(under(done, places=preparations))
    assert (across.title, transverse.title) == ("Ground, horizontal", "Ground, transverse")
    assert across.is_ground
    alone = response_spectrum(0.5 * HALVED[1].ax_mps2, HALVED[1].dt_s, across.periods_s)
    assert across.sa_g[1] == pytest.approx(alone / G, rel=1e-12)
    _, mean = ordinates(done, across).cells
    assert mean[0] == "Mean of 3 motions [g]"


FLAT = TargetSpectrum(name="AC156", at=lambda freq_hz: np.full(freq_hz.shape, 0.5), from_s=0.1,
                      to_s=10.0)  # fmt: skip


def relative(title, ratios, target=FLAT, *, is_ground=False):
    """Spectra of two motions whose mean is a ratio of the target at 0.5, 1, 2, 5 and 20 s."""
    mean = 0.5 * np.array(ratios)
    return Spectra(
        ids=("M1", "M2"),
        periods_s=np.array([0.5, 1.0, 2.0, 5.0, 20.0]),
        sa_g=np.array([0.9 * mean, 1.1 * mean]),
        target=target,
        title=title,
        is_ground=is_ground,
    )


def said(*parts):
    """The sentences on the page of what departs from its target."""
    lines = page_of(assessments.package().assessment, "motions", spectra=parts).splitlines()
    return [line for line in lines if ": the mean of the motions " in line]


def test_motions_are_named_where_they_are_below_their_target_alone():
    nowhere = TargetSpectrum(name="", at=FLAT.at, from_s=np.inf, to_s=0.0)
    assert said(relative("Horizontal", [1.0, 1.29, 1.1, 1.0, 0.1])) == []
    assert said(relative("Ground, horizontal", [0.1] * 5, nowhere, is_ground=True)) == []
    (text,) = said(relative("Ground, horizontal", [1.1, 1.0, 0.7, 0.4, 0.1], is_ground=True))
    assert text == (
        "Ground, horizontal: the mean of the motions falls to 0.40 times the target (AC156) at 0.2 "
        "Hz; it is below the target from 0.2 to 0.5 Hz. Weaker shaking results "
        "in smaller displacements. Scale or replace the motions, or justify the difference."
    )


@pytest.mark.quick
def test_the_component_farthest_above_the_target_speaks_for_those_of_one_target():
    texts = said(
        relative("Horizontal", [1.0, 1.5, 1.0, 1.0, 9.0]),
        relative("Transverse", [1.4, 1.602, 1.0, 0.9, 9.0]),
        relative("Vertical", [1.0] * 5),
    )
    short, excess = texts
    assert short.startswith("Transverse: the mean of the motions falls to 0.90 times the target")
    assert "at 0.2 Hz; it is below the target there only." in short
    assert excess == (
        "Transverse (horizontal likewise): the mean of the motions reaches 1.61 times the target "
        "(AC156) at 1 Hz; it exceeds 1.30 times the target from 1 to 2 Hz. "
        "Displacements are not reduced for this excess."
    )
