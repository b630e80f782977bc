"""What the roof plan shows: neighbors, bare edges, clearances that are missing."""
