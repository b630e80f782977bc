"""The motions of a workbook, ready to run: records read, processed, scaled, carried to the roof.

Orders the steps: `components` reads, `history` scales and carries to the roof. Finds motions that
are given twice, what is unusual in records, and links too stiff to integrate. Read `prepare`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from report.motions.components import HORIZONTAL, Components, RecordFile, read_components
from report.motions.files import bytes_of
from report.motions.history import PreparedMotion, shake
from report.project.check.motion_faults import FIELDS, LABELS
from report.project.model import ProjectInput
from report.project.model.finding import Finding, note, warning
from report.project.model.input_rows import InputRow
from report.project.model.place import Place, Where
from report.project.read.workbook_data import Sheet
from report.text.units import G_MPS2, Quantity
from solver.model import Floats, Motion

# Largest difference of two samples / peak where records are the same: above that of rounding.
ALIKE = 1e-3

_Key = tuple[int, int]  # number of samples, and index of the largest one


@dataclass(frozen=True, slots=True)
class _Horizontal:
    """A horizontal record: its cell, its row, and its samples / the sample of largest size."""

    place: Place
    row: InputRow
    shape: Floats

    def repeats(self, other: _Horizontal) -> bool:
        """Whether it is another one again, at any scale and of either sign."""
        # Times that two motions take of their records may be apart: a file may hold two.
        (start, end), (other_start, other_end) = map(_times, (self.row, other.row))
        overlaps = start < other_end and other_start < end
        return overlaps and bool(np.abs(self.shape - other.shape).max() <= ALIKE)


def repeated(
    rows: Sequence[InputRow], by_motion: Mapping[int, Components], where: Where
) -> Iterator[Finding]:
    """Yield each motion with a horizontal record of a motion above it.

    `by_motion` is by row, without the motions that could not be read; `where` returns the address
    of a place.
    """
    seen: dict[_Key, list[_Horizontal]] = {}
    for index, components in by_motion.items():
        records = list(_horizontal_records(index, rows[index], components))
        if repetition := _repetition(records, seen):
            record, earlier = repetition
            text = (
                f"{LABELS[record.place.field]} record repeats the {LABELS[earlier.place.field]}"
                f" record at {where(earlier.place)} (equal samples, apart from scale and sign):"
                f" {record.row['id']} is {earlier.row['id']} again"
            )
            yield Finding.error(record.place, text, "give each motion once")
        for key, record in records:
            seen.setdefault(key, []).append(record)


def _repetition(
    records: Sequence[tuple[_Key, _Horizontal]], seen: Mapping[_Key, Sequence[_Horizontal]]
) -> tuple[_Horizontal, _Horizontal] | None:
    """Return the first record that is one of the earlier ones again, with that one."""
    for key, record in records:
        for earlier in seen.get(key, ()):
            if record.repeats(earlier):
                return record, earlier
    return None


def _horizontal_records(
    index: int, row: InputRow, components: Components
) -> Iterator[tuple[_Key, _Horizontal]]:
    """Yield the horizontal records of a motion that are not all zeros, each with a key."""
    # Records that are the same have the same key: few others are then to be compared.
    for field in HORIZONTAL:
        if field in components.whole:
            a = components.whole[field].a_mps2
            peak_index = int(np.abs(a).argmax())
            if a[peak_index] != 0.0:
                place = Place("motions", index, field)
                yield (len(a), peak_index), _Horizontal(place, row, a / a[peak_index])


def _times(row: InputRow) -> tuple[float, float]:
    return row["from_s"] or 0.0, math.inf if row["to_s"] is None else row["to_s"]


def stiff_links(data: ProjectInput, motions: Sequence[Motion]) -> Iterator[Finding]:
    """Yield the rows whose runs together need more than `MOST_STEPS` steps."""
    if not data.links:
        return
    from solver.sliding.row import MOST_STEPS, BlockRow, minimum_steps  # with the compiler

    seconds = sum(
        len(motion.orientations) * motion.dt_s * len(motion.ax_mps2) for motion in motions
    )
    weights = {array.id: array.weight_n for array in data.arrays}
    for index, links in enumerate(data.links):
        # Steps grow with the square root of the stiffness, per mass of a block.
        damping_per_s = 2.0 * links.damping_ratio
        soft = BlockRow(mus=links.mus, stiffness_per_s2=1.0, damping_per_s=damping_per_s)
        per_s2 = (MOST_STEPS / minimum_steps(soft, seconds)) ** 2
        largest = per_s2 * weights[links.array] / (len(links.mus) * G_MPS2)
        if links.stiffness_n_per_m > largest:
            yield Finding.error(
                Place("links", index, "stiffness_n_per_m"),
                f"link stiffness is {_said(links.stiffness_n_per_m)}, too stiff to "
                f"integrate in {MOST_STEPS:.0e} steps",
                f"give {_said(0.9 * largest)} or less (a stiffer row moves as one rigid "
                "block with the mean coefficient)",
            )


def _said(stiffness: float) -> str:
    us, si = (f"{stiffness / unit.si:.2g} {unit.symbol}" for unit in Quantity.STIFFNESS.value)
    return f"{us} ({si})"


# Of all files, each counted for every motion that names it: what is read within 10 s.
MAX_TOGETHER = 64_000_000
# Once a record is at fault: the faults so far are told without reading all others.
MAX_BESIDE_FAULTS, MOST_FAULTS = 10_000_000, 100


@dataclass(frozen=True, slots=True, kw_only=True)
class Shaking:
    """The motions of a project."""

    motions: tuple[Motion, ...]  # at the roof, as run
    prepared: tuple[PreparedMotion, ...]  # processing and scaling of the records of each motion
    records: tuple[RecordFile, ...]  # every component as read

    @property
    def hashes(self) -> tuple[str, ...]:
        """Each component with the hash of its record."""
        return tuple(f"{row.motion_id} {row.component} {row.sha256}" for row in self.records)


_TOO_MUCH = (
    f"the records to here have more than {MAX_TOGETHER / 1e6:.0f} MB together",
    "give fewer motions, or convert the records (roofslip motion convert --help)",
)
_NOT_READ = ("the records from here on are not read", "correct those before it first")


def prepare(sheet: Sheet) -> Shaking:
    """Read the records that a workbook names and prepare its motions.

    Raises `InputError` with every problem of the workbook and of its records, in the order of the
    template.
    """
    return shaking(sheet, read_records(sheet))


def read_records(sheet: Sheet) -> tuple[Components, ...]:
    """Read and process the records of each motion; raises as `prepare`, but knows no roof yet."""
    by_motion: dict[int, Components] = {}
    faults: list[Finding] = []
    total = 0
    for index, row in enumerate(sheet.inputs["motions"]):
        total += bytes_of(sheet.book, {row[field] for field in LABELS if row.get(field)})
        if len(faults) > MOST_FAULTS or (faults and total > MAX_BESIDE_FAULTS):
            faults.append(Finding.error(Place("motions", index, "record"), *_NOT_READ))
            break
        if total > MAX_TOGETHER:
            faults.append(Finding.error(Place("motions", index, "record"), *_TOO_MUCH))
            break
        match read_components(sheet.book, index, row):
            case Components() as components:
                by_motion[index] = components
            case wrong:
                faults += wrong
    faults += repeated(sheet.inputs["motions"], by_motion, lambda place: sheet.addresses[place])
    sheet.refuse(faults)
    return tuple(by_motion.values())


def shaking(sheet: Sheet, by_motion: Sequence[Components]) -> Shaking:
    """Scale the records of each motion and carry them to the roof.

    Raises `InputError` with the problems of the workbook.
    """
    shaken = shake(sheet.project, by_motion)
    motions = tuple(motion for motion, _ in shaken)
    sheet.refuse(stiff_links(sheet.project, motions))
    return Shaking(
        motions=motions,
        prepared=tuple(prepared for _, prepared in shaken),
        records=tuple(chain.from_iterable(components.files for components in by_motion)),
    )


# Peak of a motion / that of the others, and the inverse, beyond which their units differ: the peaks
# of the motions of one site are within a factor of ten.
OTHER_UNIT = 100.0

# Time step [s] above which a record has no content at 25 Hz and above.
MOST_STEP_S = 0.02

# Duration [s] above which a time step is more probably wrong than right.
MOST_DURATION_S = 300.0

# Share of the longest component that may be trimmed from it without a warning.
MOST_UNEQUAL = 0.05


def record_findings(data: ProjectInput, shaking: Shaking) -> Iterator[Finding]:
    """Yield what is unusual in the records of each motion."""
    yield from _unlike_peaks(shaking.motions)
    for index, row in enumerate(data.motions):
        files = [file for file in shaking.records if file.motion_id == row.id]
        if files:
            yield from _step(index, files)
            yield from _duration(index, files)
            yield from _unequal(index, files)
        for file in files:
            yield from _spikes(index, file)
            place = Place("motions", index, FIELDS[file.component])
            yield from (note(place, f"{file.name}: {text}") for text in file.notes)


def _unlike_peaks(motions: Sequence[Motion]) -> Iterator[Finding]:
    """Yield the motions whose peak as run is far above or below that of every other motion.

    A record in cm/s2 that is read in g is 981 times too large, one in g read in cm/s2 too small.
    """
    peaks_g = [
        float(np.abs(np.concatenate((motion.ax_mps2, motion.ay_mps2))).max()) / G_MPS2
        for motion in motions
    ]
    for index, peak_g in enumerate(peaks_g):
        ratios = [
            peak_g / other_g for other_g in peaks_g[:index] + peaks_g[index + 1 :] if other_g > 0.0
        ]
        if not ratios or peak_g <= 0.0:
            continue
        # Of the motion that is nearest: where one motion differs, the others are near each other.
        ratio = min(ratios, key=lambda value: abs(math.log(value)))
        if OTHER_UNIT**-1 < ratio < OTHER_UNIT:
            continue
        times, unit = (f"{ratio:.0f}", "cm/s2") if ratio > 1.0 else (f"1/{1.0 / ratio:.0f}", "g")
        text = (
            f"peak {peak_g:.3g} g as run, {times} times the other motions: is the record in {unit}?"
            " Correct its units or its scale factor"
        )
        yield warning(f"peak {motions[index].id}", Place("motions", index, "units"), text)


def _step(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=lambda file: file.dt_s)
    if longest.dt_s > MOST_STEP_S * (1.0 + 1e-9):
        text = (
            f"{longest.name} has a time step of {longest.dt_s:g} s, and so no content above"
            f" {0.5 / longest.dt_s:.3g} Hz; {MOST_STEP_S:g} s or less is usual: correct the time"
            " step, or give another record"
        )
        yield warning(f"step {longest.motion_id}", _place(index, longest), text)


def _duration(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=_seconds)
    if _seconds(longest) > MOST_DURATION_S:
        text = (
            f"{longest.name} lasts {_seconds(longest):.0f} s at a time step of {longest.dt_s:g} s;"
            f" {MOST_DURATION_S:.0f} s or less is usual: correct the time step, or trim the record"
        )
        yield warning(f"duration {longest.motion_id}", _place(index, longest), text)


def _unequal(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=lambda file: file.npts)
    cut = max(file.npts_trimmed for file in files)
    if cut > MOST_UNEQUAL * longest.npts:
        text = (
            f"{longest.name} has {longest.npts} samples, and {cut} of them are trimmed, to the"
            " shortest component; give components of one recording"
        )
        yield warning(f"length {longest.motion_id}", _place(index, longest), text)


def _spikes(index: int, file: RecordFile) -> Iterator[Finding]:
    if not file.spikes:
        return
    first, further = file.spikes[0], len(file.spikes) - 1
    which = f"sample {first + 1:,}" + (f" and {further} more" if further else "")
    text = (
        f"{file.name}: {which}, at {first * file.dt_s:.6g} s, {'reach' if further else 'is'}"
        f" {file.peak_g:.4g} g, and no other is more than {file.others_g:.4g} g; correct the file,"
        " or give another record"
    )
    yield warning(f"spike {file.motion_id} {file.component}", _place(index, file), text)


def _seconds(file: RecordFile) -> float:
    return (file.npts - 1) * file.dt_s


def _place(index: int, file: RecordFile) -> Place:
    return Place("motions", index, FIELDS[file.component])
