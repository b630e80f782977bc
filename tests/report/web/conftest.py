"""A server without a socket, asked as the page on this machine would ask it."""

import pytest
from starlette.testclient import TestClient

from fixtures.browser import opened, quiet_page, serve_scripts, served
from report.web import app as web_app
from report.web.access import KEY_HEADER, Keys
from report.web.session import Session

HOST = "127.0.0.1:8765"


@pytest.fixture(scope="session")
def keys():
    return Keys()


class UnpreparedSession(Session):
    """One whose processes start with the first request: one process less."""

    def start(self):
        pass

    def prepare(self, workbook):
        pass


@pytest.fixture(scope="session")
def serving(keys, tmp_path_factory):
    """The server, ended with the tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(web_app, "Session", UnpreparedSession)
        app = web_app.made(keys, tmp_path_factory.mktemp("served"), [HOST])
    with TestClient(app, base_url=f"http://{HOST}", follow_redirects=False) as client:
        yield client


@pytest.fixture
def visitor(serving):
    """A tab without the key."""
    serving.headers.pop(KEY_HEADER, None)
    return serving


@pytest.fixture
def client(visitor, keys):
    """A tab that has the key, with the example open."""
    visitor.headers[KEY_HEADER] = keys.key
    visitor.post("/api/example")
    return visitor


@pytest.fixture
def session(serving):
    return serving.app.state.session


@pytest.fixture(scope="module")
def server():
    with served() as server:
        yield server


@pytest.fixture(scope="module")
def address(server):
    return server[0]


@pytest.fixture(scope="module")
def scripts(browser):
    """A page that has the scripts, the styles and the fonts, and no server."""
    with quiet_page(browser) as page:
        serve_scripts(page)
        yield page


@pytest.fixture
def page(browser, address):
    with quiet_page(browser) as page:
        opened(page, address)
        yield page
