"""Equivalent models with their values: what else a measured system could be, as numbers and as
formulas.

>>> from disting.equivalence import equivalents, explicit_map, gate
>>> values = {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 50, "d12": "0.1", "d23": "0.3"}
>>> found = equivalents("3:1", values, "3:11")  # Equivalents, a Listing for each structure
>>> (member,) = found.listings[0].members
>>> member.text["m1"], member.signs.value, member.origin.value  # of Signs, Origin
('4.8', 'positive', 'duality theorem')
>>> str(explicit_map("3:1", "3:11").at(values)["m1"])  # of a Map
'24/5'

Before many candidates are fitted a Gate tells which are equivalent:

>>> from disting import network_of
>>> gate([network_of("R0-p(R1,C1)"), network_of("p(R0,R1-C1)")]).kept
('R0-p(R1,C1)',)

The names:

    equivalents            all parameters of other models with the same transfer function
    Equivalents, Listing   its answer; the part on one structure, `among` says which were searched
    ModelEquivalent        its answer on a network or a model with formulas
    Equivalent             one set of parameters
    Signs, Origin, NONE    signs of its values; where it comes from; the text for an empty listing
    chains_of              the structures that a text such as "3:11" or "3" means
    assignments            values from texts such as "m1=1,k12=3/4"
    explicit_map, Map      formulas for equivalent parameters
    gate, Gate             which of many models are worth a fit
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.equivalence.any_model import equivalents as equivalents
    from disting.equivalence.duplicates import Gate as Gate, gate as gate
    from disting.equivalence.inputs import assignments as assignments, chains_of as chains_of
    from disting.equivalence.listing import (
        NONE as NONE,
        Equivalent as Equivalent,
        Equivalents as Equivalents,
        Listing as Listing,
        Origin as Origin,
        Signs as Signs,
        among as among,
    )
    from disting.equivalence.maps import Map as Map, explicit_map as explicit_map
    from disting.verdict.model_equivalents import ModelEquivalent as ModelEquivalent

offer(__name__)
