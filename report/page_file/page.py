"""The package as one file that a browser opens by itself, without a server or a network.

Its sections are those of the package, as the PDF has them: it computes nothing. Read `page`.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from markupsafe import Markup

from report.assessment.assessment import Assessment
from report.document.templates import rendered
from report.typeset.pdf import TEMPLATES

SECTIONS = ("summary", "plan", "comparison", "limits")
"""Sections of the package that the file has, in this order."""

SHADES = (0.5, 0.8, 1.0)
"""Values of D/C between which arrays are shaded alike on the plan."""

_FONTS = {"regular": 400, "semibold": 700}
_SVG, _LINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
_SVG_DATA = "data:image/svg+xml;base64,"


class Section(NamedTuple):
    """A section of the file."""

    id: str
    number: str  # of the part of the package
    title: str
    body: Markup


def page(package: str, assessment: Assessment, fingerprint: str) -> bytes:
    """Return the file, from the HTML of the package."""
    css = _css()
    # Whatever is in the file: nothing is loaded, and no other style or script is obeyed.
    policy = f"default-src 'none'; style-src {_hash(css)}; font-src data:; base-uri 'none'"
    context = {
        "project": assessment.project.project,
        "rules": assessment.rules.name,
        "verdict": assessment.verdict,
        "fingerprint": fingerprint,
        "policy": f"{policy}; form-action 'none'",
        "css": Markup(css),
        "sections": _sections(
            package, {item.id: _shade(assessment, item.id) for item in assessment.arrays}
        ),
        "shades": SHADES,
    }
    return rendered(TEMPLATES, "page-file.html", context).encode()


def _css() -> str:
    """Return the style of the file, with its fonts."""
    faces = (
        '@font-face { font-family: "Source Sans 3"; font-weight: '
        f"{weight}; src: url(data:font/woff;base64,{_base64(_part(f'{name}.woff'))}); }}\n"
        for name, weight in _FONTS.items()
    )
    return "".join(faces) + _part("page-file.css").decode()


def _part(name: str) -> bytes:
    return (TEMPLATES / "page-file" / name).read_bytes()


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()


def _hash(text: str) -> str:
    """Return the source of a policy that allows a script or a style."""
    return f"'sha256-{_base64(hashlib.sha256(text.encode()).digest())}'"


def _shade(assessment: Assessment, array_id: str) -> str:
    """Return the class of an array on the plan, by its largest D/C."""
    gap = assessment.governing_gap(array_id)
    if gap is None:
        return "shade-none"
    is_beyond = [not gap.demand_capacity <= limit for limit in SHADES]  # NaN is
    return f"shade-{sum(is_beyond)}"


def _sections(package: str, shades: Mapping[str, str]) -> list[Section]:
    """Return the sections of the file, for a screen."""
    tree = ElementTree.fromstring(package)
    numbered = [heading for heading in tree.iter() if heading.find("span[@class='no']") is not None]
    numbers = {heading.get("id", ""): heading[0].text or "" for heading in numbered}
    titles, bodies = dict[str, str](), dict[str, list[str]]()
    id = ""
    for section in tree.iter("section"):
        heading = section.find("h1")
        if heading is not None:
            id = heading.get("id", "")
            titles[id] = (heading[0].tail or "").strip()
            section.remove(heading)
        # A large plan is a section of its own, without a heading.
        if id in SECTIONS and section.get("class") != "contents":
            bodies.setdefault(id, []).append(_markup(section, numbers, shades))
    return [
        Section(id, numbers[id], titles[id], Markup("".join(bodies[id])))
        for id in SECTIONS
        if id in bodies
    ]


def _markup(section: Element, numbers: Mapping[str, str], shades: Mapping[str, str]) -> str:
    """Return what is in a section as HTML for a screen: its pictures are part of it."""
    for parent in list(section.iter()):
        for place, child in enumerate(parent):
            if child.tag == "img" and child.get("src", "").startswith(_SVG_DATA):
                parent[place] = _drawing(child, shades)
                parent[place].tail = child.tail
    for element in section.iter():
        # Widths are those of paper, and the policy allows no style of an element.
        element.attrib.pop("style", None)
        # Where the PDF has the number of a sheet, the file has that of a part.
        if element.get("class") == "at":
            element.text = numbers[element.get("href", "").removeprefix("#")]
        elif element.tag == "th" and element.text == "Sheet":
            element.text = "Part"
    return "".join(ElementTree.tostring(child, "unicode", method="html") for child in section)


def _drawing(picture: Element, shades: Mapping[str, str]) -> Element:
    """Return a picture as elements, its arrays shaded."""
    source = base64.b64decode(picture.get("src", "").removeprefix(_SVG_DATA))
    drawing = ElementTree.fromstring(source)
    for parent in list(drawing.iter()):
        for child in parent.findall(f"{_SVG}metadata"):
            parent.remove(child)
    for element in drawing.iter():
        element.tag = element.tag.removeprefix(_SVG)
        # Names of arrays and objects would be anchors of the file.
        name = element.attrib.pop("id", "") if element.tag == "g" else ""
        if name in shades:
            element.set("class", shades[name])
        # As HTML has it.
        if _LINK in element.attrib:
            element.set("href", element.attrib.pop(_LINK))
    drawing.attrib |= {"role": "img", "aria-label": picture.get("alt", "")}
    return drawing
