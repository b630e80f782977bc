"""What would satisfy a project that is NG."""
