"""A second process: what comes back, and how it ends."""

import os
import subprocess
import sys
import tempfile
import time
from dataclasses import is_dataclass
from importlib import import_module
from operator import truediv
from pkgutil import iter_modules

import pytest

import report.assessment
import report.workers
from places import ROOT
from report.workers import SameProcess, WorkerProcess, started_worker
from solver.model import DefectError, InputError


def refuse(cell):
    raise InputError(f"{cell}: not a number")


def unpicklable():
    return lambda: 0


@pytest.fixture
def worker():
    with WorkerProcess() as process:
        yield process


def test_results_come_back_in_order_from_another_process(worker):
    asked = [worker.submit(divmod, 7, 2), worker.submit(os.getpid)]
    assert asked[0].result(timeout=60) == (3, 1)
    assert asked[1].result(timeout=60) != os.getpid()


def test_an_exception_is_the_same_and_says_where_it_was_raised(worker):
    with pytest.raises(InputError) as caught:
        worker.submit(refuse, "Arrays!B7").result(timeout=60)
    assert caught.value.problems == ("Arrays!B7: not a number",)
    assert "in the worker" in caught.value.__notes__[0]
    assert "refuse" in caught.value.__notes__[0]


def test_it_works_on_after_an_exception(worker):
    with pytest.raises(ZeroDivisionError):
        worker.submit(truediv, 1, 0).result(timeout=60)
    assert worker.submit(truediv, 1, 2).result(timeout=60) == 0.5


@pytest.mark.parametrize("last_act", [(os._exit, 3), (unpicklable,)])
def test_a_process_that_ends_too_soon_is_an_internal_error_and_no_endless_wait(worker, last_act):
    asked = [worker.submit(*last_act), worker.submit(os.getpid)]
    for result in asked:
        with pytest.raises(DefectError, match="ended"):
            result.result(timeout=60)


def fail_while_it_works(asked):
    with WorkerProcess() as process:
        asked += [process.submit(time.sleep, 300), process.submit(os.getpid)]
        refuse("Site!B5")


def test_an_error_in_the_command_ends_it_in_the_middle_of_a_function():
    started, asked = time.monotonic(), []
    with pytest.raises(InputError, match="Site!B5"):
        fail_while_it_works(asked)
    assert time.monotonic() - started < 100
    assert asked[0].exception(timeout=0)
    assert asked[1].cancelled()  # codespell:ignore


def test_it_ends_when_the_command_is_killed():
    code = (
        "import os; from report.workers import WorkerProcess\n"
        "if __name__ == '__main__':\n"
        "    print(WorkerProcess().submit(os.getpid).result(), flush=True)\n"
        "    os.kill(os.getpid(), 9)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=60
    )
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline:
        try:
            os.kill(int(done.stdout), 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    pytest.fail("the second process is still there")


def test_without_a_second_process_the_same_functions_run_in_this_one(monkeypatch):
    def refused():
        raise OSError("no more processes")

    monkeypatch.setattr(report.workers, "WorkerProcess", refused)
    with started_worker() as here:
        assert isinstance(here, SameProcess)
        assert here.submit(os.getpid).result() == os.getpid()
        with pytest.raises(InputError):
            here.submit(refuse, "Site!B5")


def left_file():
    handle, name = tempfile.mkstemp()
    os.close(handle)
    return name


def test_what_it_leaves_in_its_temporary_folder_goes_with_it():
    with WorkerProcess() as process:
        name = process.submit(left_file).result()
        assert os.path.exists(name)
    assert not os.path.exists(os.path.dirname(name))


def test_no_part_of_an_assessment_can_change_while_it_is_sent():
    modules = [
        import_module(f"report.assessment.{each.name}")
        for each in iter_modules(report.assessment.__path__)
    ]
    found = {
        each
        for module in modules
        for each in vars(module).values()
        if isinstance(each, type) and is_dataclass(each) and each.__module__ == module.__name__
    }
    assert len(found) > 20
    for each in found:
        assert each.__dataclass_params__.frozen, each
        assert "__slots__" in vars(each), each
