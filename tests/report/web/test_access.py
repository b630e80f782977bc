"""Who may ask `roofslip serve`: tokens, the key, Host, and the headers of every answer."""

import pytest

from report.web.access import ENTRY, HEADERS, KEY_HEADER, TOKEN_HEADER, Keys

pytestmark = pytest.mark.quick

FILE = "a-token-of-a-file-with-letters"


def entered(tab, token):
    return tab.post(ENTRY, headers={TOKEN_HEADER: token})


def test_a_token_is_good_once_and_gives_the_key_that_every_request_shows(visitor, keys):
    token = keys.token()
    assert visitor.get(f"/?token={token}").status_code == 200
    assert "set-cookie" not in visitor.get(f"/?token={token}").headers
    key = entered(visitor, token).json()["key"]
    assert visitor.get("/api/state").status_code == 401
    assert visitor.get("/api/state", headers={KEY_HEADER: key}).status_code == 200
    assert entered(visitor, token).status_code == 403
    used = visitor.get(f"/?token={token}")
    assert used.status_code == 403
    assert "press Enter in its terminal" in used.text
    another = visitor.post("/api/token", headers={KEY_HEADER: key}).json()["token"]
    assert entered(visitor, another).json()["key"] == key


def test_the_token_of_a_file_stays_good_and_no_server_has_an_empty_one():
    keys = Keys(FILE)
    assert keys.exchange(FILE) == keys.exchange(FILE) == keys.key
    assert keys.exchange("") is None
    assert Keys().exchange("") is None


@pytest.mark.parametrize("token", ["", "another", "\u00e9", "x" * 5000])
def test_a_token_that_was_never_given_is_refused(visitor, token):
    assert entered(visitor, token.encode()).status_code == 403


@pytest.mark.parametrize("key", ["", "another", "\u00e9".encode()])
@pytest.mark.parametrize("path", ["/api/state", "/api/token", "/api/package/x", "/api/nothing"])
def test_nobody_is_answered_without_the_key(visitor, path, key):
    for method in ("GET", "POST", "DELETE"):
        assert visitor.request(method, path, headers={KEY_HEADER: key}).status_code == 401


def test_a_cookie_is_no_key(visitor, keys):
    answer = visitor.get("/api/state", headers={"cookie": f"{KEY_HEADER}={keys.key}"})
    assert answer.status_code == 401


def test_another_name_of_the_server_is_not_answered(visitor):
    assert visitor.get("/", headers={"host": "evil.example:8765"}).status_code == 421


@pytest.mark.parametrize("path", ["/", "/static/index.html", "/api/nothing", "/?token=wrong"])
def test_every_answer_has_the_headers(visitor, path):
    answer = visitor.get(path)
    assert {name: answer.headers[name] for name in HEADERS} == HEADERS
    policy = answer.headers["content-security-policy"]
    assert "unsafe" not in policy
    assert "default-src 'none'" in policy
