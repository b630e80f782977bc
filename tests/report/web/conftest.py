"""A server without a socket, asked as a browser on this machine would ask it."""

import pytest
from starlette.testclient import TestClient

from report.web.access import Gate
from report.web.app import made
from report.web.sessions import Sessions

HOST, TOKEN = "127.0.0.1:8765", "a-token-of-this-server"


@pytest.fixture(scope="module")
def app(tmp_path_factory):
    gate = Gate(token=TOKEN, hosts=[HOST], cookie="roofslip-8765")
    return made(gate, Sessions(tmp_path_factory.mktemp("sessions")))


@pytest.fixture
def visitor(app):
    """A browser before it opens the address."""
    with TestClient(app, base_url=f"http://{HOST}", follow_redirects=False) as client:
        client.headers["origin"] = f"http://{HOST}"
        yield client


@pytest.fixture
def client(visitor):
    """A browser that has opened the address."""
    assert visitor.get(f"/?token={TOKEN}").status_code == 303
    return visitor
