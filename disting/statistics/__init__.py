"""Scatter of the lines of a measured response, and correlation of their residuals."""
