"""Machine page: one model in any notation, what can be determined of it, what looks the same, what
to measure next.

The functions are those of the public API and of the command line; each answer has the command that
gives it too. They are several calls, so that the drawing need not wait for a decision.
"""

import shlex
from collections.abc import Iterator, Sequence
from itertools import cycle, islice

from disting.app.interface import Json
from disting.app.parts import parts_of, text_of
from disting.catalogs import lookalikes
from disting.catalogs.lookalikes import Lookalikes
from disting.catalogs.next_files import SHIPPED_SIZES as NEXT_SIZES, next_catalog
from disting.decide.identifiability import Identifiability
from disting.errors import InputError
from disting.experiments.experiment import Experiment, places_of
from disting.general.any_model import as_chain, as_model, of_network
from disting.general.identifiability import local_identifiability
from disting.general.matrix_model import AnyModel
from disting.model.chain import Chain, Sort
from disting.model.names import NAME, name_of, read, read_together
from disting.model.presentation import plural
from disting.network.chains import of_chain
from disting.network.network import Network
from disting.network.notation import network_of, notations_of, values_in
from disting.report.network_drawing import scene_of
from disting.report.scene import PAGE_PALETTE, Scene, body, number
from disting.store import Store
from disting.verdict.comparison import compare, identifiability
from disting.verdict.engine import Engine
from disting.verdict.identifiable import Identified
from disting.verdict.next_experiments import menu_for
from disting.verdict.next_words import AnyMenu, anywhere, conclusion, group_in_words
from disting.verdict.result import Relation

EXAMPLE = "write a machine such as 1=2=3; F1; S3, or a circuit such as R0-p(R1,C1)"
# values that are shown first, in kg, N/m, N s/m, ohm, H, F, ..: no two springs with one ratio k/d,
# which would make more models equivalent
START = {
    "m": ("1", "2", "1.5", "0.8", "1.2"),
    "k": ("90", "150", "60", "120", "75", "105"),
    "d": ("0.6", "0.25", "0.9", "0.4", "0.7", "0.5"),
    "b": ("0.3", "0.8", "0.45"),
    "R": ("10", "30", "20", "50"),
    "C": ("0.001", "0.02", "0.005"),
    "L": ("0.1", "0.02", "0.5"),
    "W": ("5", "8"),
    "P": ("0.002", "0.03"),
    "n": ("0.9", "0.8"),
    "a": ("1", "0.5", "2", "0.3", "1.5"),
}
MOST_COUNTED = 40  # parameters; with more the count takes longer than a drawing may
RATIO = ("2", "1.5", "3")  # of gears


def model_of(text: str, notation: str = "") -> Chain | AnyModel:
    """Return the model that a text names: a numbered chain, or a network in a notation; raises
    InputError.

    >>> model_of("2:1").n_masses, model_of("R0-p(R1,C1)").parameters
    (2, ('C1', 'R0', 'R1'))
    """
    text = text.strip()
    if not text:
        raise InputError(EXAMPLE)
    if not notation and not notations_of(text) and NAME.fullmatch(text):
        return read_together([text])[0]
    return of_network(network_of(text, notation))


def network_behind(model: Chain | AnyModel) -> Network | None:
    """Return the network that a model is; None of a chain with a lag or a dead time."""
    if not isinstance(model, Chain):
        return model.network
    return None if model.lag or model.dead_time else of_chain(model, name_of(model))


def draw_machine(request: Json) -> Json:
    """Return drawing, words and parts of a model that is given as text or as parts."""
    text = text_of(request["parts"]) if "parts" in request else request["text"].strip()
    model = model_of(text, request.get("notation", ""))
    network = network_behind(model)
    parts = None if network is None else parts_of(network)
    scene = scene_of(model)
    return {
        "text": text,
        "sort": Sort.MACHINE.value if network is None else network.sort.value,
        "drawing": drawing(scene),
        "words": scene.title if scene else "",
        "parts": parts,
        "notation_of_parts": text_of(parts) if parts else "",
        "parameters": list(names_of_values(model)),
        "values": start_values(model, text, request.get("notation", "")),
        "unseen": [] if network is None else list(network.unseen),
        "sensors": free_masses(model),
        "count": count_determinable(model),
    }


def count_determinable(model: Chain | AnyModel) -> str:
    """Return how many parameters the response determines, which takes milliseconds; "" for models
    with a dead time, a lag, exponents or very many parameters. Whether the values are unique is
    what `determine` finds.

    >>> count_determinable(model_of("1=2; F1; S2"))
    '4 parameters, only 3 determinable: infinitely many values give the same response.'
    """
    if network_behind(model) is None or len(model.parameters) > MOST_COUNTED:
        return ""
    general = as_model(model)
    if general.powers.weights or general.powers.unseen:
        return ""
    found = local_identifiability(general)
    size, rank = len(found.parameters), found.rank
    how, many = ("all", "at most finitely") if rank == size else (f"only {rank}", "infinitely")
    head = f"{plural(size, 'parameter')}, {how} determinable"
    return f"{head}: {many} many values give the same response."


def free_masses(model: Chain | AnyModel) -> list[int]:
    """Return the masses at which a further sensor may be placed, of machines with one sensor."""
    network = network_behind(model)
    if network is None or network.sort is not Sort.MACHINE or network.shape != (1, 1):
        return []
    taken = {p.plus for p in network.outputs if not p.minus}
    return [i for i in places_of(network) if i not in taken]


def drawing(scene: Scene | None) -> str:
    """Return the SVG of a drawing in the colours of the page; "" where there is none."""
    if scene is None:
        return ""
    size = f"{number(scene.width)} {number(scene.height)}"
    return (
        f'<svg viewBox="0 0 {size}" width="{number(scene.width)}" class="chain"'
        f' aria-hidden="true">{body(scene, PAGE_PALETTE)}</svg>'
    )


def names_of_values(model: Chain | AnyModel) -> tuple[str, ...]:
    """Return names of all parameters, exponents among them."""
    network = None if isinstance(model, Chain) else model.network
    return (*model.parameters, *(network.exponents if network is not None else ()))


def start_values(model: Chain | AnyModel, text: str, notation: str) -> dict[str, str]:
    """Return positive values as they are shown first; a circuit may state its own.

    >>> start_values(model_of("1=2; F1; S1"), "1=2; F1; S1", "")
    {'d12': '0.6', 'k12': '90', 'm1': '1', 'm2': '2'}
    """
    names = names_of_values(model)
    found = dict[str, str]()
    for letter in dict.fromkeys(name[0] for name in names):
        own = [name for name in names if name[0] == letter]
        found |= zip(own, islice(cycle(START.get(letter, RATIO)), len(own)), strict=True)
    network = network_behind(model)
    is_circuit = network is not None and network.sort is Sort.CIRCUIT
    stated = values_in(text, notation) if is_circuit else {}
    return {name: found[name] for name in sorted(found)} | {
        name: str(value) for name, value in stated.items()
    }


def determine(request: Json) -> Json:
    """Return which parameters of a model can be determined, with certainty and command."""
    model = model_of(request["text"], request.get("notation", ""))
    with Store.open(None) as store:
        found = identifiability(model, engine=Engine(store=store))
    basis = found.basis if isinstance(found, Identifiability) else ()
    return {
        "sentence": found.sentence,
        "rank": found.rank,
        "levels": [{"name": n, "level": level.value} for n, level in found.levels.items()],
        "combinations": [c.text for c in basis] if found.freedom else [],
        "certainty": _certainty(found),
        "reason": found.reason,
        "command": command("models", *words_of(request)),
    }


def find_alike(request: Json) -> Json:
    """Return the models of the shipped catalogues that are not distinguishable from one, by name,
    catalogue after catalogue.
    """
    model = model_of(request["text"], request.get("notation", ""))
    return {"rows": [_row(model, found, request) for found in rows_of(model)]}


def rows_of(model: Chain | AnyModel) -> Iterator[Lookalikes]:
    """Yield the rows of a model in the shipped catalogues: chains have one of their own, as some
    have a mass without a spring, which no other catalogue lists.
    """
    network, chain = network_behind(model), as_chain(model)
    if chain is not None:
        rows = (lookalikes.of_chain(chain), lookalikes.of_ground_dampers(chain, relation_of))
        yield from filter(None, rows)
    if network is not None:
        yield from filter(None, [lookalikes.of_network(network)])


def relation_of(left: Chain, right: Chain) -> Relation:
    """Return the relation of two chains over positive parameters."""
    with Store.open(None) as store:
        return compare(left, right, engine=Engine(store=store)).relation


def _row(model: Chain | AnyModel, found: Lookalikes, request: Json) -> Json:
    others = [
        {"name": name, "relation": relation.value, "drawing": drawing(scene_of(model_of(name)))}
        for name, relation in found.others.items()
    ]
    return {
        "title": found.title,
        "sentence": sentence_of(found),
        "others": others,
        "command": command_for_alike(model, found, request),
    }


def sentence_of(found: Lookalikes) -> str:
    """Return the result of a look-up in words."""
    rest, relations = found.size - 1, list(found.others.values())
    undecided = relations.count(Relation.UNDECIDED)
    count = len(relations) - undecided
    if not relations:
        return f"All other {rest} models are distinguishable from it."
    are = "is" if count == 1 else "are"
    more = f"; {undecided} more undecided" if undecided else ""
    return f"{count} of {rest} other models {are} not always distinguishable from it{more}."


def command_for_alike(model: Chain | AnyModel, found: Lookalikes, request: Json) -> str:
    """Return the command that lists the same models with their values."""
    values = start_values(model, request["text"], request.get("notation", ""))
    given = ",".join(
        f"{name}={value}" for name, value in (values | request.get("values", {})).items()
    )
    if found.family.isdecimal():
        chain = as_chain(model)
        damping = [] if chain is None or chain.damped else ["--undamped"]
        to = (
            next(iter(found.others), found.family)
            if chain and chain.ground_dampers
            else found.family
        )
        return command("equivalents", found.member, "--to", to, *damping, "--set", given)
    return command("equivalents", *words_of(request), "--family", found.family, "--set", given)


def separate(request: Json) -> Json:
    """Return what to measure next to separate a model from others that are indistinguishable from
    it.
    """
    models = [model_of(text) for text in (request["text"], *request["others"])]
    menu = _menu(models, [request["text"].strip(), *request["others"]])
    every, damped = anywhere(menu), [c.damped for m in models if (c := as_chain(m)) is not None]
    options = [] if all(damped) or not isinstance(models[-1], Chain) else ["--undamped"]
    return {
        "sentence": f"Separates all of them: {every}." if every else f"{group_in_words(menu)}.",
        "least": conclusion(menu, 0),
        "command": command("next", *menu.names, *options),
    }


def _menu(models: Sequence[Chain | AnyModel], texts: Sequence[str]) -> AnyMenu:
    """The menu of a group: of chains that a catalogue has, from there."""
    chains = [chain for m in models if (chain := as_chain(m)) is not None]
    with Store.open(None) as store:
        if len(chains) == len(models):
            names = [name_of(chain) for chain in chains]
            stored = _stored_menu(chains)
            return stored or menu_for(list(zip(names, chains, strict=True)), Engine(store=store))
        named = zip(texts, map(network_behind, models), strict=True)
        networks = [(text, network) for text, network in named if network is not None]
        return menu_for(networks, Engine(store=store))


def _stored_menu(chains: Sequence[Chain]) -> AnyMenu | None:
    """The menu of a shipped catalogue; None where there is none."""
    (n, damped), *more = dict.fromkeys((chain.n_masses, chain.damped) for chain in chains)
    names = [read(name_of(chain)) for chain in chains]
    if more or n not in NEXT_SIZES or not all(name.is_plain for name in names):
        return None
    return next_catalog(n, damped=damped).further([name.number for name in names])


def add_sensor(request: Json) -> Json:
    """Return which parameters a further sensor at a mass determines beside the present one."""
    model = model_of(request["text"], request.get("notation", ""))
    both, mass = [Experiment(), Experiment(sensor=request["mass"])], request["mass"]
    with Store.open(None) as store:
        found = identifiability(model, experiments=both, engine=Engine(store=store))
    return {
        "sentence": found.sentence,
        "level": found.level.value,
        "certainty": _certainty(found),
        "command": command("models", *words_of(request), "--also", f"sensor={mass}"),
    }


def _certainty(found: Identified) -> str:
    """Certainty of an identifiability in words."""
    certainty, safety = (
        found.rank_grade if isinstance(found, Identifiability) else (found.certainty, found.safety)
    )
    return certainty.in_words(safety)


def words_of(request: Json) -> list[str]:
    """Return the words of a command for a model."""
    notation = request.get("notation", "")
    text = request["text"].strip()
    return [text, *(["--notation", notation] if notation else [])]


def command(name: str, *words: str) -> str:
    """Return a line to copy into a terminal.

    >>> command("models", "1=2; F1; S1")
    "disting models '1=2; F1; S1'"
    """
    return shlex.join(["disting", name, *words])
