"""Whether two chains of equal rank show the same behaviour: the exact decision, its domains, its
check.
"""
