"""Long names of arrays, objects and motions, and the keys that a package prints for them.

A key stands for the whole name wherever it is read. Owns no content. Read `Names`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import chain, count

from markupsafe import escape

from report.words.counts import capitalized, name_order

LONGEST = 12
"""Characters of a name that is printed as it is."""

# A name within a longer word or a path is another name.
_BEFORE, _AFTER = r"(?<![\w/\\.-])", r"(?![\w/\\]|[.-]\w)"
# What is printed as it was entered, with all within; and what is no text.
_KEPT = r"""<(\w+)[^>]*\stranslate="no"[^>]*>.*?</\1>|<[^>]*>"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Names:
    """Prints the names of a project: a long one by its key, such as `[3]`.

    Attributes
    ----------
    keys : mapping of str to str
        By name, in the order of the keys.
    """

    keys: Mapping[str, str]

    @classmethod
    def of(cls, *kinds: Iterable[str]) -> Names:
        """Return the keys of names of several kinds.

        Names that count on have keys that count on, so that a range of names is one of keys: of
        names with one stem all have a key, or none.
        """
        rows = [sorted(map(name_order, dict.fromkeys(names))) for names in kinds]
        long = {(at, row[0]) for at, kind in enumerate(rows) for row in kind if _is_long(row[2])}
        keyed = [row[2] for at, kind in enumerate(rows) for row in kind if (at, row[0]) in long]
        given = {row[2] for row in chain(*rows)}
        free = (key for number in count(1) if (key := f"[{number}]") not in given)
        return cls(keys=dict(zip(dict.fromkeys(keyed), free, strict=False)))

    @property
    def _written(self) -> Mapping[str, str]:
        """The keys of the names, also as they begin a sentence."""
        return {**{capitalized(name): key for name, key in self.keys.items()}, **self.keys}

    def __call__(self, text: str) -> str:
        """Return a text with the keys of the names in it."""
        keys = self._written
        if not keys:
            return text
        any_of = _any_of(keys)
        return re.compile(any_of).sub(lambda match: keys[match[0]], text)

    def in_html(self, html: str) -> str:
        """Return a document with the keys of the names in its texts.

        What is marked `translate="no"` is left as it is.
        """
        if not self.keys:
            return html
        keys = {str(escape(name)): key for name, key in self._written.items()}
        head, body, rest = html.partition("<body")
        any_of = rf"{_KEPT}|{_any_of(keys)}"
        pattern = re.compile(any_of, re.DOTALL)
        return head + pattern.sub(lambda match: keys.get(match[0], match[0]), body + rest)


def _is_long(name: str) -> bool:
    return len(name) > LONGEST


def _any_of(names: Iterable[str]) -> str:
    """Return a pattern for the longest of some names."""
    longest_first = sorted(names, key=len, reverse=True)
    return f"{_BEFORE}(?:{'|'.join(map(re.escape, longest_first))}){_AFTER}"
