"""Pairs of models that the laws are about, and what the laws ask of them."""

from dataclasses import replace
from functools import cache
from itertools import combinations

from hypothesis import example, settings, strategies as st

from disting import Chain, Engine, Family, Query, View, compare
from disting.decide.same.evidence_check import Witness
from disting.verdict.cascade import audit, decide
from tests.laws.strategies import chains

ENGINE = Engine()
# the exact decision of ground dampers is slow: it has laws of its own in test_exact_laws.py
PAPER = Query(View.COMBINED)
WITNESS = Witness()
BY_CONDITIONS = (View.TF, View.MARKOV, View.COMBINED)
SMALL = [(n, damped) for n in (1, 2, 3, 4) for damped in (False, True)]
often = settings(max_examples=60, deadline=None)
quick = settings(max_examples=25, deadline=None)


def verdict(left, right, query=PAPER, engine=ENGINE):
    return compare(left, right, query=query, engine=engine)


def subject(chain, engine=ENGINE):
    return engine.subject(str(chain), chain)


@cache
def family(n_masses, damped):
    return [ENGINE.subject(f"A{i}", chain) for i, chain in enumerate(Family(n_masses, damped), 1)]


@st.composite
def similar_pairs(draw, max_masses=3):
    """Two chains of one size and kind, so that the first conditions seldom decide."""
    n = draw(st.integers(1, max_masses))
    left, right = draw(chains(n, n)), draw(chains(n, n))
    return left, replace(right, quantity=left.quantity, lag=left.lag, damped=left.damped)


@st.composite
def damper_pairs(draw):
    """One chain of three masses with two sets of ground dampers, where conditions 8 and 9 apply."""
    chain, masses = draw(chains(3, 3)), draw(st.sets(st.integers(1, 3)))
    return chain, replace(chain, ground_dampers=tuple(masses))


any_pair = st.one_of(st.tuples(chains(), chains()), similar_pairs(), damper_pairs())
EXAMPLES = [
    (Chain(2, damped=False), Chain(3, meas_plus=3, damped=False)),  # condition 2
    (Family(3, damped=False)[9], Family(3, damped=False)[10]),  # 6
    (Chain(1, damped=False), Chain(1, damped=True)),  # 6, no symmetry
    (Family(4, damped=False)[11], Family(4, damped=False)[13]),  # 7
    # 8
    (
        Chain(2, 1, 1, 2, 1, 2, ground_dampers=(1,), damped=False),
        Chain(2, 1, 1, 2, 1, 2, ground_dampers=(1,), damped=True),
    ),
    tuple(Chain(3, 2, 1, 3, 2, 3, damped=True, ground_dampers=(i,)) for i in (1, 2)),  # 9
    (Family(3, damped=True)[1], Family(3, damped=True)[4]),  # 5 on Markov parameters
    (Chain(1, damped=False), Chain(1, dead_time=True, damped=False)),  # 3
    # undecided
    (Chain(2, damped=True, ground_dampers=(1,)), Chain(2, damped=True, ground_dampers=(2,))),
]


def with_examples(test):
    for pair in EXAMPLES:
        test = example(pair=pair)(test)
    return test


def audited(subjects, query):
    for left, right in combinations(subjects, 2):
        assert audit(left, right, query) == decide(left, right, query)
