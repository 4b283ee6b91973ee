"""The sentence for who measures, against what the curves do in numbers."""

import math
import re
from dataclasses import replace
from functools import cache

import pytest
import sympy

from disting import Family, Query, View, catalog, compare, transfer_function
from disting.conditions.inclusion import Inclusion
from disting.conditions.rule import EXACT
from disting.evidence.conditions import Counts, Ranks
from disting.experiments.experiment import Experiment
from disting.model.names import chain_of
from disting.verdict.meaning import meaning_sentence
from disting.verdict.result import Relation

SIZES = [(n, damped) for n in (2, 3) for damped in (False, True)]


@cache
def fall(chain):
    """dB by which |G| falls in the decade above 10^7 rad/s, elements 1."""
    g = transfer_function(chain)
    g = g.subs({symbol: 1 for symbol in g.free_symbols if symbol.name != "s"})
    at = [abs(complex(g.subs("s", 1j * omega))) for omega in (10**7, 10**8)]
    return -20 * math.log10(at[1] / at[0])


@pytest.mark.thin(1)
@pytest.mark.parametrize(("n", "damped"), SIZES)
def test_the_steeper_curve_is_steeper(n, damped):
    family, told = Family(n, damped=damped), 0
    for left, right, verdict in catalog(n, damped=damped).pairs(View.POSITIVE):
        if isinstance(verdict.evidence, Counts):
            said = re.match(
                r"Towards .* of (\d+:\d+) falls by (\d+) dB a decade more than that of (\d+:\d+): \3 has"
                r" (one|\d+) zeros? more",
                meaning_sentence(verdict),
            )
            steep, flat = (family[int(said[at].partition(":")[2])] for at in (1, 3))
            assert {steep, flat} == {family[left], family[right]}
            assert fall(steep) - fall(flat) == pytest.approx(float(said[2]), abs=0.01)
            assert int(said[2]) == 20 * (1 if said[4] == "one" else int(said[4]))
            told += 1
    assert told


@pytest.mark.parametrize(("n", "damped"), SIZES)
def test_every_pair_has_a_sentence_that_names_both(n, damped):
    for view in View:
        for _, _, verdict in catalog(n, damped=damped).pairs(view):
            said = meaning_sentence(verdict)
            assert said.endswith(".") and {verdict.left, verdict.right} <= set(
                re.findall(r"\d+:\d+", said)
            )
            assert said.startswith("Not known: ") == (verdict.relation is Relation.UNDECIDED)


def test_the_model_of_smaller_rank_satisfies_more_equations():
    seen = 0
    for _, _, verdict in catalog(3, damped=True).pairs(View.POSITIVE):
        if isinstance(verdict.evidence, Ranks):
            ranks = {verdict.left: verdict.evidence.left, verdict.right: verdict.evidence.right}
            fewer, count = re.search(
                r"very (\S+) response satisfies (an|\d+) equations?", meaning_sentence(verdict)
            ).groups()
            assert ranks[fewer] == min(ranks.values())
            assert abs(verdict.evidence.left - verdict.evidence.right) == (
                1 if count == "an" else int(count)
            )
            seen += 1
    assert seen


@pytest.mark.full
def test_an_equation_in_numbers():
    """3:7 has 6 of 7, 3:8 all 7: the coefficients of a 3:7 fulfil an equation that those of a 3:8
    do not; seen by the rank of their derivatives at one point each.
    """

    def rank(number):
        g = transfer_function(Family(3, damped=True)[number])
        top, bottom = sympy.fraction(sympy.cancel(g))
        s = next(symbol for symbol in g.free_symbols if symbol.name == "s")
        symbols = sorted(g.free_symbols - {s}, key=str)
        lead = sympy.LC(bottom, s)
        summary = [c / lead for p in (top, bottom) for c in sympy.Poly(p, s).all_coeffs()]
        point = dict(zip(symbols, sympy.primerange(100), strict=False))
        return sympy.Matrix(summary).jacobian(symbols).subs(point).rank()

    verdict = catalog(3, damped=True).verdict(7, 8)
    assert (rank(7), rank(8)) == (6, 7)
    assert "very 3:7 response satisfies an equation that a 3:8 response" in meaning_sentence(
        verdict
    )


@pytest.mark.parametrize(
    ("left", "right", "said"),
    [
        ("2:1+delay", "2:1", "the phase of 2:1+delay falls without an end"),
        ("2:1", "2:1+delay", "the phase of 2:1+delay falls without an end"),
        ("3:1", "2:1", "The response of 3:1 has 2 poles more."),
    ],
)
def test_other_evidence(left, right, said):
    chains = [chain_of(text, Family(1, damped=True)) for text in (left, right)]
    assert said in meaning_sentence(compare(*chains))


def test_an_error_is_promised_only_where_neither_is_a_limit_of_the_other():
    verdict = catalog(3, damped=True).verdict(1, 6)
    assert verdict.closure is Inclusion.NEITHER and "leaves an error" in meaning_sentence(verdict)
    for closure in set(Inclusion) - {Inclusion.NEITHER}:
        assert "error" not in meaning_sentence(replace(verdict, closure=closure))


def test_a_sensor_that_stands_still():
    chain = Family(2, damped=True)[1]
    verdict = compare(chain, chain, experiments=[(Experiment(locked=1), Experiment(locked=2))])
    assert verdict.relation is Relation.DISTINGUISHABLE
    assert re.search(
        r"sensor of .+ locked never moves, that of .+ locked does", meaning_sentence(verdict)
    )


TOO_LARGE = "compare smaller ones of the same kind"
REMEDIES = (TOO_LARGE, "remove --conditions", "'disting equivalents' with --set")
OPEN = [
    (("3:1", "3:11"), {"query": Query(View.COMBINED)}, "remove --conditions"),
    pytest.param(  # 20 s
        ("1=2=3=4=5=6, 3=7; F1; S1", "1=2=3=4=5=6, 2=7; F1; S1"),
        {},
        TOO_LARGE,
        marks=pytest.mark.slow,
    ),
    pytest.param(
        ("#~1, #~2, 1~2; F1; S2", "#~1, 1~2; F1; S2"),
        {},
        "'disting equivalents' with --set",
        marks=pytest.mark.slow,
    ),
]


@pytest.mark.thin(1)
@pytest.mark.parametrize(("models", "asked", "remedy"), OPEN)
def test_what_is_not_known_says_why_and_what_helps(models, asked, remedy):
    """Conditions that are silent, models that are too large, positive values alone that are open."""
    verdict = compare(*models, **asked)
    assert verdict.relation is Relation.UNDECIDED
    said = meaning_sentence(verdict)
    assert said.startswith("Not known: ") and all(name in said for name in models)
    assert remedy in said and sum(words in said for words in REMEDIES) == 1


def test_what_took_too_long_says_what_helps():
    silent = compare("3:1", "3:11", query=Query(View.COMBINED))
    late = replace(silent, notes=(f"{EXACT.in_words()} was abandoned: out of time (60 s)",))
    assert TOO_LARGE in meaning_sentence(late) and TOO_LARGE not in meaning_sentence(silent)
