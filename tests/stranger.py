"""What a stranger may put in the places of files, and the state of a folder."""

import os

KINDS = ("link", "dangling link", "pipe", "device", "folder")


def occupied(path, kind, outside):
    """Put something else in the place of what is written."""
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
