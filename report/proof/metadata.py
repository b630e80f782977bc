"""What the metadata of a document (XMP) state, however they are written. Read `facts`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from defusedxml.ElementTree import fromstring

_RDF = "{http://www.w3.org/1999/02/22-rdf-syntax-ns#}"
_XMP = "{http://ns.adobe.com/xap/1.0/}"
PRODUCER = "{http://ns.adobe.com/pdf/1.3/}Producer"

_WRITING = {
    f"{_RDF}parseType",
    "{adobe:ns:meta/}xmptk",
    "{http://www.w3.org/XML/1998/namespace}lang",
}
"""Says how the metadata are written, not what."""

_REWRITTEN = {f"{_XMP}ModifyDate", f"{_XMP}MetadataDate"}
_DATE = re.compile(r"[-D:\dTZ+.' ]*")


def is_date(text: object) -> bool:
    """Whether a text is a date, as PDF or XMP write one, and no more."""
    return isinstance(text, str) and _DATE.fullmatch(text) is not None


def facts(metadata: Any) -> frozenset[tuple[str, str]]:
    """Return what a stream of metadata states, name and value, without the date of a rewriting."""
    return frozenset(
        (name, value)
        for name, value in _stated(fromstring(metadata.get_data()))
        if value and name not in _WRITING and not (name in _REWRITTEN and is_date(value))
    )


def _stated(root: Any) -> Iterator[tuple[str, str]]:
    for item in root.iter():
        yield item.tag, " ".join((item.text or "").split())
        for name, value in item.items():
            # A value is the element's text, or an address in an attribute of it.
            yield item.tag if name == f"{_RDF}resource" else name, " ".join(value.split())
