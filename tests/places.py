"""Where things are, for tests in any folder."""

from pathlib import Path

TESTS = Path(__file__).resolve().parent
ROOT = TESTS.parent
DATA = TESTS / "data"
GOLDEN = TESTS / "golden"
SAMPLES = DATA / "motions"
RECORDS = ROOT.parent / "shared" / "records"
"""Real records, beside the checkout; not everywhere."""
