"""A package compared with what its own input gives. Read `package`."""
