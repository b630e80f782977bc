"""The models of the input, and the parts of their fields."""

import datetime as dt
import math

import pytest
from pydantic import ValidationError

import inputs
from inputs import INCH
from report.sheet.schema import SECTIONS, Options, ProjectInput
from report.sheet.schema.choices import RuleSetName, SlopeUnit
from report.sheet.schema.fields import Bounds, YesNo, entries
from report.sheet.schema.motions import MotionInput
from report.sheet.schema.project import Project, Site
from report.sheet.schema.scene import Array, slope_rad
from report.text.units import LENGTHS, WEIGHTS, Quantity
from sheets import project
from solver.formats import UNIT_CHOICES

pytestmark = pytest.mark.quick

SITE = inputs.SITE | {"rule_set": "ASCE 7-16", "s_1_g": None, "site_class": None}
SITE.pop("s_ds_g")


def entry(model, name):
    return next(item for item in entries(model) if item.name == name)


def test_sections_are_parts_of_the_input_with_labels_and_messages_that_fit():
    assert [section.key for section in SECTIONS] == list(ProjectInput.model_fields)
    for section in SECTIONS:
        assert [item.name for item in entries(section.model)] == list(section.model.model_fields)
    for section in SECTIONS:
        labels = [item.cell.label.casefold() for item in entries(section.model)]
        assert len(labels) == len(set(labels))
        assert not any(set("[]*!") & set(label) for label in labels)
    for section in SECTIONS:
        for item in entries(section.model):
            assert len(item.help) <= 200
            assert len(",".join(item.choices)) <= 255
            assert not any("," in choice for choice in item.choices)


def test_a_field_has_its_type_range_and_legal_unit():
    mu = entry(Array, "mu")
    assert (mu.kind, mu.is_required, mu.bounds.words()) == (float, True, "0 to 1.5")
    assert entry(MotionInput, "units").choices == ("from file", *UNIT_CHOICES)
    step = entry(MotionInput, "dt_s")  # optional
    assert (step.kind, step.is_required, step.bounds.words()) == (float, False, "more than 0 to 1")
    assert mu.spoken == "friction coefficient"
    assert entry(Array, "mu_rate_s_per_m").bounds.words() == "more than 0 to 1000"
    client = entry(Project, "client")
    assert (client.kind, client.is_required) == (str, False)
    assert (client.default, client.max_length) == ("", 2000)
    assert entry(Array, "weight_n").quantity is Quantity.WEIGHT
    assert entry(Project, "date").kind is dt.date
    assert entry(Options, "peer_reviewed").choices == tuple(YesNo)
    assert [bounds.words() for bounds in RANGES] == [*RANGES.values()]
    assert Bounds(low=0, high=10 * INCH).words(INCH) == "0 to 10"
    assert LENGTHS == {"in": 0.0254, "ft": 0.3048, "mm": 1e-3, "cm": 1e-2, "m": 1.0}
    assert WEIGHTS["lb"] == pytest.approx(0.45359237 * 9.80665, rel=1e-15)
    assert WEIGHTS["kip"] == pytest.approx(1000 * WEIGHTS["lb"])


RANGES = {
    Bounds(): "",
    Bounds(low=0): "0 or more",
    Bounds(low=0, excludes_low=True): "more than 0",
    Bounds(high=3): "at most 3",
    Bounds(high=3, excludes_high=True): "less than 3",
    Bounds(low=1, high=2): "1 to 2",
    Bounds(low=1, high=2, excludes_low=True): "more than 1 to 2",
    Bounds(low=1, high=2, excludes_high=True): "1 to less than 2",
}


def test_slopes_become_angles_and_s_ds_is_unrounded():
    for value, unit, degrees in (
        (3.0, SlopeUnit.DEGREES, 3.0), (5.0, SlopeUnit.PERCENT, 2.8624052261117479),
        (0.25, SlopeUnit.IN_PER_12, 1.1934894239820351), (0.0, SlopeUnit.PERCENT, 0.0),
    ):  # fmt: skip
        assert math.degrees(slope_rad(value, unit)) == pytest.approx(degrees, rel=1e-12)
    assert Site(**SITE, s_s_g=1.313, f_a=1.2).s_ds == pytest.approx(1.0504, abs=1e-12)
    assert Site(**SITE, s_s_g=1.313, f_a=1.2, s_ds_g=1.05).s_ds == 1.05
    with pytest.raises(ValidationError, match="give S_DS, S_MS, or S_S and F_a"):
        Site(**SITE, s_s_g=1.313)


def test_models_are_frozen_with_rectangles_of_arrays_and_objects():
    site = Site(**SITE, s_ds_g=1.0)
    with pytest.raises(ValidationError):
        site.i_e = 1.5
    for wrong in ({"s_ds_g": 1.0, "color": "red"}, {"s_ds_g": math.nan}):
        with pytest.raises(ValidationError):
            Site(**SITE, **wrong)
    data = project()
    assert data.arrays[0].shape.x_to_m == pytest.approx(30.48)
    assert data.objects[1].placed is None
    assert data.objects[0].placed.y_from_m == pytest.approx(24.384)
    assert data.site.rule_set is RuleSetName.PV1
