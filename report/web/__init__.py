"""The page of `roofslip serve`: routes, what is open and the answers about it. Read `app`."""
