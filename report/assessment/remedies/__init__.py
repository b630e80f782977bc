"""Changes that would satisfy a project that is NG."""
