"""Numbers of the rule set replaced for a project, by the names of their provisions."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator

from report.project.model.values import Frozen, RequiredText
from solver.rules.rulesets import ALLOWED


def provision_name(key: str) -> str:
    """Return the name of a provision as on the Provisions worksheet, without its unit."""
    words = ALLOWED[key].meaning.partition(" [")[0]
    return words[:1].upper() + words[1:]


def provision_unit(key: str) -> str:
    """Return the unit of a provision, as a cell names it; empty for none."""
    allowed = ALLOWED.get(provision_key(key))
    return allowed.meaning.partition(" [")[2].rstrip("]") if allowed else ""


# Names in workbooks of versions before 0.4.0, without units.
_FORMER_NAMES = {
    "factor on (s_ds - 0.4)^2 in the prescriptive displacement": "prescriptive_factor_in",
    "maximum slope for the prescriptive route": "prescriptive_max_slope_deg",
    "minimum friction coefficient for the prescriptive route": "prescriptive_min_mu",
    "maximum slope for the analysis route": "analysis_max_slope_deg",
    "maximum height of the center of gravity / least base or support spacing": "low_profile_ratio",
    "minimum number of motions for the analysis route": "analysis_min_motions",
    "minimum number of motions for a value from the mean": "analysis_mean_motions",
    "minimum fraction of the prescriptive displacement without peer review": "analysis_floor",
    "separation between like arrays / design displacement": "separation_like",
    "separation to a fixed object or unlike array / design displacement": "separation_fixed",
    "separation to an edge with a qualifying parapet / design displacement": "separation_parapet",
    "separation to an edge without qualifying parapet / design displacement": "separation_edge",
    "minimum separation to an edge without a qualifying parapet": "separation_edge_min_in",
    "minimum height of a qualifying parapet above the roof": "parapet_height_in",
    "minimum height of a qualifying parapet above the array's c.g.": "parapet_over_cg_in",
}
_KEYS_BY_NAME = {provision_name(key).casefold(): key for key in ALLOWED} | _FORMER_NAMES


def provision_key(text: str) -> str:
    """Return the key of a provision given by its name or its key."""
    name = " ".join(text.partition(" [")[0].split()).casefold()
    return _KEYS_BY_NAME.get(name, text)


class Override(Frozen):
    """A replacement for the number of a provision, with the reason that the package prints."""

    provision: Annotated[RequiredText, AfterValidator(provision_key)]
    value: float
    reason: RequiredText
