"""A warm process that computes for the page: a line of JSON in for each job, a line out.

Started by `report.web.workers` as `python -m report.web.worker NICE`; ends with its input.
"""

from __future__ import annotations

import gc
import json
import os
import signal
import sys
import traceback
from typing import Any

from report.web.limits import INTERNAL, give_way, is_full, limit_memory

MEMORY_BYTES = 6 << 30
_TOO_LARGE = "this needs more memory than a session may use; drop fewer or shorter records"


def main() -> None:
    """Do the jobs that arrive until the input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server decides what an interrupt ends
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a library prints is no answer
    limit_memory(MEMORY_BYTES)
    give_way(int(sys.argv[1]))
    from report.web.jobs import perform

    for number, line in enumerate(sys.stdin):
        out.write(f"{answered(perform, line)}\n")
        out.flush()
        if number == 0:
            # What the first answer loaded stays: searching it for garbage would hold up an answer
            # now and then by a tenth of a second.
            gc.collect()
            gc.freeze()


def answered(perform: Any, line: str) -> str:
    """Return the answer to a line: what is performed, or why it is not."""
    try:
        return json.dumps(perform(json.loads(line)), allow_nan=False)
    except MemoryError:
        return _refused(_TOO_LARGE)
    except Exception as error:
        if isinstance(error, OSError) and is_full(error):
            return json.dumps({"errno": error.errno})
        traceback.print_exc()
        return _refused(INTERNAL)


def _refused(why: str) -> str:
    return json.dumps({"problems": [], "refused": why})


if __name__ == "__main__":
    main()
