"""The manifest of a study, stored with its batches, from which a later run continues.

Writes nothing. Read `manifest_of`, then `check_earlier`.
"""

from __future__ import annotations

import hashlib
import json
import platform
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic_core import from_json

import solver
from report.provenance.package_sources import installed, processor
from report.provenance.release import version
from report.text.units import G_MPS2
from solver.errors import InputError
from solver.model import Motion
from solver.studies.campaign import Campaign
from solver.studies.runs import SETTINGS

# Raised where a key of the manifest or a column of the parts changes its name or meaning.
SCHEMA_VERSION = 1

# Beside the folder of the parts: a reader of that folder takes every file in it for a part.
NAME = "manifest.json"

# On whose word runs are taken over from parts that are there.
OWN_KEY, TRUST_PARTS = "the key of this user", "--trust-parts"

_LIBRARIES = ("numpy", "numba", "llvmlite", "pyarrow")


def program() -> dict[str, str]:
    """Return the versions that a row depends on, and the SHA-256 of the solver's source."""
    return {
        "roofslip": version(),
        "python": platform.python_version(),
        **{name: installed(name) for name in _LIBRARIES},
        # A checkout has one version through many changes: the source tells whether rows may
        # differ.
        "solver_sha256": _source_sha256(),
    }


def version_differences(manifest_versions: Mapping[str, str], versions: Mapping[str, str]) -> str:
    """Return the versions of a manifest that differ from those here, as text; empty if none."""
    differences = []
    for name, version_here in versions.items():
        version_there = manifest_versions.get(name, "unknown")
        if version_there != version_here:
            differences.append(f"{name} {version_there[:12]}, here {version_here[:12]}")
    return "; ".join(differences)


def _source_sha256() -> str:
    root = Path(str(solver.__file__)).parent
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root).as_posix().encode()
        digest.update(name + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def machine() -> str:
    """Return the processor model and the system."""
    # Parts of several machines differ by them: mathematical functions round differently.
    return f"{processor()}, {platform.system()} {platform.machine()}, {sys.byteorder}-endian"


def manifest_of(campaign: Campaign, about: Mapping[str, Any]) -> dict[str, Any]:
    """Return the manifest of a campaign before its runs.

    `about` is what else determines the results: the input, the hazard curve, seeds.
    """
    # Little-endian whatever the machine: a cluster of several agrees on the identity.
    digest, cases = hashlib.sha256(), campaign.cases
    digest.update(cases.building.astype("<i8").tobytes())
    for values in (cases.slope_rad, cases.mu, cases.intensity):
        digest.update(values.astype("<f8").tobytes())
    runs = {
        "schema_version": SCHEMA_VERSION,
        "program": program(),
        "g_mps2": G_MPS2,
        "model": {"matters_m": SETTINGS.matters_m, "matters_share": SETTINGS.matters_share,
                  "tolerance": SETTINGS.tolerance},
        "motions": [[_motion(m) for m in motions] for motions in campaign.motions],
        "cases": {"count": len(cases), "sha256": digest.hexdigest()},
        "rows": campaign.rows,
        "parts": [[part.start, part.stop] for part in campaign.parts],
    }  # fmt: skip
    content = {**runs, "about": dict(about)}
    # Another hazard or title needs no new runs; the rows have the names of the buildings.
    of_rows = {**runs, "buildings": about.get("buildings")}
    return {**content, "runs_identity": _sha256(of_rows), "identity": _sha256(content)}


def _sha256(content: Mapping[str, Any]) -> str:
    # Sorted: the identity is that of the content, in any order.
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _motion(motion: Motion) -> dict[str, Any]:
    digest = hashlib.sha256()
    for record in (motion.ax_mps2, motion.ay_mps2, motion.az_mps2):
        # A byte between the records: else two records could be cut at another place with the same
        # hash.
        digest.update(np.ascontiguousarray(record, dtype="<f8").tobytes() + b"\0")
    return {
        "id": motion.id,
        "source": motion.source,
        "sha256": digest.hexdigest(),
        "dt_s": motion.dt_s,
        "samples": motion.ax_mps2.size,
        "factor_for_intensity_1": motion.scale,
        "polarities": list(motion.signs),
    }


def check_earlier(folder: Path, manifest: Mapping[str, Any]) -> int:
    """Return how many parts the study that wrote to a folder has; 0 for none.

    Raises `InputError` if another version of the program wrote them, with what to do, or the
    manifest is damaged.
    """
    path = folder.parent / NAME
    away = f"move the folder {folder} away or delete it, or enter another one with --out"
    if not path.exists():
        return 0
    try:
        earlier = from_json(path.read_bytes())
        schema, versions = earlier["schema_version"], dict(earlier["program"])
        parts = len(earlier.get("parts", ()))
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: damaged, not the manifest of a study; {away}") from error
    if schema != SCHEMA_VERSION:
        raise InputError(
            f"{path}: has schema_version {schema}, this version has {SCHEMA_VERSION}; {away}"
        )
    differences = version_differences(versions, manifest["program"])
    if differences:
        raise InputError(
            f"{path}: was written by another version ({differences}): its rows may differ; "
            f"finish it with that version, or {away}"
        )
    return parts
