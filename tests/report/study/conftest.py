"""One study of six motions, run by the command and read again, that several files look at."""

import pytest

from fixtures.study_workbooks import command, small, write
from report.study import outputs
from report.study.run_study import planned, run_study
from report.typeset.pdf import lay_out


@pytest.fixture(scope="session")
def laid_out():
    """The HTML of the study that is laid out."""
    return []


@pytest.fixture(scope="session")
def made(tmp_path_factory, laid_out):
    folder = write(tmp_path_factory.mktemp("study"), small(), motions=6)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(outputs, "lay_out", lambda html: laid_out.append(html) or lay_out(html))
        done = command(folder)
    assert done.exit_code == 0, done.output
    return folder, done.output


@pytest.fixture(scope="session")
def steps():
    """What the study says of its progress."""
    return []


@pytest.fixture(scope="session")
def results(made, steps):
    plan, _ = planned(made[0])
    return run_study(plan, made[0] / "out" / "study", progress=steps.append)


@pytest.fixture
def other(tmp_path):
    """A function that runs another study of the same motions and returns its results."""

    def run(**changes):
        folder = write(tmp_path, small(**changes), motions=6)
        return run_study(planned(folder)[0], tmp_path / "out")

    return run
