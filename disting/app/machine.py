"""Machine page: one model in any notation, what can be determined of it, what looks the same, what
to measure next.

The functions are those of the public API and of the command line; each answer has the command that
gives it too. They are several calls, so that the drawing need not wait for a decision.
"""

import shlex
from collections.abc import Iterator, Mapping
from itertools import cycle, islice

from disting.app.interface import Json
from disting.app.parts import parts_of, text_of
from disting.catalogs import lookalikes
from disting.catalogs.lookalikes import Lookalikes
from disting.decide.identifiability import Identifiability
from disting.equivalence.inputs import point_of
from disting.errors import InputError
from disting.experiments.experiment import Experiment, places_of
from disting.general.any_model import AnyModel, as_chain, of_network
from disting.model.chain import Chain, Sort
from disting.model.names import NAME, name_of, read_together
from disting.network.chains import of_chain
from disting.network.network import Network
from disting.network.notation import network_of, notations_of, values_in
from disting.report.network_drawing import scene_of
from disting.report.scene import PAGE_PALETTE, Scene, body, number
from disting.store import Store
from disting.verdict.comparison import identifiability
from disting.verdict.engine import Engine
from disting.verdict.next_experiments import menu_for
from disting.verdict.next_words import anywhere, conclusion, group_in_words

EXAMPLE = "write a machine such as 1=2=3; F1; S3, or a circuit such as R0-p(R1,C1)"
MOST_NEXT = 8  # models of which a menu is made at once
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
    }


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
    whole = isinstance(found, Identifiability)
    certainty, safety = found.rank_grade if whole else (found.certainty, found.safety)
    return {
        "sentence": found.sentence,
        "rank": found.rank,
        "levels": [{"name": n, "level": level.value} for n, level in found.levels.items()],
        "combinations": [c.text for c in found.basis] if whole and found.freedom else [],
        "certainty": certainty.in_words(safety),
        "reason": found.reason,
        "command": command("models", *words_of(request)),
    }


def find_alike(request: Json) -> Json:
    """Return the models of a shipped catalogue that are not distinguishable from one, by name."""
    model = model_of(request["text"], request.get("notation", ""))
    found = row_of(model)
    if found is None:
        return {
            "listed": False,
            "sentence": "No catalogue lists this model. Compare it with another one on the page"
            " Two models.",
            "others": [],
            "command": "",
        }
    others = [
        {"name": name, "relation": relation.value, "drawing": drawing(scene_of(model_of(name)))}
        for name, relation in found.others.items()
    ]
    return {
        "listed": True,
        "sentence": sentence_of(found),
        "others": others,
        "command": command_for_alike(model, found, request),
    }


def row_of(model: Chain | AnyModel) -> Lookalikes | None:
    """Return the row of a model in a shipped catalogue: of chains of four masses and more, which no
    other one lists with dampers, that of chains.
    """
    network, chain = network_behind(model), as_chain(model)
    found = lookalikes.of_network(network) if network is not None else None
    return found or (lookalikes.of_chain(chain) if chain is not None else None)


def sentence_of(found: Lookalikes) -> str:
    """Return the result of the look-up in words."""
    title = f"{found.title[0].lower()}{found.title[1:]}"
    if not found.others:
        return f"All other {found.size - 1} models are distinguishable from it ({title})."
    are = "is" if len(found.others) == 1 else "are"
    return (
        f"{len(found.others)} of {found.size - 1} other models {are} not distinguishable from it"
        f" ({title})."
    )


def command_for_alike(model: Chain | AnyModel, found: Lookalikes, request: Json) -> str:
    """Return the command that lists the same models with their values."""
    values = start_values(model, request["text"], request.get("notation", ""))
    values |= request.get("values", {})
    given = ",".join(f"{name}={value}" for name, value in values.items())
    if found.family.isdecimal():
        chain = as_chain(model)
        damping = [] if chain is None or chain.damped else ["--undamped"]
        return command("equivalents", found.member, "--to", found.family, *damping, "--set", given)
    return command("equivalents", *words_of(request), "--family", found.family, "--set", given)


def advise(request: Json) -> Json:
    """Return what to measure next: what separates a model from those that look the same, and which
    further sensor determines more of its parameters.
    """
    model = model_of(request["text"], request.get("notation", ""))
    with Store.open(None) as store:
        engine = Engine(store=store)
        return {
            "separate": _separate(model, request, engine),
            "determine": [*_further_sensors(model, request, engine)],
        }


def _separate(model: Chain | AnyModel, request: Json, engine: Engine) -> Json | None:
    """What separates the model from others that are indistinguishable from it; None where there
    are none.
    """
    others = request.get("others", [])[: MOST_NEXT - 1]
    if not others:
        return None
    named = [(request["text"].strip(), model), *((name, model_of(name)) for name in others)]
    chains = [(name, chain) for name, m in named if (chain := as_chain(m)) is not None]
    if len(chains) == len(named):
        group = [(name_of(chain), chain) for _, chain in chains]
        menu = menu_for(group, engine)
    else:
        networks = [(name, network_behind(m)) for name, m in named]
        menu = menu_for([(name, n) for name, n in networks if n is not None], engine)
    every = anywhere(menu)
    return {
        "sentence": f"Separates all of them: {every}." if every else f"{group_in_words(menu)}.",
        "least": conclusion(menu, 0),
        "command": command("next", *menu.names),
    }


def _further_sensors(model: Chain | AnyModel, request: Json, engine: Engine) -> Iterator[Json]:
    """Yield what a further sensor at each mass that has none would determine."""
    network = network_behind(model)
    is_machine = network is not None and network.sort is Sort.MACHINE
    if network is None or not is_machine or network.shape != (1, 1):
        return
    before = identifiability(model, engine=engine)
    taken = {p.plus for p in network.outputs if not p.minus}
    for mass in places_of(network) if before.level.value != "global" else ():
        if mass in taken:
            continue
        both = [Experiment(), Experiment(sensor=mass)]
        found = identifiability(model, experiments=both, engine=engine)
        yield {
            "mass": mass,
            "rank": found.rank,
            "count": len(found.levels),
            "is_global": found.level.value == "global",
            "sentence": found.sentence,
            "certainty": found.certainty.in_words(found.safety),
            "command": command("models", *words_of(request), "--also", f"sensor={mass}"),
        }


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


def exact_values(model: Chain | AnyModel, values: Mapping[str, str]) -> dict[str, str]:
    """Return the values of all parameters of a model; raises InputError for wrong names and for
    what is no positive number.
    """
    network = network_behind(model)
    if network is not None:
        point_of(network, values)
    return dict(values)
