"""The comparison with shake-table tests: acceptance, tests, result; or that there are none."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from report.document.blocks import Picture
from report.document.tables import Table, TableRow, Wide
from report.entities.columns import TableColumn
from report.figures.shake_table import computed_against_measured
from report.manual.blocks import FAIL, PASS, Block, Chart, ManualSection, joined
from report.pages.parts import verdict
from report.words.units import number
from report.words.validation import NOT_VALIDATED, explained
from solver.verification.evidence import Verification
from solver.verification.shake_table import (
    LEAST_M,
    LEAST_TESTS,
    MEDIAN,
    RATIOS,
    SHARE,
    ShakeTable,
    TableRun,
)
from solver.verification.table_tests import Data


def shake_table(verification: Verification) -> ManualSection:
    """Return the section."""
    return ManualSection(
        id="shake-table",
        title="Comparison with a shake table",
        blocks=(
            Block(title="Acceptance, stated before any comparison", texts=_acceptance()),
            *(block for table in verification.tables for block in _blocks(table)),
            *(() if verification.tables else (_none(),)),
        ),
    )


def _acceptance() -> tuple[str, ...]:
    return (
        "Each test is run with the accelerations of the table, its slope and its friction "
        "coefficient, by the model that a calculation package would use. The ratio is computed "
        f"PRD / measured PRD. Accepted: the median of the ratios is {MEDIAN[0]:g} to "
        f"{MEDIAN[1]:g}; at least {100.0 * SHARE:g}\u00a0% of the ratios are {RATIOS[0]:g} to "
        f"{RATIOS[1]:g}; there are at least {LEAST_TESTS} ratios. A test with a measured PRD of "
        f"less than {1e3 * LEAST_M:g} mm has no ratio; a run without a result counts as a ratio "
        "outside of the range. Residual displacements are listed and not judged: they may nearly "
        "cancel.",
    )


def _none() -> Block:
    return Block(
        title="Result",
        texts=(
            f"No tests of a shake table were given to this run (option --table). {explained(())}",
        ),
    )


def _blocks(table: ShakeTable) -> Iterator[Block]:
    yield Block(title="Tests", texts=(_origin(table),), tables=(_tests(table),))
    drawn = [run for run in table.runs if run.ratio > 0.0]
    yield Block(
        title="Result",
        texts=(result(table),),
        top=(_judged(table),),
        charts=(
            Chart(
                name="shake-table",
                picture=Picture(
                    svg=computed_against_measured(table),
                    caption="Computed PRD against the stated PRD of each test. Line: equal "
                    f"values; gray: ratios of {RATIOS[0]:g} to {RATIOS[1]:g}.",
                    alt="Computed PRD against the PRD of the shake-table tests",
                ),
            ),
        )
        if drawn
        else (),
    )


def _origin(table: ShakeTable) -> str:
    """Return where the slip of the tests comes from, in the words of the file."""
    counts = {
        data: sum(run.test.data is data for run in table.runs)
        for data in (Data.MEASURED, Data.COMPUTED)
    }
    words = (
        f"{len(table.runs)} tests were given. The file tests.csv states that the slip of "
        f"{counts[Data.MEASURED]} was measured and that of {counts[Data.COMPUTED]} was computed. "
        "The program cannot check this statement or the sources below."
    )
    if counts[Data.COMPUTED]:
        words += (
            " A slip that was computed validates nothing: this comparison exercises the procedure "
            "only."
        )
    return words


def result(table: ShakeTable) -> str:
    """Return whether the acceptance is satisfied, and what follows from it."""
    words = "The acceptance is satisfied." if table.is_accepted else (
        f"The acceptance is not satisfied: {joined(list(_unsatisfied(table)))}."
    )  # fmt: skip
    return words if table.validates else f"{words} {NOT_VALIDATED}"


def _unsatisfied(table: ShakeTable) -> Iterator[str]:
    for name, found, limit, is_satisfied in _rows(table):
        if not is_satisfied:
            yield f"{name[0].lower()}{name[1:]}, {found} instead of {limit}"


def _rows(table: ShakeTable) -> Iterator[tuple[str, str, str, bool]]:
    count, low, high = table.ratios.size, *MEDIAN
    yield "Number of ratios", str(count), f"{LEAST_TESTS} or more", count >= LEAST_TESTS
    yield (
        "Median ratio",
        _ratio(table.median),
        f"{low:g} to {high:g}",
        low <= table.median <= high,
    )
    yield (
        f"Share of the ratios in {RATIOS[0]:g} to {RATIOS[1]:g}",
        f"{100.0 * table.share_within:.0f} %",
        f"{100.0 * SHARE:g} % or more",
        table.share_within >= SHARE,
    )


def _judged(table: ShakeTable) -> Table:
    return Table(
        caption="Acceptance",
        columns=(
            TableColumn(head="Requirement", align="left", share=3.0),
            TableColumn(head="Found", share=1.2),
            TableColumn(head="Accepted", share=1.4),
            TableColumn(head="Result", align="center", share=0.8),
        ),
        rows=tuple(
            TableRow(cells=(name, found, limit, verdict(is_satisfied, (PASS, FAIL))))
            for name, found, limit, is_satisfied in _rows(table)
        ),
    )


def _tests(table: ShakeTable) -> Table:
    return Table(
        caption="Tests and computed values",
        columns=(
            TableColumn(head="Test", align="left", share=1.6),
            TableColumn(head="Axes", align="left", share=0.7),
            TableColumn(head="θ", unit="deg", share=0.6),
            TableColumn(head="μ", share=0.9),
            TableColumn(head="Model", share=0.7),
            TableColumn(head="PRD, stated", unit="mm", share=1.0),
            TableColumn(head="PRD, computed", unit="mm", share=1.1),
            TableColumn(head="Ratio", share=0.7),
            TableColumn(head="Residual, stated", unit="mm", share=1.1),
            TableColumn(head="Residual, computed", unit="mm", share=1.2),
        ),
        rows=tuple(_test_rows(table.runs)),
        notes=(
            "Stated: the value in tests.csv. Residual: magnitude. Model: number of the model, "
            "section 12. μ: kinetic, and static if it is another.",
        ),
        kind="compact",
    )


def _test_rows(runs: Sequence[TableRun]) -> Iterator[TableRow]:
    """Yield the tests of each source below a row that names it."""
    named = [(f"Slip {run.test.data}: {run.test.source}", run) for run in runs]
    for name in dict.fromkeys(name for name, _ in named):
        yield TableRow(cells=(Wide(name, 10),), kind="total")
        yield from (_test_row(run) for other, run in named if other == name)


def _test_row(run: TableRun) -> TableRow:
    scene = run.test.scene
    law = scene.friction
    mu = f"{law.mu_slow:g}" if law.is_constant else f"{law.mu_slow:g}, {law.mu_static:g}"
    axes = "x" + ("y" if scene.ay_mps2.size else "") + ("z" if scene.az_mps2.size else "")
    return TableRow(
        cells=(
            run.test.name,
            axes,
            f"{math.degrees(scene.slope_rad):.3g}",
            mu,
            str(int(run.model)),
            _mm(run.test.prd_m),
            run.status.value if math.isnan(run.prd_m) else _mm(run.prd_m),
            _ratio(run.ratio),
            _mm(run.test.residual_m),
            _mm(run.residual_m),
        )
    )


def _ratio(value: float) -> str:
    return "—" if math.isnan(value) else f"{value:.3f}"


def _mm(value_m: float) -> str:
    return "—" if math.isnan(value_m) else number(1e3 * value_m, 1)
