"""The table of spectra: target, achieved ordinates and their ratios at a few periods."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import itemgetter

import numpy as np
from markupsafe import Markup

from report.assessment.support.evidence import Evidence
from report.assessment.support.response_spectra import PRINTED_S, Spectra
from report.document.columns import text, words
from report.document.tables import Table, Wide, by_place, listed
from report.pages.parts import PackageData
from report.text.counts import numbered
from report.text.units import NO_BREAK, number
from solver.model import Floats


def page(_: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the table of spectra."""
    return {"spectra": spectrum_table(evidence.spectra)}


def spectrum_table(spectra: Sequence[Spectra]) -> Table:
    """Return target, achieved ordinates and their ratios at a few periods, by component."""
    periods = (
        text(f"{period:g}{NO_BREAK}s", f"{1 / period:.3g}{NO_BREAK}Hz") for period in PRINTED_S
    )
    rows = (row for part in spectra for row in _spectrum_rows(part))
    columns = by_place(words("Period", 2.9), *periods)
    return listed(rows, columns, kind="compact", style=itemgetter(-1))


def _spectrum_rows(part: Spectra) -> Iterator[Sequence[str | Wide]]:
    """Yield name, ordinates and style of each row; a component stays on one sheet."""
    indices = [int(np.argmin(np.abs(part.periods_s - period))) for period in PRINTED_S]
    target, sa = part.target_g[indices], part.sa_g[:, indices]
    # With how many, since a component may be missing in some motions.
    mean = f"Mean of {numbered(len(part.ids), 'motion')} [g]", *_numbers(sa.mean(axis=0), 3)
    yield Wide(Markup("<b>{}</b>").format(part.title), 1 + len(PRINTED_S)), "total group"
    if not part.target.name:
        yield *mean, ""
        return
    share = sa / target
    yield f"Target, {part.target.name} [g]", *_numbers(target, 3), "group"
    yield *mean, "group"
    yield "Mean / target", *_numbers(share.mean(axis=0), 2), "group"
    yield "Smallest motion / target", *_numbers(share.min(axis=0), 2), "group"
    yield "Largest motion / target", *_numbers(share.max(axis=0), 2), ""


def _numbers(values: Floats, decimals: int) -> Sequence[str]:
    return [number(float(value), decimals) for value in values]
