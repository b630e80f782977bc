"""Ways to tamper with a package, seeded: each takes its bytes and returns other bytes.

`files` are rewritten by pikepdf, a library that the program does not use.
"""

from __future__ import annotations

import hashlib
import io
import json
import random
import re
from collections.abc import Callable
from functools import wraps
from typing import Any

import pikepdf

Tamper = Callable[[bytes, random.Random], bytes]


def rewritten(data: bytes, change: Callable[[pikepdf.Pdf], None]) -> bytes:
    """Return a PDF written again after a change to its objects."""
    out = io.BytesIO()
    with pikepdf.open(io.BytesIO(data)) as pdf:
        change(pdf)
        pdf.save(out, deterministic_id=True)
    return out.getvalue()


def _to_objects(change: Callable[[pikepdf.Pdf, random.Random], object]) -> Tamper:
    """Make a change of the objects of a PDF one of its bytes."""
    return wraps(change)(lambda data, rng: rewritten(data, lambda pdf: change(pdf, rng)))


def _attached(pdf: pikepdf.Pdf) -> dict[str, pikepdf.Object]:
    files = pdf.Root.Names.EmbeddedFiles.Names[1::2]
    return {str(file.UF): file for file in files}  # the other names need not say their encoding


def set_file(pdf: pikepdf.Pdf, name: str, content: bytes) -> None:
    """Replace the content of an attachment, and what is stated of it."""
    stream = _attached(pdf)[name].EF.F
    stream.write(content)
    stream.Params.Size = len(content)
    stream.Params.CheckSum = hashlib.md5(content).digest()


def file_of(pdf: pikepdf.Pdf, name: str) -> bytes:
    """Return the content of an attachment."""
    return _attached(pdf)[name].EF.F.read_bytes()


def relisted(pdf: pikepdf.Pdf) -> None:
    """Correct every hash of the manifest, as one would who knows how packages are made."""
    manifest = json.loads(file_of(pdf, "roofslip.json"))
    for entry in manifest["files"]:
        content = file_of(pdf, entry["name"])
        entry |= {"bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}
    set_file(pdf, "roofslip.json", json.dumps(manifest, indent=1).encode() + b"\n")


def of_manifest(change: Callable[[dict[str, Any]], object]) -> Callable[[pikepdf.Pdf], None]:
    """Return a change of the manifest as one of the package."""

    def write(pdf: pikepdf.Pdf) -> None:
        manifest = json.loads(file_of(pdf, "roofslip.json"))
        change(manifest)
        set_file(pdf, "roofslip.json", json.dumps(manifest).encode())

    return write


@_to_objects
def digit_in_text(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Change one glyph of the text of a sheet into another of the same font."""
    page = rng.choice(list(pdf.pages))
    content = page.Contents.read_bytes()
    glyphs = list(re.finditer(rb"<((?:[0-9a-f]{4})+)>", content))
    old, new = rng.choice(glyphs), rng.choice(glyphs)
    while old[1][:4] == new[1][:4]:
        old, new = rng.choice(glyphs), rng.choice(glyphs)
    at = old.start(1)
    page.Contents.write(content[:at] + new[1][:4] + content[at + 4 :])


def _digit_changed(content: bytes, rng: random.Random) -> bytes:
    at = rng.choice([m.start() for m in re.finditer(rb"(?<=[0-9.])[1-9](?=[0-9])", content)])
    other = rng.choice([d for d in b"123456789" if d != content[at]])
    return content[:at] + bytes([other]) + content[at + 1 :]


@_to_objects
def digit_in_results(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Change one digit of results.json, and its hash with it."""
    results = file_of(pdf, "results.json")
    # Not its hashes: beyond 1e-12 of a number there is nothing to find.
    places = list(re.finditer(rb"\"\w+_m\": \d+\.\d{4}", results))
    at = rng.choice(places).end() - 1
    other = rng.choice([d for d in b"123456789" if d != results[at]])
    set_file(pdf, "results.json", results[:at] + bytes([other]) + results[at + 1 :])
    relisted(pdf)


def _records(pdf: pikepdf.Pdf) -> list[str]:
    listed = json.loads(file_of(pdf, "roofslip.json"))["files"]
    return [entry["name"] for entry in listed if entry["kind"] == "record"]


@_to_objects
def digit_in_record(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Change one digit of a record, and its hash with it."""
    name = rng.choice(_records(pdf))
    set_file(pdf, name, _digit_changed(file_of(pdf, name), rng))
    relisted(pdf)


@_to_objects
def swapped_records(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Exchange two records, and their hashes with them."""
    one, two = rng.sample(_records(pdf), 2)
    contents = file_of(pdf, one), file_of(pdf, two)
    set_file(pdf, one, contents[1])
    set_file(pdf, two, contents[0])
    relisted(pdf)


@_to_objects
def byte_in_attachment(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Change one byte of an attachment and nothing else."""
    name = rng.choice(sorted(_attached(pdf)))
    content = bytearray(file_of(pdf, name))
    content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
    set_file(pdf, name, bytes(content))


def cut(data: bytes, rng: random.Random) -> bytes:
    """Cut the end off."""
    return data[: rng.randrange(1, len(data) - 8)]


def flipped(data: bytes, rng: random.Random) -> bytes:
    """Flip one bit of the file."""
    at = rng.randrange(len(data) - 8)
    return data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1 :]


@_to_objects
def stamped_over(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Put an annotation with other words over a sheet."""
    page = rng.choice(list(pdf.pages))
    note = pikepdf.Dictionary(
        Type=pikepdf.Name.Annot, Subtype=pikepdf.Name.FreeText, Rect=[100, 300, 400, 340],
        Contents="OK", DA="/Helv 12 Tf",
    )  # fmt: skip
    if "/Annots" not in page:
        page.Annots = pdf.make_indirect(pikepdf.Array())
    page.Annots.append(pdf.make_indirect(note))


@_to_objects
def without_sheet(pdf: pikepdf.Pdf, rng: random.Random) -> None:
    """Take out a sheet."""
    del pdf.pages[rng.randrange(len(pdf.pages))]


def appended(data: bytes, rng: random.Random) -> bytes:
    """Append bytes after the end."""
    return data + rng.randbytes(rng.randrange(1, 200))


OF_THE_INPUT: tuple[Tamper, ...] = (digit_in_record, swapped_records)
"""They leave a package that agrees with itself until it is computed again."""

OF_THE_FILE: tuple[Tamper, ...] = (
    digit_in_text, digit_in_results, byte_in_attachment, cut, flipped, stamped_over,
    without_sheet, appended,
)  # fmt: skip


def of_other_software(pdf: pikepdf.Pdf, name: str = "harfbuzz") -> None:
    """Have a package say that another version of something made it; `harfbuzz` places letters."""
    manifest = json.loads(file_of(pdf, "roofslip.json"))
    manifest["environment"][name] = "0.9"
    set_file(pdf, "roofslip.json", json.dumps(manifest, indent=1).encode() + b"\n")


def _script(pdf: pikepdf.Pdf) -> pikepdf.Object:
    action = pikepdf.Dictionary(S=pikepdf.Name.JavaScript, JS="app.alert('Approved')")
    return pdf.make_indirect(action)


def _first_link(pdf: pikepdf.Pdf) -> pikepdf.Object:
    notes = (note for page in pdf.pages for note in page.get("/Annots", ()))
    return next(note for note in notes if note.Subtype == "/Link")


def _seal(pdf: pikepdf.Pdf) -> pikepdf.Object:
    return pdf.Root.AcroForm.Fields[0]


def _font(pdf: pikepdf.Pdf) -> pikepdf.Object:
    """Return the font of a package with the most glyphs."""
    fonts = (item for item in pdf.objects if isinstance(item, pikepdf.Dictionary))
    found = [item for item in fonts if item.get("/Subtype") == "/Type0"]
    return max(found, key=lambda font: len(font.ToUnicode.read_bytes()))


def _form(pdf: pikepdf.Pdf) -> pikepdf.Object:
    """Return the drawing of a package with the most strokes."""
    forms = (item for item in pdf.objects if isinstance(item, pikepdf.Stream))
    found = [item for item in forms if item.get("/Subtype") == "/Form"]
    return max(found, key=lambda form: len(form.read_bytes()))


def _white(pdf: pikepdf.Pdf, width: float = 612, height: float = 792) -> pikepdf.Object:
    look = pdf.make_stream(b"1 1 1 rg 0 0 %d %d re f" % (width, height))
    look.Type, look.Subtype = pikepdf.Name.XObject, pikepdf.Name.Form
    look.BBox = [0, 0, width, height]
    return look


def _put(item: pikepdf.Object, **entries: object) -> None:
    """Give a dictionary of a PDF entries: `AA` is `/AA`."""
    for name, value in entries.items():
        item[f"/{name}"] = value


def _parent(pdf: pikepdf.Pdf) -> pikepdf.Object:
    """Return a field above a link, which has an action; it is reached upward only."""
    action = pikepdf.Dictionary(D=_script(pdf))
    return pdf.make_indirect(pikepdf.Dictionary(FT=pikepdf.Name.Btn, T="a", AA=action))


def _linked_elsewhere(pdf: pikepdf.Pdf) -> None:
    link = _first_link(pdf)
    del link.Dest
    link.A = pikepdf.Dictionary(S=pikepdf.Name.URI, URI="https://example.com")


def _noted(pdf: pikepdf.Pdf, **entries: object) -> None:
    """Put a note on the cover."""
    note = pikepdf.Dictionary(Type=pikepdf.Name.Annot, **entries)
    pdf.pages[0].Annots.append(pdf.make_indirect(note))


def _with_layers(pdf: pikepdf.Pdf) -> None:
    """Put the drawing of the most strokes on a layer that is off."""
    layer = pdf.make_indirect(pikepdf.Dictionary(Type=pikepdf.Name.OCG, Name="a"))
    pdf.Root.OCProperties = pikepdf.Dictionary(OCGs=[layer], D=pikepdf.Dictionary(OFF=[layer]))
    _form(pdf).OC = layer


def _painted_twice(pdf: pikepdf.Pdf) -> pikepdf.Object:
    white = pdf.make_stream(_white(pdf).read_bytes())
    return pikepdf.Array([pdf.pages[0].obj.Contents, white])


def _first_with(pdf: pikepdf.Pdf, key: str, value: str = "") -> pikepdf.Object:
    items = (item for item in pdf.objects if isinstance(item, pikepdf.Dictionary))
    return next(item for item in items if key in item and value in ("", str(item[key])))


_OTHER_CODES = b"""/CIDInit /ProcSet findresource begin 12 dict begin begincmap
/CIDSystemInfo 3 dict dup begin /Registry (Adobe) def /Ordering (Identity) def /Supplement 0 def
end def /CMapName /Other def /CMapType 1 def 1 begincodespacerange <0000> <ffff> endcodespacerange
2 begincidrange <0000> <00ff> 1 <0100> <ffff> 256 endcidrange endcmap
CMapName currentdict /CMap defineresource pop end end"""

_HALF, _MOVED = [0, 0, 612, 396], [0, 396, 612, 1188]


def _above(pdf: pikepdf.Pdf, **entries: object) -> None:
    """Give a sheet entries by what is above it."""
    for name, value in entries.items():
        del pdf.pages[0].obj[f"/{name}"]
        pdf.Root.Pages[f"/{name}"] = value


REFUSED: dict[str, Callable[[pikepdf.Pdf], object]] = {
    "opens with a script": lambda pdf: _put(pdf.Root, OpenAction=_script(pdf)),
    "opens elsewhere": lambda pdf: _put(
        pdf.Root, OpenAction=pikepdf.Array([pdf.pages[-1].obj, pikepdf.Name.Fit])
    ),
    "script as it closes": lambda pdf: _put(pdf.Root, AA=pikepdf.Dictionary(WC=_script(pdf))),
    "script of a sheet": lambda pdf: _put(
        pdf.pages[0].obj, AA=pikepdf.Dictionary(O=_script(pdf))
    ),
    "script by name": lambda pdf: _put(
        pdf.Root.Names, JavaScript=pikepdf.Dictionary(Names=["a", _script(pdf)])
    ),
    "script of the seal": lambda pdf: _put(_seal(pdf), AA=pikepdf.Dictionary(Fo=_script(pdf))),
    "script of a parent": lambda pdf: _put(_first_link(pdf), Parent=_parent(pdf)),
    "form of the reader": lambda pdf: _put(pdf.Root.AcroForm, XFA=pdf.make_stream(b"<xdp/>")),
    "address of a link": _linked_elsewhere,
    "script of a bookmark": lambda pdf: _put(pdf.Root.Outlines.First, A=_script(pdf)),
    "look of the seal": lambda pdf: _seal(pdf).AP.N.write(b"0 0 1 rg 0 0 200 100 re f"),
    "look of a link": lambda pdf: _put(
        _first_link(pdf), AP=pikepdf.Dictionary(N=_white(pdf)), Rect=[0, 0, 612, 792]
    ),
    # White over the cover, and in its list like the field beside it.
    "note on a sheet": lambda pdf: _noted(
        pdf, Subtype=pikepdf.Name.Square, Rect=[0, 0, 612, 792], F=4,
        AP=pikepdf.Dictionary(N=_white(pdf)),
    ),
    "file on a sheet": lambda pdf: _noted(
        pdf, Subtype=pikepdf.Name.FileAttachment, Rect=[100, 100, 120, 120],
        FS=_attached(pdf)["roofslip.json"],
    ),
    "file of a sheet": lambda pdf: _put(
        pdf.pages[0].obj, AF=pikepdf.Array([_attached(pdf)["roofslip.json"]])
    ),
    "another file": lambda pdf: pdf.attachments.update({"other.txt": b"Approved"}),
    "layers": _with_layers,
    "cropped": lambda pdf: _put(pdf.pages[0].obj, CropBox=_HALF),
    "cropped from above": lambda pdf: _put(pdf.Root.Pages, CropBox=_HALF),
    "turned": lambda pdf: _put(pdf.pages[0].obj, Rotate=180),
    "smaller": lambda pdf: _put(pdf.pages[0].obj, MediaBox=_HALF),
    "moved": lambda pdf: _put(pdf.pages[0].obj, MediaBox=_MOVED),
    "moved from above": lambda pdf: _above(pdf, MediaBox=_MOVED),
    "moved, and trimmed with it": lambda pdf: _put(
        pdf.pages[0].obj, MediaBox=_MOVED, TrimBox=_MOVED, BleedBox=_MOVED
    ),
    "turned from above": lambda pdf: _put(pdf.Root.Pages, Rotate=90),
    "shown to its trim": lambda pdf: _put(pdf.pages[0].obj, TrimBox=_HALF),
    "shown to its art": lambda pdf: _put(pdf.pages[0].obj, ArtBox=_HALF),
    "in other units from above": lambda pdf: _put(pdf.Root.Pages, UserUnit=2),
    "in other units": lambda pdf: _put(pdf.pages[0].obj, UserUnit=2),
    "painted by a second stream": lambda pdf: _put(
        pdf.pages[0].obj, Contents=_painted_twice(pdf)
    ),
    # Codes stand for other glyphs, by a map inside the file.
    "mapped by a stream": lambda pdf: _put(_font(pdf), Encoding=pdf.make_stream(_OTHER_CODES)),
    "alternative text": lambda pdf: _put(
        _first_with(pdf, "/Alt"), Alt="All requirements are satisfied"
    ),
    "text read instead": lambda pdf: _put(_first_with(pdf, "/S", "/P"), ActualText="OK"),
    "alternative text of a link": lambda pdf: _put(_first_link(pdf), Contents="Approved"),
    "title of a bookmark": lambda pdf: _put(pdf.Root.Outlines.First, Title="Approved"),
    "another producer": lambda pdf: _put(pdf.docinfo, Producer="The building department"),
}  # fmt: skip
"""Changes to a package that no software explains, whichever wrote it."""


def painted_over(pdf: pikepdf.Pdf) -> None:
    """Paint the cover white, and leave its words where they are."""
    page = pdf.pages[0].obj
    page.Contents.write(page.Contents.read_bytes() + b"\nq " + _white(pdf).read_bytes() + b" Q")


def drawing_painted_over(pdf: pikepdf.Pdf) -> None:
    form = _form(pdf)
    form.write(form.read_bytes() + b"\nq 1 1 1 rg -999 -999 1999 1999 re f Q")


def drawing_of_results(pdf: pikepdf.Pdf) -> None:
    """Replace a drawing by the bytes of an attachment: readers show nothing there."""
    _form(pdf).write(file_of(pdf, "results.json"))


REDRAWN: tuple[Callable[[pikepdf.Pdf], None], ...] = (
    painted_over, drawing_painted_over, drawing_of_results,
)  # fmt: skip
"""Changes to what a package shows that other software could have made, for all one can tell."""


def meant_otherwise(pdf: pikepdf.Pdf) -> None:
    """Have the code of one digit stand for another one in a text that is copied or searched."""
    stream = _font(pdf).ToUnicode
    three, eight = (f"{ord(digit):04x}".encode() for digit in "38")
    swap = {three: eight, eight: three}
    stream.write(
        re.sub(
            rb"(<[0-9a-fA-F]{4}>\s*<)([0-9a-fA-F]{4})>",
            lambda found: found[1] + swap.get(found[2].lower(), found[2]) + b">",
            stream.read_bytes(),
        )
    )


def refused_whoever_wrote_it(data: bytes, rng: random.Random) -> bytes:
    """Put in what no report writes, and name another version of what draws."""
    return rewritten(
        data, lambda pdf: (of_other_software(pdf), rng.choice([*REFUSED.values()])(pdf))
    )


def drawn_otherwise(data: bytes, rng: random.Random) -> bytes:
    """Change what a package shows, and name another version of what draws."""
    return rewritten(data, lambda pdf: (of_other_software(pdf), rng.choice(REDRAWN)(pdf)))


OF_THE_SOFTWARE: tuple[Tamper, ...] = (refused_whoever_wrote_it, drawn_otherwise)
"""They name other software than that which made the package."""
