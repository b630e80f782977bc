"""The command line. Read `main`."""
