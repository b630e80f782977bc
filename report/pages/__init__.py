"""The pages of the package as finished strings, part by part."""
