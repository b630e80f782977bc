"""`roofslip serve`: what it prints and refuses, and one server of its own on loopback."""

import http.client
import json
import os
import pty
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.parse
import urllib.request
from contextlib import closing
from subprocess import PIPE

import pytest

from fixtures.commands import errors_of, hearing, stdout_of
from fixtures.paths import ROOT
from report.cli.page_server import names_of
from report.web.access import ENTRY, KEY_HEADER, TOKEN_HEADER

pytestmark = pytest.mark.quick

WAIT_S = 120.0
TOKEN = "a-token-of-twenty-letters"


def test_a_host_needs_a_token_and_a_port_that_is_taken_and_a_missing_package_are_named(monkeypatch):
    assert "--host requires --token-file" in errors_of("serve", "--host", "127.0.0.1")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        told = errors_of("serve", "--no-browser", "--port", port)
    assert (
        f"Port {port} of 127.0.0.1 is in use: stop the program that uses it, or use another --port."
        in told
    )
    assert "Address already in use" not in told
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    assert "install the extra web" in errors_of("serve", "--no-browser")


@pytest.mark.parametrize("token", ["", "short", "a token with spaces in it", "x" * 19])
def test_a_token_that_can_be_guessed_or_is_no_part_of_an_address_is_refused(token, tmp_path):
    path = tmp_path / "token"
    path.write_text(token)
    told = errors_of("serve", "--host", "127.0.0.1", "--token-file", path)
    assert "20 or more letters" in told


@pytest.mark.parametrize(
    ("host", "port", "name", "hosts"),
    [
        (None, 8765, "127.0.0.1", ["127.0.0.1:8765", "localhost:8765"]),
        ("calc.example", 80, "calc.example", ["calc.example"]),
        ("10.0.0.5", 8080, "10.0.0.5", ["10.0.0.5:8080"]),
        ("::1", 8080, "[::1]", ["[::1]:8080"]),
        ("0.0.0.0", 8080, socket.gethostname(), []),
    ],
)
def test_the_server_answers_to_the_names_of_its_address(host, port, name, hosts):
    found = names_of(host, port)
    assert (found[0], list(found[1])) == (name, hosts)


def serving(*words, **options):
    """A server in a process of its own."""
    command = [sys.executable, "-m", "report.cli", "serve", "--port", "0", "--no-browser", *words]
    return subprocess.Popen(command, cwd=ROOT, stdout=PIPE, stderr=PIPE, text=True, **options)


def asked(url, method, **headers):
    request = urllib.request.Request(url, headers=headers, method=method)
    return json.load(urllib.request.urlopen(request, timeout=WAIT_S))


@pytest.mark.parametrize("end", ["SIGTERM", "SIGHUP"])
@pytest.mark.nightly
def test_the_server_answers_and_leaves_nothing_behind(tmp_path, end):
    token = tmp_path / "token"
    token.write_text(f"{TOKEN}\n")
    words = ("--host", "127.0.0.1", "--token-file", str(token))
    env = os.environ | {"TMPDIR": str(tmp_path)}
    server = serving(*words, preexec_fn=hearing(signal.SIGHUP), env=env)
    try:
        address = server.stdout.readline().strip()
        match = re.fullmatch(rf"(http://127\.0\.0\.1:\d+)/\?token={TOKEN}", address)
        page = urllib.request.urlopen(address, timeout=WAIT_S)
        assert b"<title>" in page.read()
        for _ in range(2):  # the token of a file stays good
            key = asked(match[1] + ENTRY, "POST", **{TOKEN_HEADER: TOKEN})["key"]
        state = asked(f"{match[1]}/api/state", "GET", **{KEY_HEADER: key})
        assert state["answer"]["verdict"]["text"] == "OK"
        assert "server" not in {name.lower() for name in page.headers}
        assert len(list(tmp_path.glob("roofslip-serve-*"))) == 1
    finally:
        server.send_signal(getattr(signal, end))
        _, warned = server.communicate(timeout=30)
    assert warned.strip() == (
        "warning: the connection is not encrypted; put a reverse proxy with TLS in front of it"
    )
    assert server.returncode == 0
    assert not list(tmp_path.glob("roofslip-serve-*"))


@pytest.mark.nightly
def test_on_a_terminal_enter_prints_another_address_and_an_interrupt_ends_all():
    there, here = pty.openpty()
    server = serving(stdin=here)
    try:
        first = server.stdout.readline().strip()
        os.write(there, b"\n")
        second = server.stdout.readline().strip()
        page, _, token = first.partition("/?token=")
        keys = [asked(page + ENTRY, "POST", **{TOKEN_HEADER: each.partition("=")[2]})["key"]
                for each in (first, second)]  # fmt: skip
        assert keys[0] == keys[1]
        assert first != second
        with pytest.raises(urllib.error.HTTPError, match="403"):
            asked(page + ENTRY, "POST", **{TOKEN_HEADER: token})
    finally:
        server.send_signal(signal.SIGINT)
        _, told = server.communicate(timeout=30)
        os.close(here)
        os.close(there)
    assert told.strip() == "Press Enter for another address, or Ctrl+C to stop."
    assert server.returncode == 0


@pytest.mark.nightly
def test_a_server_that_ends_during_an_upload_prints_no_traceback(tmp_path):
    (tmp_path / "token").write_text(TOKEN)
    server = serving("--token-file", str(tmp_path / "token"))
    try:
        page = urllib.parse.urlsplit(server.stdout.readline())
        key = asked(f"http://{page.netloc}{ENTRY}", "POST", **{TOKEN_HEADER: TOKEN})["key"]
        upload = http.client.HTTPConnection(page.netloc, timeout=WAIT_S)
        upload.putrequest("POST", "/api/upload")
        upload.putheader(KEY_HEADER, key)
        upload.putheader("Content-Type", "multipart/form-data; boundary=b")
        upload.putheader("Content-Length", "1000")
        upload.endheaders(b"--b\r\n")
        asked(f"http://{page.netloc}/api/state", "GET", **{KEY_HEADER: key})  # it has begun by now
    finally:
        server.send_signal(signal.SIGINT)
        _, told = server.communicate(timeout=30)
    with closing(upload):
        assert upload.getresponse().read() == b'{"error":"The server ends."}'
    assert "Traceback" not in told
    assert server.returncode == 0


@pytest.mark.nightly
def test_once_says_the_verdict_of_the_example():
    told = stdout_of("serve", "--once", "--no-browser", "--port", 0)
    assert re.search(r"^the example: OK, after \d+\.\d s$", told, re.MULTILINE)
