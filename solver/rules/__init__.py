"""Every number of every code, by edition, and what follows from them. Read `rulesets`."""
