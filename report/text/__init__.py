"""Units and symbols: how values are printed. Read `units`."""
