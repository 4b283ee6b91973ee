"""Predictions of the remaining structures for the machine: with their uncertainty, around a
controller, for other programs.
"""
