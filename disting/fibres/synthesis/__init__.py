"""Inverse network synthesis: every chain with a given transfer function, listed in ball arithmetic.

It decides what the conditions leave open: one rational model of one chain, and all models of the
other chain that equal it.
"""
