"""The rows of results.json on the input files: workbook, records, documents and motions."""

from __future__ import annotations

from collections.abc import Mapping

from report.project.model.choices import RecordedAt
from report.results.result_base import ResultModel, Words
from solver.records.measures import Measures


class WorkbookResult(ResultModel):
    """The workbook that was assessed."""

    name: str
    """Name of the file."""
    sha256: str
    """SHA-256 of the file."""


class RecordResult(ResultModel):
    """A record as it was read."""

    motion: str
    component: str
    name: str
    format: str
    notes: tuple[Words, ...]
    """Notes on what was read or assumed beyond the numbers."""
    sha256: str
    npts: int
    """Number of samples."""
    dt_s: float
    """Time step."""
    peak_g: float
    """Largest acceleration."""


class DocumentResult(ResultModel):
    """A document that the workbook attaches."""

    label: str
    """Label of its cell."""
    path: str
    """Path from the folder of the workbook."""
    size: int
    """Number of bytes."""
    sha256: str
    """SHA-256 of the file."""


class RoofResult(ResultModel):
    """A component of a ground motion, transferred to the roof."""

    words: Words
    """Description of the building."""
    n_modes: int
    """Number of modes included."""
    next_mode_share: float
    """Contribution of the first neglected mode / peak at the roof."""
    left_out_share: float
    """Contribution of all neglected modes / peak at the roof."""
    ground_peak_mps2: float
    """Peak acceleration at the ground."""
    roof_peak_mps2: float
    """Peak acceleration at the roof."""
    pad_s: float
    """Free vibration after the end of the ground record."""


class MotionResult(ResultModel):
    """A motion as it was run."""

    id: str
    recorded_at: RecordedAt
    """Where it was recorded: at the roof, or at the ground."""
    processing: Words
    scaling: Words
    scale: float
    """Factor on the record."""
    dt_s: float
    """Time step."""
    npts: int
    """Number of samples."""
    sha256: str
    """SHA-256 of its samples as run, without the scale: record, transverse and vertical component
    one after the other, in m/s² as 8-byte numbers, the lowest byte first."""
    components: Mapping[str, Measures]
    """Measures of each component."""
    building: Mapping[str, RoofResult]
    """Transfer of each component to the roof; empty for roof motions."""
