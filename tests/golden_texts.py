"""Golden texts: `./roofslip test --golden` shows what changed and takes it over."""

import difflib

import pytest

from places import GOLDEN


def pytest_addoption(parser):
    parser.addoption("--golden", action="store_true", help="take over texts that changed")


@pytest.fixture
def golden(request):
    """A function that holds a text against a golden file; `--golden` takes it over."""
    is_taken_over = request.config.getoption("--golden")

    def hold(name, text):
        changed = difference(GOLDEN / name, text, is_taken_over=is_taken_over)
        if changed and not is_taken_over:
            pytest.fail(f"{changed}\n\n./roofslip test --golden takes it over", pytrace=False)
        request.node.user_properties.append(("golden", changed))

    return hold


def difference(path, text, *, is_taken_over):
    """Return what a text changes in a file, and write it there if it is taken over."""
    before = path.read_text(encoding="utf-8") if path.is_file() else ""
    names = (f"before/{path.name}", f"now/{path.name}")
    lines = difflib.unified_diff(before.splitlines(), text.splitlines(), *names, n=1, lineterm="")
    changed = "\n".join(lines)
    if changed and is_taken_over:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return changed


def pytest_runtest_logreport(report):
    """Print what was taken over, in the process that has the terminal."""
    if report.when == "teardown":
        for name, changed in report.user_properties:
            if name == "golden" and changed:
                print(f"\n{changed}")
