"""Structural identifiability of one chain: which of its parameters an experiment can determine,
and how many sets of them fit.

Distinguishability compares two structures; this compares one with itself (E. Walter, L. Pronzato
1997, chapter 2). A fibre of the coefficient map at a rational point counts the parameter vectors
with one behaviour; the row space of its Jacobian tells which functions of the parameters are
determined at all.

>>> from disting import Family
>>> from disting.questions.identifiability.analysis import identifiabilities
>>> from disting.questions.identifiability.check import confirms
>>> family = Family(3)
>>> first, fourth = identifiabilities([family[1], family[4]])
>>> first.rank, fourth.least, fourth.renamings[0].symmetries  # of a Renaming
(7, 2, ('reflection of the free part',))
>>> confirms(fourth, family[4])
True

The parts of a finding: a Combination that is determined, a Scaling that changes nothing, an
Alternative with its Origin. It is on the canonical form of a chain, and `as_given` in its names.
Of any model `local` gives a Local, `by_parameter` the level of each parameter, `joint` the grade of
several statements together; `encoded` and `decoded` are for a store.

>>> from disting.questions.identifiability.by_parameter import joint
>>> joint([100, 120])
(<Certainty.BOUNDED: 'bounded'>, 99)
"""
