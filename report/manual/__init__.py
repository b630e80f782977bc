"""The verification manual: what `solver.verification` found, as pages. Read `render` first."""
