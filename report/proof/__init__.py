"""Compares a package with the one reproduced from its own input. Read `package`."""
