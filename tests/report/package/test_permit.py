"""The edition letter: two sheets for a permit, refused where they do not say it all."""

import pytest
from pypdf import PdfReader

from fixtures import assessments, commands, pages, project_parts, workbooks
from report.pages.registry import package_data
from report.project.model.choices import PackageEdition


@pytest.fixture
def project(tmp_path):
    """The example without motions, as a letter."""
    path = workbooks.without_motions(tmp_path)
    workbooks.type_into(path, {"Options/Edition": "letter"})
    return tmp_path


def test_the_table_has_the_displacement_and_four_separations_of_each_array():
    package = package_data(assessments.without_motions(), edition=PackageEdition.LETTER)
    table = pages.page_of(package, "permit").table("Arrays: design displacement")
    delta_in = 60.0 * (1.566 - 0.4) ** 2  # PV1-2012, I = 1
    needed = [f"{factor * delta_in:.1f}" for factor in (1.0, 0.5, 1.0, 1.0, 1.5)]
    assert needed == ["81.6", "40.8", "81.6", "81.6", "122.4"]
    assert [cells[0] for cells in table.cells] == ["A1", "A2", "A3"]
    for cells in table.cells:
        assert list(cells[3:8]) == needed


def test_every_open_check_is_on_the_first_page_and_every_clearance_on_the_second():
    done = assessments.without_motions()
    package = package_data(done, edition=PackageEdition.LETTER)
    opened = pages.page_of(package, "permit").table("Open")
    assert len(opened.cells) == len(done.open) > 0
    gaps = pages.page_of(package, "permit-plan").table("Clearances")
    assert len(gaps.cells) == len(done.clearances)


def test_what_the_two_sheets_do_not_say_is_refused_in_words(tmp_path):
    arrays = [project_parts.array(f"B{k}", 0.5, x=110 * k) for k in range(7)]
    path = workbooks.make(
        tmp_path, arrays=arrays, clearances=[], options={"package_edition": "letter"}
    )
    told = [line for line in workbooks.problems(path) if "edition is letter" in line]
    assert all(line.startswith("Options!") for line in told)
    for fault in (
        "edition is letter, which permits at most six arrays; 7 are entered",
        "edition is letter, which does not permit an analysis, but motions are listed",
        "edition is letter, which does not permit overrides",
    ):
        assert len([line for line in told if fault in line]) == 1


def test_more_than_two_sheets_are_refused(project, monkeypatch):
    monkeypatch.setattr("report.making.lay_out", lambda *given: given[2](3) or b"%PDF")
    told = commands.output_of("report", project, exit_code=2)
    assert "edition is letter, which has two sheets; this input requires 3" in told
    assert not (project / "out").exists()


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("name", "units", "paper"),
    [
        ("example", "US", "11 x 17"),
        ("example", "SI", "A3"),
        ("conditions", "US", "automatic"),  # 14 open conditions
        ("conditions", "SI", "automatic"),
        ("conditions", "US", "11 x 17"),
        ("conditions", "SI", "A3"),
    ],
)
def test_two_sheets_have_room_in_both_units_on_large_paper_and_for_many_conditions(
    tmp_path, name, units, paper
):
    path = workbooks.without_motions(tmp_path, name)
    options = {"Options/Edition": "letter", "Options/Sheet size of the roof plan": paper}
    workbooks.type_into(path, {**options, "Project/Primary units": units})
    assert "calc-package.pdf, 2 sheets" in commands.stdout_of("report", tmp_path)


@pytest.mark.nightly
def test_the_package_has_two_sheets_and_verifies(project):
    told = commands.stdout_of("report", project)
    assert "calc-package.pdf, 2 sheets" in told
    path = project / "out" / "calc-package.pdf"
    assert len(PdfReader(path).pages) == 2
    assert "Same: " in commands.stdout_of("verify-package", path)
