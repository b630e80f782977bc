"""Words that several checks and pages have in common."""

from __future__ import annotations

NOT_GIVEN = "not entered"
NO_DESIGN = "unknown without a permitted design displacement"

# Of a remedy whose outcome the workbook has no cell for: no input takes the condition away.
STAYS = "It remains listed for the plan checker's decision."
