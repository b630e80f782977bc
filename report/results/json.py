"""results.json: a dump of `report.entities.results`, in SI units with null for no value.

Computes nothing.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.entities.results import results


def results_json(assessment: Assessment, evidence: Evidence) -> bytes:
    """Return everything as JSON in SI, with units in the keys and null for no value."""
    document = results(assessment, evidence).model_dump(mode="python")
    document["input"] = assessment.project.model_dump(mode="json")
    return json.dumps(_nan_to_none(document), indent=1, ensure_ascii=False).encode() + b"\n"


def _nan_to_none(value: Any) -> Any:
    """Return the document with null for every NaN or infinity, which JSON does not have."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: _nan_to_none(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_nan_to_none(item) for item in value]
    return value
