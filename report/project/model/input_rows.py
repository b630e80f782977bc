"""An input as it was read: each value is valid by itself, and not yet checked against the others.

A value that could not be read is absent, so that one wrong cell hides no other fault.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

InputRow = Mapping[str, Any]
"""Values of a row by field."""

Inputs = Mapping[str, Sequence[InputRow]]
"""Rows by section."""
