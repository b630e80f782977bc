"""A server without a socket, asked as a browser on this machine would ask it."""

import pytest
from starlette.testclient import TestClient

from report.web.access import Gate
from report.web.app import made
from report.web.sessions import Sessions

HOST, TOKEN = "127.0.0.1:8765", "a-token-of-this-server"


@pytest.fixture(scope="session")
def sessions(tmp_path_factory):
    return Sessions(tmp_path_factory.mktemp("sessions"))


@pytest.fixture(scope="session")
def served(sessions):
    """The server with one process that computes, ended with the tests."""
    gate = Gate(token=TOKEN, hosts=[HOST], cookie="roofslip-8765")
    with browser(made(gate, sessions, processes=1)) as client:
        yield client


def browser(app):
    client = TestClient(app, base_url=f"http://{HOST}", follow_redirects=False)
    client.headers["origin"] = f"http://{HOST}"
    return client


@pytest.fixture
def visitor(served):
    """A browser before it opens the address."""
    served.cookies.clear()
    return served


@pytest.fixture
def client(visitor):
    """A browser that has opened the address."""
    assert visitor.get(f"/?token={TOKEN}").status_code == 303
    return visitor
