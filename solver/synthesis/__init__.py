"""Synthetic roof motions of three components that match target spectra. Read `suite`."""
