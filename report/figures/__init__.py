"""The charts and drawings of the package."""
