"""One block under one motion: one axis, two axes, a row, model selection. Read `checked`."""
