"""A page where two machines of a catalogue move side by side under one force.

The page computes everything itself: the parameters of the second machine from those of the first,
both motions and both Bode diagrams (templates motion-*.js). It is given what it cannot work out:
the models, the verdicts over positive parameters, and the parts of the drawings.
"""

from itertools import cycle, islice

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.evidence.positive import Share
from disting.model.chain import Chain
from disting.report.describe_machine import parts_of
from disting.report.domains import one_sided_pairs, with_exceptions
from disting.report.drawing import JOINT, MASS, PITCH, WALL, draw
from disting.report.environment import render
from disting.report.model import folder_of, ways
from disting.report.page_drawing import share
from disting.report.payload import script_json
from disting.report.words import short_title
from disting.verdict.query import View
from disting.verdict.result import Relation

# of the machine that is shown first [kg, N/m, N s/m]: modes of about 1 Hz, which the eye follows,
# damped by some percent; no two springs have one ratio k/d, which would make more models equivalent
START = {
    "m": (1.0, 2.0, 1.5, 0.8, 1.2),
    "k": (90.0, 150.0, 60.0, 120.0, 75.0, 105.0),
    "d": (0.6, 0.25, 0.9, 0.4, 0.7, 0.5),
    "i": (2.0, 1.5, 3.0),  # ratios of gears
}


def motion_page(catalog: Catalog) -> str:
    """HTML of the page of a catalogue with two models or more."""
    first = first_pair(catalog)
    return render(
        "motion.html",
        family=short_title(catalog),
        back=f"{catalog.name}.html",
        site=True,
        members=[tuple(f"A{i}" for i in group) for group in catalog.classes()],
        parts=share((), parts_of(catalog.family)),
        payload=_payload(catalog, first),
    )


def first_pair(catalog: Catalog) -> tuple[int, int]:
    """The pair that is shown first: two that cannot be told apart, where there are any.

    >>> from disting.catalogs import catalog
    >>> first_pair(catalog(3, damped=True))
    (1, 11)
    """
    groups = catalog.classes()
    return (groups[0][0], groups[0][1]) if groups else (1, 2)


def start_values(chain: Chain) -> tuple[float, ...]:
    """Positive parameters of a chain as it is shown first, in their order [kg, N/m, N s/m].

    >>> start_values(Chain(2, 1, 1, 2, 1, 2, damped=True))
    (1.0, 2.0, 90.0, 0.6)
    """
    places = {kind: list(islice(cycle(of), chain.n_masses)) for kind, of in START.items()}
    elements = chain.structure.elements
    return tuple(places[e.kind][e.at - (e.kind == "m")] for e in elements)


def _payload(catalog: Catalog, first: tuple[int, int]) -> Markup:
    """JSON of models, start values and verdicts; a pair that is not named is distinguishable."""
    scene = draw(catalog.family[1])
    return script_json(
        {
            "folder": folder_of(catalog),
            "masses": catalog.n_masses,
            "damped": catalog.damped,
            "order": catalog.family[1].sensor.order,
            "drawing": {
                "size": [scene.width, scene.height],
                "wall": WALL,
                "pitch": PITCH,
                "joint": JOINT,
                "mass": MASS,
            },
            "models": [chain.indices[1:] for chain in catalog.family],
            "values": [start_values(chain) for chain in catalog.family],
            "first": first,
            "groups": catalog.classes(),
            "aside": list(with_exceptions(catalog, View.POSITIVE)),
            "able": _able(catalog),
            "open": [
                (low, high)
                for low, high, v in catalog.pairs(View.POSITIVE)
                if v.relation is Relation.UNDECIDED
            ],
        }
    )


def _able(catalog: Catalog) -> list[tuple[int, int, Share]]:
    """(given, other, share): how many positive models of `number` have a positive equivalent in
    `other`, of the pairs that are neither always nor never told apart.
    """
    pairs = [(case.given, case.other, case.share) for case in one_sided_pairs(catalog)]
    for low, high in catalog.depending():
        for number, other in ((low, high), (high, low)):
            way = ways(number, other, catalog.verdict(low, high, View.POSITIVE))[0]
            pairs.append((number, other, Share.UNKNOWN if way is None else way.share))
    return pairs
