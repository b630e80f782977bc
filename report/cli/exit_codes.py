"""Exit codes of the commands. 0: done, whatever the verdict."""

INTERNAL_ERROR = 1
"""The program failed (with the traceback), or checks of `verify` did."""
DIFFERS = 1
"""A package differs from what its own input gives."""
INPUT_ERROR = 2
NOT_OK = 3
"""With --fail-on-ng: the verdict is not OK."""
NOT_COMPARED = 4
"""`verify-package` could not compare all of a package."""
INTERRUPTED = 130
"""Ended by Ctrl+C, which shells write as 128 + signal 2."""
