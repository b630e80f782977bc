"""Whatever is required of a project, a file for each subject; `every` has all of it."""
