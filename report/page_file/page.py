"""The package as one file that a browser opens without a server or a network.

Its sections are those of the package, as the PDF has them: it computes nothing. Read `page`.
"""

from __future__ import annotations

import base64
import hashlib
import re
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from markupsafe import Markup

from report.assessment.assessment import Assessment
from report.document.templates import rendered
from report.page_file.data import data
from report.typeset.pdf import TEMPLATES

SECTIONS = ("summary", "plan", "comparison", "limits")
"""Sections of the package that the file has, in this order."""

SHADES = (0.5, 0.8, 1.0)
"""Values of D/C between which arrays are shaded alike on the plan."""

# Of a file with what it computes with.
MOST_BYTES = 2_500_000

_OWN = Path(__file__).parent / "static"
# The scripts and the style of the page that `serve` shows, of which it plays a run.
_SHARED = Path(__file__).parents[1] / "web" / "static"
_IMPORT = re.compile(r'^import (\{[^}]*\}) from "\./([\w-]+\.js)";\n', re.MULTILINE)
_EXPORTED = re.compile(r"^export (?:async )?(?:function|const|class) (\w+)", re.MULTILINE)
_FONTS = {"regular": 400, "semibold": 700}
_SVG, _LINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
_SVG_DATA = "data:image/svg+xml;base64,"


class FileSection(NamedTuple):
    """A section of the file."""

    id: str
    number: str  # as in the package
    title: str
    body: Markup
    rest: Markup  # of the plan: from the end of its figure on


def page(package: str, assessment: Assessment, fingerprint: str, results: bytes) -> bytes:
    """Return the file, from the HTML of the package and results.json.

    If it would be too large, it computes nothing and states this.
    """
    run_data = data(assessment, results) if assessment.has_motions else ""
    made = _page(package, assessment, fingerprint, run_data)
    if len(made) <= MOST_BYTES:
        return made
    warnings.warn(
        "calc-package.html does not recompute the runs: with their motions, it would be"
        f" {len(made) / 1e6:.1f} MB, more than {MOST_BYTES / 1e6:.1f} MB",
        stacklevel=2,
    )
    return _page(package, assessment, fingerprint, "")


def _page(package: str, assessment: Assessment, fingerprint: str, run_data: str) -> bytes:
    css, script = _css(), _script("file.js") if run_data else ""
    # Whatever is in the file: nothing is loaded, and no other style or script is obeyed.
    policy = f"default-src 'none'; style-src {_hash(css)}; font-src data:; base-uri 'none'"
    if run_data:
        # Compiling WebAssembly needs this word of the policy; `eval` of a script stays forbidden.
        policy += f"; script-src {_hash(script)} 'wasm-unsafe-eval'"
    shades = {item.id: _shade(assessment, item.id) for item in assessment.arrays}
    context = {
        "project": assessment.project.project,
        "rules": assessment.rules.name,
        "verdict": assessment.verdict,
        "has_motions": assessment.has_motions,
        "fingerprint": fingerprint,
        "policy": f"{policy}; form-action 'none'",
        "css": Markup(css),
        "script": Markup(script),
        "data": Markup(run_data),
        "most_mb": MOST_BYTES / 1e6,
        "sections": _sections(package, shades),
        "shades": SHADES,
    }
    return rendered(TEMPLATES, "page-file.html", context).encode()


def _script(name: str) -> str:
    """Return a module with everything it imports as one script: each module is a function."""
    modules: dict[str, str] = {}

    def add(name: str) -> None:
        path = _OWN / name
        text = (path if path.is_file() else _SHARED / name).read_text(encoding="utf-8")
        for _, imported in _IMPORT.findall(text):
            if imported not in modules:
                add(imported)
        names = ", ".join(_EXPORTED.findall(text))
        body = _IMPORT.sub(lambda match: _taken(*match.groups()), text)
        # One classic script: a page opened as a file may not import modules from files.
        body = re.sub(r"^export ", "", body, flags=re.MULTILINE)
        # Those that it imports are there by now: each function runs where it stands.
        modules[name] = f'modules["{name}"] = (() => {{\n{body}return {{ {names} }};\n}})();\n'

    add(name)
    return f'"use strict";\nconst modules = {{}};\n{"".join(modules.values())}'


def _taken(names: str, module: str) -> str:
    """Return an import as a constant."""
    return f'const {names.replace(" as ", ": ")} = modules["{module}"];\n'


def _css() -> str:
    """Return the style of the file, with its fonts."""
    faces = (
        '@font-face { font-family: "Source Sans 3"; font-weight: '
        f"{weight}; src: url(data:font/woff;base64,{_base64(_part(f'{name}.woff'))}); }}\n"
        for name, weight in _FONTS.items()
    )
    views = (_SHARED / "views.css").read_text(encoding="utf-8")
    return "".join(faces) + _part("page-file.css").decode() + views


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


def _sections(package: str, shades: Mapping[str, str]) -> list[FileSection]:
    """Return the sections of the file, for a screen."""
    # The HTML of a package is well-formed XML: `lay_out` refuses any other.
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
    sections = []
    for id in SECTIONS:
        if id in bodies:
            body = "".join(bodies[id])
            end = body.index("</figure>") if id == "plan" else len(body)
            parts = Markup(body[:end]), Markup(body[end:])
            sections.append(FileSection(id, numbers[id], titles[id], *parts))
    return sections


def _markup(section: Element, numbers: Mapping[str, str], shades: Mapping[str, str]) -> str:
    """Return the content of a section as HTML for a screen, including its pictures."""
    for parent in list(section.iter()):
        for place, child in enumerate(parent):
            if child.tag == "img" and child.get("src", "").startswith(_SVG_DATA):
                parent[place] = _drawing(child, shades)
                parent[place].tail = child.tail
    for element in section.iter():
        # Widths are those of paper, and the policy allows no style of an element.
        element.attrib.pop("style", None)
        # For the number of a sheet the file has that of a section, which it may lack.
        if element.get("class") == "at":
            target = element.get("href", "").removeprefix("#").partition(":")[0]
            element.text = numbers[target]
            element.set("href", f"#{target}")
            if target not in SECTIONS:
                element.tag, element.attrib = "span", {}
        elif element.tag == "th" and element.text == "Sheet":
            element.text = "Section"
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
