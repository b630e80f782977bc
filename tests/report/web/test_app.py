"""The routes of the page, without a socket."""


def test_a_first_visit_shows_the_example_with_its_answer(client):
    state = client.get("/api/state").json()
    assert state["project"]["is_example"]
    assert state["problems"] == []
    assert state["answer"]["verdict"] == "OK"
    assert state["answer"]["model"] == "full"
    assert [array["id"] for array in state["answer"]["arrays"]] == state["views"]["arrays"]


def test_a_value_that_the_workbook_could_not_have_is_refused_with_its_cell(client):
    asked = {"n": 1, "moving": False, "values": {"rule_set": "ASCE 7-22"}}
    answer = client.post("/api/assess", json=asked)
    assert answer.status_code == 422
    found = answer.json()["problems"][0]
    assert found["text"].startswith("Site!B11: F_a is 1.2")
    assert found["remedy"].startswith("leave it blank")
    assert found["row"]["cells"][found["row"]["at"]] == "1.2"


def test_values_of_a_slider_that_moves_are_provisional_and_carry_no_verdict(client):
    asked = {"n": 2, "moving": True, "values": {"friction": 0.95}}
    found = client.post("/api/assess", json=asked).json()
    assert (found["model"], found["is_provisional"], found["reasons"]) == ("one axis", True, [])
    of = [found, *found["arrays"], *found["clearances"], *found["plan"]["gaps"]]
    assert {item["verdict"] for item in of} == {None}
