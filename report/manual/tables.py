"""Sections that consist of tables: checks, methods, other programs, software."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from report.document.tables import Table, TableRow, Wide
from report.entities.columns import TableColumn
from report.manual.blocks import (
    FAIL,
    PASS,
    Block,
    ManualSection,
    digits,
    percent,
    scientific,
    seconds,
    unbroken,
)
from report.manual.machine import Machine
from report.pages.parts import verdict
from report.words.letters import lettered
from report.words.units import number
from solver.rivals.methods import METHODS
from solver.verification.evidence import (
    CheckRow,
    PeerPoint,
    Verification,
)


def checks(verification: Verification) -> ManualSection:
    """Return every check, a table for each section."""
    names = dict.fromkeys(row.section for row in verification.checks)
    return ManualSection(
        id="checks",
        title="Checks",
        blocks=[
            Block(
                title=name,
                tables=(_check_table([r for r in verification.checks if r.section == name]),),
            )
            for name in names
        ],
    )


def _check_table(checks: Sequence[CheckRow]) -> Table:
    rows: list[TableRow] = []
    for id, source in dict.fromkeys((row.id, row.source) for row in checks):
        words = f"{id}. Source: {lettered(source)}"
        rows.append(TableRow(cells=(Wide(words, 7),), kind="total"))
        rows += [_check_row(row) for row in checks if (row.id, row.source) == (id, source)]
    return Table(
        caption="",
        columns=(
            TableColumn(head="Problem", align="left", share=3.15),
            TableColumn(head="Quantity", align="left", share=1.95),
            TableColumn(head="Expected", share=1.55),
            TableColumn(head="Computed", share=1.55),
            TableColumn(head="Error", share=1.1),
            TableColumn(head="Tolerance", share=1.1),
            TableColumn(head="Result", align="center", share=0.7),
        ),
        rows=tuple(rows),
        kind="compact",
    )


def _check_row(row: CheckRow) -> TableRow:
    return TableRow(
        cells=(
            unbroken(lettered(row.problem)),
            f"{row.quantity} [{lettered(row.unit)}]" if row.unit != "1" else row.quantity,
            digits(row.expected),
            digits(row.computed),
            scientific(row.error),
            scientific(row.tolerance),
            verdict(row.passed, (PASS, FAIL)),
        )
    )


def methods() -> ManualSection:
    """Return the table of methods."""
    table = Table(
        caption="",
        columns=(
            TableColumn(head="Method", align="left", share=1.7),
            TableColumn(head="Accuracy set by", align="left", share=1.5),
            TableColumn(head="Order", align="center", share=0.55),
            TableColumn(head="Vertical", align="center", share=0.75),
            TableColumn(head="Limitations", align="left", share=3.6),
            TableColumn(head="Source", align="left", share=2.6),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    lettered(method.title),
                    _KNOBS[method.knob],
                    number(method.order, 0),
                    "yes" if method.takes_vertical else "no",
                    lettered(method.invalid_when),
                    lettered(method.source),
                )
            )
            for method in METHODS.values()
        ),
        notes=(
            "Order: order of convergence in the sub-step where the motion is smooth; transitions "
            "between stick and slip reduce it to one. Vertical: whether the method includes "
            "vertical shaking.",
        ),
        kind="compact",
    )
    return ManualSection(
        id="methods",
        title="Methods compared",
        blocks=(
            Block(
                texts=(
                    "Each method is implemented in its usual form, and all have the same input and "
                    "output. Calculation packages use the first method; the others serve for "
                    "comparison only.",
                ),
                tables=(table,),
            ),
        ),
    )


_KNOBS = {
    "": "no setting",
    "substeps": "sub-steps per interval",
    "stiffness_per_m": "link stiffness [1/m]",
    "tolerance": "relative tolerance",
    "velocity_mps": "velocity v0 [m/s]",
}


def peers(peers: Sequence[PeerPoint]) -> ManualSection:
    """Return the results of other programs."""
    return ManualSection(
        id="peers",
        title="Other programs",
        blocks=(
            Block(
                texts=(
                    "These programs were run on the same records and analysis cases during this "
                    "verification, where installed. None of them is required by, or part of, "
                    "this program.",
                ),
                tables=(
                    Table(
                        caption="",
                        columns=(
                            TableColumn(head="Record", align="left", share=2.0),
                            TableColumn(head="Analysis case", align="left", share=2.0),
                            TableColumn(head="Time per run", share=1.0),
                            TableColumn(head="Error in PRD", share=1.0),
                        ),
                        rows=tuple(_peer_rows(peers)),
                        kind="compact",
                    ),
                ),
            ),
        ),
    )


def _peer_rows(peers: Sequence[PeerPoint]) -> Iterator[TableRow]:
    """Yield the runs of each program and model below a row that names them."""
    named = [(f"{peer.peer} {peer.version}: {peer.note}", peer) for peer in peers]
    for name in dict.fromkeys(name for name, _ in named):
        yield TableRow(cells=(Wide(name, 4),), kind="total")
        for peer in (peer for other, peer in named if other == name):
            failed = math.isnan(peer.prd_error_percent)
            error = "failed" if failed else percent(peer.prd_error_percent)
            yield TableRow(cells=(peer.record, lettered(peer.scene), seconds(peer.seconds), error))


def _command(verification: Verification) -> str:
    words = "roofslip verify --quick" if verification.quick else "roofslip verify"
    if len(verification.roofs) > 1 or any(
        evidence.study.n_recorded for evidence in verification.rungs
    ):
        words += " --records followed by the folder of the recorded motions of section 2"
    if verification.tables:
        words += " --table followed by the folder of the tests of section 13"
    return words


def software(verification: Verification, machine: Machine) -> ManualSection:
    """Return versions and the machine."""
    return ManualSection(
        id="software",
        title="Software and machine",
        blocks=(
            Block(
                texts=(
                    "Run times were measured on this machine under its load at the time; errors "
                    f"do not depend on the machine. Command to repeat: {_command(verification)}. "
                    "The file verification.csv lists all checks and all runs of the methods; the "
                    "folder charts has the charts as files.",
                ),
                tables=(
                    Table(
                        caption="",
                        columns=(
                            TableColumn(head="Item", align="left"),
                            TableColumn(head="Version or description", align="left", share=3.0),
                        ),
                        rows=tuple(TableRow(cells=cells) for cells in machine.rows),
                    ),
                ),
            ),
        ),
    )
