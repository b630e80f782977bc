"""The numbers of the calculation that are not in the assessment; its equations are in the template.

For the governing array, unrounded. Read `page`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from report.assessment.runs import nan_is_worst
from report.drawing.items import drawn_slope_deg
from report.pages.parts import PackageData, statistic
from report.sheet.schema.choices import Direction
from report.text.units import Quantity
from solver.rules.provisions import SEPARATION_KEYS, Neighbor


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    motion = ("method-motion", "Motion of an array")
    return (
        *([motion] if package.assessment.has_motions else []),
        ("method-design", "Design displacement"),
        ("method-separation", "Separations"),
    )


def page(package: PackageData) -> Mapping[str, object]:
    """Return what the equations need beside the package."""
    largest_m = package.governing.design_m
    return {
        "is_shared": sum(item.design_m == largest_m for item in package.assessment.arrays) > 1,
        **_motion(package),
        **_weights(package),
        **_design(package),
        **_separations(package),
    }


def _motion(package: PackageData) -> Mapping[str, object]:
    """Return the forces with the roof at rest / m g, and the accelerations that begin sliding."""
    array = package.governing.array
    theta, law, drawn_deg = array.slope_rad, array.friction, drawn_slope_deg(array)
    phi = math.atan(law.mu_static)
    decay = math.exp(-0.1 * law.rate_s_per_m) if law.is_by_velocity else 1.0
    return {
        "drawn_deg": None if math.isclose(math.degrees(theta), drawn_deg) else drawn_deg,
        "phi_rad": phi,
        "cos": math.cos(theta),
        "sin": math.sin(theta),
        "holding": law.mu_static * math.cos(theta),
        "rests": math.tan(theta) <= law.mu_static,
        "down_g": -math.tan(phi - theta),
        "up_g": math.tan(phi + theta),
        "mu_at_tenth": law.mu_fast - (law.mu_fast - law.mu_slow) * decay,
    }


def _weights(package: PackageData) -> Mapping[str, object]:
    """Return the weight over plan area of the governing array, and the range of the others."""
    own, fmt = package.governing.array, package.fmt
    others = [array.weight_pa for array in package.data.arrays if array.id != own.id]
    ends = [fmt.first(end(others), Quantity.PRESSURE) for end in (min, max) if others]
    unit = fmt.units(Quantity.PRESSURE)[0].symbol
    return {
        "weight_pa": own.weight_pa,
        "other_weights": " to ".join(dict.fromkeys(ends)) + f" {unit}" if others else "",
    }


def _design(package: PackageData) -> Mapping[str, object]:
    array = package.governing
    return {
        "statistic": statistic(array.analysis.basis),
        "analysis_mark": array.mark(lambda item: item.analysis.value_m),
        "interconnection_mark": array.mark(lambda item: item.interconnection_n),
        "ways": (Direction.DOWN, Direction.UP, Direction.ACROSS),
    }


def _separations(package: PackageData) -> Mapping[str, object]:
    """Return the largest required separation of each condition that occurs, and the clauses."""
    gaps, rules = package.assessment.clearances, package.assessment.rules
    clauses = {rules.values[key].clause for key in SEPARATION_KEYS.values()}
    alike = {kind: [gap for gap in gaps if gap.neighbor is kind] for kind in Neighbor}
    return {
        "separation_clauses": sorted(clauses),
        "separations": [
            (max(some, key=lambda gap: nan_is_worst(gap.required_m)), SEPARATION_KEYS[kind])
            for kind, some in alike.items()
            if some
        ],
    }
