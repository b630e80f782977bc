"""Data that the file computes with, as JSON: results.json, the motions as run, the kernels.

Read `data`.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from report.assessment.assessment import Assessment
from report.typeset.pdf import TEMPLATES
from solver.model import STANDARD_GRAVITY_MPS2, Motion

# Records are mostly printed to it: whole numbers of this part of g take a quarter of the room.
_PER_G = 1e5


def data(assessment: Assessment, results: bytes) -> str:
    """Return the data of the file; no `<` in it closes the enclosing element."""
    arrays = assessment.project.arrays
    document = {
        "results": _packed(results),
        "kernels": _packed((TEMPLATES / "page-file" / "kernels.wasm").read_bytes()),
        "motions": _motions(assessment.shaking.motions),
        "outlines": {
            array.id: {"outline": array.shape.points, "downslope_deg": array.downslope_deg}
            for array in arrays
        },
    }
    return json.dumps(document, separators=(",", ":")).replace("<", "\\u003c")


def _packed(content: bytes) -> str:
    return base64.b64encode(zlib.compress(content, 6)).decode()


def _motions(motions: Sequence[Motion]) -> dict[str, Any]:
    """Return the samples of all motions, bit for bit."""
    parts = [(motion.ax_mps2, motion.ay_mps2, motion.az_mps2) for motion in motions]
    samples = np.concatenate([part for components in parts for part in components])
    counts = np.round(samples / STANDARD_GRAVITY_MPS2 * _PER_G)
    # To the last bit: the browser computes in this order, and must get the numbers of the package.
    is_whole = np.array_equal(counts / _PER_G * STANDARD_GRAVITY_MPS2, samples)
    if is_whole:
        # Differences are small: the lowest byte of each first, and the rest are nearly all zero.
        steps = np.diff(counts.astype("<i4"), prepend=np.int32(0)).astype("<i4")
        content = steps.view(np.uint8).reshape(-1, 4).T.tobytes()
    else:
        content = samples.astype("<f8").tobytes()
    return {
        "per_g": _PER_G if is_whole else 0,
        "samples": _packed(content),
        "listed": [
            {"dt_s": motion.dt_s, "sizes": [part.size for part in components]}
            for motion, components in zip(motions, parts, strict=True)
        ],
    }
