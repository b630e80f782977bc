"""Checks of the input: required cells, contradictory cells, unusual values."""
