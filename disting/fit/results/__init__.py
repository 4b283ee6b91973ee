"""What the structures that are left say of the machine: with which uncertainty, around a
controller, for other programs.
"""
