"""What is asked of chains beyond the conditions: same behaviour, inclusion, positive parameters,
identifiability.
"""
