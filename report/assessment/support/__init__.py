"""Supporting results that the package prints with an assessment."""
