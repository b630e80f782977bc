"""What tests of figures share: the fonts that are shipped."""

import pytest

from report.figures.base import load_fonts
from report.typeset.pdf import TEMPLATES


@pytest.fixture(scope="session", autouse=True)
def fonts():
    load_fonts(TEMPLATES / "fonts")
