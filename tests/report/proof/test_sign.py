"""Signing with certificates of certomancer and a time-stamp server of its own; no network."""

import datetime as dt
import io
import json
import re
import sys
import threading
import warnings
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, HTTPServer

import pikepdf
import pytest
import yaml
from asn1crypto import tsp
from certomancer.registry import ArchLabel, CertLabel, CertomancerConfig, ServiceLabel
from cryptography.hazmat.primitives.asymmetric import rsa
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat
from pyhanko.keys import load_certs_from_pemder_data
from pyhanko.pdf_utils import generic
from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter
from pyhanko.pdf_utils.reader import PdfFileReader
from pyhanko.sign.validation import validate_pdf_signature
from pyhanko_certvalidator import ValidationContext
from pypdf import PdfReader

from fixtures import commands, tampering
from fixtures.marks import by_day
from report.cli.one_package import warn_of_other_packages
from report.proof.opened_package import opened
from report.proof.package_comparison import compared
from report.proof.pdf_contents import refused
from report.proof.signatures import Appended, Signature, appended
from report.typeset.finish import FIELD
from solver.errors import InputError

PASSWORD = "pass word"
CONFIG = """
external-url-prefix: "http://localhost"
keysets:
  keys: {keys: {root: {path: root.pem}, engineer: {path: engineer.pem}, clock: {path: clock.pem}}}
pki-architectures:
  test:
    keyset: keys
    entities:
      root: {common-name: Root}
      engineer: {common-name: "Jane Doe, S.E."}
      clock: {common-name: Clock}
    certs:
      root: &issued
        subject: root
        issuer: root
        validity: {valid-from: "2020-01-01T00:00:00+0000", valid-to: "2100-01-01T00:00:00+0000"}
        extensions:
          - {id: basic_constraints, critical: true, value: {ca: true}}
          - {id: key_usage, critical: true,
             smart-value: {schema: key-usage, params: [key_cert_sign, crl_sign]}}
      engineer:
        <<: *issued
        subject: engineer
        extensions:
          - {id: key_usage, critical: true,
             smart-value: {schema: key-usage, params: [digital_signature, non_repudiation]}}
      clock:
        <<: *issued
        subject: clock
        extensions:
          - {id: key_usage, critical: true,
             smart-value: {schema: key-usage, params: [digital_signature]}}
          - {id: extended_key_usage, critical: true, value: [time_stamping]}
    services:
      time-stamping:
        clock: {signing-cert: clock}
"""


@pytest.fixture(scope="module")
def authority(tmp_path_factory):
    """Certificates for an engineer and a clock, with keys made now."""
    folder = tmp_path_factory.mktemp("keys")
    form = (Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    for name in ("root", "engineer", "clock"):
        key = rsa.generate_private_key(public_exponent=65537, key_size=2048)
        (folder / f"{name}.pem").write_bytes(key.private_bytes(*form))
    config = CertomancerConfig(yaml.safe_load(CONFIG), key_search_dir=str(folder))
    return config.get_pki_arch(ArchLabel("test"))


@pytest.fixture(scope="module")
def p12(authority, tmp_path_factory):
    path = tmp_path_factory.mktemp("p12") / "engineer.p12"
    path.write_bytes(authority.package_pkcs12(CertLabel("engineer"), password=PASSWORD.encode()))
    return path


@pytest.fixture(scope="module")
def clock(authority):
    """The address of a time-stamp server on this machine."""

    class Stamps(BaseHTTPRequestHandler):
        def do_POST(self):
            asked = self.rfile.read(int(self.headers["Content-Length"]))
            stamper = authority.service_registry.summon_timestamper(
                ServiceLabel("clock"), dt.datetime.now(dt.UTC)
            )
            answer = stamper.request_tsa_response(tsp.TimeStampReq.load(asked)).dump()
            self.send_response(200)
            self.send_header("Content-Type", "application/timestamp-reply")
            self.send_header("Content-Length", str(len(answer)))
            self.end_headers()
            self.wfile.write(answer)

        def log_message(self, *_):
            pass

    with HTTPServer(("127.0.0.1", 0), Stamps) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
        thread.join()


@pytest.mark.quick
def test_without_the_library_a_signature_is_not_checked(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyhanko.sign.validation", None)
    assert appended(b"") == Appended(is_checked=False)


@pytest.fixture(scope="module")
def sign(data, p12, tmp_path_factory):
    """A function that signs with the command; returns the outcome and the signed bytes."""

    def run(*options, content=data, password=PASSWORD):
        path = tmp_path_factory.mktemp("signed") / "calc-package.pdf"
        path.write_bytes(content)
        done = commands.run("sign", path, "--p12", p12, "--password", password, *options)
        made = path.with_name("calc-package-signed.pdf")
        return done, made.read_bytes() if made.exists() else b""

    return run


@pytest.fixture(scope="module")
def signed(sign):
    return sign()


@pytest.fixture(scope="module")
def found(data):
    """A function that returns what was appended to the package."""
    return lambda whole: appended(whole, data)


def checked(content, authority):
    """Return what pyHanko says about the one signature of a file."""
    (signature,) = PdfFileReader(io.BytesIO(content)).embedded_signatures
    root = authority.get_cert(CertLabel("root"))
    (trusted,) = load_certs_from_pemder_data(root.dump())
    context = ValidationContext(trust_roots=[trusted], allow_fetching=False)
    return signature, validate_pdf_signature(signature, context, context)


@pytest.mark.nightly
def test_a_signature_is_pades_b_b_and_what_is_appended_is_found(signed, authority, data, found):
    done, content = signed
    assert done.exit_code == 0, done.output
    assert content.startswith(data)
    signature, status = checked(content, authority)
    assert signature.field_name == FIELD
    assert signature.sig_object["/SubFilter"] == "/ETSI.CAdES.detached"
    assert status.bottom_line
    assert status.timestamp_validity is None
    expected = Signature(field=FIELD, signer="Jane Doe, S.E.")
    assert found(content) == Appended(signed=(expected,), problems=())
    for more in (b"\n", b"% more\n", b"1 0 obj\n<<>>\nendobj\n"):
        assert "appended: bytes that no signature covers" in found(content + more).problems


@pytest.mark.nightly
def test_a_time_stamp_makes_it_b_t(sign, authority, clock, found):
    done, content = sign("--time-stamp", clock)
    assert done.exit_code == 0, done.output
    _, status = checked(content, authority)
    assert status.bottom_line
    assert status.timestamp_validity.valid
    assert found(content).problems == ()


@pytest.fixture
def updated(data):
    """A function that appends to the package what a change with pyHanko's writer gives."""

    def update(change):
        writer, out = IncrementalPdfFileWriter(io.BytesIO(data)), io.BytesIO()
        change(writer)
        writer.write(out)
        return out.getvalue()

    return update


@pytest.mark.nightly
def test_an_update_that_changes_a_sheet_is_found_though_it_is_signed(sign, updated, found):
    def change(writer):
        contents = writer.root["/Pages"]["/Kids"][3].raw_get("/Contents")
        stream = contents.get_object()
        stream._data = stream.data.replace(b"BT", b"BT 2 0 0 2 0 0 Tm", 1)
        stream._encoded_data = None
        writer.mark_update(contents)

    given = updated(change)
    with pikepdf.open(io.BytesIO(given)) as pdf:
        assert b"2 0 0 2 0 0 Tm" in pdf.pages[3].Contents.read_bytes()
    done, content = sign(content=given)
    assert done.exit_code == 0, done.output
    later = found(content)
    assert [one.field for one in later.signed] == [FIELD]
    (told,) = later.problems
    assert re.fullmatch(r"appended: another object \d+, which no signature changes", told)


def test_a_package_behind_another_one_is_found_though_it_is_signed(sign, data, found):
    """Its cross-references name none before them, so that readers see the second one alone."""
    done, content = sign(content=tampering.rewritten(data, tampering.painted_over))
    assert done.exit_code == 0, done.output
    assert appended(content).problems == ()
    moved = re.sub(
        rb"startxref\s+(\d+)", lambda at: b"startxref\n%d" % (int(at[1]) + len(data)), content
    )
    with suppress(InputError):  # offsets within it are those of the file
        assert found(data + moved).problems


def test_a_signature_that_does_not_fit_is_a_difference(signed, found):
    _, content = signed
    start = content.rindex(b"/Contents <") + len(b"/Contents <")
    # The last byte of what was signed with the key; behind it are zeros.
    end = start + len(content[start : content.index(b">", start)].rstrip(b"0"))
    digit = b"1" if content[end - 3 : end - 2] != b"1" else b"2"
    later = found(content[: end - 3] + digit + content[end - 2 :])
    assert [one.field for one in later.signed] == [FIELD]
    assert any(text.startswith(f"signature '{FIELD}': ") for text in later.problems)


@pytest.mark.parametrize("entry", by_day(["/AA", "/A", "/Lock"], 1))
def test_a_hidden_field_with_an_action_is_refused_though_it_is_signed(sign, updated, entry):
    name, text = generic.NameObject, generic.pdf_string
    script = {name("/S"): name("/JavaScript"), name("/JS"): text("app.alert(1)")}
    field = new_field(generic, (0, 0, 0, 0))
    field[name(entry)] = generic.DictionaryObject(script)
    _, content = sign(content=updated(lambda writer: add_field(writer, field)))
    assert next(refused(PdfReader(io.BytesIO(content))))


def new_field(generic, rectangle):
    name = generic.NameObject
    return generic.DictionaryObject({
        name("/Type"): name("/Annot"), name("/Subtype"): name("/Widget"), name("/FT"): name("/Sig"),
        name("/T"): generic.pdf_string("other"), name("/F"): generic.NumberObject(132),
        name("/Rect"): generic.ArrayObject(map(generic.NumberObject, rectangle)),
    })  # fmt: skip


def add_field(writer, field):
    page = writer.root["/Pages"]["/Kids"][0]
    reference = writer.add_object(field)
    page["/Annots"].append(reference)
    writer.root["/AcroForm"]["/Fields"].append(reference)
    writer.update_container(page)
    writer.update_root()


@pytest.mark.nightly
def test_a_field_over_a_sheet_is_found_though_it_is_signed_and_an_empty_one_is_not(
    sign, updated, found
):
    hidden, painted, twin = (new_field(generic, (0, 0, size, size)) for size in (0, 600, 600))
    twin[generic.NameObject("/T")] = generic.pdf_string(FIELD)
    twin[generic.NameObject("/V")] = generic.DictionaryObject()
    _, content = sign(content=updated(lambda writer: add_field(writer, hidden)))
    assert found(content).problems == ()
    for field in (painted, twin):
        content = updated(lambda writer, field=field: add_field(writer, field))
        if field is painted:
            _, content = sign(content=content)
        assert next(refused(PdfReader(io.BytesIO(content)))).startswith("sheet 1: an annotation")


def without_annotations(writer):
    page = writer.root["/Pages"]["/Kids"][0]
    page["/Annots"] = generic.ArrayObject()
    writer.update_container(page)


def with_another_title(writer):
    info = writer.trailer["/Info"]
    info["/Title"] = generic.pdf_string("Approved")
    writer.set_info(info)


@pytest.mark.parametrize(
    ("change", "said"),
    [(without_annotations, "another object"), (with_another_title, "appended: ")],
    ids=["the field of the signature taken out", "another title"],
)
@pytest.mark.nightly
def test_what_came_with_a_signature_is_found(sign, updated, found, change, said):
    _, content = sign(content=updated(change))
    assert any(said in text for text in found(content).problems)


@pytest.fixture
def made(job, monkeypatch):
    """Has the command take the package that is there for the one made again."""
    data = (job / "out" / "calc-package.pdf").read_bytes()
    monkeypatch.setattr("report.cli.package_proof.made_again", lambda *_: data)
    return data


@pytest.mark.nightly
def test_a_signature_that_cannot_be_checked_is_said_not_to_be(made, sign, tmp_path, monkeypatch):
    path = tmp_path / "calc-package-signed.pdf"
    path.write_bytes(sign(content=made)[1])
    monkeypatch.setitem(sys.modules, "pyhanko.sign.validation", None)
    told = commands.output_of("verify-package", path, exit_code=4)
    assert "Same" not in told
    assert "were not checked" in told
    assert "./roofslip sign installs" in told
    assert list(tmp_path.iterdir()) == [path]
    monkeypatch.undo()
    monkeypatch.setattr("report.cli.package_proof.made_again", lambda *_: made)
    said = commands.as_json("verify-package", path)
    assert said["answer"] == "same"
    assert said["signed"] == [{"field": FIELD, "signer": "Jane Doe, S.E."}]


@pytest.mark.nightly
def test_a_smaller_sheet_differs_also_where_no_signature_can_be_checked(
    data, sign, updated, monkeypatch
):
    def change(writer):
        sheet = writer.root["/Pages"]["/Kids"][3]
        for frame in ("/MediaBox", "/TrimBox", "/BleedBox"):
            sheet[frame] = generic.ArrayObject(map(generic.NumberObject, (0, 0, 612, 396)))
        writer.update_container(sheet)

    content = sign(content=updated(change))[1]
    monkeypatch.setitem(sys.modules, "pyhanko.sign.validation", None)
    found = compared(opened(content), opened(data))
    assert found.answer == "differs"
    assert found.reasons[0].startswith("size of sheet 4")


@pytest.mark.nightly
def test_what_was_painted_over_before_it_was_signed_is_never_the_same(made, sign, tmp_path):
    path = tmp_path / "calc-package-signed.pdf"
    painted = tampering.rewritten(made, tampering.painted_over)
    path.write_bytes(sign(content=painted)[1])
    told = commands.output_of("verify-package", path, exit_code=4)
    assert "drawings not compared: read the regenerated package" in told
    assert "by 'Jane Doe, S.E.'" in told
    assert (tmp_path / "calc-package-signed-again.pdf").read_bytes() == made


def test_what_cannot_be_signed_is_an_input_error_and_a_rewritten_file_can(sign, signed, data):
    done, content = sign(password="other")
    assert (done.exit_code, content) == (2, b"")
    assert "wrong password" in done.output
    done, content = sign("--time-stamp", "http://127.0.0.1:9")
    assert (done.exit_code, content) == (2, b""), done.output
    done, _ = sign(content=signed[1])
    assert done.exit_code == 2
    assert "cannot be signed" in done.output
    again = tampering.rewritten(data, lambda pdf: None)
    done, content = sign(content=again)
    assert done.exit_code == 0
    assert content.startswith(again)


@pytest.mark.parametrize("missing", ["calc-package.pdf", "yours.p12"])
def test_a_file_that_is_not_there_is_told_before_a_password_is_asked_for(missing, tmp_path):
    for name in {"calc-package.pdf", "yours.p12"} - {missing}:
        (tmp_path / name).write_bytes(b"")
    package, p12 = (tmp_path / name for name in ("calc-package.pdf", "yours.p12"))
    told = commands.errors_of("sign", package, "--p12", p12)
    assert missing in told
    assert "assword" not in told


@pytest.mark.quick
def test_the_package_is_not_overwritten_by_the_one_that_is_signed(tmp_path):
    package = tmp_path / "calc-package.pdf"
    package.write_bytes(b"as it was")
    words = ("sign", package, "--p12", package, "--password", "x", "--out", package)
    assert "use another --out" in commands.errors_of(*words)
    assert package.read_bytes() == b"as it was"


@pytest.mark.nightly
def test_a_signed_package_beside_a_new_one_is_named_where_it_is_of_another_input(
    sign, job, tmp_path
):
    data = (job / "out" / "calc-package.pdf").read_bytes()
    results = json.loads((job / "out" / "results.json").read_bytes())

    def later(pdf):
        tampering.set_file(pdf, "input.xlsx", tampering.file_of(pdf, "input.xlsx") + b" ")
        tampering.relisted(pdf)

    _, content = sign(content=data)
    new = tmp_path / "calc-package.pdf"
    for name, held in (
        ("calc-package-signed.pdf", content),
        ("copy.pdf", data),
        ("cut.pdf", content[: len(content) // 2]),
        ("letter.pdf", b"%PDF-1.7 of another program"),
    ):
        (tmp_path / name).write_bytes(held)
    (tmp_path / "folder.pdf").mkdir()
    new.write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_of_other_packages(new)
    new.write_bytes(tampering.rewritten(data, later))
    with pytest.warns(UserWarning, match="another input") as told:
        warn_of_other_packages(new)
    revision, verdict = results["input"]["project"]["revision"], results["verdict"]
    said = f"is of revision {revision}, another input: {verdict}"
    assert [str(one.message) for one in told] == [
        f"{tmp_path / 'calc-package-signed.pdf'}: {said}; sign the new package",
        f"{tmp_path / 'copy.pdf'}: {said}",
    ]
