"""Structural identifiability of one chain: which of its parameters an experiment can determine,
and how many sets of them fit.

Distinguishability compares two structures; this compares one with itself (E. Walter, L. Pronzato
1997, chapter 2). A fibre of the coefficient map at a rational point counts the parameter vectors
with one behaviour; the row space of its Jacobian shows which functions of the parameters are
determined at all.

>>> from disting import Family
>>> from disting.decide.identifiability import confirms, identifiabilities
>>> family = Family(3)
>>> first, fourth = identifiabilities([family[1], family[4]])
>>> first.rank, fourth.least, fourth.renamings[0].symmetries  # of a Renaming
(7, 2, ('reflection of the free part',))
>>> confirms(fourth, family[4])
True

The parts of a finding: a Combination that is determined, an Alternative with its Origin. It is on
the canonical form of a chain, and `in_names_of` in its names. Of any model `local` gives a Local,
`by_parameter` the level of each parameter, `joint` the grade of several statements together;
`encode` and `decode` are for a store.

>>> from disting.decide.identifiability import joint
>>> joint([100, 120])
(<Certainty.BOUNDED: 'bounded'>, 99)

The names:

    identifiability, identifiabilities, IDENTIFIABILITY   of one chain, of many; the question
    Identifiability, Level           the answer; global, local, .. of a parameter
    Combination, Formula, Renaming   what is determined; a term of it; exchanges of parameters
    Alternative, Origin              another set of parameters; where it comes from
    ParameterIdentifiability, by_parameter   the level of each parameter of any model
    Local, local, joint              ranks of the Jacobian; the certainty of several statements
    confirms                         check an answer again
    in_names_of, encode, decode      in other names; as text and back
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.decide.identifiability.analysis import (
        IDENTIFIABILITY as IDENTIFIABILITY,
        identifiabilities as identifiabilities,
        identifiability as identifiability,
        in_names_of as in_names_of,
    )
    from disting.decide.identifiability.answer import Identifiability as Identifiability
    from disting.decide.identifiability.check import confirms as confirms
    from disting.decide.identifiability.levels import (
        Local as Local,
        ParameterIdentifiability as ParameterIdentifiability,
        by_parameter as by_parameter,
        decode as decode,
        encode as encode,
        joint as joint,
        local as local,
    )
    from disting.decide.identifiability.parts import (
        Alternative as Alternative,
        Combination as Combination,
        Formula as Formula,
        Level as Level,
        Origin as Origin,
        Renaming as Renaming,
    )

offer(__name__)
