"""What the roof plan shows: neighbors, bare edges, envelopes, clearances that are missing."""
