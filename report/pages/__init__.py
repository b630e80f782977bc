"""Contents of the pages of the package, part by part; their text is in the templates."""
