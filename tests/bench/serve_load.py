"""Times of the answers of `roofslip serve` while many users move a slider once a second.

Run from the repository root: .venv/bin/python tests/bench/serve_load.py [USERS] [SECONDS]
Prints the median and the 95th percentile of the answers in one axis, and of those at rest.
"""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Sequence
from http.cookiejar import CookieJar

USERS, SECONDS = 20, 30.0
WAIT_S = 120.0
STALE = 409


class User(threading.Thread):
    """A session that moves the slider of friction once a second, and lets it rest each time."""

    def __init__(self, number: int, address: str, until: float) -> None:
        super().__init__()
        self._number, self._until = number, until
        self._page = address.partition("?")[0]
        self._browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))
        self._browser.open(address, timeout=WAIT_S).read()
        self.moving: list[float] = []
        self.at_rest: list[float] = []
        self.stale = 0

    def run(self) -> None:
        """Move until the end."""
        time.sleep(self._number / 20.0 % 1.0)
        move = 0
        while (began := time.monotonic()) < self._until:
            move += 1
            self._ask(self.moving, 2 * move, is_moving=True)
            resting = threading.Thread(target=self._ask, args=(self.at_rest, 2 * move + 1))
            resting.start()
            time.sleep(max(began + 1.0 - time.monotonic(), 0.0))
        resting.join()

    def _ask(self, times: list[float], n: int, *, is_moving: bool = False) -> None:
        friction = 0.6 + 0.4 * ((n * 37 + self._number * 11) % 97) / 97
        values = {"friction": round(friction, 4)}
        body = json.dumps({"page": "p", "n": n, "moving": is_moving, "values": values})
        request = urllib.request.Request(
            f"{self._page}api/assess",
            body.encode(),
            {"Content-Type": "application/json", "Origin": self._page[:-1]},
        )
        began = time.monotonic()
        try:
            self._browser.open(request, timeout=WAIT_S).read()
            times.append(time.monotonic() - began)
        except urllib.error.HTTPError as error:
            if error.code != STALE:
                raise
            self.stale += 1


def main(users: int, seconds: float) -> None:
    """Start a server, let the users move, and print the times."""
    command = [sys.executable, "-m", "report.cli", "serve", "--port", "0", "--no-browser"]
    began = time.monotonic()
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert server.stdout is not None
        address = server.stdout.readline().strip()
        first = User(0, address, 0.0)
        page = address.partition("?")[0]
        first._browser.open(f"{page}api/state", timeout=WAIT_S).read()
        print(f"example shown {time.monotonic() - began:.2f} s after the start")
        for is_moving, name in ((True, "one axis"), (False, "at rest")):
            times: list[float] = []
            for n in range(40):
                first._ask(times, n, is_moving=is_moving)
            print(f"one user, {name}: {_summary(times)}")
        until = time.monotonic() + seconds
        everyone = [User(k, address, until) for k in range(users)]
        for user in everyone:
            user.start()
        for user in everyone:
            user.join()
        print(f"{users} users, one axis: {_summary([t for u in everyone for t in u.moving])}")
        print(f"{users} users, at rest: {_summary([t for u in everyone for t in u.at_rest])}, "
              f"{sum(user.stale for user in everyone)} dropped as stale")  # fmt: skip
    finally:
        server.terminate()
        server.wait()


def _summary(times: Sequence[float]) -> str:
    ordered = sorted(times)
    if not ordered:
        return "no answer"
    p95 = ordered[min(int(0.95 * len(ordered)), len(ordered) - 1)]
    return f"{len(ordered)} answers, median {ordered[len(ordered) // 2]:.3f} s, 95 % {p95:.3f} s"


if __name__ == "__main__":
    given = sys.argv[1:]
    main(int(given[0]) if given else USERS, float(given[1]) if len(given) > 1 else SECONDS)
