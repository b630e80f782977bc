"""Writes a DLL for Windows on x86-64 without code, whose exports are those of other DLLs."""

from __future__ import annotations

import re
import struct
from collections.abc import Mapping
from pathlib import Path

_BASE, _PAGE, _BLOCK, _START = 0x5A0000000, 0x1000, 0x200, 0x1000


def names_of(library: Path) -> list[str]:
    """Return the names in an import library (.lib)."""
    found = set(re.findall(rb"__imp_(\w+)\x00", library.read_bytes()))
    return sorted(name.decode() for name in found)


def write_forwarder(path: Path, forwards: Mapping[str, str]) -> None:
    """Write a DLL whose names are forwarded to `DLL.NAME`."""
    exports = _exports(path.name, forwards)
    relocations = struct.pack("<II", _START, 8)  # an empty block: the image may be moved
    relocations_at = _up(_START + len(exports), _PAGE)
    end = _up(relocations_at + len(relocations), _PAGE)
    optional = struct.pack("<HBBIIIII", 0x20B, 14, 0, 0, _up(len(exports), _BLOCK), 0, 0, 0)
    optional += struct.pack(
        "<QIIHHHHHHIIIIHH", _BASE, _PAGE, _BLOCK, 6, 0, 0, 0, 6, 0, 0, end, 0x400, 0, 3, 0x160
    )
    optional += struct.pack("<QQQQII", 0x100000, 0x1000, 0x100000, 0x1000, 0, 16)
    directories = [(0, 0)] * 16
    directories[0] = (_START, len(exports))
    directories[5] = (relocations_at, len(relocations))
    optional += b"".join(struct.pack("<II", *each) for each in directories)
    head = b"MZ" + b"\0" * 58 + struct.pack("<I", 0x40) + b"PE\0\0"
    head += struct.pack("<HHIIIHH", 0x8664, 2, 0, 0, 0, len(optional), 0x2022) + optional
    file_at = 0x400
    for name, at, content, kind in (
        (b".edata", _START, exports, 0x40000040),
        (b".reloc", relocations_at, relocations, 0x42000040),
    ):
        size = _up(len(content), _BLOCK)
        head += struct.pack("<8sIIIIIIHHI", name, len(content), at, size, file_at, 0, 0, 0, 0, kind)
        file_at += size
    blocks = (content.ljust(_up(len(content), _BLOCK), b"\0") for content in (exports, relocations))
    path.write_bytes(head.ljust(0x400, b"\0") + b"".join(blocks))


def _exports(name: str, forwards: Mapping[str, str]) -> bytes:
    names = sorted(forwards)
    n, texts, texts_at = len(names), b"", _START + 40 + 10 * len(names)

    def placed(text: str) -> int:
        nonlocal texts
        at = texts_at + len(texts)
        texts += text.encode() + b"\0"
        return at

    own = placed(name)
    names_at = [placed(each) for each in names]
    forwards_at = [placed(forwards[each]) for each in names]
    tables = (_START + 40, _START + 40 + 4 * n, _START + 40 + 8 * n)
    head = struct.pack("<IIHHIIIIIII", 0, 0, 0, 0, own, 1, n, n, *tables)
    body = struct.pack(f"<{n}I{n}I{n}H", *forwards_at, *names_at, *range(n))
    return head + body + texts


def _up(size: int, step: int) -> int:
    return -(-size // step) * step
