"""Ids of checks that other modules ask for."""

from __future__ import annotations

# Id of the limits on the motions.
MOTIONS_ID = "motions"


# Id of the requirement on friction beyond the velocities tested.
VELOCITY_ROW = "friction_velocity"


# Id of the requirement that clearances are given as the plan has them.
PLAN_ROW = "neighbors"


# Id of the requirement on the strength between the parts of an array.
STRENGTH_ROW = "interconnection"


OVERRIDE_ID = "override"


# Ids of the rows here.
LOWERING = (OVERRIDE_ID, "statistic")
