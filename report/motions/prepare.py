"""The motions of a workbook, ready to run: records read, processed, scaled, moved to the roof.

Orders the steps: `components` reads, `history` scales and transfers to the roof. Read `prepare`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

from report.motions.components import Components, RecordFile, read_components
from report.motions.history import PreparedMotion, shake
from report.motions.record_reading import bytes_of
from report.motions.repeated_records import repeated
from report.project.check.motion_faults import LABELS
from report.project.model import ProjectInput
from report.project.model.finding import Finding
from report.project.model.input_rows import Place
from report.project.read.workbook_data import Sheet
from report.text.units import G_MPS2, Quantity, with_unit
from solver.model import Motion

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
    f"the records up to this row exceed {MAX_TOGETHER / 1e6:.0f} MB in total",
    "use fewer motions, or convert the records (roofslip motion convert --help)",
)
_NOT_READ = ("the records from here on were not read", "first correct the rows above")


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
        # Each lost record costs a search of the folder: 800 of them took a minute and a half.
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
    """Scale the records of each motion and transfer them to the roof.

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
        # c = 2 zeta sqrt(k m), of a stiffness of 1.
        damping_per_s = 2.0 * links.damping_ratio
        soft = BlockRow(mus=links.mus, stiffness_per_s2=1.0, damping_per_s=damping_per_s)
        per_s2 = (MOST_STEPS / minimum_steps(soft, seconds)) ** 2
        largest = per_s2 * weights[links.array] / (len(links.mus) * G_MPS2)
        if links.stiffness_n_per_m > largest:
            yield Finding.error(
                Place("links", index, "stiffness_n_per_m"),
                f"link stiffness is {_stiffness_text(links.stiffness_n_per_m)}, too stiff to "
                f"integrate in {MOST_STEPS:.0e} steps",
                # Less than the limit, which two digits might round up.
                f"enter {_stiffness_text(0.9 * largest)} or less (a stiffer row moves as one rigid "
                "block with the mean coefficient)",
            )


def _stiffness_text(stiffness: float) -> str:
    us, si = (
        with_unit(f"{stiffness / unit.si:.2g}", unit.symbol) for unit in Quantity.STIFFNESS.value
    )
    return f"{us} ({si})"
