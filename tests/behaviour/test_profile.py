"""Profiles: against the oracle's ranks and row sets, their proven zeros, error bounds and JSON
text.
"""

from dataclasses import replace
from itertools import combinations
from math import ceil, comb, log2

import pytest
from hypothesis import given, settings, strategies as st

from disting import Chain, Engine, Family, Settings
from disting.algebra.certainty import Size, prime, safety
from disting.algebra.matroid import rank_in
from disting.algebra.symbols import coefficients
from disting.behaviour.chain_model import ChainModel, degrees, is_sign_free
from disting.behaviour.profile import (
    NoMatroid,
    from_samples,
    profile,
    profile_from_json,
    profile_to_json,
)
from disting.behaviour.sample import Representation, draw_point, samples
from disting.behaviour.transfer import expand
from tests.conditions.handmade import LARGE, SMALL, sample
from tests.laws.strategies import chains
from tests.oracles import sympy_twin as twin

TF, MARKOV = Representation
THREE = [*Family(3, damped=False), *Family(3, damped=True)]
ENGINE = Engine()
quick = settings(max_examples=25, deadline=None)


def of(chain, representation=TF, count=0, chosen=None):
    return profile(ChainModel(chain.structure), representation, count, chosen or Settings())


def written(structure):
    """Label -> coefficient as text, not normalised."""
    sides = zip("ba", expand(structure), strict=True)
    return {
        f"{letter}{i}": str(c)
        for letter, part in sides
        for i, c in enumerate(coefficients(part, "s"))
    }


def row_bases(p):
    """All sets of `rank` rows of full rank, from the canonical form of the matroid."""
    live = [i for i, free in enumerate(p.free) if free]
    return frozenset(
        rows for rows in combinations(live, p.rank) if rank_in(p.matroid, rows) == p.rank
    )


@pytest.mark.thin(6)
@pytest.mark.sampled(8)
@pytest.mark.parametrize("chain", THREE, ids=str)
@pytest.mark.parametrize(("representation", "count"), [(TF, 0), (MARKOV, 7)])
def test_three_mass_profiles_are_the_oracle_s(chain, representation, count):
    found, expected = (
        of(chain, representation, count),
        twin.summary(chain, representation.value, count),
    )
    assert found.free == tuple(bool(x) for x in expected.symbolic_form)
    assert found.rank == expected.rank
    assert row_bases(found) == expected.bases
    assert {i: int(v) for i, v in enumerate(found.constants) if v} == expected.constants
    if representation is TF:
        assert found.degrees == (
            expected.n_numerator - 1,
            len(expected.entries) - expected.n_numerator,
        )


@pytest.mark.full
def test_the_oracle_s_row_sets_are_many():
    """A test of the test above: uniform and other matroids occur."""
    sizes = {(p.rank, len(p.form), len(row_bases(p))) for p in map(of, THREE)}
    assert any(bases == comb(free, rank) > 1 for rank, free, bases in sizes)
    assert any(bases < comb(free, rank) for rank, free, bases in sizes)


# --- constants and proven zeros
# --------------------------------------------------------------------------------------


@quick
@given(chains(max_masses=5))
def test_proven_zeros_are_the_constant_coefficients(chain):
    """All constants of a chain are zeros, and all zeros are proven to be."""
    p = of(chain)
    assert p.proven_zeros == set(p.labels) - p.form
    assert set(p.constants) <= {"", "0"}


@quick
@given(chains(max_masses=5), st.integers(1, 10))
def test_proven_zeros_are_constant_markov_parameters(chain, count):
    p = of(chain, MARKOV, count)
    assert p.proven_zeros <= set(p.labels) - p.form
    assert set(p.constants) <= {"", "0"}


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    "chain", [*Family(2, damped=False), *Family(2, damped=True), *THREE], ids=str
)
def test_all_constant_markov_parameters_of_short_chains_are_proven(chain):
    """Longer ones may have a zero behind the first term: a free mass beside two ports far apart."""
    p = of(chain, MARKOV, 9)
    assert p.proven_zeros == set(p.labels) - p.form


def test_zeros_are_known_exactly_where_terms_may_cancel():
    """Without a gap, force and sensor references lie in one row with both signs: there the
    polynomials are written out.
    """
    whole = Chain(4, 1, 1, 3, 1, 3, damped=False).structure.united(
        Chain(4, 2, 1, 3, 1, 3, damped=False).structure
    )
    found, table = profile(ChainModel(whole), TF, 0, Settings()), written(whole)
    assert not is_sign_free(whole)
    assert (
        found.proven_zeros
        == {label for label, text in table.items() if text == "0"}
        == set(found.labels) - found.form
    )


def test_an_undamped_chain_has_every_other_markov_parameter_zero():
    p = of(Family(3, damped=False)[1], MARKOV, 8)
    assert p.form == {"G0", "G2", "G4", "G6", "G8"}
    assert p.proven_zeros == {"G1", "G3", "G5", "G7"}


def test_a_remote_sensor_answers_late():
    p = of(Family(3, damped=True)[3], MARKOV, 6)
    assert p.proven_zeros == {"G0", "G1"}
    assert p.form == {"G2", "G3", "G4", "G5", "G6"}


# --- points, primes and error bounds
# ---------------------------------------------------------------------------------


def test_more_points_give_the_same_profile_with_more_safety():
    base = of(Family(3, damped=True)[4])
    for points in (1, 2, 5):
        other = of(Family(3, damped=True)[4], chosen=Settings(points=points))
        assert replace(other, safety=base.safety) == base
        assert (other.safety > base.safety) == (points > 3)


@pytest.mark.thin(8)
@pytest.mark.parametrize("n_masses", [1, 2, 3, 5, 8, 12])
@pytest.mark.parametrize(("representation", "count"), [(TF, 0), (MARKOV, 12)])
def test_the_error_bound_is_below_one_in_a_billion_billions(n_masses, representation, count):
    chain = Chain(n_masses, meas_plus=n_masses, damped=True)
    assert of(chain, representation, count, Settings(subset_limit=0)).safety > 60


def test_statements_share_the_error_bound():
    """A union over 13 invariants and the rank, then over those of the matroid too."""
    chain = Family(4, damped=True)[23]
    without, with_matroid = (
        of(chain, chosen=Settings(subset_limit=limit)) for limit in (0, 30_000_000)
    )
    assert len(without.labels) == 13
    claims = len(list(with_matroid.matroid.dependences()))
    assert claims == 18
    alone = safety(ChainModel(chain.structure).minor_size(None), 3)
    assert (without.safety, with_matroid.safety) == (alone - 4, alone - ceil(log2(claims + 14)))


@quick
@given(chains(max_masses=4))
def test_minor_size_bounds_the_polynomials(chain):
    """Degree N + 1 and coefficients that sum to 2^(3 N + 4) at most, before normalisation."""
    pair, n = expand(chain.structure), chain.n_masses
    for part in pair:
        powers = [sum(monomial[1:]) for monomial in part.monoms()]
        assert max(powers) <= n + 1
        assert log2(sum(abs(int(c)) for c in part.coeffs())) <= 3 * n + 4


def test_minor_size_grows_with_all_that_it_should():
    small, large, lagged = (
        Chain(n, damped=True, lag=lag).structure for n, lag in ((2, False), (3, False), (2, True))
    )
    base = ChainModel(small).minor_size(None)
    for other in (
        ChainModel(large).minor_size(None),
        ChainModel(lagged).minor_size(None),
        ChainModel(small).minor_size(8),
    ):
        assert other.degree > base.degree
        assert other.bits > base.bits
    assert ChainModel(small).minor_size(9).degree > ChainModel(small).minor_size(8).degree
    assert base == Size(4 * 2 * 3, 4 * (2 * 11 + 3 + 1 + 3))
    assert ChainModel(small).minor_size(8) == Size(4 * 10 * 3, 4 * (10 * 11 + 5 + 1 + 3))


def test_one_special_point_among_others_does_no_harm():
    """What is not zero at any point is not zero; what is dependent at one point only is not
    dependent.
    """
    rows, special = [[1, 0], [0, 1], [1, 1]], [[1, 0], [0, 0], [1, 0]]
    names = ("b0", "b1", "b2")
    good, bad = (sample(r, [1, 2, 3], names, LARGE) for r in (rows, special))
    search = sample(rows, [1, 2, 3], names, SMALL)
    expected = from_samples(
        [good, good], [search], frozenset(), (2, 0), 0, 1, Size(4, 4), Settings()
    )
    assert (expected.rank, expected.free) == (2, (True, True, True))
    for seen in ([good, bad], [bad, good]):
        assert (
            from_samples(seen, [search], frozenset(), (2, 0), 0, 1, Size(4, 4), Settings())
            == expected
        )


def test_a_special_search_point_is_followed_by_another():
    """The dependence that only the first one shows is refuted; it counts among the statements
    that share the bound.
    """
    rows, parallel = (
        [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 2, 3]],
        [
            [1, 0, 0],
            [2, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
        ],
    )
    good, special = (
        sample(r, [1, 2, 3, 4], ("b0", "b1", "b2", "b3"), SMALL) for r in (rows, parallel)
    )
    seen = [sample(rows, [1, 2, 3, 4], good.labels, LARGE)] * 2

    def searched(*points):
        return from_samples(seen, points, frozenset(), (3, 0), 0, 1, Size(10, 20), Settings())

    assert searched(special, good).matroid == searched(good).matroid and isinstance(
        searched(special).matroid, NoMatroid
    )
    assert searched(special, good).safety <= searched(good).safety
    asked = iter([good, special])
    from_samples(seen, asked, frozenset(), (3, 0), 0, 1, Size(10, 20), Settings())
    assert next(asked) is special


def test_the_search_of_every_chain_with_dampers_ends():
    """The first search point of this one, among thousands, is special."""
    chain = Chain(5, 2, 2, 4, 2, 4, damped=True, ground_dampers=(1,))
    assert not isinstance(
        profile(ChainModel(chain.structure), Representation.MARKOV, 20, Settings()).matroid,
        NoMatroid,
    )


def test_constants_are_fractions_whatever_the_primes():
    primes, names = [prime("one"), LARGE, SMALL], ("b0", "b1")
    *seen, search = (sample([[1], [0]], [5, 2 * pow(3, -1, p)], names, p) for p in primes)
    found = from_samples(seen, [search], frozenset(), (1, 0), 0, 1, Size(4, 4), Settings())
    assert found.constants == ("", "2/3")


def test_points_and_primes_are_independent_of_each_other():
    structure = Family(3, damped=False)[1].structure
    seen = list(samples(ChainModel(structure), TF, 0, 4, "seed"))
    assert len({s.modulus for s in seen}) == 4
    assert len({s.values for s in seen}) == 4
    assert all(s.modulus.bit_length() == 61 for s in seen)
    assert list(samples(ChainModel(structure), TF, 0, 2, "seed")) == seen[:2]
    assert next(samples(ChainModel(structure), TF, 0, 1, "other")) != seen[0]


# --- summaries that are exhaustive, limits, JSON
# ---------------------------------------------------------------------


def test_coefficients_are_exhaustive_and_markov_parameters_where_they_count_the_states():
    two, three = Chain(2, damped=True), Chain(3, damped=True, lag=True)
    assert of(two).describes_all(of(three))
    assert of(two, MARKOV, 11).describes_all(of(three, MARKOV, 11))
    assert not of(two, MARKOV, 10).describes_all(of(three, MARKOV, 10))


def test_a_limit_leaves_the_matroid_out_and_nothing_else():
    chain = Family(3, damped=True)[1]
    limited = of(chain, chosen=Settings(subset_limit=3))
    assert isinstance(limited.matroid, NoMatroid)
    full = of(chain)
    assert replace(limited, matroid=full.matroid, safety=full.safety) == full


@quick
@given(chains(dead_time=True))
def test_json_text_gives_the_profile_back(chain):
    for representation, count in ((TF, 0), (MARKOV, 6)):
        p = of(chain, representation, count, Settings(subset_limit=50))
        assert profile_from_json(profile_to_json(p)) == p
        assert hash(profile_from_json(profile_to_json(p))) == hash(p)


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"representation": "tf"}', '{"representation": "other", "labels": []}'],
)
def test_other_text_is_no_profile(text):
    with pytest.raises((ValueError, KeyError, TypeError)):
        profile_from_json(text)


def test_symmetric_chains_share_one_profile():
    left, right = (ENGINE.subject("", Family(3, damped=True)[i]) for i in (2, 5))
    assert left.chain != right.chain
    assert left.profile(TF, 0) is right.profile(TF, 0)


# --- degrees
# ---------------------------------------------------------------------------------------------------------


@quick
@given(chains(max_masses=4), st.integers(0, 10**6))
def test_degrees_do_not_depend_on_the_luck_of_a_point(chain, seed):
    """Modulo primes of 9 bits special points are frequent: they are drawn again, so the degrees
    are always the generic ones.
    """
    table = written(replace(chain, dead_time=False).structure)
    expected = tuple(
        max(int(x[1:]) for x, text in table.items() if x[0] == letter and text != "0")
        for letter in "ba"
    )
    assert degrees(chain.structure) == expected
    where = draw_point(ChainModel(chain.structure), f"small:{seed}", 9)
    assert (where.quotients[0].num.degree(), where.quotients[0].den.degree()) == expected
