"""Signs a package in the field over its seal box: PAdES baseline B-B, or B-T with a time stamp.

Needs the optional extra `sign`. Appends to the file, so that `report.proof.updates` still finds
what was signed. Read `signed`.
"""

from __future__ import annotations

import io
from typing import Any

from report.typeset.finish import FIELD
from report.typeset.pdf import TEMPLATES
from solver.model import InputError

_LETTERS_PT = 9
_EXTRA = "signing needs the extra 'sign'; ./roofslip sign installs it"


def signed(data: bytes, p12: bytes, password: str, time_url: str = "") -> bytes:
    """Return a package with a signature appended.

    Parameters
    ----------
    data : bytes
    p12 : bytes
        PKCS#12: private key, certificate, and those of its issuers.
    password : str
        Of the PKCS#12 file.
    time_url : str
        Of a time-stamp authority (RFC 3161); without it nothing is sent anywhere.

    Raises
    ------
    InputError
        If the file has no empty field, the password is wrong, or no time stamp comes.
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
        raise InputError("the certificate cannot be opened: not PKCS#12, or another password")
    about = signers.PdfSignatureMetadata(
        field_name=FIELD, subfilter=fields.SigSeedSubFilter.PADES, md_algorithm="sha256"
    )
    clock = timestamps.HTTPTimeStamper(time_url) if time_url else None
    out = io.BytesIO()
    try:
        signers.PdfSigner(about, signer, timestamper=clock, stamp_style=_look()).sign_pdf(
            IncrementalPdfFileWriter(io.BytesIO(data)), existing_fields_only=True, output=out
        )
    except (SigningError, PdfReadError) as error:
        text = "cannot be signed: its field is missing or is signed already, or it is damaged"
        raise InputError(text) from error
    except timestamps.TimestampRequestError as error:
        raise InputError(f"{time_url}: gave no time stamp") from error
    return out.getvalue()


def _look() -> Any:
    """Return how the signature looks in the seal box: name and time, in the font of the package."""
    from pyhanko.pdf_utils.font.api import FontEngineFactory
    from pyhanko.pdf_utils.font.opentype import GlyphAccumulator
    from pyhanko.pdf_utils.text import TextBoxStyle
    from pyhanko.stamp import TextStampStyle

    content = (TEMPLATES / "fonts" / "SourceSans3-Regular.ttf").read_bytes()

    class Font(FontEngineFactory):
        """The font of the package; that of pyHanko leaves its file open."""

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
