"""How a study was run: motions, mats, models; and its limits."""

from __future__ import annotations

from collections.abc import Iterator

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.manual.blocks import Block, ManualSection, joined
from report.pages.symbols import with_symbols
from report.study.results import StudyResults
from report.study.spread import FREQ_HZ
from report.words.units import digits_up
from report.words.validation import explained
from solver.verification.shake_table import SHIPPED


def basis(results: StudyResults) -> ManualSection:
    """Return the section on how the study was run."""
    tables = (_models(results), *_mats(results), _motions(results), *_warnings(results))
    block = Block(texts=_how(results), tables=tables)
    return ManualSection(id="basis", title="Basis", blocks=(block,))


def _how(results: StudyResults) -> tuple[str, ...]:
    manifest, model = results.manifest, results.manifest["model"]
    motions = results.plan.motions.motions[0]
    components = 1 + motions[0].has_transverse + motions[0].has_vertical
    orientations = len(motions[0].orientations)
    without = results.curves.without_value
    return (
        f"Each of {len(motions)} motions with {components} component"
        f"{'s' if components > 1 else ''} is scaled to each "
        f"{results.plan.input.study.intensity.letters} and run {orientations} time"
        f"{'s' if orientations > 1 else ''}: "
        f"{'each horizontal component' if motions[0].has_transverse else 'the record'} along the "
        f"slope, {'as recorded and reversed' if len(motions[0].signs) > 1 else 'in one polarity'}. "
        "The largest PRD of these runs is the PRD of the motion.",
        "Each run uses the simplest adequate model: a component is neglected if its effect on the "
        f"PRD and on every excursion is at most the larger of {1e3 * model['matters_m']:g} mm and "
        f"{100.0 * model['matters_share']:g} % of the PRD.",
        _lost_words(int(without.sum()), without.size * len(motions)),
        f"The runs of the cases are in the folder runs: one row for each run in Parquet files, "
        f"{manifest['agreement']}."
        + (
            f" {results.capacity_runs:,} more runs find the capacities of the arrays; they are not "
            "kept."
            if results.arrays
            else ""
        ),
    )


def _models(results: StudyResults) -> Table:
    manifest = results.manifest
    return Table(
        caption="Runs by model",
        columns=(
            TableColumn(head="Model", align="left", share=3.0),
            TableColumn(head="Runs"),
            TableColumn(head="Share"),
        ),
        rows=tuple(
            TableRow(cells=(title, f"{count:,}", f"{100.0 * count / manifest['rows']:.1f} %"))
            for title, count in manifest["models"].items()
        ),
        kind="compact",
    )


def _mats(results: StudyResults) -> Iterator[Table]:
    given = results.plan.input
    if not given.mats:
        return
    yield Table(
        caption="Mats",
        columns=(
            TableColumn(head="Mat", align="left", share=1.5),
            TableColumn(head="μ, median"),
            TableColumn(head="Standard deviation of ln μ", share=1.4),
            TableColumn(head="Tested values", align="left", share=2.4),
            TableColumn(head="Report", align="left", share=1.8),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    mat.id,
                    f"{given.friction(mat.id).center:.3g}",
                    f"{given.friction(mat.id).beta:.3f}" if mat.tested else "none",
                    mat.tested or "none",
                    mat.report or "none",
                )
            )
            for mat in given.mats
        ),
        kind="compact",
    )


def _motions(results: StudyResults) -> Table:
    letters = results.plan.input.study.intensity.letters
    return Table(
        caption="Motions",
        columns=(
            TableColumn(head="Motion", align="left", share=1.4),
            TableColumn(head="Samples"),
            TableColumn(head="Time step", unit="s"),
            TableColumn(head=with_symbols(f"Factor for {letters} = 1"), share=1.4),
            TableColumn(head="Source", align="left", share=2.4),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    motion.id,
                    f"{motion.ax_mps2.size:,}",
                    f"{motion.dt_s:g}",
                    f"{motion.scale:.4g}",
                    motion.source or "not stated",
                )
            )
            for motion in results.plan.motions.motions[0]
        ),
        kind="compact",
    )


def _warnings(results: StudyResults) -> Iterator[Table]:
    if results.plan.warnings:
        yield Table(
            caption="Warnings on the workbook",
            columns=(
                TableColumn(head="Cell", align="left", share=1.2),
                TableColumn(head="Warning", align="left", share=6.0),
            ),
            rows=tuple(TableRow(cells=(cell, f"{text}.")) for cell, text in results.plan.warnings),
        )


def _lost_words(lost: int, runs: int) -> str:
    if not lost:
        return "Every motion gave a final PRD in every case of the curves."
    return (
        f"{lost:,} of {runs:,} pairs of case and motion have no final PRD (uplift, or sliding at "
        "the end of the record). They count as larger than any limit: a statistic that depends on "
        "one is none."
    )


def limits(results: StudyResults) -> ManualSection:
    """Return the section on what the study does not say."""
    given = results.plan.input
    shown = ", as the confidence intervals of the fragilities show" if results.arrays else ""
    items = [
        "Every array is one rigid block with one friction coefficient; velocity-dependent friction "
        "and rows of linked blocks are not part of a study.",
        "A study does not check whether its motions satisfy the requirements of the rule set; a "
        "calculation package does.",
        "The motions are scaled linearly to each intensity; their spectra are not conditioned on "
        "it.",
        f"The statistics are those of {len(results.plan.motions.motions[0])} motions. With few "
        f"motions the 84th percentile and the dispersion are uncertain{shown}.",
        *_record_spread(results),
        "Values between the cases are interpolated linearly; values beyond them are not given.",
    ]
    if given.study.site_intensity:
        items.append(
            "The chance of exceedance is for the stated distribution of intensity: it is not a "
            "rate in years."
        )
    items.append(explained(SHIPPED))
    return ManualSection(id="limits", title="Limits", blocks=(Block(items=items),))


def _record_spread(results: StudyResults) -> Iterator[str]:
    """Yield how much the spectra of the motions differ, and what follows where they hardly do."""
    spread, count = results.spread, len(results.plan.motions.motions[0])
    if not spread.is_known:
        return
    text = (
        f"The spectra of the {count} motions differ by a standard deviation of ln Sa of "
        f"{digits_up(spread.median, 2)} in the median and {digits_up(spread.largest, 2)} at most "
        f"(damping 5\u00a0%, all components at the roof, {FREQ_HZ.size} frequencies from "
        f"{FREQ_HZ[0]:.3g} to {FREQ_HZ[-1]:.3g} Hz)."
    )
    if spread.is_one_spectrum:
        lacking = ["the 84th percentile"]
        lacking += ["the dispersions β"] if results.arrays else []
        lacking += ["the chances"] if any(one.chances for one in results.arrays) else []
        text += (
            " They are nearly one spectrum, with almost no record-to-record spread: "
            f"{joined(lacking)} do{'es' if len(lacking) == 1 else ''} not contain how much the "
            "spectra of recorded earthquakes differ."
        )
    yield text
