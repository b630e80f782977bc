"""Hostile requests: what is too long or too slow ends, and nothing of the server gets out.

After the security chapter of WeasyPrint's manual: long renderings, requests to other places,
endless loops, huge values, local files, leaks of the system, SVG.
"""

import json

import pytest

from fixtures.paths import ROOT
from fixtures.workbooks import type_into
from report.web.access import KEY_HEADER

pytestmark = pytest.mark.quick

EXAMPLE = ROOT / "projects" / "example"


def sent(client, *files):
    return client.post("/api/upload", files=[("files", file) for file in files])


def test_a_body_that_is_too_long_is_not_read_to_its_end(client, monkeypatch):
    monkeypatch.setattr("report.web.files.MOST_SENT", 100_000)
    assert sent(client, ("input.xlsx", bytes(200_000))).status_code == 413
    taken = []

    def body():
        yield b'--x\r\nContent-Disposition: form-data; name="files"; filename="input.xlsx"\r\n\r\n'
        for _ in range(1000):
            taken.append(1)
            yield bytes(10_000)

    headers = {"content-type": "multipart/form-data; boundary=x"}
    assert client.post("/api/upload", content=body(), headers=headers).status_code == 413


def test_a_tab_that_is_closed_while_files_arrive_is_no_internal_error(client, session):
    headers = {
        "host": client.base_url.netloc.decode(),
        KEY_HEADER.lower(): client.headers[KEY_HEADER],
        "content-type": "multipart/form-data; boundary=x",
        "content-length": "1000",
    }
    scope = {
        "type": "http",
        "method": "POST",
        "scheme": "http",
        "path": "/api/upload",
        "query_string": b"",
        "headers": [(name.encode(), value.encode()) for name, value in headers.items()],
    }
    left = set(session.folder.iterdir())
    messages = [{"type": "http.request", "body": b"--x", "more_body": True}]
    answers = []

    async def receive():
        return messages.pop() if messages else {"type": "http.disconnect"}

    async def send(message):
        answers.append(message)

    client.portal.call(client.app, scope, receive, send)
    assert answers[0]["status"] == 400
    assert set(session.folder.iterdir()) == left


def test_a_request_that_is_too_long_is_refused(client):
    headers = {"content-type": "application/json"}
    long = b'{"page": "' + b"x" * 200_000 + b'"}'
    assert client.post("/api/assess", content=long, headers=headers).status_code == 413


@pytest.mark.nightly
def test_a_workbook_that_names_files_of_the_machine_reads_none(client, tmp_path):
    path = tmp_path / "input.xlsx"
    path.write_bytes((EXAMPLE / "input.xlsx").read_bytes())
    names = {"C8": "/etc/passwd", "D8": "../../etc/passwd", "E8": "file:///x"}
    type_into(path, {f"Motions!{cell}": name for cell, name in names.items()})
    state = sent(client, ("input.xlsx", path.read_bytes())).json()
    assert {item["cell"] for item in state["problems"]} >= names.keys()
    assert "root:" not in json.dumps(state)


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


@pytest.mark.nightly
def test_no_answer_names_a_folder_of_the_server(client):
    asked = (client.post(f"/api/{name}", json={"values": {}}) for name in ("assess", "workbook"))
    for answer in (sent(client, ("input.xlsx", b"x")), *asked):
        assert "served" not in answer.text
        assert "/tmp" not in answer.text
