"""The routes of the page, without a socket."""

import errno
import io
import json
import math
import re
import shutil
import time
import zipfile
from pathlib import Path

import pytest

from fixtures.page_parts import elements, table_rows, words
from fixtures.paths import ROOT
from fixtures.project_parts import HEAD
from fixtures.workbooks import SECTIONS, blank, cell_address, make, type_into
from report.project.model.choices import ClearanceSource
from report.project.read.read import read
from report.web.access import KEY_HEADER
from report.web.jobs import perform
from report.web.worker import State

EXAMPLE = ROOT / "projects" / "example"
CONDITIONS = ROOT / "projects" / "conditions"
JSON = {"content-type": "application/json"}


def asked(client, values, *, moving=False):
    body = {"page": "p", "n": 1, "moving": moving, "values": values}
    return client.post("/api/assess", content=json.dumps(body), headers=JSON)


def error_of(answer, status=422):
    """The sentence of an answer that is an error."""
    assert answer.status_code == status
    return answer.json()["error"]


def state_of(client):
    return client.get("/api/state").json()


def begun(client, **values):
    """A package that is begun."""
    return client.post("/api/package", json={"values": values}).json()


def uploads(session):
    """The folders of uploads."""
    return [each.name for each in session.folder.glob("upload-*")]


@pytest.mark.quick
def test_a_first_visit_shows_the_example_with_its_answer(client):
    state = state_of(client)
    assert state["project"]["is_example"]
    assert state["problems"] == []
    assert state["answer"]["verdict"]["text"] == "OK"
    assert re.fullmatch(r"All \d+ checks are satisfied\.", state["answer"]["verdict_text"])
    assert state["answer"]["count"] == 0
    assert state["answer"]["model_text"].startswith("Full model")
    rows = table_rows(state["answer"]["html"]["arrays"])
    assert [words(row["Array"]) for row in rows] == state["views"]["arrays"]


def test_an_address_that_names_a_project_is_that_of_the_page(client):
    named = f"/p/{state_of(client)['project']['id']}/"
    assert client.get(named).content == client.get("/").content
    assert client.get("/p/").status_code == 404


def test_a_value_that_the_workbook_could_not_have_is_refused_with_its_cell(client):
    answer = asked(client, {"rule_set": "ASCE 7-22"})
    assert answer.status_code == 422
    found = answer.json()["problems"][0]
    assert found["text"].startswith(cell_address("<Site/F_a>: F_a is 1.2"))
    assert found["remedy"].startswith("leave it blank")
    assert found["row"]["cells"][found["row"]["at"]] == "1.2"


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"friction": 9.0}, "Friction is 9.0; enter a number from 0.5 to 1.06"),
        ({"friction": "0.9"}, "Friction is 0.9; enter a number"),
        ({"friction": math.nan}, "Friction is nan; enter a number"),
        ({"friction": math.inf}, "Friction is inf; enter a number"),
        ({"friction": -math.inf}, "Friction is -inf; enter a number"),
        ({"friction": -1e308}, "Friction is -1e+308; enter a number"),
        ({"gravity": 1.0}, "Gravity: the workbook has no such slider"),
        ({"polarity": "sideways"}, "Polarity is sideways; choose both or"),
        ({f"x{k}": 1.0 for k in range(1000)}, "The request is not one of the page"),
    ],
)
def test_values_that_no_page_sends_are_refused(client, values, sentence):
    assert error_of(asked(client, values)).startswith(sentence)


@pytest.mark.nightly
def test_values_of_a_slider_that_moves_are_provisional_and_carry_no_verdict(client):
    found = asked(client, {"friction": 0.95}, moving=True).json()
    assert found["model_text"].startswith(
        "Provisional: each motion is run only in the orientations"
    )
    assert (found["verdict"], found["count"]) == (None, 0)
    drawn = found["html"]
    verdicts = [
        words(row["Verdict"])
        for name in ("arrays", "clearances")
        for row in table_rows(drawn[name])
    ]
    assert set(verdicts) == {"–"}
    assert not re.search(r"\b(OK|NG)\b|ng-", drawn["plan"])


@pytest.mark.parametrize(
    ("room", "size"),
    [(0, [340, 350]), (379, [340, 350]), (380, [380, 350]), (779, [740, 533]), (9999, [9980, 540])],
)
def test_the_plan_is_placed_on_the_widest_sheet_that_the_page_has_room_for(client, room, size):
    body = {"page": "p", "n": 1, "values": {}, "room": room}
    found = client.post("/api/assess", content=json.dumps(body), headers=JSON).json()
    least, most = found["plan"]["rooms_px"]
    assert least <= room < most
    assert found["plan"]["size_px"] == size
    written = {words(one) for one in elements(found["html"]["plan"], "svg/text")}
    assert {"A1", "A2", "A3", "1", "6"} <= written


@pytest.mark.quick
@pytest.mark.parametrize(
    ("kind", "body", "told"),
    [
        *(("assess", body, "The request is not one of the page; load the page again") for body in (
            b"", b"[]", b"{", b'{"values": 3}', b'{"n": "1"}', b'{"room": "1"}', b"[" * 90000)),
        ("slide", b"{}", "The request lacks array and motion;"),
        ("contour", b"{}", "The request lacks array;"),
    ],
)  # fmt: skip
def test_a_request_that_is_not_one_of_the_page_is_refused(client, kind, body, told):
    answer = client.post(f"/api/{kind}", content=body, headers=JSON)
    assert error_of(answer).startswith(told)
    assert client.post(f"/api/{kind}", data={"values": "{}"}).status_code == 415  # a form


@pytest.mark.nightly
def test_views_answer_from_the_values_of_the_sliders(client):
    about = {"page": "p", "n": 1, "array": "A2", "motion": "RM6", "values": {}}
    first = client.post("/api/slide", json=about).json()
    second = client.post("/api/slide", json=about | {"values": {"friction": 0.9}}).json()
    assert second["prd_m"] > first["prd_m"]
    assert "'A9'" in error_of(client.post("/api/slide", json=about | {"array": "A9"}))


def folder_of(project):
    paths = [project / "input.xlsx", *project.glob("records/*"), *project.glob("documents/*")]
    return [(f"{project.name}/{p.relative_to(project).as_posix()}", p.read_bytes()) for p in paths]


def sent(client, files):
    return client.post("/api/upload", files=[("files", file) for file in files])


@pytest.mark.nightly
def test_a_folder_and_its_zip_give_the_same_state(client):
    files = folder_of(EXAMPLE)
    first = sent(client, files).json()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files:
            archive.writestr(name, content)
    second = sent(client, [("example.zip", packed.getvalue())]).json()
    assert first.pop("opened") != second.pop("opened")
    assert first == second
    assert not first["project"]["is_example"]
    assert first["answer"]["verdict"]["text"] == "OK"
    assert client.post("/api/example").json()["project"]["is_example"]


@pytest.mark.nightly
def test_an_upload_that_cannot_be_read_leaves_open_what_was_open(client, session):
    others = uploads(session)
    before = sent(client, folder_of(EXAMPLE)).json()["opened"]
    assert len(sent(client, [("input.xlsx", b"no workbook")]).json()["problems"]) == 1
    assert sent(client, [("records/x.csv", b"0")]).status_code == 422
    state = state_of(client)
    assert state["opened"] == before
    assert state["answer"]["verdict"]["text"] == "OK"
    assert {*uploads(session)} - {*others} == {before}


NOT_FILLED = "No plan was filled in"


def test_before_a_drawing_is_read_there_is_no_workbook_that_was_filled_in(client):
    assert error_of(client.get("/api/plan"), 404).startswith(NOT_FILLED)


@pytest.mark.nightly
def test_a_drawing_that_is_refused_fills_in_no_workbook(client, tmp_path):
    book = blank(tmp_path / "input.xlsx").read_bytes()
    files = [("files", ("input.xlsx", book)), ("files", ("roof.dxf", b"no drawing"))]
    told = client.post("/api/plan", files=files, data={"layers": "{}", "unit": "ft"})
    assert error_of(told).startswith("Not a DXF drawing")
    assert error_of(client.get("/api/plan"), 404).startswith(NOT_FILLED)


def test_more_files_than_a_project_has_are_refused_in_the_words_of_the_page(client):
    told = error_of(sent(client, [(f"{k}.csv", b"") for k in range(501)]))
    assert told == "More than 500 files; drop the workbook and its records"


def full(*_, **__):
    raise OSError(errno.ENOSPC, "No space left on device")


async def half_written(_, job, *__):
    """What another process does on a full disk."""
    Path(job["to"]).write_bytes(b"half")
    return perform(job)


FULL = {
    "upload": {"report.web.files.store": full},
    "package": {"os.link": full, "shutil.copyfile": full},
    "workbook": {
        "report.web.jobs._open": full, "report.web.session.Session._answer": half_written,
    },
}  # fmt: skip


@pytest.mark.parametrize("asks", FULL)
def test_a_full_disk_is_said(client, session, monkeypatch, asks):
    left, files = set(session.folder.iterdir()), folder_of(EXAMPLE)
    with monkeypatch.context() as patch:
        for name, fails in FULL[asks].items():
            patch.setattr(name, fails)
        values = {"json": {"values": {}}}
        body = {"files": [("files", file) for file in files]} if asks == "upload" else values
        assert error_of(client.post(f"/api/{asks}", **body), 507).startswith("The disk is full")
    assert state_of(client)["project"]
    assert set(session.folder.iterdir()) == left


def test_every_error_of_a_workbook_is_shown_at_once_with_its_row(client, tmp_path):
    path, name = tmp_path / "input.xlsx", "Arrays/1/Friction coefficient"
    path.write_bytes((EXAMPLE / "input.xlsx").read_bytes())
    type_into(path, {name: "wet"})
    state = sent(client, [("input.xlsx", path.read_bytes())]).json()
    assert state["project"] is state["answer"] is None
    assert state["is_alone"]
    by_cell = {item["cell"]: item for item in state["problems"] if item["sheet"] == "Arrays"}
    row = by_cell[cell_address(name).partition("!")[2]]["row"]
    assert (row["heads"][row["at"]], row["cells"][row["at"]]) == ("Friction coefficient", "wet")
    # Of 40 columns those that the page shows: the first, and two on either side of the cell.
    assert row["at"] == 3
    assert (len(row["heads"]), len(row["cells"]), row["cells"][0]) == (6, 6, "A1")
    # The records were not sent: every motion says so.
    assert len([item for item in state["problems"] if item["sheet"] == "Motions"]) >= 7


@pytest.mark.nightly
def test_each_tab_is_answered_about_its_own_project_until_that_is_closed(client, monkeypatch):
    monkeypatch.setattr("report.web.session.MOST_OPEN", 2)
    one, other = (sent(client, folder_of(each)).json() for each in (CONDITIONS, EXAMPLE))
    for state in (one, other):
        body = {"opened": state["opened"], "values": {}}
        answer = client.post("/api/assess", json=body).json()
        assert answer["verdict"] == state["answer"]["verdict"]
        found = client.get(f"/api/state?project={state['project']['id']}").json()
        assert (found["opened"], found["project"]) == (state["opened"], state["project"])
        name = client.post("/api/workbook", json=body).headers["content-disposition"]
        assert name == 'attachment; filename="input.xlsx"'
    folder = client.app.state.session.folder / one["opened"]
    assert folder.is_dir()
    sent(client, folder_of(EXAMPLE))  # one more than stays open
    assert not folder.exists()
    for name in ("assess", "slide", "contour", "workbook", "package"):
        body = {"values": {}, "array": "A1", "motion": "RM1", "opened": one["opened"]}
        told = error_of(client.post(f"/api/{name}", json=body), 412)
        assert told == "This project is no longer open here. Open its workbook and records again."
    closed = client.get(f"/api/state?project={one['project']['id']}").json()
    assert closed["project"]["id"] != one["project"]["id"]  # which the page tells


def test_the_workbook_with_the_values_is_read_back_as_what_was_assessed(client, tmp_path):
    values = {"friction": 0.93, "slope": 0.7, "intensity": 1.06, "clearance": -3.0}
    answer = client.post("/api/workbook", json={"values": values})
    assert answer.headers["content-disposition"] == 'attachment; filename="input.xlsx"'
    shutil.copytree(EXAMPLE / "documents", tmp_path / "documents")
    path = tmp_path / "input.xlsx"
    path.write_bytes(answer.content)
    shown = asked(client, values).json()["shown"]
    arrays = read(path).project.arrays
    assert [array.mu for array in arrays] == pytest.approx([0.465, 0.465, 0.372])
    assert shown["friction"].startswith("0.465 (A1, A2)")


def test_a_package_is_begun_found_by_its_project_and_canceled_by_its_button(client):
    package = begun(client, friction=0.9)
    made = package["id"]
    assert package["values"] == {"friction": 0.9}
    # Another tab gets the one that is being made, and a page that is loaded finds it.
    again = begun(client)
    assert (again["id"], again["values"]) == (made, {"friction": 0.9})
    assert state_of(client)["package"]["id"] == made
    assert client.get(f"/api/package/{made}/calc-package.pdf").status_code == 404
    assert client.delete(f"/api/package/{made}").json()["state"] == "canceled"
    assert state_of(client)["package"] is None
    assert client.get("/api/package/another").status_code == 404


def test_a_file_of_a_package_is_given_to_who_has_the_key(client):
    made = begun(client)["id"]
    # Not `package.cancel`: the loop of the server, in another thread, ends the process as well.
    client.delete(f"/api/package/{made}")
    package = client.app.state.session.packages.find(made)
    package.out.mkdir()
    (package.out / "results.json").write_text("{}")
    package.state = State.DONE
    saved = client.get(f"/api/package/{made}/results.json")
    assert (saved.status_code, saved.text) == (200, "{}")
    assert saved.headers["content-disposition"] == 'attachment; filename="results.json"'
    client.headers.pop(KEY_HEADER)
    assert client.get(f"/api/package/{made}/results.json").status_code == 401


def over(client, made):
    for _ in range(300):
        about = client.get(f"/api/package/{made}").json()
        if about["is_over"]:
            return about
        time.sleep(0.1)
    raise AssertionError(about)


@pytest.mark.nightly
def test_a_package_is_made_from_the_workbook_that_is_open_and_no_other(client, session):
    files = dict(folder_of(EXAMPLE))
    content = files.pop("example/input.xlsx")
    others = [(f"example/{name}.xlsx", b"not a workbook") for name in ("a", "input 2", "z")]
    sent(client, [*others, ("example/Input.XLSX", content), *files.items()])
    # Without one of its records the package fails early, in words that name its workbook.
    next((session.folder / session.opened).rglob("records/*")).unlink()
    about = over(client, begun(client)["id"])
    assert about["state"] == "failed"
    assert about["words"].startswith("Motions!")


@pytest.mark.nightly
def test_a_package_of_a_workbook_that_is_closed_meanwhile_is_not_begun(client, monkeypatch):
    def meanwhile(workbook, folder):
        monkeypatch.setattr("report.web.session.MOST_OPEN", 1)
        sent(client, folder_of(EXAMPLE))
        raise FileNotFoundError(workbook)

    sent(client, folder_of(EXAMPLE))
    monkeypatch.setattr("report.web.files.copied", meanwhile)
    told = error_of(client.post("/api/package", json={"values": {}}), 412)
    assert told.startswith("This project is no longer open here.")


@pytest.mark.nightly
def test_clearances_that_a_plan_lacks_are_added_to_a_copy_that_is_open_then(client, tmp_path):
    assert not state_of(client)["lacks"]
    folder = tmp_path / "roof"
    confirmed = {"drawing_confirmed_by": "RG", "drawing_confirmed_date": "2025-11-18"}
    make(folder, clearances=[], objects=SECTIONS["objects"][:1], project=HEAD | confirmed)
    before = sent(client, folder_of(folder)).json()
    assert before["lacks"] == ["clearances"]
    after = client.post("/api/clearances", json={"opened": before["opened"]}).json()
    assert not after["lacks"]
    assert after["opened"] != before["opened"]
    assert state_of(client)["project"] == after["project"]
    content = client.post("/api/workbook", json={"values": {}}).content
    (tmp_path / "saved.xlsx").write_bytes(content)
    rows = read(tmp_path / "saved.xlsx").project.clearances
    assert read(tmp_path / "saved.xlsx").project.project.drawing_confirmed_date is None
    assert {(row.array, row.object, row.source) for row in rows} == {
        ("A1", "A2", ClearanceSource.DRAWING), ("A2", "RTU-1", ClearanceSource.DRAWING),
    }  # fmt: skip
    former = client.post("/api/assess", json={"opened": before["opened"], "values": {}})
    tables = [one["html"]["clearances"] for one in (former.json(), after["answer"])]
    assert tables[0] != tables[1]
