"""What input-output behaviour reveals of a model."""
