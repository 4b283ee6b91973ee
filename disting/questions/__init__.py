"""Questions on chains beyond the conditions: equivalence, inclusion, positive parameters,
identifiability.
"""
