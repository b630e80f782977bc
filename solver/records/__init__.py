"""Records: units, processing, scaling, spectra, measures. Read `record`."""
