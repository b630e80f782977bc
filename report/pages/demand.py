"""The seismic demand in equations: S_DS and S_D1, target spectra of the motions, and F_p."""

from __future__ import annotations

from collections.abc import Iterator

from markupsafe import Markup

from report.document.blocks import Line
from report.motions.targets import OWN
from report.pages.parts import PackageData
from report.pages.site import site_force
from report.sheet.schema import RecordedAt, Site
from report.typeset.equations import fraction, symbol
from report.words.units import number


def demand_lines(package: PackageData) -> tuple[Line, ...]:
    """Return S_DS and S_D1 from the given values, the target spectra in use, and F_p."""
    site = package.data.site
    return (
        *_parameters(site, _SHORT, (site.s_s_g, site.f_a, site.s_ms_g, site.s_ds_g)),
        *_parameters(site, _AT_1S, (site.s_1_g, site.f_v, site.s_m1_g, site.s_d1_g)),
        *_ac156(package),
        *_design_spectrum(package),
        *_force(package),
    )


# Mapped value, coefficient, maximum considered and design value.
_SHORT = ("S_S", "F_a", "S_{MS}", "S_{DS}")
_AT_1S = ("S_1", "F_v", "S_{M1}", "S_{D1}")

_Given = tuple[float | None, float | None, float | None, float | None]


def _parameters(site: Site, names: tuple[str, str, str, str], given: _Given) -> Iterator[Line]:
    """Yield the equations of one period for what is not given, as `Site.parameters` has it."""
    mapped, coefficient, maximum, design = given
    mapped_name, coefficient_name, maximum_name, design_name = names
    clause = site.edition.clause
    if maximum is None and site.edition.has_site_coefficients and mapped and coefficient:
        maximum = coefficient * mapped
        latex = f"{maximum_name}={coefficient_name}\\,{mapped_name}"
        substituted = f"{number(coefficient, 3)} × {number(mapped, 3)} g"
        yield _line(latex, clause("s_ms"), (substituted, f"{number(maximum, 3)} g"))
    if design is None and maximum is not None:
        yield _ratio(clause("s_ds"), design_name, ("2", "3"), maximum_name, maximum)
    if design is not None and maximum is None:
        yield _ratio(clause("s_ds"), maximum_name, ("3", "2"), design_name, design)


def _ratio(
    reference: str, name: str, share: tuple[str, str], other_name: str, other_g: float
) -> Line:
    """Return an acceleration as a fraction of another."""
    above, below = share
    latex = rf"{name}=\frac{{{above}}}{{{below}}}\,{other_name}"
    substituted = Markup("{} × {} g").format(fraction(above, below), number(other_g, 3))
    result_g = float(above) / float(below) * other_g
    return _line(latex, reference, (substituted, f"{number(result_g, 3)} g"))


def _line(latex: str, reference: str, *steps: tuple[str, str]) -> Line:
    return Line(latex=latex, reference=reference, steps=steps)


def _force(package: PackageData) -> Iterator[Line]:
    """Yield F_p / W_p with its limits, where a_p and R_p are given."""
    site, force = package.data.site, site_force(package)
    if force is None or site.force_factor is None or site.force_divisor is None:
        return
    largest_i_p = max(array.i_p for array in package.data.arrays)
    s_ds, i_p = number(site.s_ds, 3), number(largest_i_p, 2)
    factor, divisor = number(site.force_factor, 2), number(site.force_divisor, 2)
    height = number(site.z_over_h, 3)
    steps: tuple[tuple[str | Markup, str], ...] = ()
    if site.edition.has_site_coefficients:
        latex = r"\frac{F_p}{W_p}=\frac{0.4\,a_p\,S_{DS}}{R_p/I_p}\left(1+2\,\frac{z}{h}\right)"
        substituted = f"0.4 × {factor} × {s_ds} / ({divisor} / {i_p}) × (1 + 2 × {height})"
    else:
        latex = r"\frac{F_p}{W_p}=0.4\,S_{DS}\,I_p\,\frac{H_f}{R_{\mu}}\,\frac{C_{AR}}{R_{po}}"
        amplified = force.formula / (
            0.4 * site.s_ds * largest_i_p * site.force_factor / site.force_divisor
        )
        reduction = site.edition.amplification.reduction_at(site.z_over_h)
        ratio_of = Markup("{} / {} = {} / {}").format(
            symbol("H_f"), symbol("R_μ"), number(amplified * reduction, 3), number(reduction, 2)
        )
        steps = ((ratio_of, number(amplified, 3)),)
        substituted = f"0.4 × {s_ds} × {i_p} × {number(amplified, 3)} × {factor} / {divisor}"
    yield Line(
        latex=latex,
        reference=site.edition.clause("force"),
        steps=(
            *steps,
            (substituted, number(force.formula, 3)),
            (f"At most 1.6 × {s_ds} × {i_p}", number(force.maximum, 3)),
            (f"At least 0.3 × {s_ds} × {i_p}", number(force.minimum, 3)),
        ),
        note="For comparison: an unattached array slides, and no clearance here uses this force.",
    )


def _ac156(package: PackageData) -> Iterator[Line]:
    """Yield the corners at the roof, of components without a project-specific spectrum."""
    site, goals = package.data.site, package.assessment.targets
    horizontal, vertical = package.assessment.horizontal_target, package.assessment.vertical_target
    s_ds, height = number(site.s_ds, 3), number(site.roof_height_m / site.structure_height_m, 3)
    amplification = package.data.site.edition.amplification
    is_above_grade = site.roof_height_m > 0.0  # at grade there is no reduction
    slope = f"{amplification.slope:g}"
    reduction = f"{amplification.reduction:g}" if is_above_grade else "1"
    if reduction == "1":
        formula = rf"S_{{DS}}\left(1+{slope}\,\frac{{z}}{{h}}\right)"
        amplified = f"(1 + {slope} × {height})"
    else:
        formula = rf"S_{{DS}}\frac{{1+{slope}\,z/h}}{{{reduction}}}"
        amplified = f"(1 + {slope} × {height}) / {reduction}"
    flexible = rf"A_{{FLX}}={formula}\leq 1.6\,S_{{DS}}"
    rigid = rf"A_{{RIG}}=0.4\,{formula}"
    if goals.roof.name != OWN:
        flexible_g, rigid_g = (f"{number(float(horizontal.sa_g[k]), 3)} g" for k in (1, 3))
        least = f"min({s_ds} g × {amplified}, 1.6 × {s_ds} g)"
        yield _line(flexible, "AC156", (least, flexible_g))
        yield _line(rigid, "AC156", (f"0.4 × {s_ds} g × {amplified}", rigid_g))
    if goals.vertical.name != OWN:
        found = ", ".join(f"{number(float(vertical.sa_g[k]), 3)} g" for k in (1, 3))
        latex = r"A_{FLX,v}=0.67\,S_{DS},\quad A_{RIG,v}=0.27\,S_{DS}"
        yield _line(latex, "AC156, vertical", (f"0.67 × {s_ds} g, 0.27 × {s_ds} g", found))


def _design_spectrum(package: PackageData) -> Iterator[Line]:
    """Yield the design spectrum where it is the target of ground motions."""
    site, t_l_s = package.data.site, package.data.target.t_l_s
    on_ground = any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions)
    has_own = package.assessment.targets.ground.name == OWN
    s_d1_g = site.s_d1
    if not on_ground or has_own or s_d1_g is None or t_l_s is None:
        return
    yield Line(
        latex=(r"S_a=\mathrm{min}\left(S_{DS},\ \frac{S_{D1}}{T},\ \frac{S_{D1}T_L}{T^2}\right)"),
        reference=site.edition.clause("t_l"),
        note=Markup(
            "At the ground. Below {} = 0.2 {} = {} s it decreases to 0.4 {} at T = 0; {} = {} s, "
            "{} = {} s."
        ).format(
            symbol("T_0"),
            symbol("T_S"),
            number(0.2 * s_d1_g / site.s_ds, 3),
            symbol("S_DS"),
            symbol("T_S"),
            number(s_d1_g / site.s_ds, 3),
            symbol("T_L"),
            f"{t_l_s:g}",
        ),
    )
