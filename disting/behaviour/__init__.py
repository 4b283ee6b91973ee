"""Information on a model in its input-output behaviour."""
