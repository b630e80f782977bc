"""Every number of every code, by edition, and the formulas that use them. Read `rulesets`."""
