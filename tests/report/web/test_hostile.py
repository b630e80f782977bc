"""Hostile requests: what is too long or too slow ends, and nothing of the server gets out.

After the security chapter of WeasyPrint's manual: long renderings, requests to other places,
endless loops, huge values, local files, leaks of the system, SVG.
"""

import io
import json
import zipfile

import pytest

from places import ROOT
from report.web import receiving

EXAMPLE = ROOT / "projects" / "example"


def sent(client, *files):
    return client.post("/api/upload", files=[("files", file) for file in files])


def test_a_body_that_is_too_long_is_not_read_to_its_end(client, monkeypatch):
    monkeypatch.setattr(receiving, "MOST_SENT", 100_000)
    assert sent(client, ("input.xlsx", bytes(200_000))).status_code == 413
    taken = []

    def body():
        yield b'--x\r\nContent-Disposition: form-data; name="files"; filename="input.xlsx"\r\n\r\n'
        for _ in range(1000):
            taken.append(1)
            yield bytes(10_000)

    headers = {"content-type": "multipart/form-data; boundary=x"}
    assert client.post("/api/upload", content=body(), headers=headers).status_code == 413


def test_a_visitor_who_leaves_while_files_arrive_is_no_internal_error(client, sessions):
    cookie = "; ".join(f"{name}={value}" for name, value in client.cookies.items())
    headers = {
        "host": client.base_url.netloc.decode(),
        "origin": client.headers["origin"],
        "cookie": cookie,
        "content-type": "multipart/form-data; boundary=x",
    }
    scope = {
        "type": "http",
        "method": "POST",
        "scheme": "http",
        "path": "/api/upload",
        "query_string": b"",
        "headers": [(name.encode(), value.encode()) for name, value in headers.items()],
    }
    messages = [{"type": "http.request", "body": b"--x", "more_body": True}]
    sent = []

    async def receive():
        return messages.pop() if messages else {"type": "http.disconnect"}

    async def send(message):
        sent.append(message)

    client.portal.call(client.app, scope, receive, send)
    assert sent[0]["status"] == 400
    assert list(sessions.find(client.cookies["roofslip-8765"]).folder.iterdir()) == []


def test_a_request_with_more_than_the_page_sends_is_refused(client):
    values = {f"x{k}": 1.0 for k in range(1000)}
    assert client.post("/api/assess", json={"values": values}).status_code == 422
    headers = {"content-type": "application/json"}
    long = b'{"page": "' + b"x" * 200_000 + b'"}'
    assert client.post("/api/assess", content=long, headers=headers).status_code == 413


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999", "-1e308"])
def test_values_that_are_no_finite_numbers_are_refused(client, number):
    body = f'{{"values": {{"friction": {number}}}}}'
    headers = {"content-type": "application/json"}
    assert client.post("/api/assess", content=body, headers=headers).status_code == 422


def test_a_workbook_that_names_files_of_the_machine_reads_none(client, tmp_path):
    from sheets import edit

    path = tmp_path / "input.xlsx"
    path.write_bytes((EXAMPLE / "input.xlsx").read_bytes())

    def change(book):
        for cell, name in (("C8", "/etc/passwd"), ("D8", "../../etc/passwd"), ("E8", "file:///x")):
            book["Motions"][cell] = name

    edit(path, change)
    state = sent(client, ("input.xlsx", path.read_bytes())).json()
    found = {item["cell"]: item["text"] for item in state["problems"]}
    assert found.keys() >= {"C8", "D8", "E8"}
    assert "root:" not in json.dumps(state)


@pytest.mark.parametrize(
    "content",
    [b"", b"PK\x03\x04", b"<svg/>", b"\xd0\xcf\x11\xe0" + bytes(600), b"%PDF-1.7"],
)
def test_a_file_that_is_no_workbook_is_a_problem_and_not_an_error(client, content):
    state = sent(client, ("input.xlsx", content)).json()
    assert state["project"] is None
    assert len(state["problems"]) == 1


def test_a_workbook_that_unpacks_to_gigabytes_is_a_problem(client):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/workbook.xml", bytes(60_000_000))
    state = sent(client, ("input.xlsx", data.getvalue())).json()
    assert len(state["problems"]) == 1


def test_a_name_with_markup_stays_text(client):
    answer = sent(client, ('a"><svg onload=x>.xlsx', b"x"))
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/json"
    assert "<" not in answer.json()["error"]


@pytest.mark.parametrize(
    "path", ["/static/../app.py", "/static/%2e%2e/app.py", "/static/..%2fapp.py", "/static/"]
)
def test_static_files_are_those_of_the_page_alone(client, path):
    assert client.get(path).status_code in (404, 405)


def test_no_answer_names_a_folder_of_the_server(client, tmp_path):
    state = sent(client, ("input.xlsx", b"x"))
    refused = client.post("/api/assess", json={"values": {}})
    for answer in (state, refused, client.post("/api/workbook", json={"values": {}})):
        assert "sessions" not in answer.text
        assert "/tmp" not in answer.text
