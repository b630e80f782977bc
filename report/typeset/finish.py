"""What the renderer leaves out of a tagged PDF/A-3: done on its objects before they are written.

Scopes of table headings, MIME types of attachments, an empty signature field, and the claim to be
PDF/UA-1 beside PDF/A-3a. Read `finish`.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

SEAL = "seal"
"""Id of the box over which the signature field lies."""

FIELD = "Seal and signature of the engineer"
"""Name of the signature field."""

LEVEL = 3
"""Of compression: level 6 takes three times as long for a file that is 7 % smaller."""

_PT_PER_PX = 0.75
# Readers of PDF/A accept properties beyond their own only with this description (ISO 19005-3,
# 6.6.2.3.3); PDF/UA-1 (ISO 14289-1, 5) asks for the property.
_UA = b"""<rdf:Description rdf:about="" xmlns:pdfuaid="http://www.aiim.org/pdfua/ns/id/"
 pdfuaid:part="1"/>
<rdf:Description rdf:about="" xmlns:pdfaExtension="http://www.aiim.org/pdfa/ns/extension/"
 xmlns:pdfaSchema="http://www.aiim.org/pdfa/ns/schema#"
 xmlns:pdfaProperty="http://www.aiim.org/pdfa/ns/property#"><pdfaExtension:schemas><rdf:Bag>
<rdf:li rdf:parseType="Resource"><pdfaSchema:schema>PDF/UA identification</pdfaSchema:schema>
<pdfaSchema:namespaceURI>http://www.aiim.org/pdfua/ns/id/</pdfaSchema:namespaceURI>
<pdfaSchema:prefix>pdfuaid</pdfaSchema:prefix><pdfaSchema:property><rdf:Seq>
<rdf:li rdf:parseType="Resource"><pdfaProperty:name>part</pdfaProperty:name>
<pdfaProperty:valueType>Integer</pdfaProperty:valueType>
<pdfaProperty:category>internal</pdfaProperty:category>
<pdfaProperty:description>Part of ISO 14289</pdfaProperty:description></rdf:li>
</rdf:Seq></pdfaSchema:property></rdf:li></rdf:Bag></pdfaExtension:schemas></rdf:Description>
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attached:
    """A file inside a PDF.

    Attributes
    ----------
    name : str
        Relative path, with `/`.
    content : bytes
    mime : str
        Such as ``text/csv``.
    relationship : str
        ``Source`` of the document, or ``Data`` that it shows (ISO 32000-2, table 43).
    description : str
    """

    name: str
    content: bytes
    mime: str
    relationship: str
    description: str


def finish(document: Any, pdf: Any, attached: Sequence[Attached]) -> None:
    """Complete the objects of a PDF.

    Parameters
    ----------
    document : weasyprint.Document
    pdf : pydyf.PDF
    attached : sequence of Attached
        Its attachments.
    """
    _scope_headings(pdf)
    _name_kinds(pdf, attached)
    _claim_ua(pdf)
    for at, page in enumerate(document.pages):
        if SEAL in page.anchors:
            _add_field(pdf, at, _rectangle(page))
    _compress(pdf)


def _scope_headings(pdf: Any) -> None:
    """Give each table heading its scope: the column in a table's head, the row elsewhere."""
    kinds = {item.reference: item for item in _dictionaries(pdf) if "S" in item}
    for item in kinds.values():
        if item["S"] == "/TH":
            body = kinds[kinds[item["P"]]["P"]]
            item["A"]["Scope"] = "/Column" if body["S"] == "/THead" else "/Row"


def _dictionaries(pdf: Any) -> Iterator[Any]:
    return (item for item in pdf.objects if isinstance(item, dict))


def _name_kinds(pdf: Any, attached: Sequence[Attached]) -> None:
    """Give each attachment its MIME type."""
    files = {file.name: file for file in attached}
    for item in _dictionaries(pdf):
        if item.get("Type") == "/Filespec":
            kind = files[item["UF"].string].mime.replace("/", "#2f")
            _object(pdf, item["EF"]["F"]).extra["Subtype"] = f"/{kind}"


def _compress(pdf: Any) -> None:
    """Compress each stream, which the renderer does once for its identifier and once to write it.

    The report of the example takes 5 % longer without.
    """
    import pydyf

    for item in pdf.objects:
        if isinstance(item, pydyf.Stream) and item.compress:
            item.compress = False
            _, _, written = item.data.partition(b"\nstream\n")
            item.stream = [zlib.compress(written.removesuffix(b"\nendstream"), LEVEL)]
            item.extra["Filter"] = "/FlateDecode"


def _object(pdf: Any, reference: bytes) -> Any:
    return pdf.objects[int(reference.split()[0])]


def _claim_ua(pdf: Any) -> None:
    metadata = _object(pdf, pdf.catalog["Metadata"])
    metadata.stream = [metadata.stream[0].replace(b"</rdf:RDF>", _UA + b"</rdf:RDF>")]


def _rectangle(page: Any) -> tuple[float, ...]:
    """Return where the box of the seal lies [pt], from the lower left corner of the page."""
    left, top, right, bottom = page.anchors[SEAL]
    from_below = (left, page.height - bottom, right, page.height - top)
    return tuple(round(_PT_PER_PX * px, 3) for px in from_below)


def _add_field(pdf: Any, page: int, rectangle: tuple[float, ...]) -> None:
    """Add an empty signature field, tagged as a form field."""
    import pydyf

    left, bottom, right, top = rectangle
    look = pydyf.Stream(
        [],
        {
            "Type": "/XObject",
            "Subtype": "/Form",
            "BBox": pydyf.Array([0, 0, right - left, top - bottom]),
        },
    )
    pdf.add_object(look)
    reference = pdf.page_references[page]
    field = pydyf.Dictionary(
        {
            "Type": "/Annot",
            "Subtype": "/Widget",
            "FT": "/Sig",
            "T": pydyf.String(FIELD),
            "TU": pydyf.String(FIELD),
            "Rect": pydyf.Array(rectangle),
            "P": reference,
            "F": 4,  # it is printed
            "AP": pydyf.Dictionary({"N": look.reference}),
        }
    )
    pdf.add_object(field)
    _object(pdf, reference).setdefault("Annots", pydyf.Array()).append(field.reference)
    pdf.catalog["AcroForm"] = pydyf.Dictionary({"Fields": pydyf.Array([field.reference])})
    _tag_field(pdf, reference, field)


def _tag_field(pdf: Any, page: bytes, field: Any) -> None:
    import pydyf

    root = _object(pdf, pdf.catalog["StructTreeRoot"])
    document = _object(pdf, root["K"][0])
    to = pydyf.Dictionary({"Type": "/OBJR", "Obj": field.reference, "Pg": page})
    pdf.add_object(to)
    element = pydyf.Dictionary(
        {
            "Type": "/StructElem",
            "S": "/Form",
            "P": document.reference,
            "Pg": page,
            "K": pydyf.Array([to.reference]),
        }
    )
    pdf.add_object(element)
    document["K"].append(element.reference)
    numbers = _object(pdf, root["ParentTree"])["Nums"]
    field["StructParent"] = numbers[-2] + 1
    numbers += [field["StructParent"], element.reference]
