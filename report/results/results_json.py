"""results.json with units in its keys: written, and read as that of a previous revision.

Computes no result, and trusts nothing in the file of a previous revision. Read `results_json`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import from_json

from report.assessment.assessment import Assessment
from report.assessment.support.evidence import Evidence
from report.results.results_model import SCHEMA_VERSION, Compared
from report.results.rows import results
from report.text.json_numbers import finite
from report.text.typed_letters import UNPRINTABLE, cut
from report.typeset.letters import named, undrawable
from solver.errors import InputError
from solver.file_checks import read_file
from solver.suggestions import meant


def results_json(assessment: Assessment, evidence: Evidence) -> bytes:
    """Return everything as JSON in SI, with units in the keys and null for no value."""
    document = results(assessment, evidence).model_dump(mode="python")
    # As it is read from a workbook: `--since` compares it field by field.
    document["input"] = assessment.project.model_dump(mode="json")
    return json.dumps(finite(document), indent=1, ensure_ascii=False).encode() + b"\n"


# Version 0.3 wrote 2, without `checks`.
READ_VERSIONS = (2, SCHEMA_VERSION)

GIVE = "use the results.json of a previous revision"
AGAIN = "recreate it with this version of `report`, from the workbook of that revision"

# Largest file that is read [B], and most objects of one that is compared.
MOST_BYTES, MOST_OBJECTS = 25_000_000, 100_000


def read_former(path: Path) -> tuple[Compared, bytes]:
    """Read results.json of a previous revision; return it as data, and the file.

    Raises `InputError` if it cannot be read, is damaged or incomplete, or has another schema
    version.
    """
    if not path.exists():
        raise InputError(f"{path}: no such file; {meant(path) or GIVE}")
    content = read_file(path, MOST_BYTES, str(path), too_large=GIVE)
    return former_from(content, path), content


def former_from(content: bytes, path: Path) -> Compared:
    """Return the content of results.json as data.

    Raises `InputError`.
    """
    # Before they are parsed: millions of empty rows take gigabytes.
    if (count := content.count(b"{")) > MOST_OBJECTS:
        raise InputError(
            f"{path}: has {count:,} objects; at most {MOST_OBJECTS:,} are compared; {GIVE}"
        )
    try:
        # It counts how deep it goes; the parser of the standard library ends in a traceback.
        document = from_json(content, allow_inf_nan=False)
    except ValueError as error:
        raise InputError(f"{path}: not a results.json file, or damaged; {AGAIN}") from error
    if not isinstance(document, dict):
        raise InputError(f"{path}: not a results.json file, or damaged (not an object); {AGAIN}")
    version = document.get("schema_version")
    # True equals 1, and 2.0 equals 2: only a whole number is a version.
    if type(version) is not int or version not in READ_VERSIONS:
        stated = f"{version!r:.40}" if version is not None else "missing"
        known = " and ".join(map(str, READ_VERSIONS))
        raise InputError(f"{path}: schema_version is {stated}; this version reads {known}; {AGAIN}")
    try:
        # Strict: "1.0" is no number, and true is none either.
        earlier = Compared.model_validate_json(content, strict=True)
    except ValidationError as error:
        raise InputError(f"{path}: {_first(error)}; the file is damaged: {AGAIN}") from error
    # Every text of it may be printed in the list of changes.
    for text in _texts(earlier.model_dump(mode="json")):
        if letter := UNPRINTABLE.search(text):
            raise InputError(
                f"{path}: '{cut(text)}' has the character U+{ord(letter[0]):04X}, which cannot be"
                f" printed; the file is damaged: {AGAIN}"
            )
        # Laid out, it would be a box, and the log of the renderer an error.
        if missing := undrawable(text):
            raise InputError(
                f"{path}: no font of this machine has {named(missing)} of '{cut(text)}'; install"
                " one that does"
            )
    return earlier


def _texts(value: Any) -> Iterator[str]:
    """Yield all texts of a document, keys included."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from (key, *_texts(item))
    elif isinstance(value, list):
        for item in value:
            yield from _texts(item)


def _first(error: ValidationError) -> str:
    """Return the first problem with its place in the file."""
    first = error.errors(include_url=False, include_input=False, include_context=False)[0]
    place = ".".join(str(step) for step in first["loc"])
    further = f", and {error.error_count() - 1} more" if error.error_count() > 1 else ""
    return f"{place or 'the whole'} is not in the form that `report` writes{further}"
