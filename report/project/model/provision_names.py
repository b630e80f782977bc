"""Provisions by their names in words, as a user reads and types them."""

from __future__ import annotations

from solver.rules.rulesets import ALLOWED


def provision_name(key: str) -> str:
    """Return the name of a provision in words, as on the Provisions worksheet; without its unit."""
    words = ALLOWED[key].meaning.partition(" [")[0]
    return words[:1].upper() + words[1:]


def provision_unit(key: str) -> str:
    """Return the unit of a provision, as a cell names it; empty for none."""
    allowed = ALLOWED.get(provision_key(key))
    return allowed.meaning.partition(" [")[2].rstrip("]") if allowed else ""


_KEYS_BY_NAME = {provision_name(key).casefold(): key for key in ALLOWED}


def provision_key(text: str) -> str:
    """Return the key of a provision given by its name or its key."""
    name = " ".join(text.partition(" [")[0].split()).casefold()
    return _KEYS_BY_NAME.get(name, text)
