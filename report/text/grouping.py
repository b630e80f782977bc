"""Items in groups of one key, in the order of their first items."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from typing import Any, TypeVar

_Item = TypeVar("_Item")

_Key = TypeVar("_Key", bound=Hashable)


def grouped_by(items: Iterable[_Item], key: Callable[[_Item], _Key]) -> Mapping[_Key, list[_Item]]:
    """Return items in groups of one key, in the order of their first items."""
    groups: dict[_Key, list[_Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def ids_by(items: Iterable[Any], key: Callable[[Any], _Key]) -> Mapping[_Key, list[str]]:
    """Return the same of items with an id, each by that."""
    groups = grouped_by(items, key).items()
    return {value: [item.id for item in alike] for value, alike in groups}
