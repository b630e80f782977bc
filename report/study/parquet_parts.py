"""The rows of a study as Parquet parts: written, signed, run where they are missing.

A part is written aside and renamed. Its metadata say what it is, with the SHA-256 and the HMAC of
all of the file. A study that is killed at any moment continues with the batches that are complete
and signed with the user's key. Read `run_missing`.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import random
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from report.study.manifest import NAME, machine
from report.study.optional_packages import ARROW, optional_package
from solver.errors import InputError
from solver.file_checks import check_plain
from solver.file_writing import write_all
from solver.kernels.compiler import THREADS
from solver.model import Floats
from solver.sliding.model_selection import Model
from solver.studies.campaign import Campaign
from solver.studies.runs import LENGTHS, STATUSES, Rows, Runner, run_part

Flags = np.ndarray[Any, np.dtype[np.bool_]]

_PARTS = "part-?????.parquet"

# Size of a row on disk, for `--dry-run`: five lengths, and keys that repeat.
BYTES_A_ROW = 40.0

# Keys of the metadata.
_ABOUT, _SIGNATURE = b"roofslip_study", b"roofslip_signature"

_SHA256, _HMAC = b"roofslip sha256=", b" hmac="
_UNSIGNED = _SHA256 + b"0" * 64 + _HMAC + b"0" * 64


def part_name(number: int) -> str:
    """Return the file name of a part."""
    return f"part-{number:05d}.parquet"


@dataclass(frozen=True, slots=True, kw_only=True)
class About:
    """Metadata of a part."""

    identity: str  # of the runs of its study
    number: int
    models: Mapping[str, int]  # runs by model
    seconds: float  # of processor time
    machine: str
    computed: datetime  # by the clock of that machine


_AS_JSON = TypeAdapter(About)


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """A part that was run and is whole."""

    about: About
    rows: int  # one for each run
    sha256: str  # of its file
    is_own: bool  # signed with the user's key


OnDone = Callable[[Done], None]


def mixed(numbers: Sequence[int]) -> list[int]:
    """Return parts in a mixed order."""
    # The rate so far is then that of those to come, which the time left is told by.
    return random.Random(0).sample(numbers, len(numbers))


def made_part(runner: Runner, number: int, identity: str, names: Sequence[str]) -> bytes:
    """Run a part and return it as Parquet, not yet signed, in any process."""
    pa = optional_package(ARROW)
    started = time.thread_time()
    part = runner.campaign.parts[number]
    rows = run_part(runner, part)
    table = _table(runner.campaign, part, rows, names)
    counts = np.bincount(rows.model.ravel(), minlength=len(Model))
    sink = pa.BufferOutputStream()
    with pa.parquet.ParquetWriter(
        sink,
        table.schema,
        compression="lz4",
        # Keys repeat in thousands of rows; lengths do not, and a dictionary of them would be as
        # long as they are.
        use_dictionary=[name for name in table.column_names if name not in LENGTHS],
        # By these readers skip parts that have none of the values that they select.
        write_statistics=["slope_deg", "mu", "intensity"],
    ) as writer:
        writer.write_table(table)
        about = About(
            identity=identity,
            number=number,
            models={model.title: int(counts[model]) for model in Model if counts[model]},
            # Of this thread: the others run parts of their own at the same time.
            seconds=time.thread_time() - started,
            machine=machine(),
            computed=datetime.now(UTC),
        )
        writer.add_key_value_metadata({_ABOUT: _AS_JSON.dump_json(about), _SIGNATURE: _UNSIGNED})
    return sink.getvalue().to_pybytes()  # type: ignore[no-any-return]


def _table(campaign: Campaign, part: slice, rows: Rows, names: Sequence[str]) -> Any:
    """Return rows as a table, one row for each run."""
    pa = optional_package(ARROW)
    cases, columns = campaign.cases[part], campaign.columns
    count, n_columns = len(cases), len(columns)

    def keys(words: Iterable[str], indices: Any) -> Any:
        return pa.DictionaryArray.from_arrays(np.asarray(indices, np.int32), pa.array(list(words)))

    motions = [motion.id for motion in campaign.motions[0]]
    swapped = [orientation.is_transverse for _, orientation in columns]
    signs = np.array([orientation.polarity for _, orientation in columns], dtype=np.int8)
    return pa.table(
        {
            "building": keys(names, np.repeat(cases.building, n_columns)),
            # Rounded, it is what was typed, by which readers select rows.
            "slope_deg": np.repeat(np.degrees(cases.slope_rad).round(12), n_columns),
            "slope_rad": np.repeat(cases.slope_rad, n_columns),
            "mu": np.repeat(cases.mu, n_columns),
            "intensity": np.repeat(cases.intensity, n_columns),
            "motion": keys(motions, np.tile([number for number, _ in columns], count)),
            "component": keys(("record", "transverse"), np.tile(swapped, count)),
            "polarity": np.tile(signs, count),
            **{name: lengths.ravel() for name, lengths in zip(LENGTHS, rows.lengths, strict=True)},
            "status": keys([status.value for status in STATUSES], rows.status.ravel()),
            "model": keys([model.title for model in Model], rows.model.ravel()),
        }
    )


def signed(content: bytes, key: bytes) -> bytes:
    """Return a part with the SHA-256 and the HMAC of all of its unsigned file in its metadata."""
    # The placeholder of the same length: no offset of the Parquet file moves.
    start = content.rindex(_SHA256)
    before, after = content[:start], content[start + len(_UNSIGNED) :]
    digest = hashlib.sha256(before + _UNSIGNED + after)
    tag = hmac.digest(key, digest.digest(), "sha256").hex()
    signature = _SHA256 + digest.hexdigest().encode() + _HMAC + tag.encode()
    return before + signature + after


def peaks(content: bytes, campaign: Campaign) -> tuple[Floats, Flags]:
    """Return the data of a part needed for the statistics, each of shape (cases, motions).

    The largest PRD of the orientations [m], NaN if one of them has no final value; and whether the
    friction demand exceeds the coefficient at any of them.
    """
    pa = optional_package(ARROW)
    columns = ["prd_m", "status", "model"]
    table = pa.parquet.read_table(pa.BufferReader(content), columns=columns, use_threads=False)
    rows = table.to_pandas(use_threads=False)
    prd = rows["prd_m"].where(rows["status"] == STATUSES[0].value).to_numpy()
    slips = (rows["model"] != Model.NO_SLIP.title).to_numpy()
    numbers = np.array([number for number, _ in campaign.columns])
    # Columns are in the order of the motions: each begins where the number changes.
    starts = np.flatnonzero(np.diff(numbers, prepend=-1))
    shape = (-1, len(numbers))
    return (
        # NaN wins: of a motion all orientations need a final value.
        np.maximum.reduceat(prd.reshape(shape), starts, axis=1),
        np.logical_or.reduceat(slips.reshape(shape), starts, axis=1),
    )


def done_parts(folder: Path, campaign: Campaign, identity: str, key: bytes) -> dict[int, Done]:
    """Return the parts that are whole and of these runs, those of other keys included."""
    complete = {}
    for number, part in enumerate(campaign.parts):
        try:
            done = _opened((folder / part_name(number)).read_bytes(), key)
        # Not there, cut off or damaged (ArrowInvalid is a ValueError): its runs are run again.
        except (OSError, ValueError, KeyError, TypeError, NotImplementedError):
            continue
        rows = (part.stop - part.start) * len(campaign.columns)
        if (done.about.identity, done.about.number, done.rows) == (identity, number, rows):
            complete[number] = done
    return complete


def _opened(content: bytes, key: bytes) -> Done:
    """Return a part; raises `ValueError` if it is not whole."""
    # The last one: a name in the rows may spell the same letters.
    end = content.rindex(_SHA256) + len(_UNSIGNED)
    tag, expected = slice(end - 64, end), signed(content, key)
    if content[: tag.start] != expected[: tag.start]:
        raise ValueError("the SHA-256 is not that of the content")
    pa = optional_package(ARROW)
    metadata = pa.parquet.read_metadata(pa.BufferReader(content))
    return Done(
        about=_AS_JSON.validate_json(metadata.metadata[_ABOUT]),
        rows=metadata.num_rows,
        sha256=hashlib.sha256(content).hexdigest(),
        # In a time that says nothing of how many letters agree, as for every such comparison.
        is_own=hmac.compare_digest(content[tag], expected[tag]),
    )


def read_part(folder: Path, done: Done) -> bytes:
    """Return the content of a part; raises `InputError` if it changed since it was checked."""
    path = folder / part_name(done.about.number)
    content = path.read_bytes()
    if hashlib.sha256(content).hexdigest() != done.sha256:
        raise InputError(f"{path}: changed meanwhile; start again")
    return content


def keep(folder: Path, content: bytes, key: bytes) -> Done:
    """Sign a part and write it."""
    content = signed(content, key)
    done = _opened(content, key)
    write_all({part_name(done.about.number): content}, folder)
    return done


def begin(folder: Path, manifest: Mapping[str, Any], n_earlier: int) -> None:
    """Write the manifest; `n_earlier` is the number of parts of the study that was there before.

    Raises `InputError` if a file has the name of a part and no study wrote it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    # Parts of the former study are replaced, damaged or not; any other file would be lost.
    ours = {part_name(number) for number in range(n_earlier)}
    for path in sorted(folder.glob(_PARTS)):
        if path.name not in ours and _ABOUT not in path.read_bytes():
            raise InputError(
                f"{path}: has the name of a part of a study, but no study wrote it; move it to "
                "another folder, or choose another one with --out"
            )
    write_all({NAME: json.dumps(manifest, indent=1).encode() + b"\n"}, folder.parent)


def check_places(out: Path, folder: Path) -> None:
    """Refuse what is no plain file in the places of the manifest and the parts."""
    check_plain(out / NAME, out)
    check_plain(folder, out, is_folder=True)
    for path in folder.glob(_PARTS):
        check_plain(path, out)


def run_missing(
    folder: Path,
    campaign: Campaign,
    identity: str,
    names: Sequence[str],
    missing: Sequence[int],
    key: bytes,
    on_done: OnDone,
) -> None:
    """Run parts on all cores of this machine, and keep each as it is done."""
    runner = Runner(campaign)
    # Once, before the threads.
    _ = runner.tracks

    def work(number: int) -> Done:
        return keep(folder, made_part(runner, number, identity, names), key)

    # One more than there are cores: a part that waits for the disk leaves no core idle.
    with ThreadPoolExecutor(THREADS + 1) as pool:
        running = [pool.submit(work, number) for number in mixed(missing)]
        try:
            for future in as_completed(running):
                on_done(future.result())
        # Ctrl+C as well: the parts that run are finished, those that wait are not begun.
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def finished(folder: Path, manifest: Mapping[str, Any], done: Sequence[Done]) -> dict[str, Any]:
    """Return the manifest of a study that is done, and remove parts of other studies."""
    counts: Counter[str] = Counter()
    for part in done:
        counts.update(part.about.models)
    sha256 = {part_name(part.about.number): part.sha256 for part in done}
    for path in folder.glob(_PARTS):
        if path.name not in sha256:
            path.unlink()
    machines = sorted({part.about.machine for part in done})
    return {
        **manifest,
        "models": {model.title: counts[model.title] for model in Model if counts[model.title]},
        "machines": machines,
        "agreement": (
            "all batches ran on one processor model: a repetition produces the same bits"
            if len(machines) == 1
            else "batches ran on several processor models: numbers agree to 1e-12"
        ),
        "processor_seconds": round(sum(part.about.seconds for part in done), 3),
        "part_sha256": dict(sorted(sha256.items())),
    }
