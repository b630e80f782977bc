"""Who may ask `roofslip serve`: token, cookie, Host, Origin, and the headers of every answer."""

import pytest

from report.web.access import HEADERS

TOKEN = "a-token-of-this-server"


def test_the_token_is_exchanged_for_a_cookie_and_leaves_the_address(visitor):
    answer = visitor.get(f"/?token={TOKEN}")
    assert answer.status_code == 303
    assert answer.headers["location"] == "/"
    cookie = answer.headers["set-cookie"]
    assert {"HttpOnly", "SameSite=strict", "Path=/"} <= set(cookie.split("; "))
    assert TOKEN not in cookie
    assert visitor.get("/").status_code == 200


@pytest.mark.parametrize("path", ["/", "/?token=another", "/static/index.html", "/api/state"])
def test_nobody_is_answered_without_the_token(visitor, path):
    answer = visitor.get(path)
    assert answer.status_code in (401, 403)
    assert "roofslip serve" in answer.text


def test_another_name_of_the_server_is_not_answered(client):
    assert client.get("/", headers={"host": "evil.example:8765"}).status_code == 421


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": ""},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
    ],
)
def test_a_page_of_another_site_changes_nothing(client, headers):
    assert client.post("/api/example", headers=headers).status_code == 403


def test_a_reverse_proxy_that_asks_under_the_name_of_the_server_is_answered(client):
    headers = {"origin": "https://roofslip.firm.example", "sec-fetch-site": "same-origin"}
    assert client.post("/api/example", headers=headers).status_code == 200


@pytest.mark.parametrize("path", ["/", "/static/index.html", "/api/nothing", "/?token=wrong"])
def test_every_answer_has_the_headers(client, path):
    answer = client.get(path)
    assert {name: answer.headers[name] for name in HEADERS} == HEADERS
    policy = answer.headers["content-security-policy"]
    assert "unsafe" not in policy
    assert "default-src 'none'" in policy
