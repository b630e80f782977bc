"""What the pages of the package print, part by part; their words are in the templates."""
