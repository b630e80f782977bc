"""Supporting results that the package prints beside an assessment."""
