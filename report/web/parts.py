"""An answer as drawn on the page: each updated element as HTML.

Computes nothing and contains no text: `parts.html` has a macro for each element. Read `drawn`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup, escape

_SUBSCRIPT = re.compile(r"\b([A-Z])_(\w{1,3})\b")
_TERMS = {
    "Mean PRD": "Mean of the peak relative displacement (PRD) of the array under the motions. The "
    "PRD is the largest distance of the array from its start during one motion.",
    "Design Δ": "Design displacement: what the separations are computed from. It is that of the "
    "analysis with its factor and its floor, or the prescriptive displacement.",
    "Prescriptive": "Displacement of the prescriptive procedure, which needs no motions.",
    "D/C": "Demand / capacity: required / provided clearance. More than 1.00 is NG.",
    "Verdict": "OK; NG: not satisfied; Condition: satisfied once the condition is closed.",
    "Provided": "Clearance that is there, from the workbook.",
    "Required": "Separation that the design displacements require.",
}
_SENT = ("verdict", "line", "verdict_text", "model_text", "next", "pending", "tips")


def drawn(answer: Mapping[str, Any]) -> dict[str, Any]:
    """Return an answer with its elements as HTML, by their ids; bars by array."""
    make, plan, bars = parts(), answer["plan"], answer["bars"].values()
    lengths = (each["length_m"] for chart in bars for each in (*chart["lines"], *chart["rows"]))
    scale_m = max(filter(None, lengths), default=1.0)
    reasons = answer["reasons"]
    return {name: answer[name] for name in _SENT} | {
        "count": sum(reason["level"] != "remedy" for reason in reasons),
        "plan": {name: plan[name] for name in ("size_px", "rooms_px")},
        "html": {
            "headline": make.headline(answer),
            "worst": make.worst(answer["worst"]),
            "reasons": make.reasons(answer),
            "warnings": make.warnings([row for row in reasons if row["level"] == "warning"]),
            "arrays": make.arrays(answer["arrays"]),
            "clearances": make.clearances(answer["clearances"]),
            "bars": {
                id: make.bars(chart, scale_m)
                for id, chart in answer["bars"].items()
                if chart["rows"]
            },
            "plan": make.plan(plan),
        },
    }


@cache
def parts() -> Any:
    """Return the macros as functions, compiled once in a process."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["subscripted"] = subscripted
    environment.globals["TERMS"] = _TERMS
    return environment.get_template("parts.html").module


def subscripted(text: str) -> Markup:
    """Return words with their subscripts: S_DS is an S with a small DS."""
    # Not of what `escape` returns, which would escape the subscripts as well.
    return Markup(_SUBSCRIPT.sub(r"\1<sub>\2</sub>", str(escape(text))))
