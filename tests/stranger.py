"""What a stranger may put in the places of files, and the state of a folder."""

import os
import sys

import pytest

KINDS = ("link", "dangling link", "pipe", "device", "folder")


LINKS = "on Windows, links need an administrator"
PIPES = "on Windows, no pipe has a place in a folder"
SENTENCES = "the sentence is that of the system"


def not_on_windows(cause):
    """Mark a test that cannot pass there."""
    return pytest.mark.skipif(sys.platform == "win32", reason=cause)


def occupied(path, kind, outside):
    """Put something else in the place of what is written."""
    if sys.platform == "win32" and kind not in ("folder", "hard link"):
        pytest.skip(PIPES if kind == "pipe" else LINKS)
    if path.is_dir():
        path.rename(outside)
    match kind:
        case "link":
            path.symlink_to(outside)
        case "dangling link":
            path.symlink_to(outside.with_name("nowhere"))
        case "device":
            path.symlink_to(os.devnull)
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "hard link":
            os.link(outside, path)


def state(place):
    """Everything below a folder, links as such."""
    return {
        str(path.relative_to(place)): os.readlink(path)
        if path.is_symlink()
        else path.read_bytes() if path.is_file() else None
        for path in place.rglob("*")
    }  # fmt: skip
