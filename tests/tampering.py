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

import pikepdf

Tamper = Callable[[bytes, random.Random], bytes]


def rewritten(data: bytes, change: Callable[[pikepdf.Pdf], None]) -> bytes:
    """Return a PDF written again after a change to its objects."""
    out = io.BytesIO()
    with pikepdf.open(io.BytesIO(data)) as pdf:
        change(pdf)
        pdf.save(out, deterministic_id=True)
    return out.getvalue()


def _attached(pdf: pikepdf.Pdf) -> dict[str, pikepdf.Object]:
    names = pdf.Root.Names.EmbeddedFiles.Names
    return {str(names[k]): names[k + 1] for k in range(0, len(names), 2)}


def set_file(pdf: pikepdf.Pdf, name: str, content: bytes) -> None:
    """Replace the content of an attachment."""
    _attached(pdf)[name].EF.F.write(content)


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


def digit_in_text(data: bytes, rng: random.Random) -> bytes:
    """Change one glyph of the text of a sheet into another of the same font."""

    def change(pdf: pikepdf.Pdf) -> None:
        page = rng.choice(list(pdf.pages))
        content = page.Contents.read_bytes()
        glyphs = list(re.finditer(rb"<((?:[0-9a-f]{4})+)>", content))
        old, new = rng.choice(glyphs), rng.choice(glyphs)
        while old[1][:4] == new[1][:4]:
            old, new = rng.choice(glyphs), rng.choice(glyphs)
        at = old.start(1)
        page.Contents.write(content[:at] + new[1][:4] + content[at + 4 :])

    return rewritten(data, change)


def _digit_changed(content: bytes, rng: random.Random) -> bytes:
    at = rng.choice([m.start() for m in re.finditer(rb"(?<=[0-9.])[1-9](?=[0-9])", content)])
    other = rng.choice([d for d in b"123456789" if d != content[at]])
    return content[:at] + bytes([other]) + content[at + 1 :]


def digit_in_results(data: bytes, rng: random.Random) -> bytes:
    """Change one digit of results.json, and its hash with it."""

    def change(pdf: pikepdf.Pdf) -> None:
        results = file_of(pdf, "results.json")
        # Not its hashes: beyond 1e-12 of a number there is nothing to find.
        places = list(re.finditer(rb"\"\w+_m\": \d+\.\d{4}", results))
        at = rng.choice(places).end() - 1
        other = rng.choice([d for d in b"123456789" if d != results[at]])
        set_file(pdf, "results.json", results[:at] + bytes([other]) + results[at + 1 :])
        relisted(pdf)

    return rewritten(data, change)


def _records(pdf: pikepdf.Pdf) -> list[str]:
    listed = json.loads(file_of(pdf, "roofslip.json"))["files"]
    return [entry["name"] for entry in listed if entry["kind"] == "record"]


def digit_in_record(data: bytes, rng: random.Random) -> bytes:
    """Change one digit of a record, and its hash with it."""

    def change(pdf: pikepdf.Pdf) -> None:
        name = rng.choice(_records(pdf))
        set_file(pdf, name, _digit_changed(file_of(pdf, name), rng))
        relisted(pdf)

    return rewritten(data, change)


def swapped_records(data: bytes, rng: random.Random) -> bytes:
    """Exchange two records, and their hashes with them."""

    def change(pdf: pikepdf.Pdf) -> None:
        one, two = rng.sample(_records(pdf), 2)
        contents = file_of(pdf, one), file_of(pdf, two)
        set_file(pdf, one, contents[1])
        set_file(pdf, two, contents[0])
        relisted(pdf)

    return rewritten(data, change)


def byte_in_attachment(data: bytes, rng: random.Random) -> bytes:
    """Change one byte of an attachment and nothing else."""

    def change(pdf: pikepdf.Pdf) -> None:
        name = rng.choice(sorted(_attached(pdf)))
        content = bytearray(file_of(pdf, name))
        content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
        set_file(pdf, name, bytes(content))

    return rewritten(data, change)


def cut(data: bytes, rng: random.Random) -> bytes:
    """Cut the end off."""
    return data[: rng.randrange(1, len(data) - 8)]


def flipped(data: bytes, rng: random.Random) -> bytes:
    """Flip one bit of the file."""
    at = rng.randrange(len(data) - 8)
    return data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1 :]


def stamped_over(data: bytes, rng: random.Random) -> bytes:
    """Put an annotation with other words over a sheet."""

    def change(pdf: pikepdf.Pdf) -> None:
        page = rng.choice(list(pdf.pages))
        note = pikepdf.Dictionary(
            Type=pikepdf.Name.Annot, Subtype=pikepdf.Name.FreeText, Rect=[100, 300, 400, 340],
            Contents="OK", DA="/Helv 12 Tf",
        )  # fmt: skip
        if "/Annots" not in page:
            page.Annots = pdf.make_indirect(pikepdf.Array())
        page.Annots.append(pdf.make_indirect(note))

    return rewritten(data, change)


def without_sheet(data: bytes, rng: random.Random) -> bytes:
    """Take out a sheet."""

    def change(pdf: pikepdf.Pdf) -> None:
        del pdf.pages[rng.randrange(len(pdf.pages))]

    return rewritten(data, change)


def appended(data: bytes, rng: random.Random) -> bytes:
    """Append bytes after the end."""
    return data + rng.randbytes(rng.randrange(1, 200))


OF_THE_INPUT: tuple[Tamper, ...] = (digit_in_record, swapped_records)
"""They leave a package that agrees with itself until it is computed again."""

OF_THE_FILE: tuple[Tamper, ...] = (
    digit_in_text, digit_in_results, byte_in_attachment, cut, flipped, stamped_over,
    without_sheet, appended,
)  # fmt: skip
