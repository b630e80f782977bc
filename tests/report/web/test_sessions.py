"""Sessions end after an hour without use, with all of their files."""

from report.web import sessions
from report.web.sessions import LIFE_S, Sessions


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def test_a_session_ends_an_hour_after_its_last_use_with_its_folder(tmp_path, monkeypatch):
    clock = Clock()
    monkeypatch.setattr("time.monotonic", clock)
    all_ = Sessions(tmp_path)
    used, unused = all_.begin(), all_.begin()
    (unused.new_folder() / "input.xlsx").write_bytes(b"x")
    clock.now = LIFE_S
    assert all_.find(used.id) is used
    clock.now = LIFE_S + 1.0
    assert all_.find(unused.id) is None
    all_.end_unused()
    assert all_.alive == [used]
    assert list(tmp_path.iterdir()) == [used.folder]
    assert all_.find("") is None


def test_the_folder_of_a_session_does_not_tell_its_name(tmp_path):
    session = Sessions(tmp_path).begin()
    assert session.folder.name not in session.id
    assert session.id not in str(session.folder)
    assert len(session.id) > 40
    assert session.folder.stat().st_mode & 0o077 == 0


def test_where_there_are_too_many_the_one_unused_for_longest_ends(tmp_path, monkeypatch):
    clock = Clock()
    monkeypatch.setattr("time.monotonic", clock)
    monkeypatch.setattr(sessions, "MOST", 2)
    all_ = Sessions(tmp_path)
    first, second = all_.begin(), all_.begin()
    clock.now = 1.0
    all_.find(first.id)
    third = all_.begin()
    assert set(map(id, all_.alive)) == {id(first), id(third)}
    assert not second.folder.exists()


def test_an_upload_replaces_the_files_of_the_one_before(tmp_path):
    session = Sessions(tmp_path).begin()
    before, after = session.new_folder(), session.new_folder()
    session.open(before / "project" / "input.xlsx")
    assert session.opened == before.name
    assert session.open(after / "input.xlsx") == before
    assert session.opened == after.name


def test_of_two_uploads_the_one_that_was_begun_last_counts(tmp_path):
    session = Sessions(tmp_path).begin()
    first, second = session.new_folder(), session.new_folder()
    assert not session.is_newest(first)
    assert session.is_newest(second)
    session.open(sessions.EXAMPLE)
    assert not session.is_newest(second)
