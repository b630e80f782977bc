"""Commands as a user or a script calls them, in this process."""

from __future__ import annotations

import ctypes
import json
import signal
from collections.abc import Callable
from functools import partial

from click.testing import CliRunner, Result

from report.cli.main import main


def run(*words: object) -> Result:
    """Return how a command ends."""
    return CliRunner().invoke(main, [str(word) for word in words])


def printed(*words: object) -> str:
    """Return what a command prints that succeeds, without its progress."""
    done = run(*words)
    assert done.exit_code == 0, done.output
    return done.stdout


def as_json(*words: object) -> dict:
    """Return what a command prints as JSON."""
    return json.loads(printed(*words, "--json"))


def ended(*words: object, exit_code: int = 0) -> str:
    """Return all that a command prints which ends with an exit code."""
    done = run(*words)
    assert done.exit_code == exit_code, done.output
    return done.output


refused = partial(ended, exit_code=2)
"""Returns what a command prints as it refuses its input."""


def hearing(number: signal.Signals) -> Callable[[], object]:
    """Return a `preexec_fn` of a process that takes a signal, which the tests may have to ignore.

    A shell starts what runs in the background without Ctrl+C, and `nohup` without the hangup.
    """
    return partial(signal.signal, number, signal.SIG_DFL)


def no_override() -> None:
    """As a `preexec_fn`, give up the right of root to do what permissions forbid."""
    libc, drop_from_bounding_set = ctypes.CDLL(None), 24
    for override in (1, 2):
        libc.prctl(drop_from_bounding_set, override, 0, 0, 0)
