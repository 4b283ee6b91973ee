"""The rules that may decide a pair: the conditions of the paper, and the questions that follow
them.
"""
