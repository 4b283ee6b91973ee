"""Bounded verdicts proven afterwards: what is proven is true, and what is not true is never
proven.
"""

from dataclasses import replace

import pytest
import sympy

from disting import (
    Certainty,
    Engine,
    Family,
    MatrixModel,
    Model,
    Query,
    View,
    compare,
    local_identifiability,
    network_of,
)
from disting.algebra.determinants import OutOfTimeError, rank
from disting.algebra.symbols import symbols
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.behaviour.transfer import coefficients_have_rank, rank_is_at_most
from disting.general.any_model import of_network
from disting.model.question import Settings
from disting.verdict.comparison import prove, prove_all


def decided(n, damped):
    engine = Engine()
    return engine.decisions(
        [engine.subject(f"A{i}", c) for i, c in enumerate(Family(n, damped), 1)], Query()
    )


@pytest.mark.sampled(5)
@pytest.mark.full
@pytest.mark.parametrize("size", [(1, 3), (2, 2), (3, 2), (2, 3)])
@pytest.mark.parametrize("rank_below", [0, 1])
def test_rank_agrees_with_sympy(size, rank_below):
    """Products of random matrices of linear forms have the rank of the thinner one."""
    m, n = size
    inner = max(1, min(m, n) - rank_below)
    x, y, z = symbols(["x", "y", "z"]).values()
    forms = [x + 2 * y, y - z, 3 * x, x * y + z, z + 1, x - y, y * y, 2 * z - x]
    left = [[forms[(3 * i + j) % 8] for j in range(inner)] for i in range(m)]
    right = [[forms[(5 * i + 3 * j + 1) % 8] for j in range(n)] for i in range(inner)]
    product = [
        [sum((left[i][k] * right[k][j] for k in range(inner)), 0 * x) for j in range(n)]
        for i in range(m)
    ]
    oracle = sympy.Matrix(
        m, n, [sympy.sympify(str(e).replace("^", "**")) for row in product for e in row]
    )
    assert rank(product, 10.0) == oracle.rank(simplify=True)


def test_rank_of_nothing_and_out_of_time():
    x, y = symbols(["x", "y"]).values()
    assert rank([], 1.0) == rank([[x - x, x - x]], 1.0) == 0
    with pytest.raises(OutOfTimeError, match="more than 0 s"):
        rank([[x, y], [y, x]], 0.0)


@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), [(2, True), (3, False), (3, True), (4, False)])
def test_proven_ranks_are_the_sampled_ones(n, damped):
    for chain in Family(n, damped):
        found = profile(ChainModel(chain.structure), Representation.TF, 0, Settings()).rank
        assert rank_is_at_most(chain.structure, (), found, 20.0)
        assert not rank_is_at_most(chain.structure, (), found - 1, 20.0)


@pytest.mark.full
@pytest.mark.parametrize(
    "model", [3, *(pytest.param(i, marks=pytest.mark.slow) for i in (1, 7, 9))]
)
def test_markov_ranks_are_proven_too(model):
    structure = Family(3, damped=True)[model].structure
    labels = tuple(f"G{k}" for k in range(1, 13))
    seen = profile(ChainModel(structure), Representation.MARKOV, 12, Settings())
    positions = tuple(i for i, label in enumerate(seen.labels) if label != "G0")
    assert len(positions) == 12
    for count in (3, 12):
        some = labels[:count]
        known = (
            rank([[*row] for row in _oracle_rows(structure, some)], 60.0) if count == 3 else None
        )
        if known is not None:
            assert rank_is_at_most(structure, some, known, 20.0) and not rank_is_at_most(
                structure, some, known - 1, 20.0
            )
    assert rank_is_at_most(structure, labels, seen.rank, 20.0)


def _oracle_rows(structure, labels):
    """Gradients of Markov parameters by SymPy, as polynomials after clearing denominators."""
    from disting.behaviour.transfer import expand

    whole = expand(structure)
    s = sympy.Symbol("s")
    num, den = (sympy.Poly(sympy.sympify(str(p).replace("^", "**")), s) for p in whole)
    m, lead, a = den.degree(), den.LC(), den.all_coeffs()
    b = [0] * (m - num.degree()) + num.all_coeffs()
    g = []
    for k in range(len(labels) + 1):
        top = b[k] if k <= m else 0
        g.append((top - sum(a[i] * g[k - i] for i in range(1, min(k, m) + 1))) / lead)
    names = structure.parameters
    ring = symbols(list(names))
    for label in labels:
        row = [sympy.together(sympy.diff(g[int(label[1:])], name)) for name in names]
        common = sympy.lcm_list([sympy.denom(e) for e in row])
        yield [_poly(sympy.expand(sympy.cancel(e * common)), ring) for e in row]


def _poly(expression, ring):
    one = next(iter(ring.values())) ** 0
    return eval(str(expression).replace("^", "**"), {}, dict(ring)) * one


@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "damped"), [(3, False), (3, True), pytest.param(4, False, marks=pytest.mark.slow)]
)
def test_every_rank_verdict_of_these_classes_is_proven(n, damped):
    before = decided(n, damped)
    after = prove_all(before)
    for i, j, rule, _, certainty, safety in after.grades():
        assert after.relation(i, j) is before.relation(i, j)
        if rule in ("4", "5"):
            assert (certainty, safety) == (Certainty.PROVEN, 0)
            assert after.verdict(i, j).certainty is Certainty.PROVEN
            assert after.verdict(i, j).evidence == before.verdict(i, j).evidence


def test_nothing_is_raised_without_a_proof():
    family = Family(3, damped=True)
    bounded = compare(family[1], family[7])
    assert prove(bounded, family[1], family[7], seconds=0.0) == bounded
    exact = compare(family[1], family[6])
    assert exact.decided_by == "exact" and prove(exact, family[1], family[6]) == exact
    open_pair = compare(family[1], family[11], query=Query(View.COMBINED))
    assert prove(open_pair, family[1], family[11]) == open_pair


MODELS = [
    Model.from_state_space([["-k12-k01", "k21"], ["k12", "-k21-k02"]], [1, 0], [1, 0]),
    Model.from_transfer_function("(a+b)*s + c", "(s + a + b)*(s + c*d)"),
    MatrixModel.from_state_space(
        [["-k12-k01", "k21"], ["k12", "-k21-k02"]], [1, 0], [[1, 0], [0, 1]]
    ),
    of_network(network_of("R0-p(R1,C1)-R2")),
]


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_ranks_of_general_models_are_the_sampled_ones(model):
    entries = [(e.numerator, e.denominator) for e in model.entries]
    found = local_identifiability(model).rank
    assert coefficients_have_rank(entries, model.parameters, (), found, 20.0)
    assert not coefficients_have_rank(entries, model.parameters, (), found - 1, 20.0)


def test_general_models_are_proven_apart_by_their_ranks():
    """b1, b0 and a0 of the first one obey an equation, of the second one none."""
    less = Model.from_transfer_function("a*c*s + a*c*b", "s**2 + b*s + b**2", name="less")
    more = Model.from_transfer_function("a*s + c", "s**2 + b*s + d", name="more")
    asked = Query(View.COMBINED, ("4",))
    found = compare(less, more, query=asked)
    assert found.certainty is Certainty.BOUNDED
    assert prove(found, less, more).certainty is Certainty.PROVEN
    turned = replace(found, evidence=replace(found.evidence, left=1))
    assert prove(turned, less, more).certainty is Certainty.BOUNDED  # the rank is 2, not 1
