"""What the data say of fitted candidates: explained or not, determined or not, excluded or not, and
what does the same.
"""
