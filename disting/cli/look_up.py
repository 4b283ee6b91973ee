"""What the shipped catalogues hold on two chains: a look-up, which needs nothing that decides."""

from collections.abc import Sequence
from dataclasses import replace

from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.cli.compare_words import Known
from disting.model.chain import Chain, Sensor
from disting.model.names import name_of, names_of, read
from disting.verdict.query import Query
from disting.verdict.result import Verdict


def look_up(chains: Sequence[Chain], asked: Query) -> Verdict | None:
    """The stored verdict on two chains of a shipped catalogue, if all conditions may decide, under
    their whole names.
    """
    left, right = sorted((read(name_of(chain)) for chain in chains), key=lambda n: n.number)
    a, b = chains
    stored = (
        a.n_masses == b.n_masses in SHIPPED_SIZES
        and a.damped == b.damped
        and a.sensor is b.sensor is Sensor.ACCELERATION
        and left.is_plain
        and right.is_plain
        and left != right
        and asked == Query(asked.view)
    )
    if not stored:
        return None
    verdict = catalog(a.n_masses, damped=a.damped).verdict(left.number, right.number, asked.view)
    return replace(verdict, left=str(left), right=str(right))


def in_order(chains: Sequence[Chain], verdict: Verdict) -> list[Chain]:
    """The chains in the order of their verdict: a stored one names the model of the lower number
    first.
    """
    turned = verdict.left != names_of(chains[0], chains[1])[0]
    return list(reversed(chains)) if turned else list(chains)


def shipped_ranks(chains: Sequence[Chain]) -> tuple[Known, ...] | None:
    """How much of two chains is determined, as their catalogues have it; None if none tells of
    them.
    """
    a, b = chains
    if not all(_is_shipped(chain) for chain in chains):
        return None
    records = (catalog(c.n_masses, damped=c.damped).record(read(name_of(c)).number) for c in chains)
    named = zip(names_of(a, b), records, strict=True)
    return tuple((name, r["rank"], len(r["parameters"])) for name, r in named)


def _is_shipped(chain: Chain) -> bool:
    """Whether a catalogue tells of it."""
    plain = replace(chain, ground_dampers=(), lag=False, dead_time=False) == chain
    acceleration = chain.sensor is Sensor.ACCELERATION
    return plain and acceleration and chain.n_masses in SHIPPED_SIZES
