"""A second process: what comes back, and how it ends."""

import gc
import os
import pickle
import subprocess
import sys
import tempfile
import time
from dataclasses import is_dataclass
from functools import cached_property
from importlib import import_module
from multiprocessing import connection
from operator import truediv
from pkgutil import walk_packages

import pytest

import report.assessment
from fixtures.paths import ROOT
from report.web.processes import WorkerProcess, tell
from report.web.worker import begun
from solver.errors import DefectError, InputError


def refuse(cell):
    raise InputError(f"{cell}: not a number")


def no_json():
    return {1, 2}


@pytest.fixture
def worker():
    with WorkerProcess(gc.disable) as process:
        yield process


@pytest.mark.quick
def test_results_come_back_in_order_from_another_process(worker):
    asked = [worker.submit(divmod, 7, 2), worker.submit(os.getpid)]
    assert asked[0].result(timeout=60) == [3, 1]
    assert asked[1].result(timeout=60) != os.getpid()


@pytest.mark.parametrize("last_act", [(os._exit, 3), (no_json,), (truediv, 1, 0)])
def test_a_process_that_ends_too_soon_is_an_internal_error_and_no_endless_wait(worker, last_act):
    asked = [worker.submit(*last_act), worker.submit(os.getpid)]
    for result in asked:
        with pytest.raises(DefectError, match="ended"):
            result.result(timeout=60)


def fail_while_it_works(asked):
    with WorkerProcess(gc.disable) as process:
        asked += [process.submit(time.sleep, 300), process.submit(os.getpid)]
        refuse("Site!B5")


@pytest.mark.quick
def test_an_error_in_the_command_ends_it_in_the_middle_of_a_function():
    started, asked = time.monotonic(), []
    with pytest.raises(InputError, match="Site!B5"):
        fail_while_it_works(asked)
    assert time.monotonic() - started < 100
    assert asked[0].exception(timeout=0)
    assert asked[1].cancelled()  # codespell:ignore


@pytest.mark.nightly
def test_it_ends_in_the_middle_of_a_function_when_the_command_is_killed():
    code = (
        "import gc, os, time; from report.web.processes import WorkerProcess\n"
        "if __name__ == '__main__':\n"
        "    worker = WorkerProcess(gc.disable)\n"
        "    print(worker.submit(os.getpid).result(), flush=True)\n"
        "    worker.submit(time.sleep, 300)\n"
        "    time.sleep(0.5)\n"
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


def tell_twice():
    tell("one")
    tell(2)
    return {"done": True}


def test_no_collection_interrupts_the_answers_of_a_process_of_the_page(tmp_path):
    process = begun(tmp_path)
    try:
        assert process.submit("gc:get_threshold").result()[0] > 50_000
    finally:
        process.shutdown()


def test_a_process_tells_how_far_it_is():
    heard = []
    with WorkerProcess(gc.disable, told=heard.append) as process:
        assert process.submit(tell_twice).result(timeout=60) == {"done": True}
        assert heard == ["one", 2]


class MakesFolder:
    """Makes a folder where it is unpickled."""

    def __init__(self, folder):
        self.folder = folder

    def __reduce__(self):
        return os.mkdir, (self.folder,)


def send_pickle(folder):
    """Answer as a process that a hostile file has taken over may."""
    kind = getattr(connection, "PipeConnection", connection.Connection)  # that of Windows
    pipes = (each for each in gc.get_objects() if isinstance(each, kind))
    next(each for each in pipes if each.writable).send(MakesFolder(folder))


def test_nothing_of_a_process_is_unpickled_and_what_it_leaves_goes(worker, tmp_path):
    folder = tmp_path / "unpickled"
    with pytest.raises(ValueError, match="decode"):
        worker.submit(send_pickle, str(folder)).result(timeout=60)
    assert not folder.exists()
    # It would have been made.
    pickle.loads(pickle.dumps(MakesFolder(str(folder))))
    assert folder.exists()
    with WorkerProcess(gc.disable) as process:
        name = process.submit(left_file).result()
        assert os.path.exists(name)
    assert not os.path.exists(os.path.dirname(name))


def left_file():
    handle, name = tempfile.mkstemp()
    os.close(handle)
    return name


@pytest.mark.quick
def test_no_part_of_an_assessment_can_change():
    modules = [
        import_module(each.name)
        for each in walk_packages(report.assessment.__path__, "report.assessment.")
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
        # What is computed once has its place beside the fields.
        has_cached = any(isinstance(item, cached_property) for item in vars(each).values())
        assert has_cached or "__slots__" in vars(each), each
