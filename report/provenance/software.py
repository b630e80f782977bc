"""The software that computes a package: its bill of materials, and what else decides bytes.

Only what the command needs, with all that this needs in turn: tools of developers and optional
extras change neither the list nor its hash.
"""

from __future__ import annotations

import ctypes
import hashlib
import json
import platform
import zlib
from collections.abc import Iterator, Mapping, Set
from functools import cache
from importlib import metadata
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = "roofslip"
SPEC_VERSION = "1.6"
"""Of CycloneDX (ECMA-424)."""

_NATIVE = {
    "pango": (("libpango-1.0.so.0", "libpango-1.0.0.dylib"), "pango_version_string"),
    "harfbuzz": (("libharfbuzz.so.0", "libharfbuzz.0.dylib"), "hb_version_string"),
}
"""Libraries that place letters: names of their files, and what returns their version."""

NEVER_DRAWS = frozenset({"click", "ezdxf", "pypdf", "xlsxwriter", "zlib"})
"""What serves the terminal, the other files or packing: no letter and no stroke depends on it."""


@cache
def sbom() -> bytes:
    """Return the software bill of materials as CycloneDX JSON, without a time stamp."""
    needs = _needs()
    components = {name: _component(about) for name, about in distributions().items()}
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": SPEC_VERSION,
        "version": 1,
        "metadata": {"component": components[ROOT] | {"type": "application"}},
        "components": [part for name, part in components.items() if name != ROOT],
        "dependencies": [
            {
                "ref": components[name]["bom-ref"],
                "dependsOn": sorted(
                    components[below]["bom-ref"] for below in needs[name] if below in components
                ),
            }
            for name in components
        ],
    }
    return json.dumps(document, indent=1, ensure_ascii=False).encode() + b"\n"


@cache
def sbom_sha256() -> str:
    """Return the hash of `sbom`."""
    return hashlib.sha256(sbom()).hexdigest()


@cache
def distributions() -> Mapping[str, metadata.PackageMetadata]:
    """Return what every installed distribution that the command needs says of itself, by name."""
    return {name: _about(name) for name in sorted(_needs())}


@cache
def _about(name: str) -> metadata.PackageMetadata:
    """Return what a distribution says of itself, read once: each of its properties reads it all."""
    return metadata.distribution(name).metadata


@cache
def _needs() -> Mapping[str, Set[str]]:
    """Return what each installed distribution requires here, by name."""
    needs: dict[str, set[str]] = {}
    wanted, seen = [(ROOT, "")], set()
    while wanted:
        name, extra = asked = wanted.pop()
        if asked in seen:
            continue
        seen.add(asked)
        try:
            lines = _about(name).get_all("Requires-Dist") or ()
        except metadata.PackageNotFoundError:
            continue  # left out at the installation
        below = [found for line in lines for found in _required(Requirement(line), extra)]
        needs.setdefault(name, set()).update(other for other, _ in below)
        wanted += below
    return needs


def _required(requirement: Requirement, extra: str) -> Iterator[tuple[str, str]]:
    """Yield what a line of requirements names here, alone and with each extra that it asks for."""
    if requirement.marker is None or requirement.marker.evaluate({"extra": extra}):
        name = canonicalize_name(requirement.name)
        yield from ((name, wanted) for wanted in ("", *sorted(requirement.extras)))


def _component(about: metadata.PackageMetadata) -> dict[str, Any]:
    name, version = canonicalize_name(about["Name"]), about["Version"]
    purl = f"pkg:pypi/{name}@{version}"
    library = {"type": "library", "bom-ref": purl, "name": name, "version": version, "purl": purl}
    return library | _license(about)


def _license(about: metadata.PackageMetadata) -> dict[str, Any]:
    """Return the license as the distribution states it: an SPDX expression, or a name."""
    if "License-Expression" in about:
        return {"licenses": [{"expression": about["License-Expression"]}]}
    names = [
        line.rpartition(" :: ")[2]
        for line in about.get_all("Classifier") or ()
        if line.startswith("License :: ")
    ]
    if not names and "License" in about:
        names = about["License"].splitlines()[:1]
    return {"licenses": [{"license": {"name": name}} for name in names]} if names else {}


@cache
def environment() -> Mapping[str, str]:
    """Return the versions of all that may change a byte of a package, by name."""
    return {
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "system": f"{platform.system()} {platform.machine()} {' '.join(platform.libc_ver())}",
        "zlib": zlib.ZLIB_RUNTIME_VERSION,
        **{name: _native(*known) for name, known in _NATIVE.items()},
        **{name: about["Version"] for name, about in distributions().items()},
    }


def _native(files: tuple[str, ...], asked: str) -> str:
    for file in files:
        try:
            returned = getattr(ctypes.CDLL(file), asked)
        except (OSError, AttributeError):
            continue
        returned.restype = ctypes.c_char_p
        return str(returned().decode())
    return "unknown"
