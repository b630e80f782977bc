"""The methods of one axis by name, for comparison with the exact one. Read `methods`."""
