"""The one-axis methods by name, for comparison with the exact method. Read `methods`."""
