"""Units and letters: how values are written. Read `units`."""
