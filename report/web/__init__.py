"""The page of `roofslip serve`: routes, sessions and the answers to them. Read `app`."""
