"""results.json: a dump of `report.entities.results`, in SI units with null for no value.

Computes nothing.
"""

from __future__ import annotations

import json

from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.entities.results import results
from report.words.formats import finite


def results_json(assessment: Assessment, evidence: Evidence) -> bytes:
    """Return everything as JSON in SI, with units in the keys and null for no value."""
    document = results(assessment, evidence).model_dump(mode="python")
    document["input"] = assessment.project.model_dump(mode="json")
    return json.dumps(finite(document), indent=1, ensure_ascii=False).encode() + b"\n"
