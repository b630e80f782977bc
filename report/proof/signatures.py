"""Data appended to a package: pyHanko's result on its signatures, and anything else.

Needs the optional extra `sign`: pyHanko is imported where it is used, as packages are verified
without it too. Not whether a certificate is trusted: a PDF reader knows whom its
user trusts. Read `appended`.

Signs a package in the field over its seal box: PAdES baseline B-B, or B-T with a time stamp.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass
from typing import Any

from pypdf import PdfReader
from pypdf.generic import ArrayObject, DictionaryObject, PdfObject, StreamObject

from report.proof.pdf_contents import guarded
from report.typeset.finish import FIELD
from report.typeset.pdf import TEMPLATES
from solver.errors import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class Signature:
    """A signature: its field, and the name in its certificate."""

    field: str
    signer: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Appended:
    """Data appended to a package."""

    signed: Sequence[Signature] = ()
    problems: Sequence[str] = ()  # where it is more than signatures that fit
    is_checked: bool = True  # whether pyHanko is installed


def appended(data: bytes, made: bytes = b"") -> Appended:
    """Return the data appended to a package.

    `made` is what it was appended to; without it only signatures are judged.

    Raises `InputError` if the file is damaged.
    """
    try:
        import pyhanko.sign.validation  # noqa: F401
    except ImportError:
        # Without the extra, all else is still compared, and the answer says what was not checked.
        return Appended(is_checked=False)
    for name in ("pyhanko", "pyhanko_certvalidator"):
        # They would print that nobody is trusted.
        logging.getLogger(name).addHandler(logging.NullHandler())
    return guarded(lambda: _judged(data, made))


def _judged(data: bytes, made: bytes) -> Appended:
    from pyhanko.pdf_utils.reader import PdfFileReader
    from pyhanko.sign.validation.status import SignatureCoverageLevel as Level

    file = PdfFileReader(io.BytesIO(data))
    # One that is unclear, so that a file without signatures has a largest level, too.
    signed, levels = [], [Level.UNCLEAR]
    # pyHanko's own comparison of revisions takes minutes for thousands of tags in one object
    # stream: only changed objects are looked at.
    problems = list(_others(data, made)) if made else []
    for signature in file.embedded_signatures:
        status = _validated(signature)
        stamp = getattr(status, "timestamp_validity", None)
        # Intact: the digest is that of the bytes; valid: the certificate's key signed that digest.
        if not all(part.intact and part.valid for part in (status, stamp) if part):
            problems.append(
                f"signature '{signature.field_name}': does not match the bytes that it covers"
            )
        levels.append(signature.evaluate_signature_coverage())
        signer = status.signing_cert.subject.native.get("common_name", "")
        signed.append(Signature(field=signature.field_name, signer=str(signer)))
    # The last signature must cover all; those before it, all up to their own revision.
    if max(levels) != Level.ENTIRE_FILE or min(levels[1:]) < Level.ENTIRE_REVISION:
        problems.append("appended: bytes that no signature covers")
    return Appended(signed=tuple(signed), problems=tuple(problems))


def _validated(signature: Any) -> Any:
    from pyhanko.sign.validation import validate_pdf_signature, validate_pdf_timestamp
    from pyhanko_certvalidator import ValidationContext

    # Whom to trust is for the reader of the file: here only what was signed is looked at.
    offline = ValidationContext(trust_roots=[], allow_fetching=False)
    is_stamp = signature.sig_object.get("/Type") == "/DocTimeStamp"
    validate: Any = validate_pdf_timestamp if is_stamp else validate_pdf_signature
    return validate(signature, offline, skip_diff=True)


# What signing may change in a field; and in the catalog, the form, a sheet and the information.
_SIGNED = {"/V", "/AP", "/F", "/Lock"}
_CHANGING = {"/AcroForm", "/Metadata", "/Extensions", "/DSS", "/SigFlags", "/Fields", "/Annots"}
_CHANGING |= {"/ModDate", "/Producer"}


def _others(data: bytes, made: bytes) -> Iterator[str]:
    """Yield changes in a package other than those of signing."""
    original, signed = (PdfReader(io.BytesIO(file), strict=True) for file in (made, data))
    before, after = _places(original), _places(signed)
    for number in sorted(before):
        # Objects whose place in the file is the same have the same bytes: what was made is its
        # beginning.
        if before[number] != after.get(number) and not _is_signing(
            original.get_object(number), signed.get_object(number)
        ):
            yield f"appended: another object {number}, which no signature changes"
    # A new trailer may name another catalog beside the untouched one.
    trailers = [_without(pdf.trailer, {"/Size", "/Prev", "/ID"}) for pdf in (original, signed)]
    if any(trailers[0][key] != trailers[1].get(key) for key in ("/Root", "/Info")):
        yield "appended: another document"
    # Title and author are in the XMP stream, which signing may rewrite.
    if _stated(original) != _stated(signed):
        yield "appended: another title, author or subject"


def _places(pdf: PdfReader) -> dict[int, object]:
    places: dict[int, object] = {}
    for table in pdf.xref.values():
        places |= table
    return places | pdf.xref_objStm


def _stated(pdf: PdfReader) -> object:
    about = pdf.xmp_metadata
    return about and (about.dc_title, about.dc_creator, about.dc_description, about.dc_subject)


def _is_signing(before: Any, after: Any) -> bool:
    """Whether an object was changed as signing changes it; what it shows is refused elsewhere."""
    if isinstance(before, StreamObject):
        # Of streams only XMP: another content of a sheet is another sheet.
        return bool(before.get("/Type") == "/Metadata" == after.get("/Type"))
    # A signature adds fields and annotations; one that is gone or replaced is no signing.
    if isinstance(before, ArrayObject):  # fields or annotations
        return isinstance(after, ArrayObject) and _written(after).startswith(
            _written(before)[:-1].rstrip()
        )
    if not isinstance(before, DictionaryObject) or not isinstance(after, DictionaryObject):
        return False
    if "/Annots" in before and not _is_signing(before["/Annots"], after.get("/Annots")):
        return False
    # Of the field itself the value and look; elsewhere where fields are listed, and dates.
    changing = _SIGNED if before.get("/FT") == "/Sig" else _CHANGING
    return _without(before, changing) == _without(after, changing)


def _without(item: DictionaryObject, keys: Set[str]) -> dict[str, bytes]:
    return {key: _written(item.raw_get(key)) for key in item.keys() - keys}


def _written(item: PdfObject) -> bytes:
    out = io.BytesIO()
    item.write_to_stream(out)
    return out.getvalue()


_LETTERS_PT = 9
_EXTRA = "signing needs the extra 'sign'; ./roofslip sign installs it"


def signed(data: bytes, p12: bytes, password: str, time_url: str = "") -> bytes:
    """Return a package with a signature appended.

    `p12` is a PKCS#12 file: private key, certificate, and those of its issuers. Without `time_url`,
    a time-stamp authority (RFC 3161), nothing is sent anywhere.

    Raises `InputError` if the file has no empty field, the password is wrong, or no time stamp
    comes.
    """
    try:
        from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter
        from pyhanko.pdf_utils.misc import PdfReadError
        from pyhanko.sign import fields, signers, timestamps
        from pyhanko.sign.general import SigningError
    except ImportError as error:
        raise InputError(_EXTRA) from error
    try:
        signer = signers.SimpleSigner.load_pkcs12_data(p12, [], password.encode())
    except ValueError:
        signer = None
    if signer is None:
        raise InputError("cannot open the certificate: not a PKCS#12 file, or wrong password")
    about = signers.PdfSignatureMetadata(
        field_name=FIELD, subfilter=fields.SigSeedSubFilter.PADES, md_algorithm="sha256"
    )
    clock = timestamps.HTTPTimeStamper(time_url) if time_url else None
    out = io.BytesIO()
    try:
        # Appended: the package before it stays as it was, and can be compared to the byte.
        signers.PdfSigner(about, signer, timestamper=clock, stamp_style=_look()).sign_pdf(
            IncrementalPdfFileWriter(io.BytesIO(data)), existing_fields_only=True, output=out
        )
    except (SigningError, PdfReadError) as error:
        text = (
            "cannot be signed: its signature field is missing or already signed, or the file"
            " is damaged"
        )
        raise InputError(text) from error
    except timestamps.TimestampRequestError as error:
        raise InputError(f"{time_url}: no time stamp received") from error
    return out.getvalue()


def _look() -> Any:
    """Return the look of the signature in the seal box: name and time, in the package font."""
    from pyhanko.pdf_utils.font.api import FontEngineFactory
    from pyhanko.pdf_utils.font.opentype import GlyphAccumulator
    from pyhanko.pdf_utils.text import TextBoxStyle
    from pyhanko.stamp import TextStampStyle

    # Embedded as in the package: a font of the machine may lack letters of the name.
    content = (TEMPLATES / "fonts" / "SourceSans3-Regular.ttf").read_bytes()

    class Font(FontEngineFactory):
        """The font of the package."""

        # That of pyHanko leaves its file open.

        def create_font_engine(self, writer: Any, obj_stream: Any = None) -> GlyphAccumulator:
            """Return the font for one PDF."""
            return GlyphAccumulator(
                writer, io.BytesIO(content), font_size=_LETTERS_PT, obj_stream=obj_stream
            )

    return TextStampStyle(
        stamp_text="Signed by %(signer)s\n%(ts)s",
        border_width=0,
        background=None,
        text_box_style=TextBoxStyle(font=Font(), font_size=_LETTERS_PT),
    )
