"""Equivalence of two chains of equal rank: the exact decision, its domains, its check."""
