"""The rows of a study as Parquet parts: written, checked by hash, run where they are missing.

A part is written aside and renamed; then a line with its SHA-256 is added to `JOURNAL`. A study
that is killed at any moment goes on with the parts that agree with their line. Read `run_missing`.
"""

from __future__ import annotations

import hashlib
import json
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic_core import from_json

from report.study.extra import ARROW, extra
from report.study.manifest import NAME, machine
from solver.files import check_plain, write_all
from solver.kernels.compiler import THREADS
from solver.model import Floats, InputError
from solver.sliding.least_model import Model
from solver.studies.campaign import Campaign
from solver.studies.runs import LENGTHS, STATUSES, Rows, Runner, run_part

JOURNAL = ".done.jsonl"
"""Hidden, so that readers of the folder skip it."""

_PARTS = "part-?????.parquet"

BYTES_A_ROW = 40.0
"""Size of a row on disk, for `--dry-run`: five lengths, and keys that repeat."""

_IDENTITY = b"roofslip_study"


def part_name(number: int) -> str:
    """Return the file name of a part."""
    return f"part-{number:05d}.parquet"


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """A part that was run.

    Attributes
    ----------
    models : mapping of str to int
        Number of runs by model.
    seconds : float
        Processor time of its thread [s].
    """

    number: int
    sha256: str
    models: Mapping[str, int]
    seconds: float
    machine: str


OnDone = Callable[[Done], None]


def costliest_first(campaign: Campaign, numbers: Sequence[int]) -> list[int]:
    """Return parts by their costs."""
    costs = [float(campaign.seconds[part].sum()) for part in campaign.parts]
    return sorted(numbers, key=lambda number: -costs[number])


def made_part(
    runner: Runner, number: int, identity: str, names: Sequence[str]
) -> tuple[bytes, Done]:
    """Run a part and return it as Parquet, in any process."""
    started = time.thread_time()
    part = runner.campaign.parts[number]
    rows = run_part(runner, part)
    content = parquet(runner.campaign, part, rows, identity, names)
    counts = np.bincount(rows.model.ravel(), minlength=len(Model))
    done = Done(
        number=number,
        sha256=hashlib.sha256(content).hexdigest(),
        models={model.title: int(counts[model]) for model in Model if counts[model]},
        seconds=time.thread_time() - started,
        machine=machine(),
    )
    return content, done


def parquet(
    campaign: Campaign, part: slice, rows: Rows, identity: str, names: Sequence[str]
) -> bytes:
    """Return rows as a Parquet file, one row for each run.

    Parameters
    ----------
    names : sequence of str
        Of the buildings.
    """
    pa = extra(ARROW)
    cases, columns = campaign.cases[part], campaign.columns
    each, whole = len(columns), len(cases) * len(columns)

    def keys(values: Sequence[str], at: Any) -> Any:
        indices = pa.array(np.asarray(at, dtype=np.int32))
        return pa.DictionaryArray.from_arrays(indices, pa.array(list(values), pa.string()))

    def by_case(values: Floats) -> Any:
        return pa.array(np.repeat(values, each))

    motions = [motion.id for motion in campaign.motions[0]]
    swapped = [orientation.is_transverse for _, orientation in columns]
    signs = np.array([orientation.polarity for _, orientation in columns], dtype=np.int8)
    table = {
        "building": keys(names, np.repeat(cases.building, each)),
        # Rounded, it is what was typed, by which readers select rows.
        "slope_deg": by_case(np.asarray(np.degrees(cases.slope_rad), dtype=float).round(12)),
        "slope_rad": by_case(cases.slope_rad),
        "mu": by_case(cases.mu),
        "intensity": by_case(cases.intensity),
        "motion": keys(motions, np.tile([number for number, _ in columns], len(cases))),
        "component": keys(("record", "transverse"), np.tile(swapped, len(cases))),
        "polarity": pa.array(np.tile(signs, len(cases))),
        **{
            name: pa.array(values.reshape(whole))
            for name, values in zip(LENGTHS, rows.lengths, strict=True)
        },
        "status": keys([status.value for status in STATUSES], rows.status.ravel()),
        "model": keys([model.title for model in Model], rows.model.ravel()),
    }
    schema_of = pa.table(table).replace_schema_metadata({_IDENTITY: identity.encode()})
    sink = pa.BufferOutputStream()
    pa.parquet.write_table(
        schema_of,
        sink,
        compression="lz4",
        use_dictionary=[name for name in table if name not in LENGTHS],
        write_statistics=["slope_deg", "mu", "intensity"],
    )
    return sink.getvalue().to_pybytes()  # type: ignore[no-any-return]


@dataclass(frozen=True, slots=True, kw_only=True)
class Peaks:
    """What the statistics need of a part, by case and motion.

    Attributes
    ----------
    prd_m : array, shape (cases, motions)
        Largest PRD of the orientations [m]; NaN if one of them has no final value.
    slips : array of bool, shape (cases, motions)
        Whether the friction demand exceeds the coefficient at any orientation.
    """

    prd_m: Floats
    slips: np.ndarray[Any, np.dtype[np.bool_]]


def peaks(content: bytes, campaign: Campaign) -> Peaks:
    """Return the peaks of a part."""
    pa = extra(ARROW)
    columns = ["prd_m", "status", "model"]
    table = pa.parquet.read_table(pa.BufferReader(content), columns=columns, use_threads=False)
    shape = (-1, len(campaign.columns))
    ok, still = STATUSES[0].value, Model.NO_SLIP.title
    final = _equals(table["status"], ok).reshape(shape)
    prd = np.where(final, table["prd_m"].to_numpy().reshape(shape), np.nan)
    slips = ~_equals(table["model"], still).reshape(shape)
    starts = [
        at
        for at, (number, _) in enumerate(campaign.columns)
        if at == 0 or number != campaign.columns[at - 1][0]
    ]
    return Peaks(
        prd_m=np.maximum.reduceat(prd, starts, axis=1),  # NaN wins
        slips=np.logical_or.reduceat(slips, starts, axis=1),
    )


def _equals(column: Any, word: str) -> Any:
    """Return where a column of keys has a word."""
    chunks = []
    for chunk in column.chunks:
        coded = chunk.dictionary_encode() if not hasattr(chunk, "dictionary") else chunk
        words = coded.dictionary.to_pylist()
        code = words.index(word) if word in words else -1
        chunks.append(coded.indices.to_numpy() == code)
    return np.concatenate(chunks)


def done_parts(folder: Path, campaign: Campaign, identity: str) -> dict[int, Done]:
    """Return the parts that are whole: the journal has their hash for this manifest."""
    found: dict[int, Done] = {}
    for line in _journal(folder):
        done = Done(**{name: line[name] for name in Done.__dataclass_fields__})
        if line.get("identity") == identity and done.number in range(len(campaign.parts)):
            found[done.number] = done
    return {number: done for number, done in found.items() if _is_whole(folder, done)}


def _journal(folder: Path) -> Iterator[dict[str, Any]]:
    """Yield the lines of the journal; the last may be torn."""
    try:
        lines = (folder / JOURNAL).read_bytes().splitlines()
    except FileNotFoundError:
        return
    for line in lines:
        try:
            content = from_json(line)
        except ValueError:
            continue
        if isinstance(content, dict) and Done.__dataclass_fields__.keys() <= content.keys():
            yield content


def _is_whole(folder: Path, done: Done) -> bool:
    try:
        with (folder / part_name(done.number)).open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest() == done.sha256
    except OSError:
        return False


def read_part(folder: Path, done: Done) -> bytes:
    """Return the content of a part.

    Raises
    ------
    InputError
        If it changed since it was checked.
    """
    content = (folder / part_name(done.number)).read_bytes()
    if hashlib.sha256(content).hexdigest() != done.sha256:
        raise InputError(f"{folder / part_name(done.number)}: changed meanwhile; start again")
    return content


def keep(folder: Path, content: bytes, done: Done, identity: str) -> None:
    """Write a part, and then its line in the journal."""
    write_all({part_name(done.number): content}, folder)
    line = json.dumps({"identity": identity, **asdict(done)}).encode() + b"\n"
    # Appended in one write: lines of two processes do not mix.
    journal = os.open(folder / JOURNAL, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o666)
    try:
        os.write(journal, line)
        os.fsync(journal)
    finally:
        os.close(journal)


def begin(folder: Path, manifest: Mapping[str, Any]) -> None:
    """Write the manifest, and end the last line of the journal.

    Raises
    ------
    InputError
        If a file has the name of a part and no study wrote it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _check_own(folder)
    journal = folder / JOURNAL
    if journal.exists() and not journal.read_bytes().endswith(b"\n"):
        with journal.open("ab") as file:
            file.write(b"\n")  # ends a torn line
    write_all({NAME: json.dumps(manifest, indent=1).encode() + b"\n"}, folder.parent)


def check_places(out: Path, folder: Path) -> None:
    """Refuse what is no plain file in the places of the manifest, the journal and the parts.

    Raises
    ------
    InputError
    """
    check_plain(out / NAME, out)
    check_plain(folder, out, is_folder=True)
    check_plain(folder / JOURNAL, out, in_place=True)
    for path in folder.glob(_PARTS):
        check_plain(path, out)


def _check_own(folder: Path) -> None:
    """Refuse files that only have the names of parts: they would be replaced or removed."""
    listed = {part_name(line["number"]) for line in _journal(folder)}
    foreign = [
        path.name
        for path in sorted(folder.glob(_PARTS))
        if path.name not in listed and _IDENTITY not in path.read_bytes()
    ]
    if foreign:
        raise InputError(
            f"{folder / foreign[0]}: has the name of a part of a study, but no study wrote it; move"
            " it to another folder, or choose another one with --out"
        )


def run_missing(
    folder: Path,
    campaign: Campaign,
    identity: str,
    names: Sequence[str],
    missing: Sequence[int],
    on_done: OnDone,
) -> None:
    """Run parts on all cores of this machine, the costliest first, and keep each as it is done."""
    runner = Runner(campaign)
    _ = runner.tracks  # once, before the threads

    def work(number: int) -> Done:
        content, done = made_part(runner, number, identity, names)
        keep(folder, content, done, identity)
        return done

    # One more than there are cores: a part that waits for the disk leaves no core idle.
    with ThreadPoolExecutor(THREADS + 1) as pool:
        running = {pool.submit(work, number) for number in costliest_first(campaign, missing)}
        try:
            while running:
                ended, running = wait(running, return_when=FIRST_COMPLETED)
                for future in ended:
                    on_done(future.result())
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def finished(folder: Path, manifest: Mapping[str, Any], done: Sequence[Done]) -> dict[str, Any]:
    """Return the manifest of a study that is done, and remove parts of other studies."""
    done = sorted(done, key=lambda part: part.number)
    counts = {model.title: sum(part.models.get(model.title, 0) for part in done) for model in Model}
    models = {title: count for title, count in counts.items() if count}
    ours = {part_name(part.number) for part in done}
    for path in folder.glob(_PARTS):
        if path.name not in ours:
            path.unlink()
    machines = sorted({part.machine for part in done})
    return {
        **manifest,
        "models": models,
        "machines": machines,
        "agreement": (
            "all parts ran on one processor model: a repetition gives the same bits"
            if len(machines) == 1
            else "parts ran on several processor models: numbers agree to 1e-12"
        ),
        "processor_seconds": round(sum(part.seconds for part in done), 3),
        "part_sha256": {part_name(p.number): p.sha256 for p in done},
    }
