"""What pyHanko says of the signatures of a package and of what was appended with them.

Needs the optional extra `sign`. Not whether a certificate is trusted: a PDF reader knows whom its
user trusts. Read `appended`.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from report.proof.package import guarded


@dataclass(frozen=True, slots=True, kw_only=True)
class Signature:
    """A signature: its field, and the name in its certificate."""

    field: str
    signer: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Appended:
    """What was appended to a package.

    Attributes
    ----------
    signed : sequence of Signature
    problems : sequence of str
        Where it is more than signatures that fit.
    is_checked : bool
        Whether pyHanko is installed.
    """

    signed: Sequence[Signature] = ()
    problems: Sequence[str] = ()
    is_checked: bool = True


def appended(data: bytes, made: bytes = b"") -> Appended:
    """Return what was appended to a package.

    Parameters
    ----------
    made : bytes
        What it was appended to, where that is known; else the first revision of the file.

    Raises
    ------
    InputError
        If the file is damaged.
    """
    try:
        import pyhanko.sign.validation  # noqa: F401
    except ImportError:
        return Appended(is_checked=False)
    for name in ("pyhanko", "pyhanko_certvalidator"):
        # They would print that nobody is trusted.
        logging.getLogger(name).addHandler(logging.NullHandler())
    return guarded(lambda: _judged(data, made))


def _judged(data: bytes, made: bytes) -> Appended:
    from pyhanko.pdf_utils.reader import PdfFileReader
    from pyhanko.sign.validation.status import SignatureCoverageLevel as Level

    file = PdfFileReader(io.BytesIO(data))
    problems, signed, levels = list(_others(file, made)), [], [Level.UNCLEAR]
    for one in file.embedded_signatures:
        status = _validated(one)
        stamp = getattr(status, "timestamp_validity", None)
        if not all(each.intact and each.valid for each in (status, stamp) if each):
            problems.append(f"signature '{one.field_name}': does not fit the bytes that it covers")
        levels.append(one.evaluate_signature_coverage())
        signer = status.signing_cert.subject.native.get("common_name", "")
        signed.append(Signature(field=one.field_name, signer=str(signer)))
    if max(levels) != Level.ENTIRE_FILE or min(levels[1:]) < Level.ENTIRE_REVISION:
        problems.append("appended: bytes that no signature covers")
    return Appended(signed=tuple(signed), problems=tuple(problems))


def _validated(signature: Any) -> Any:
    from pyhanko.sign.validation import validate_pdf_signature, validate_pdf_timestamp
    from pyhanko_certvalidator import ValidationContext

    offline = ValidationContext(trust_roots=[], allow_fetching=False)
    is_stamp = signature.sig_object.get("/Type") == "/DocTimeStamp"
    validate: Any = validate_pdf_timestamp if is_stamp else validate_pdf_signature
    return validate(signature, offline, skip_diff=True)


def _others(file: Any, made: bytes) -> Iterator[str]:
    """Yield what was appended beside signatures, by pyHanko's rules for a certified form."""
    from pyhanko.pdf_utils.reader import PdfFileReader
    from pyhanko.sign.diff_analysis import DEFAULT_DIFF_POLICY, SuspiciousModification
    from pyhanko.sign.fields import MDPPerm

    first = PdfFileReader(io.BytesIO(made)) if made else file
    starts = [one.xrefs.get_startxref_for_revision(0) for one in (file, first)]
    if starts[0] != starts[1]:
        yield "appended: a package of its own"
    found = DEFAULT_DIFF_POLICY.review_file(file, 0, doc_mdp=MDPPerm.FILL_FORMS)
    if isinstance(found, SuspiciousModification):
        yield f"appended: more than signatures: {found}"
    last = file.get_historical_resolver(file.xrefs.total_revisions - 1)
    information = [_stated(one) for one in (file.get_historical_resolver(0), last)]
    if information[0] != information[1] or _stated(first) != _stated(file):
        yield "appended: another title, author or subject"


def _stated(file: Any) -> tuple[Any, ...]:
    about = file.document_meta_view
    return (about.title, about.author, about.subject, about.keywords, about.creator)
