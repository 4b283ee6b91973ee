"""General parametric models: any rational transfer functions with parameters, with one input and
one output or with several, compared as chains are.

>>> from disting import Model, alternatives
>>> from disting.general.any_model import as_chain, unnamed
>>> lag = Model.from_transfer_function("k", "T*s + 1", name="lag")
>>> other = Model.from_transfer_function("a", "b*s + c", name="other")
>>> found = alternatives(lag, {"k": 2, "T": 3}, other)
>>> found.extent.value, len(found.equivalents)  # of Extent, each an Equivalent
('family', 3)
>>> unnamed(lag) == unnamed(Model.from_transfer_function("k", "1 + T*s")), as_chain(lag)
(True, None)

What data determine of one of them, a GlobalIdentifiability and a LocalIdentifiability:

>>> from disting import global_identifiability, local_identifiability
>>> global_identifiability(other).sentence
'3 parameters, only 2 determinable: a/b, c/b.'
>>> local_identifiability(other).rank
2

Evidence of a verdict is found again, as `disting.verify` does: Witnesses by
`model_evidence.confirms`, formulas by `is_explicit`, that there are none by `is_without`:

>>> from disting import compare
>>> from disting.general.formulas import is_explicit
>>> is_explicit(compare(lag, other).evidence, lag, other)
True
"""
