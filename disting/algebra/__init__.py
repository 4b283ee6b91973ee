"""Exact algebra that knows no mechanics; the home of python-flint."""
