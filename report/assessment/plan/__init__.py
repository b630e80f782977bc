"""Evaluation of the roof plan: adjacent items, bare edges, missing clearances."""
