"""A package that was made once, and what holds a tampered one against it."""

from functools import cache

import pytest

from fixtures import packages, tampering
from report.proof.opened_package import opened
from report.proof.package_comparison import compared


@pytest.fixture(scope="session")
def job(tmp_path_factory):
    return packages.reported(tmp_path_factory, "conditions", packages.without_figures).project


@pytest.fixture(scope="session")
def data(job):
    return (job / "out" / "calc-package.pdf").read_bytes()


@pytest.fixture(scope="session")
def few_sheets(data):
    """The package without most of its sheets, for what is compared by the words of every sheet."""

    def change(pdf):
        del pdf.pages[8:]

    return tampering.rewritten(data, change)


@pytest.fixture(scope="session")
def proof(data):
    """A function that compares the bytes of a package with what was made from its input."""
    parsed = cache(opened)
    return lambda given, made=data: compared(opened(given), parsed(made))


@pytest.fixture
def tampered(proof):
    """A function that changes a package, and returns how that compares with it as it was."""

    def of(content, *changes):
        def change(pdf):
            for one in changes:
                one(pdf)

        given = tampering.rewritten(content, change)
        assert given != tampering.rewritten(content, lambda pdf: None)
        return proof(given, content)

    return of
