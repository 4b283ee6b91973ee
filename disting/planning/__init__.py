"""Prediction of further measurements: power against a rival, and choice of the next experiment."""
