"""Fibres: all parameters with a given behaviour, by network synthesis and by polynomial ideals."""
