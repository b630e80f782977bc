"""Which tests belong to a path of the command line."""

import pytest

import asked


@pytest.mark.parametrize(
    ("path", "tests"),
    [
        ("report/sheet", ["tests/report/sheet"]),
        ("./report/sheet/", ["tests/report/sheet"]),
        ("solver", ["tests/solver"]),
        ("report/web/static", ["tests/report/web"]),
        ("report/sheet/__init__.py", ["tests/report/sheet"]),
        ("tests/report/words", ["tests/report/words"]),
        ("tests/test_asked.py::test_nothing", ["tests/test_asked.py::test_nothing"]),
    ],
)
def test_a_folder_of_the_product_stands_for_its_tests_and_one_of_tests_for_itself(path, tests):
    assert asked.tests_of(path) == tests


def test_a_module_stands_for_the_files_that_bear_its_name_or_import_it():
    of_template = asked.tests_of("report/sheet/writing/template.py")
    assert {"tests/report/sheet/test_template.py", "tests/report/sheet/test_read.py"} <= {
        *of_template
    }
    assert "tests/report/sheet/test_cells.py" not in of_template
    assert asked.tests_of("report/cli/doctor.py") == ["tests/report/cli/test_doctor.py"]


def test_a_module_that_no_test_imports_stands_for_its_folder():
    assert asked.tests_of("report/cli/__main__.py") == ["tests/report/cli"]


def test_to_a_changed_module_belong_its_folder_and_the_files_that_import_it():
    found = asked.tests_of_changed(
        ["report/cli/terminal.py", "report/cli/gone.py", "docs/index.md"]
    )
    assert {"tests/report/cli", "tests/report/cli/test_terminal.py"} <= set(found)
    assert asked.tests_of_changed(["tests/test_asked.py"]) == ("tests/test_asked.py",)


def test_options_and_their_values_stay_as_they_are():
    words = ["--which", "quick", "solver/rules", "-k", "solver", "-x"]
    assert asked.words_for_pytest(words) == [*words[:2], "tests/solver/rules", *words[3:]]


@pytest.mark.parametrize(
    ("path", "meant"),
    [("report/shet", "report/sheet"), ("tests/report/word", "tests/report/words"), ("../x", None)],
)
def test_a_path_without_tests_says_what_would_do(path, meant):
    with pytest.raises(
        LookupError, match=r"such as report/sheet or report/sheet/faults\.py"
    ) as why:
        asked.tests_of(path)
    assert str(why.value).count("did you mean") == (meant is not None)
    assert meant is None or f"did you mean {meant}?" in str(why.value)
