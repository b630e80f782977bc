"""The requirements on a project, one file per subject; `every` combines them."""
