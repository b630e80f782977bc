"""Whether what is filled in makes sense: required cells, cells that contradict, the unusual."""
