"""The command line; `*_cli` and `terminal` beside it alone print and catch as well.

Parses, calls, reports; heavy imports stay inside the commands so that `--help` is quick.
Exit codes: 0 done, 2 the input is at fault, 1 a defect of ours (with the traceback, or with the
checks that failed).
"""

from __future__ import annotations

import datetime as dt
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.garbage import no_collections, none_at_exit
from report.motion_cli import motion
from report.slide_cli import slide
from report.terminal import Progress, input_errors

if TYPE_CHECKING:
    from report.assess import ArrayAssessment, Assessment
    from report.sheet.workbook import InputBook
    from solver.verification.evidence import Verification

_SCENE = click.Path(path_type=Path)


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 96})
@click.version_option(package_name="roofslip", prog_name="roofslip")
def main() -> None:
    """Calculation packages for the seismic sliding of ballasted rooftop solar arrays.

    Begin with `roofslip new DIR`, fill DIR/input.xlsx, then run `roofslip report DIR`.
    """
    none_at_exit()


main.add_command(motion)
main.add_command(slide)


@main.command()
@click.argument("folder", metavar="DIR", type=_SCENE)
@click.option("--units", type=click.Choice(["US", "SI"]), default="US", show_default=True,
              help="Units of the input cells, and the ones printed first.")  # fmt: skip
def new(folder: Path, units: str) -> None:
    """Write DIR/input.xlsx, ready to fill, and DIR/records/ for the motions."""
    with input_errors(folder):
        path = _new_project(folder, units)
    click.echo(f"{path}: fill the yellow cells, put the roof motions into {folder / 'records'},")
    click.echo(f"then run: roofslip report {folder}")


def _new_project(folder: Path, units: str) -> Path:
    """Write a blank workbook and an empty records folder; never over a workbook that is there."""
    from report.sheet.schema import UnitsFirst
    from report.sheet.template import write_template
    from solver.model import InputError

    path = folder / "input.xlsx"
    if path.exists():
        raise InputError(f"{path}: is there already; choose another folder, or move it away")
    try:
        (folder / "records").mkdir(parents=True, exist_ok=True)
        write_template(path, units=UnitsFirst(units))
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written ({error.strerror}); choose another folder"
        ) from error
    return path


@main.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=_SCENE)
def check(source: Path) -> None:
    """Read and validate the input; write nothing."""
    with input_errors(source):
        book = _read(source)
    data = book.input
    click.echo(
        f"{book.path}: no problems found. {len(data.arrays)} arrays, {len(data.clearances)} "
        f"clearances, {len(data.motions)} motions, S_DS {data.site.s_ds:.3f} g, "
        f"{data.site.rule_set}."
    )


@main.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=_SCENE)
@click.option("--out", type=_SCENE, help="Folder for the outputs; default: out/ beside the input.")
def report(source: Path, out: Path | None) -> None:
    """Write calc-package.pdf, results.xlsx and results.json, and print the governing numbers."""
    with input_errors(source), Progress() as progress, no_collections():
        book, assessment, files = _outputs(source, progress)
        progress("putting the files in place")
        folder = out or book.path.parent / "out"
        _publish(files, folder)
    _print_summary(book, assessment)
    click.echo("")
    for name in files:
        click.echo(folder / name)


@main.command()
@click.option("--out", type=_SCENE, default=Path("out"), show_default=True,
              help="Folder for the outputs.")  # fmt: skip
@click.option("--quick", is_flag=True, help="Fewer records, scenes and settings: seconds.")
@click.option("--records", type=_SCENE, help="Folder of real records: files of three components "
              "run in every model; roof_575_market in it, ground and floors of 575 Market Street, "
              "is held against the way from ground to roof.")  # fmt: skip
def verify(out: Path, quick: bool, records: Path | None) -> None:
    """Check the solver and every rival, and write verification.pdf with its table and charts.

    Exits 1 where a check fails, with the outputs written.
    """
    with input_errors(records or out), Progress() as progress:
        found, files = _verification(quick, records, progress)
        progress("putting the files in place")
        _publish(files, out)
    failed = [row for row in found.checks if not row.passed]
    passed = len(found.checks) - len(failed)
    click.echo(f"{'FAIL' if failed else 'PASS'}: {passed} of {len(found.checks)} checks passed")
    for row in failed:
        click.echo(
            f"  {row.section}: {row.problem}, {row.quantity}: expected {row.expected:.10g}, found "
            f"{row.found:.10g} {row.unit}, error {row.error:.1e} over {row.tolerance:.1e}"
        )
    for name in files:
        click.echo(out / name)
    if failed or not found.checks:
        sys.exit(1)


# The steps of a report


def _read(source: Path) -> InputBook:
    from report.sheet.workbook import read_workbook

    return read_workbook(source)


def _assess(book: InputBook) -> Assessment:
    from report.assess import assess

    return assess(book.input, book.motions)


def _outputs(
    source: Path, progress: Callable[[str], None]
) -> tuple[InputBook, Assessment, dict[str, bytes]]:
    """Return the input, what was found, and every output as finished bytes, by file name."""
    from report.aside import begin
    from report.package import load, render
    from report.pages.parts import Scene

    # One process computes and finds the words, this one draws and lays out.
    steps = begin(lambda: _steps(source, progress))
    load()
    book, assessment = next(steps)
    scene = Scene(data=book.input, assessment=assessment)
    package = render(scene, lambda: next(steps), lambda: next(steps), progress)
    progress("writing the result tables")
    (tables,) = steps
    return book, assessment, {"calc-package.pdf": package, **tables}


def _steps(source: Path, progress: Callable[[str], None]) -> Iterator[Any]:
    """Yield input and assessment, then findings, then the words of the package, then the tables."""
    from report.findings import find
    from report.package import words
    from report.pages.parts import Scene

    progress("reading the workbook")
    book = _read(source)
    progress("running the motions (the first run compiles the solver)")
    assessment = _assess(book)
    scene = Scene(data=book.input, assessment=assessment)
    yield book, assessment
    found = find(book, assessment, scene.governing)
    yield found
    yield words(book, scene, found)
    yield _tables(book, assessment)


def _tables(book: InputBook, assessment: Assessment) -> dict[str, bytes]:
    from report.outputs import results_json
    from report.results_book import results_xlsx

    return {
        "results.xlsx": results_xlsx(book, assessment),
        "results.json": results_json(book, assessment),
    }


def _verification(
    quick: bool, records: Path | None, progress: Callable[[str], None]
) -> tuple[Verification, Mapping[str, bytes]]:
    """Return what was found, and every output as finished bytes by file name."""
    from report.manual.render import files
    from solver.verification.run import recorded_buildings, recorded_triples, verify

    buildings = recorded_buildings(records) if records else ()
    motions = recorded_triples(records) if records else ()
    found = verify((), quick=quick, progress=progress, buildings=buildings, motions=motions)
    return found, files(found, dt.date.today(), progress)


def _publish(files: Mapping[str, bytes], folder: Path) -> None:
    from report.outputs import publish

    publish(files, folder)


# What is printed


def _print_summary(book: InputBook, assessment: Assessment) -> None:
    us_first = book.input.project.units_first == "US"
    columns = ("array", "computed", "prescriptive", "design", "governing clearance", "D/C", "")
    rows = [_summary_row(assessment, item, us_first) for item in assessment.arrays]
    widths = [max(map(len, column)) for column in zip(columns, *rows, strict=True)]
    for row in (columns, *rows):
        cells = (text.ljust(width) for text, width in zip(row, widths, strict=True))
        click.echo("  ".join(cells).rstrip())
    for warning in assessment.warnings:
        click.echo(f"warning: {warning}")
    for item in assessment.arrays:
        if not item.tipping.is_ok:
            click.echo(f"warning: array {item.array.id} begins to tip: part 11 of the package")
    for name in (one.found.array.id for one in assessment.linked if not one.is_rigid_enough):
        text = f"one rigid block is not shown to be enough for array {name}"
        click.echo(f"warning: {text}: part 11 of the package")
    checks = [*assessment.building_checks, *(c for a in assessment.arrays for c in a.checks)]
    for failed in (c for c in checks if not c.ok):
        click.echo(f"warning: outside {failed.provision.clause}: {failed.title}")


def _summary_row(assessment: Assessment, item: ArrayAssessment, us_first: bool) -> tuple[str, ...]:
    from report.units import Quantity, pair, ratio

    def shown(value_m: float) -> str:
        if value_m != value_m:
            return "no value"
        return pair(value_m, Quantity.DISPLACEMENT, us_first)

    gap = assessment.governing_clearance(item.array.id)
    clearance = (f"to {gap.across_from(item.array.id)}", ratio(gap.demand_capacity)) if gap else ()
    return (
        item.array.id,
        shown(item.analysis.value_m),
        shown(item.prescriptive.value_m),
        shown(item.design_m),
        *(clearance or ("none given", "")),
        "OK" if assessment.array_ok(item) else "NG",
    )


if __name__ == "__main__":
    main()
