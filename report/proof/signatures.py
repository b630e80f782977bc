"""Whether a signature fits the bytes that it covers. Needs the optional extra `sign`.

Not whether a certificate is trusted: a PDF reader knows whom its user trusts. Read `checked`.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from report.proof.package import guarded
from solver.model import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class Signature:
    """A signature.

    Attributes
    ----------
    field : str
        Name of its field.
    signer : str
        As the certificate states it; empty if nothing was checked.
    problem : str
        Why it does not fit; empty if it does, or if nothing was checked.
    """

    field: str
    signer: str = ""
    is_checked: bool = True
    problem: str = ""


def checked(data: bytes, fields: Sequence[str]) -> Iterator[Signature]:
    """Yield the signatures of a PDF in some fields."""
    try:
        import pyhanko.sign.validation  # noqa: F401
    except ImportError:
        yield from (Signature(field=field, is_checked=False) for field in fields)
        return
    for field in fields:
        try:
            yield guarded(partial(_validated, data, field))
        except InputError as error:
            yield Signature(field=field, problem=str(error))


def _validated(data: bytes, field: str) -> Signature:
    from pyhanko.pdf_utils.reader import PdfFileReader
    from pyhanko.sign.validation import validate_pdf_signature, validate_pdf_timestamp
    from pyhanko_certvalidator import ValidationContext

    for name in ("pyhanko", "pyhanko_certvalidator"):
        # They would print that nobody is trusted.
        logging.getLogger(name).addHandler(logging.NullHandler())
    file = PdfFileReader(io.BytesIO(data))
    (found,) = (one for one in file.embedded_signatures if one.field_name == field)
    offline = ValidationContext(trust_roots=[], allow_fetching=False)
    is_stamp = found.sig_object.get("/Type") == "/DocTimeStamp"
    validate: Any = validate_pdf_timestamp if is_stamp else validate_pdf_signature
    status = validate(found, offline, skip_diff=True)
    stamp = getattr(status, "timestamp_validity", None)
    is_fitting = all(one.intact and one.valid for one in (status, stamp) if one)
    return Signature(
        field=field,
        signer=str(status.signing_cert.subject.native.get("common_name", "")),
        problem="" if is_fitting else "does not fit the bytes that it covers",
    )
