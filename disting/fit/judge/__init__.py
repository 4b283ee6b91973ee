"""Judgement of fitted candidates by the data: explained or not, determined or not, excluded or not,
and equivalents.
"""
