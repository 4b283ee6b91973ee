"""Chain models and their enumeration; interface of every family of models (`protocol`)."""
