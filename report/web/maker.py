"""Makes one package for the page, in a process with limits, and says how far it is.

Started by `report.web.packages` as `python -m report.web.maker WORKBOOK DIR`: a line of JSON
out for each step. The process that draws beside it gets the same limits.
"""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from report.making import Step
from report.web.limits import (
    FULL,
    INTERNAL,
    give_way,
    is_full,
    limit_files,
    limit_memory,
    limit_processor,
)
from report.words.counts import capitalized

MEMORY_BYTES = 8 << 30
FILE_BYTES = 1 << 30
PROCESSOR_S = 900
NICE = 10


def main() -> None:
    """Make the package of a workbook."""
    limit_memory(MEMORY_BYTES)
    limit_files(FILE_BYTES)
    limit_processor(PROCESSOR_S)
    give_way(NICE)
    from report.making import make
    from report.workers import started_worker

    workbook, out = (Path(each) for each in sys.argv[1:])

    def made() -> None:
        with started_worker() as worker:
            make(workbook, out, None, lambda step: _say(stage=in_words(step)), worker)

    _say(**outcome(made))


def outcome(make: Callable[[], None]) -> Mapping[str, str]:
    """Make a package, and return what became of it, in the words of the page."""
    try:
        make()
    except MemoryError:
        return _failed("It needs more memory than a package may use.")
    except Exception as error:
        from solver.model import InputError

        if is_full(error) or is_full(error.__cause__):
            return _failed(FULL)
        if isinstance(error, InputError):
            return _failed(error.problems[0])
        traceback.print_exc()
        return _failed(INTERNAL)
    return {"stage": "done"}


def _failed(message: str) -> Mapping[str, str]:
    return {"stage": "failed", "message": message}


def in_words(step: Step) -> str:
    """Return a step as a sentence of the page; its hint is of the terminal."""
    return capitalized(str(replace(step, hint="")))


def _say(**said: str) -> None:
    print(json.dumps(said), flush=True)


if __name__ == "__main__":
    main()
