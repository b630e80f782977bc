"""One block under one motion: one axis, two axes, a row, the least model. Read `checked`."""
