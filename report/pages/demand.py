"""The seismic demand in equations: S_DS and the target spectra of the motions."""

from __future__ import annotations

from collections.abc import Iterator

from markupsafe import Markup

from report.motions.targets import OWN
from report.pages.parts import Line, PackageData
from report.sheet.schema import RecordedAt
from report.typeset.equations import fraction, symbol
from report.words.units import number


def demand_lines(package: PackageData) -> tuple[Line, ...]:
    """Return S_DS and the corners of the target spectra in use."""
    return (*_s_ds(package), *_ac156(package), *_design_spectrum(package))


def _s_ds(package: PackageData) -> Iterator[Line]:
    site = package.data.site
    if site.s_ds_g is None and site.s_s_g is not None and site.f_a is not None:
        yield Line(
            latex=r"S_{DS}=\frac{2}{3}F_a S_S",
            reference="ASCE 7 Eqs. 11.4-1, 11.4-3",
            steps=(
                (
                    Markup("{} × {} × {} g").format(
                        fraction("2", "3"), number(site.f_a, 3), number(site.s_s_g, 3)
                    ),
                    f"{number(site.s_ds, 3)} g",
                ),
            ),
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
        yield Line(
            latex=flexible,
            reference="AC156",
            steps=(
                (
                    f"min({s_ds} g × {amplified}, 1.6 × {s_ds} g)",
                    f"{number(float(horizontal.sa_g[1]), 3)} g",
                ),
            ),
        )
        yield Line(
            latex=rigid,
            reference="AC156",
            steps=((f"0.4 × {s_ds} g × {amplified}", f"{number(float(horizontal.sa_g[3]), 3)} g"),),
        )
    if goals.vertical.name != OWN:
        yield Line(
            latex=r"A_{FLX,v}=0.67\,S_{DS},\quad A_{RIG,v}=0.27\,S_{DS}",
            reference="AC156, vertical",
            steps=(
                (
                    f"0.67 × {s_ds} g, 0.27 × {s_ds} g",
                    f"{number(float(vertical.sa_g[1]), 3)} g, "
                    f"{number(float(vertical.sa_g[3]), 3)} g",
                ),
            ),
        )


def _design_spectrum(package: PackageData) -> Iterator[Line]:
    """Yield the design spectrum where it is the target of ground motions."""
    site, t_l_s = package.data.site, package.data.target.t_l_s
    on_ground = any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions)
    has_own = package.assessment.targets.ground.name == OWN
    if not on_ground or has_own or site.s_1_g is None or site.f_v is None or t_l_s is None:
        return
    s_d1_g = 2.0 / 3.0 * site.f_v * site.s_1_g
    yield Line(
        latex=(
            r"S_a=\mathrm{min}\left(S_{DS},\ \frac{S_{D1}}{T},\ \frac{S_{D1}T_L}{T^2}\right),"
            r"\quad S_{D1}=\frac{2}{3}F_v S_1"
        ),
        reference="ASCE 7, 11.4.6",
        steps=(
            (
                Markup("{}: {} × {} × {} g").format(
                    symbol("S_D1"), fraction("2", "3"), number(site.f_v, 3), number(site.s_1_g, 3)
                ),
                f"{number(s_d1_g, 3)} g",
            ),
        ),
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
