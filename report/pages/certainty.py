"""How sure: friction and slope, the margin of each clearance, directions of shaking not run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from report.assessment.certainty import TOLERANCE, Certainty, Margin, Surface
from report.assessment.friction import mu_words
from report.assessment.trials import with_mu
from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import NO_VALUE, TableColumn
from report.pages.parts import PackageData
from report.words.letters import power_of_ten
from report.words.units import Quantity, number
from solver.rules.provisions import Neighbor


def page(package: PackageData, certainty: Certainty) -> dict[str, object]:
    """Return the page without its chart."""
    return {
        "surface": _surface(package, certainty.surface),
        "margin": _margin(package, certainty.margins),
        "margins": _margin_table(package, certainty.margins) if certainty.margins else None,
        "angles": " ".join(_angles(package, certainty)),
        "turned": _turned_table(package, certainty) if certainty.turned else None,
    }


def pictures(package: PackageData, surface: Surface) -> Sequence[Picture]:
    """Return the contours; none where nothing slides on the whole grid."""
    from report.figures.certainty import contours

    if not (surface.mean_m > 0.0).any():
        return ()
    array, unit = surface.array, package.fmt.units()[0].symbol
    return (
        Picture(
            svg=contours(surface, package.assessment.arrays, package.fmt.us_first),
            caption=f"Mean PRD [{unit}] of the {len(array.motions)} motions over friction "
            f"coefficient and slope, each motion in its governing heading for array {array.id}. "
            f"Crosses: the grid, μ = {_listed(surface.mus.tolist(), 2)} by slope = "
            f"{_listed([math.degrees(s) for s in surface.slopes_rad.tolist()], 1)} deg; contours "
            f"interpolate its logarithm. Tolerance of a run: {power_of_ten(_exponent(TOLERANCE))} "
            f"of its PRD.{_dots(surface)}",
            alt="Contours of the mean PRD over friction coefficient and slope",
        ),
    )


def _exponent(value: float) -> int:
    return round(math.log10(value))


def _listed(values: Sequence[float], decimals: int) -> str:
    return ", ".join(number(value, decimals) for value in values)


def _dots(surface: Surface) -> str:
    if not surface.others:
        return " Dots: the arrays."
    law = "constant" if surface.array.array.friction.is_constant else "velocity-dependent"
    return (
        f" Dots: the arrays; hollow ({', '.join(surface.others)}): friction is not of the kind "
        f"shown, that of {surface.array.id} ({law}), scaled as a whole."
    )


def _surface(package: PackageData, surface: Surface) -> str:
    """Return the grid at the governing array and one step beside it, in words."""
    array, fmt = surface.array, package.fmt
    row = _nearest(surface.slopes_rad.tolist(), array.array.slope_rad)
    column = _nearest(surface.mus.tolist(), array.array.mu)
    here = float(surface.mean_m[row, column])
    lost = int((surface.mean_m != surface.mean_m).sum())
    sentences = [
        f"Array {array.id} (μ = {mu_words(array.array.friction)}, slope "
        f"{number(math.degrees(array.array.slope_rad), 2)}°): the mean PRD on the grid is "
        f"{fmt.both(here)}; the runs of this package, in all headings, give "
        f"{fmt.both(array.analysis.mean_m)}."
    ]
    if here > 0.0:
        sentences += _steps(package, surface, row, column, here)
    elif not (surface.mean_m > 0.0).any() and not lost:
        sentences.append("Nothing slides on the whole grid: no contours are drawn.")
    if lost:
        sentences.append(
            f"{lost} of {surface.mean_m.size} points have no value: a run there gives no "
            "displacement."
        )
    if surface.n_unfinished:
        sentences.append(
            f"{surface.n_unfinished} of {surface.n_runs} runs on the grid are still sliding at the "
            "end of their record: their PRD is not final."
        )
    return " ".join(sentences)


def _nearest(values: Sequence[float], wanted: float) -> int:
    return min(range(len(values)), key=lambda k: abs(values[k] - wanted))


def _steps(
    package: PackageData, surface: Surface, row: int, column: int, here: float
) -> Iterator[str]:
    beside = []
    if column > 0:
        less = float(surface.mean_m[row, column - 1])
        law = with_mu(surface.array.array, float(surface.mus[column - 1])).friction
        beside.append(f"with μ = {mu_words(law)}: {_times(less, here)}")
    if row + 1 < surface.slopes_rad.size:
        steeper = float(surface.mean_m[row + 1, column])
        slope = math.degrees(float(surface.slopes_rad[row + 1]))
        beside.append(f"with a slope of {number(slope, 1)}°: {_times(steeper, here)}")
    if beside:
        text = "; ".join(beside)
        yield f"{text[0].upper()}{text[1:]}."


def _times(value: float, base: float) -> str:
    return NO_VALUE if math.isnan(value) else f"{number(value / base, 2)} times that"


def _margin(package: PackageData, margins: Sequence[Margin]) -> str:
    """Return the smallest margin, and the clearances that have none, in words."""
    if not margins:
        return "The workbook lists no clearances: there is no margin to state."
    have = [margin for margin in margins if margin.gap.ok and not math.isnan(margin.least_mu)]
    without = {margin.number for margin in margins} - {margin.number for margin in have}
    unknown = {margin.number for margin in margins if not margin.gap.is_permitted}
    sentences = []
    if have and not all(margin.is_beyond for margin in have):
        least = max(have, key=lambda margin: _share(margin))
        friction = least.array.array.friction
        start = (
            f"The smallest margin of a satisfied clearance is that of No. {least.number}, "
            f"{least.gap.clearance.array} to {least.gap.clearance.object}: "
            f"μ of {least.array.id}, {mu_words(friction)}, "
        )
        if least.least_mu == least.array.array.mu:
            slow = " at low velocity" if friction.is_by_velocity else ""
            sentences.append(f"{start}may not be 0.01 less{slow}.")
        else:
            percent = number(100.0 * (1.0 - _share(least)), 1)
            sentences.append(f"{start}may be {percent} % less: {_least(least)}.")
    elif have:
        sentences.append(
            "With half of the given friction all clearances that are satisfied remain satisfied."
        )
    if short := sorted(without - unknown):
        verb = "is" if len(short) == 1 else "are"
        sentences.append(
            f"{_clearances(short)} {verb} not satisfied as given; "
            f"{package.part('clearances')} states what would do."
        )
    if unknown:
        verb = "has" if len(unknown) == 1 else "have"
        sentences.append(f"{_clearances(sorted(unknown))} {verb} no verdict, and no margin.")
    return " ".join(sentences)


def _clearances(numbers: Sequence[int]) -> str:
    return f"Clearance{'s' if len(numbers) > 1 else ''} {', '.join(map(str, numbers))}"


def _share(margin: Margin) -> float:
    mu = margin.array.array.mu
    return margin.least_mu / mu if mu > 0.0 else 1.0


def _margin_table(package: PackageData, margins: Sequence[Margin]) -> Table:
    fmt = package.fmt
    return Table(
        caption="Least friction coefficient of each array with which each clearance is satisfied",
        columns=(
            TableColumn(head="No.", share=0.5),
            TableColumn(head="From", align="left", share=0.8),
            TableColumn(head="To", align="left", share=1.1),
            TableColumn(head="Friction of", align="left", share=0.8),
            TableColumn(head="μ", unit="given", share=1.6),
            TableColumn(head="μ", unit="least", share=1.6),
            TableColumn(head="Change", unit="%", share=0.9),
            *fmt.columns("Required there", share=0.9),
            *fmt.columns("Provided", share=0.9),
        ),
        rows=tuple(_margin_row(package, margin) for margin in margins),
        notes=(
            "Searched down to half of the given coefficient in steps of 0.05, then of 0.01, in the "
            "governing heading of each motion; with the value shown all runs satisfy the "
            "clearance, and with 0.01 less they do not, unless marked ≤ (the lowest value tried). "
            "Required there: for this array alone. A friction law is scaled as a whole and named "
            f"by its low-velocity coefficient.{_alike(margins)}",
        ),
        kind="compact",
    )


def _alike(margins: Sequence[Margin]) -> str:
    """Return that arrays that are alike stay so, if any are."""
    if not any(margin.gap.neighbor is Neighbor.LIKE for margin in margins):
        return ""
    return (
        " Arrays that are alike remain alike: the friction of both is that shown. With another "
        "friction on one side alone they are not, and the factor of unlike arrays applies."
    )


def _least(margin: Margin) -> str:
    return mu_words(with_mu(margin.array.array, margin.least_mu).friction)


def _margin_row(package: PackageData, margin: Margin) -> TableRow:
    fmt, row = package.fmt, margin.gap.clearance
    none = math.isnan(margin.least_mu)
    least = "none" if none else _least(margin)
    return TableRow(
        cells=(
            str(margin.number),
            row.array,
            row.object,
            margin.array.id,
            mu_words(margin.array.array.friction),
            f"≤ {least}" if margin.is_beyond and not none else least,
            "—" if none else number(100.0 * (_share(margin) - 1.0), 1),
            *(("—", "—") if none else fmt.cells(margin.required_m)),
            *fmt.cells(row.provided_m, Quantity.SIZE),
        )
    )


def _angles(package: PackageData, certainty: Certainty) -> Iterator[str]:
    """Yield what the runs in other directions give."""
    run, used = certainty.motion, certainty.used_m
    array = package.governing.id
    yield (
        f"PRD used for array {array} under its governing motion, {run.motion.id}: "
        f"{package.fmt.both(used)}. The runs below are not part of the design value."
    )
    yield f"{directions(package, certainty)}."


def directions(package: PackageData, certainty: Certainty) -> str:
    """Return what other angles and a reversed vertical component give, as a clause."""
    angles = (
        f"{len(certainty.turned)} more angles of the horizontal pair give "
        f"{turned_words(package, certainty)}"
        if certainty.turned
        else "the motion has one horizontal component, and its angle is not varied"
    )
    text = f"{angles}; {reversed_words(package, certainty)}"
    return text[0].upper() + text[1:]


def turned_words(package: PackageData, certainty: Certainty) -> str:
    """Return the range of the PRDs at other angles, as a clause."""
    used, worst = certainty.used_m, certainty.worst
    if math.isnan(worst.result.prd_m):
        return f"no displacement at {number(worst.angle_deg, 1)}°: {worst.result.status.sentence}"
    if not used > 0.0:
        return f"PRDs up to {package.fmt.both(worst.result.prd_m)}"
    least = min(run.result.prd_m for run in certainty.turned)
    return (
        f"{number(least / used, 2)} to {number(worst.result.prd_m / used, 2)} times that PRD, the "
        f"largest at {number(worst.angle_deg, 1)}°"
    )


def reversed_words(package: PackageData, certainty: Certainty) -> str:
    """Return what the reversed vertical component gives, as a clause."""
    value, used = certainty.reversed_m, certainty.used_m
    if not certainty.motion.motion.has_vertical:
        return "there is no vertical component to reverse"
    if math.isnan(value):
        return "a reversed vertical component gives no displacement"
    times = f", {number(value / used, 2)} times that PRD" if used > 0.0 else ""
    return f"a reversed vertical component gives {package.fmt.both(value)}{times}"


def _turned_table(package: PackageData, certainty: Certainty) -> Table:
    runs, used = certainty.turned, certainty.used_m
    values = [package.fmt.cells(run.result.prd_m) for run in runs]
    shares = [number(run.result.prd_m / used, 2) if used > 0.0 else "—" for run in runs]
    units = [f"PRD [{unit.symbol}]" for unit in package.fmt.units()]
    rows = zip((*units, "PRD / used"), (*zip(*values, strict=True), shares), strict=True)
    return Table(
        caption=f"Array {package.governing.id} under motion {certainty.motion.motion.id}, its "
        "horizontal pair turned counterclockwise; at 0° the record acts downslope",
        columns=(
            TableColumn(head="Angle", align="left", share=1.7),
            *(TableColumn(head=f"{number(run.angle_deg, 1)}°") for run in runs),
        ),
        rows=tuple(TableRow(cells=(name, *cells)) for name, cells in rows),
        kind="compact",
    )
