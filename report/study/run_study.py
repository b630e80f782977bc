"""A study from its workbook to its results, for the command and for scripts. Read `run_study`."""

from __future__ import annotations

import json
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from report.study.capacity_runs import maximum_runs
from report.study.cluster import connected, run_on_cluster
from report.study.manifest import NAME, OWN_KEY, TRUST_PARTS, check_earlier, manifest_of
from report.study.optional_packages import ARROW, optional_package
from report.study.parquet_parts import (
    BYTES_A_ROW,
    Done,
    begin,
    check_places,
    done_parts,
    finished,
    run_missing,
)
from report.study.read_study import read_study
from report.study.study_motions import study_motions
from report.study.study_plan import StudyPlan, plan_study
from report.study.study_results import StudyResults, results_of
from report.study.user_key import user_key
from solver.file_writing import write_all

# Folder of the parts, in the folder of the outputs.
RUNS = "runs"


class Estimate(NamedTuple):
    """The size of a study; the capacities of the arrays need at most this many more runs."""

    cases: int
    runs: int
    parts: int
    capacity_runs: int
    disk_bytes: float


def planned(source: str | Path) -> tuple[StudyPlan, Path]:
    """Read a study workbook and its records; return the plan and the workbook's folder.

    Raises `InputError` with every problem, by cell.
    """
    sheet = read_study(Path(source))
    return plan_study(sheet, study_motions(sheet)), sheet.book.path.parent


def estimate(plan: StudyPlan) -> Estimate:
    """Return the size of a study."""
    campaign = plan.campaign
    return Estimate(
        cases=len(campaign.cases),
        runs=campaign.rows,
        parts=len(campaign.parts),
        capacity_runs=sum(maximum_runs(plan, array) for array in plan.arrays),
        disk_bytes=BYTES_A_ROW * campaign.rows,
    )


def run_study(
    plan: StudyPlan,
    out: str | Path,
    *,
    scheduler: str = "",
    allow_matched: bool = False,
    trust_parts: bool = False,
    progress: Callable[[str], None] = lambda _: None,
) -> StudyResults:
    """Run what is missing of a study and return its results; the parts are in `out` / `RUNS`.

    `scheduler` is the address of a Dask scheduler; without it all cores of this machine run. With
    `allow_matched`, fragilities are exported without a record-to-record dispersion. With
    `trust_parts`, parts that are not signed with the user's key are taken over; without, they are
    computed again with a warning.

    Raises `InputError` if a package is missing, the folder has the parts of another version, the
    user's key cannot be kept, or the cluster cannot be used.
    """
    # First: without it nothing can be kept of hours of runs.
    optional_package(ARROW)
    out = Path(out)
    folder, campaign = out / RUNS, plan.campaign
    check_places(out, folder)
    manifest = manifest_of(campaign, plan.about) | {"workbook": {"name": plan.workbook}}
    earlier_parts, key = check_earlier(folder, manifest), user_key()
    identity, names = str(manifest["runs_identity"]), plan.motions.buildings
    done = done_parts(folder, campaign, identity, key)
    if not trust_parts:
        done = _own(done)
    taken_over = _taken_over(done)
    missing = [number for number in range(len(campaign.parts)) if number not in done]
    tell = _meter(plan, missing, progress)

    def on_done(part: Done) -> None:
        done[part.about.number] = part
        tell(part)

    if scheduler:
        # The manifest is written once the cluster has answered: a wrong address leaves a former
        # one.
        with connected(scheduler, manifest) as client:
            begin(folder, manifest, earlier_parts)
            run_on_cluster(client, folder, campaign, identity, names, missing, key, on_done)
    else:
        begin(folder, manifest, earlier_parts)
        run_missing(folder, campaign, identity, names, missing, key, on_done)
    full = finished(folder, manifest, list(done.values()))
    full["taken_over"] = taken_over
    full["design_displacement"] = plan.design_rule.about
    results = results_of(plan, folder, done, full, allow_matched=allow_matched, progress=progress)
    # Known only now: the capacities are searched after the runs of the cases.
    full["capacity_runs"] = results.capacity_runs
    write_all({NAME: json.dumps(full, indent=1).encode() + b"\n"}, out)
    return results


def _own(done: Mapping[int, Done]) -> dict[int, Done]:
    """Return the parts that are signed with the user's key; warn of others."""
    unsigned = [part for part in done.values() if not part.is_own]
    if unsigned:
        warnings.warn(
            f"recomputed: {sum(part.rows for part in unsigned):,} runs in {len(unsigned)} of "
            f"{len(done)} batches not signed with your key (from another user or machine, or "
            f"edited); {TRUST_PARTS} also reuses such batches",
            stacklevel=3,
        )
    return {number: part for number, part in done.items() if part.is_own}


def _taken_over(done: Mapping[int, Done]) -> list[dict[str, Any]]:
    """Return the number of reused runs, their date and signer, for the manifest."""
    taken = []
    for is_own, word in ((True, OWN_KEY), (False, TRUST_PARTS)):
        parts = [part for part in done.values() if part.is_own is is_own]
        dates = sorted(f"{part.about.computed:%Y-%m-%d}" for part in parts)
        runs = sum(part.rows for part in parts)
        if parts:
            taken.append({"runs": runs, "from": dates[0], "to": dates[-1], "on_the_word_of": word})
    return taken


def _meter(
    plan: StudyPlan, missing: Sequence[int], progress: Callable[[str], None]
) -> Callable[[Done], None]:
    """Return a function that prints the progress of the runs, their rate, and the time left."""
    campaign, started, ran = plan.campaign, time.monotonic(), 0
    parts = [campaign.parts[number] for number in missing]
    rows = sum(part.stop - part.start for part in parts) * len(campaign.columns)
    if missing:
        progress(f"running {rows:,} runs")

    def tell(part: Done) -> None:
        nonlocal ran
        ran += part.rows
        rate = ran / (time.monotonic() - started)
        left_s = (rows - ran) / rate
        progress(f"{ran:,} of {rows:,} runs, {rate:,.0f} a second, {left_s:.0f} s left")

    return tell
