"""The profile of one model in one representation: all that conditions 1 to 5 and 7 need, computed
once.

A profile is small, hashable data. Pairs are compared through profiles, so a family costs one
profile a model, and models with equal profiles form buckets.
"""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields, replace
from functools import lru_cache
from itertools import chain
from math import ceil, log2
from typing import Any

from disting.algebra.certainty import SEARCH_BITS, Size, enough, safety
from disting.algebra.matroid import Component, Matroid, SearchTooLargeError, matroid
from disting.algebra.quotient import Quotient, rational, series_rows
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.sample import (
    DrawnPoint,
    Representation,
    Sample,
    draw_point,
    samples,
    seen_at,
)
from disting.model.chain import Structure
from disting.model.protocol import Model
from disting.model.question import Settings

REMEMBERED = 64
SEARCHES = 3  # points modulo 31 bits: with thousands of models one is special now and then


@dataclass(frozen=True, slots=True)
class NoMatroid:
    """A matroid that was not computed, and why."""

    reason: str


@dataclass(frozen=True, slots=True)
class Profile:
    """Properties of one model in one representation.

    `labels` of the moment invariants; `free` marks the non-constant ones; `constants` holds the
    values of the others ("" where free); `degrees` (numerator, denominator) of (25), of several
    transfer functions one pair after the other, (-1, 0) for one that is zero; `count` of Markov
    parameters (0 for transfer functions); `rank` = number of determinable parameters. The degrees,
    that the invariants in `proven_zeros` vanish, that free ones are free and, with `rank_proven`,
    the rank hold without any error probability; all else is wrong with a probability of at most
    2**-safety, over the choice of the random points. A rank found at a point is a lower bound; it
    is proven where it is the number of parameters, or that of the rows that vary, all others being
    proven constant.
    """

    representation: Representation
    labels: tuple[str, ...]
    free: tuple[bool, ...]
    constants: tuple[str, ...]
    degrees: tuple[int, ...]
    count: int
    n_states: int
    n_parameters: int
    rank: int
    matroid: Matroid | NoMatroid
    proven_zeros: frozenset[str]
    rank_proven: bool
    safety: int

    @property
    def form(self) -> frozenset[str]:
        """Symbolic form: the labels of the non-constant invariants."""
        return frozenset(label for label, free in zip(self.labels, self.free, strict=True) if free)

    def describes_all(self, other: "Profile") -> bool:
        """Return True if both summaries together are exhaustive: N_S1 + N_S2 Markov parameters
        (section 4.3), or any coefficients.
        """
        return (
            self.representation is Representation.TF or self.count >= self.n_states + other.n_states
        )


@lru_cache(maxsize=REMEMBERED)
def profile(
    model: Model, representation: Representation, count: int, settings: Settings
) -> Profile:
    """Profile from `settings.points` random points, or as many as it takes, with large primes,
    and one with a small prime.
    """
    markov = count if representation is Representation.MARKOV else None
    size, constants = model.minor_size(markov), model.constants(markov)
    points = enough(size, settings.points)
    drawn = list(samples(model, representation, count, points, settings.seed))
    searches = (
        seen_at(draw_point(model, label, SEARCH_BITS), representation, count)
        for label in search_labels(settings.seed)
    )
    settings = replace(settings, subset_limit=min(settings.subset_limit, model.most_subsets))
    degrees = tuple(chain.from_iterable(model.degrees))
    sampled = from_samples(
        drawn, searches, frozenset(constants), degrees, count, model.n_states, size, settings
    )
    values = zip(sampled.labels, sampled.constants, strict=True)
    return replace(
        sampled,
        representation=representation,
        constants=tuple(constants.get(name, value) for name, value in values),
        safety=sampled.safety - model.lost_bits * points,
    )


def inverse_profile(structure: Structure, count: int, settings: Settings) -> Profile:
    """Profile of the Markov parameters H_0..H_count of 1/G: another summary of the same behaviour,
    whose dependences separate models that those of G do not; a dead time is left out.

    s^-k/G = H_0 + H_1/s + H_2/s^2 + .., k = deg den - deg num (25). The H_i are fixed rational
    functions of the transfer function's coefficients, so models with equal closures of their images
    have equal closures in these coordinates too: equal ranks of all sets of rows, as condition 5
    has it for G. H_i is a polynomial over power i + 1 of the numerator's leading coefficient, as
    G_i is over that of the denominator's, so the bounds of the minors are those of G.
    """
    model = ChainModel(structure)
    size = model.minor_size(count)
    seed = f"{settings.seed}:inverse"
    points = range(enough(size, settings.points))
    drawn = [_inverse_at(draw_point(model, f"{seed}:{k}"), count) for k in points]
    searches = (
        _inverse_at(draw_point(model, label, SEARCH_BITS), count) for label in search_labels(seed)
    )
    return from_samples(drawn, searches, frozenset(), (0, 0), count, model.n_states, size, settings)


def _inverse_at(where: DrawnPoint, count: int) -> Sample:
    """The Markov parameters of den / (s^k num)."""
    (q,) = where.quotients
    assert q is not None  # of a chain
    k = q.den.degree() - q.num.degree()
    lifted = tuple(p.left_shift(k) for p in q.num_derivatives)
    turned = Quotient(q.den, q.num.left_shift(k), q.den_derivatives, lifted)
    values, rows = series_rows(turned, count)
    labels = tuple(f"H{i}" for i in range(count + 1))
    return Sample(labels, tuple(values), tuple(map(tuple, rows)), len(where.point), where.modulus)


def search_labels(label: str) -> Iterator[str]:
    """Yield labels of the points at which dependences are searched, one after another while
    they are special.
    """
    for attempt in range(SEARCHES):
        yield f"{label}:search{f':{attempt}' if attempt else ''}"


def from_samples(
    seen: Sequence[Sample],
    searches: Iterable[Sample],
    proven: frozenset[str],
    degrees: tuple[int, ...],
    count: int,
    n_states: int,
    size: Size,
    settings: Settings,
) -> Profile:
    """Profile of a summary known through samples; `proven` are the labels that are proven to be
    constant.

    Dependences are searched at the first of `searches` that is not special, according to `seen`;
    the others are not searched.
    """
    labels = seen[0].labels
    free = tuple(any(any(s.rows[i]) for s in seen) for i in range(len(labels)))
    constants = tuple(
        "" if free[i] else rational(seen[0].values[i], seen[0].modulus) for i in range(len(labels))
    )
    everything = tuple(range(len(labels)))
    rank = max(s.rank(everything) for s in seen)
    shape, claims = _matroid(seen, searches, rank, settings.subset_limit)
    return Profile(
        representation=Representation.MARKOV
        if labels[:1] and labels[0][0] == "G"
        else Representation.TF,
        labels=labels,
        free=free,
        constants=constants,
        degrees=degrees,
        count=count,
        n_states=n_states,
        n_parameters=seen[0].n_parameters,
        rank=rank,
        matroid=shape,
        proven_zeros=proven,
        rank_proven=rank == seen[0].n_parameters
        or (rank == sum(free) and _constants_known(labels, free, proven)),
        safety=safety(size, len(seen)) - ceil(log2(claims + len(labels) + 1)),
    )


def _constants_known(labels: Sequence[str], free: Sequence[bool], proven: frozenset[str]) -> bool:
    """Return True if all rows that look constant are proven constant: then at most the free rows
    can be independent.
    """
    return all(
        is_constant or label in proven for label, is_constant in zip(labels, free, strict=True)
    )


def _matroid(
    seen: Sequence[Sample], searches: Iterable[Sample], rank: int, limit: int
) -> tuple[Matroid | NoMatroid, int]:
    """Matroid at a search point with each dependence confirmed at all points, and the number of
    statements that were tried.

    What was refuted counts too: each statement had its chance to be confirmed wrongly.
    """
    claims = 0
    for search in searches:
        try:
            shape = matroid(search.jacobian, limit)
        except SearchTooLargeError as reason:
            return NoMatroid(f"more than {limit:,} sets of coefficients to look at: {reason}"), 0
        statements = list(shape.dependences())
        claims += len(statements)
        if shape.rank == rank and not any(
            s.rank(rows) > bound for s in seen for rows, bound in statements
        ):
            return shape, claims
    return NoMatroid("every search point was special; choose another seed"), 0


def profile_to_json(profile: Profile) -> str:
    """Compact JSON text of a profile: what a cache keeps. Never pickled, so that a foreign file can
    do no harm.
    """
    data = {f.name: getattr(profile, f.name) for f in fields(profile)} | {
        "proven_zeros": sorted(profile.proven_zeros)
    }
    data["matroid"] = (
        asdict(profile.matroid)
        if isinstance(profile.matroid, NoMatroid)
        else _plain(profile.matroid)
    )
    return json.dumps(data, separators=(",", ":"))


def profile_from_json(text: str) -> Profile:
    """Inverse of `profile_to_json`; raises ValueError, KeyError or TypeError for what is none."""
    data = json.loads(text)
    return Profile(
        **data
        | {
            "representation": Representation(data["representation"]),
            "labels": tuple(data["labels"]),
            "free": tuple(data["free"]),
            "constants": tuple(data["constants"]),
            "degrees": tuple(data["degrees"]),
            "matroid": _read_matroid(data["matroid"]),
            "proven_zeros": frozenset(data["proven_zeros"]),
        }
    )


def _plain(m: Matroid) -> dict[str, Any]:
    components = [
        {"rows": c.rows, "rank": c.rank, "dual": c.dual, "flats": c.flats} for c in m.components
    ]
    return {"size": m.size, "rank": m.rank, "components": components}


def _read_matroid(data: dict[str, Any]) -> Matroid | NoMatroid:
    if "reason" in data:
        return NoMatroid(data["reason"])
    return Matroid(data["size"], data["rank"], tuple(_component(c) for c in data["components"]))


def _component(data: dict[str, Any]) -> Component:
    flats = tuple((tuple(rows), rank) for rows, rank in data["flats"])
    return Component(tuple(data["rows"]), data["rank"], data["dual"], flats)
