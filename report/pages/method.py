"""The calculation line by line: equation, source, substituted numbers, result."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from markupsafe import Markup

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.clearances import ClearanceCheck
from report.document.blocks import Line
from report.pages.demand import demand_lines
from report.pages.parts import PackageData, nan_is_worst, statistic
from report.sheet.schema import Direction
from report.typeset.equations import fraction, symbol
from report.words.units import Quantity, number
from solver.rules.provisions import SEPARATION_KEYS, Basis, Neighbor, PrescriptiveBasis


def below(_: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    return (
        ("method-demand", "Seismic demand"),
        ("method-motion", "Motion of an array"),
        ("method-design", "Design displacement"),
        ("method-separation", "Separations"),
    )


def page(package: PackageData) -> Mapping[str, object]:
    """Return the equations with their numbers, for the governing array."""
    governing = package.governing
    return {
        "array": governing.id,
        "demand": demand_lines(package),
        "motion": motion_lines(package, governing),
        "prescriptive": prescriptive_line(package, governing),
        "design": design_lines(package, governing),
        "separation": separation_line(package),
        "interconnection": interconnection_line(package, governing),
    }


def motion_lines(package: PackageData, array: ArrayAssessment) -> Sequence[Line]:
    """Return the equations of motion and the yield accelerations of an array."""
    return (
        *_friction_lines(array),
        *_force_lines(array),
        _rest_line(array),
        *_sliding_lines(package),
        *_yield_lines(array),
    )


def _force_lines(array: ArrayAssessment) -> Sequence[Line]:
    """Return the normal and the driving force."""
    theta = array.array.slope_rad
    degrees, added = number(math.degrees(theta), 3), Markup("{}, with {} added")
    return (
        Line(
            latex=r"N=m\left[(g+a_v)\cos\theta+a_h\sin\theta\right]",
            reference=added.format("Eq. 6", symbol("a_v")),
            steps=((f"Roof at rest: N/(m g) = cos {degrees}°", number(math.cos(theta), 4)),),
        ),
        Line(
            latex=r"G=m\left[(g+a_v)\sin\theta-a_h\cos\theta\right]",
            reference=added.format("Eq. 7", symbol("a_v")),
            steps=((f"Roof at rest: G/(m g) = sin {degrees}°", number(math.sin(theta), 4)),),
        ),
    )


def _rest_line(array: ArrayAssessment) -> Line:
    """Return the condition of no slip, with the roof at rest."""
    theta, mu = array.array.slope_rad, array.array.friction.mu_static
    outcome = "rests" if math.tan(theta) <= mu else "slides"
    compared = f"{number(math.sin(theta), 4)} compared with {number(mu, 3)}"
    return Line(
        latex=r"\left|G\right|\leq\mu N\;\Rightarrow\;\mathrm{rests}",
        reference="Eqs. 8, 9",
        steps=(
            (
                f"Roof at rest: {compared} × {number(math.cos(theta), 4)}",
                f"{number(mu * math.cos(theta), 4)}, {outcome}",
            ),
        ),
    )


def _sliding_lines(package: PackageData) -> Sequence[Line]:
    """Return the equations of sliding, along the slope and in two axes."""
    return (
        Line(
            latex=r"m\ddot{s}=G-\mu N\,\mathrm{sign}(\dot{s})",
            reference="Eqs. 11–18, along the slope",
            note="s is the sliding displacement, positive downslope; the horizontal relative "
            "displacement is u = s cos θ.",
        ),
        Line(
            latex=(
                r"m\dot{\mathbf{v}}=\mathbf{G}-\mu N\,\frac{\mathbf{v}}{\left|\mathbf{v}\right|},"
                r"\quad\mathbf{G}=(G,\,-m\,a_y)"
            ),
            reference="the same equation in two axes",
            note="With cross-slope shaking, v is the sliding velocity, along and across the slope; "
            "the array is at rest while |G| ≤ μN. PRD is the largest resultant of u and the "
            f"cross-slope displacement. {package.part('model').capitalize()} lists where this "
            "applies.",
        ),
    )


def _yield_lines(array: ArrayAssessment) -> Sequence[Line]:
    """Return the friction angle and the accelerations at which sliding begins."""
    theta, mu = array.array.slope_rad, array.array.friction.mu_static
    phi = math.atan(mu)
    degrees, friction = number(math.degrees(theta), 3), number(math.degrees(phi), 3)
    down, up = math.tan(phi - theta), math.tan(phi + theta)
    return (
        Line(
            latex=r"\phi=\arctan\mu",
            reference="friction angle",
            steps=((f"arctan {number(mu, 3)}", f"{friction}°"),),
        ),
        Line(
            latex=r"a_{down}=-g\tan(\phi-\theta)",
            reference=Markup("Eqs. 6–9, {} = 0").format(symbol("a_v")),
            steps=((f"−g tan({friction}° − {degrees}°)", f"{number(-down, 3)} g"),),
            note="Downslope sliding begins below this horizontal roof acceleration.",
        ),
        Line(
            latex=r"a_{up}=g\tan(\phi+\theta)",
            reference=Markup("Eqs. 6–9, {} = 0").format(symbol("a_v")),
            steps=(
                (
                    f"g tan({friction}° + {degrees}°)",
                    "none: the array cannot slide upslope" if up <= 0.0 else f"{number(up, 3)} g",
                ),
            ),
            note="Upslope sliding begins above this horizontal roof acceleration.",
        ),
    )


def _friction_lines(array: ArrayAssessment) -> Sequence[Line]:
    """Return the friction coefficient as a function of velocity, where a test gave it."""
    law = array.array.friction
    if not law.is_by_velocity:
        return ()
    slow, fast, rate = law.mu_slow, law.mu_fast, law.rate_s_per_m
    tenth = fast - (fast - slow) * math.exp(-0.1 * rate)
    return (
        Line(
            latex=r"\mu(v)=\mu_{fast}-(\mu_{fast}-\mu_{slow})\,e^{-r\left|v\right|}",
            reference="Constantinou, Mokha, Reinhorn 1990, Eq. 2",
            steps=(
                (
                    f"At 0.1 m/s: {number(fast, 3)} − ({number(fast, 3)} − {number(slow, 3)}) × "
                    f"exp(−{number(rate, 1)} × 0.1)",
                    number(tenth, 3),
                ),
            ),
            note="The equations below, for the roof at rest and the onset of sliding, use "
            f"μ = {number(law.mu_static, 3)}.",
        ),
    )


def prescriptive_line(package: PackageData, array: ArrayAssessment) -> Line:
    """Return the prescriptive displacement."""
    site, rules, fmt = package.data.site, package.assessment.rules, package.fmt
    key = package.prescriptive_key(array)
    value, minimum = array.prescriptive.value_m, array.prescriptive.minimum_m
    if array.prescriptive.governs is PrescriptiveBasis.LOW_CATEGORY:
        return Line(
            latex=r"\Delta_{MPV}=\Delta_{A,B,C}",
            reference=package.clause(key),
            steps=((f"SDC {site.sdc_text}", fmt.both(value) + package.prescriptive_mark(array)),),
        )
    least = fmt.both(minimum) + package.mark("prescriptive_minimum_in")
    factor = f"{rules['prescriptive_factor_in']:g} in" + package.mark("prescriptive_factor_in")
    inside = "" if rules.importance_in_separation else f" × {number(site.i_e, 2)}"
    latex = (
        r"\Delta_{MPV}=k_p\,(S_{DS}-0.4)^2\geq\Delta_{min}"
        if rules.importance_in_separation
        else r"\Delta_{MPV}=k_p\,I_e\,(S_{DS}-0.4)^2\geq\Delta_{min}"
    )
    bracket = Markup("({} − 0.4)<sup>2</sup>").format(number(max(site.s_ds, 0.4), 3))
    return Line(
        latex=latex,
        reference=package.clause("prescriptive_factor_in"),
        steps=(
            (
                Markup("{}{} × {}, not less than {}").format(factor, inside, bracket, least),
                fmt.both(value) + package.prescriptive_mark(array),
            ),
        ),
        note=f"The {array.prescriptive.governs} governs. The value is the same for every array.",
    )


def design_lines(package: PackageData, array: ArrayAssessment) -> Sequence[Line]:
    """Return the steps from the peaks of an array to its design displacement."""
    fmt, analysis, rules = package.fmt, array.analysis, package.assessment.rules
    unit = fmt.units()[0]
    peaks = [run.governing.prd_m for run in array.motions]
    shown = " + ".join(fmt.cells(peak)[0] for peak in peaks[:12]) + (
        " + …" if len(peaks) > 12 else ""
    )
    count = str(len(peaks))
    factor = number(analysis.factor, 2) + package.mark("analysis_factor")
    largest = analysis.basis is Basis.LARGEST_FACTORED
    picked = analysis.largest_m if largest else analysis.mean_m
    floor = number(rules["analysis_floor"], 2) + package.mark("analysis_floor")
    computed = array.mark(lambda item: item.analysis.value_m)
    return [
        Line(
            latex=r"\overline{\Delta}=\frac{1}{n}\sum_{i=1}^{n}\mathrm{PRD}_i",
            reference="mean of the motions",
            steps=(
                (
                    Markup("{} {}").format(fraction(shown, count), unit.symbol),
                    fmt.both(analysis.mean_m),
                ),
            ),
        ),
        Line(
            latex=r"\Delta_{max}=\mathrm{max}_i\,\mathrm{PRD}_i",
            reference=f"motion {array.worst.motion.id}",
            steps=(("largest of the motions", fmt.both(analysis.largest_m)),),
        ),
        Line(
            latex=(
                r"\Delta_{RHA}=k_a\,\Delta_{max}"
                if largest
                else r"\Delta_{RHA}=k_a\,\overline{\Delta}"
            ),
            reference=package.clause("analysis_factor"),
            steps=((f"{factor} × {fmt.both(picked)}", f"{fmt.both(analysis.value_m)}{computed}"),),
            note=f"Statistic: {statistic(analysis.basis)}.",
        ),
        Line(
            latex=r"\Delta_{floor}=k_f\,\Delta_{MPV}",
            reference=package.clause("analysis_floor"),
            steps=(
                (
                    "peer reviewed: no floor"
                    if package.data.options.peer_reviewed
                    else f"{floor} × {fmt.both(array.prescriptive.value_m)}",
                    fmt.both(package.floor_m(array)) + package.floor_mark(array),
                ),
            ),
        ),
        _design_line(package, array),
        *([_directions_line(package, array)] if array.by_direction else []),
    ]


def _design_line(package: PackageData, array: ArrayAssessment) -> Line:
    """Return the design displacement by the route taken."""
    fmt, by_analysis = package.fmt, array.route is Route.ANALYSIS
    first, second = (
        (array.analysis.value_m, array.floor_m)
        if by_analysis
        else (array.prescriptive.value_m, array.analysis.largest_m)
    )
    return Line(
        latex=r"\Delta=\mathrm{max}(\Delta_{RHA},\,\Delta_{floor})"
        if by_analysis
        else r"\Delta=\mathrm{max}(\Delta_{MPV},\,\Delta_{max})",
        reference="design displacement",
        steps=(
            (
                f"max({fmt.both(first)}, {fmt.both(second)})",
                fmt.both(array.design_m) + package.design_mark(array),
            ),
        ),
        note=f"Governed by: {array.source}.",
    )


def _directions_line(package: PackageData, array: ArrayAssessment) -> Line:
    """Return the design displacements downslope, upslope and cross-slope."""
    fmt, factor = package.fmt, number(array.analysis.factor, 2) + package.mark("analysis_factor")
    largest = array.analysis.basis is Basis.LARGEST_FACTORED
    ways = (Direction.DOWN, Direction.UP, Direction.ACROSS)
    return Line(
        latex=(
            r"\Delta_d=\mathrm{max}(k_a\,\Delta_{max,d},\,\Delta_{floor})"
            if largest
            else r"\Delta_d=\mathrm{max}(k_a\,\overline{\Delta}_d,\,\Delta_{floor})"
        ),
        reference="in each direction d",
        steps=tuple(
            (
                f"{way.value.capitalize()}: max({factor} × "
                f"{fmt.both(analysis.largest_m if largest else analysis.mean_m)}, "
                f"{fmt.both(array.floor_m)})",
                fmt.both(array.design_toward_m(way)) + package.direction_mark(array, way),
            )
            for way in ways
            for analysis in (array.directions[way],)
        ),
        note="Based on the largest displacement of all runs of each motion in that direction "
        f"({package.part('results')}), with the same statistic. A clearance uses the displacement "
        "in its own direction; direction any uses the largest.",
    )


def separation_line(package: PackageData) -> Line:
    """Return the largest required separation of each condition that occurs."""
    latex = (
        r"s_{req}=k\,I\,\Delta"
        if package.assessment.rules.importance_in_separation
        else r"s_{req}=k\,\Delta"
    )
    clauses = {package.assessment.rules.values[key].clause for key in SEPARATION_KEYS.values()}
    return Line(
        latex=latex,
        reference=", ".join(sorted(clauses)),
        steps=tuple(
            _separation(package, max(gaps, key=lambda gap: nan_is_worst(gap.required_m)))
            for kind in Neighbor
            if (gaps := [gap for gap in package.assessment.clearances if gap.neighbor is kind])
        ),
    )


def _separation(package: PackageData, gap: ClearanceCheck) -> tuple[str, str]:
    fmt, rules = package.fmt, package.assessment.rules
    key = SEPARATION_KEYS[gap.neighbor]
    inside = f" × {number(gap.importance, 2)}" if rules.importance_in_separation else ""
    least = (
        f", not less than {fmt.both(rules.length_m('separation_edge_min_in'))}"
        f"{package.mark('separation_edge_min_in')}"
        if gap.is_minimum_value
        else ""
    )
    feet = "" if math.isnan(gap.required_m) else f" = {fmt.both(gap.required_m, Quantity.PLAN)}"
    return (
        f"To {_ARTICLES[gap.neighbor]} ({gap.governing_array}, "
        f"{gap.governing_direction.value}): {number(rules[key], 2)}{package.mark(key)}{inside} × "
        f"{fmt.both(gap.design_m)}{gap.design_mark}{least}",
        fmt.both(gap.required_m) + feet + gap.mark,
    )


def interconnection_line(package: PackageData, array: ArrayAssessment) -> Line:
    """Return the interconnection strength."""
    rules, fmt = package.assessment.rules, package.fmt
    first = f"{rules['interconnection_sds']:g}{package.mark('interconnection_sds')}"
    second = f"{rules['interconnection_min']:g}{package.mark('interconnection_min')}"
    return Line(
        latex=r"F=\mathrm{max}(c_1 S_{DS},\,c_2)\,W_1,\quad W_1=W/2",
        reference=package.clause("interconnection_sds"),
        steps=(
            (
                f"max({first} × {number(package.data.site.s_ds, 3)}, {second}) × "
                f"{fmt.both(array.array.weight_n / 2.0, Quantity.WEIGHT)}",
                fmt.both(array.interconnection_n, Quantity.WEIGHT)
                + array.mark(lambda item: item.interconnection_n),
            ),
        ),
    )


_ARTICLES = {
    Neighbor.LIKE: "a like array",
    Neighbor.FIXED: "a fixed object",
    Neighbor.UNLIKE: "an unlike array",
    Neighbor.PARAPET: "an edge with a qualifying parapet",
    Neighbor.EDGE: "an edge without a qualifying parapet",
}
