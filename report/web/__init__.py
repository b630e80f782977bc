"""The page of `roofslip serve`: routes, open projects and the answers about them. Read `app`."""
