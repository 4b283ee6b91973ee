"""Page of two models: verdict, formulas and values that connect them, evidence, motion."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from disting.app.interface import Json, Progress
from disting.app.machine import command, drawing, model_of, network_behind, start_values
from disting.app.workers import Setting
from disting.equivalence.closed_forms import closed_forms
from disting.equivalence.inputs import point_of
from disting.equivalence.listing import Signs
from disting.equivalence.search import chain_equivalents
from disting.general.any_model import as_chain, as_model, measurand
from disting.general.equivalent import spell
from disting.general.matrix_model import AnyModel
from disting.general.synthesis import NoFormulas
from disting.model.chain import Chain
from disting.model.names import name_of
from disting.model.question import Domain
from disting.network.network import Network
from disting.report.motion import drawing_of, machine_of, start_values_of
from disting.report.network_drawing import scene_of
from disting.store import Store
from disting.verdict.comparison import compare
from disting.verdict.engine import Engine
from disting.verdict.meaning import meaning_sentence
from disting.verdict.model_equivalents import model_equivalents
from disting.verdict.result import Relation, Verdict
from disting.verdict.verdict_file import verdict_file

Pair = tuple[Chain | AnyModel, Chain | AnyModel]
EXTENTS = {
    "finite": "all there are",
    "family": "and infinitely many more",
    "unknown": "and perhaps more",
}
LONGEST = 9  # signs of a fraction such as 3600/361; longer ones are rounded


def compare_two(request: Json) -> Json:
    """Return the verdict on two models, with its reason, certainty and command."""
    models = _models(request)
    verdict = _verdict(models)
    return {
        "relation": verdict.relation.value,
        "in_words": verdict.in_words,
        "meaning": meaning_sentence(verdict, measurand(models)),
        "sentence": verdict.sentence,
        "evidence": verdict.evidence.formula if verdict.evidence else "",
        "certainty": verdict.sure,
        "drawings": [drawing(scene_of(model)) for model in models],
        "command": command("compare", request["left"].strip(), request["right"].strip()),
    }


def decide_two(request: Json, progress: Progress, _: Setting) -> Json:
    """Return the same as a job, without the limit of a quick call."""
    progress("deciding", 0, 1)
    return compare_two(request)


def find_formulas(request: Json) -> Json:
    """Return formulas for the values of the right model in those of the left one, where both are
    indistinguishable and formulas are known.
    """
    left, right = _models(request)
    verdict = _verdict((left, right))
    if verdict.relation is not Relation.INDISTINGUISHABLE:
        return {"forms": [], "reason": "There is no map for all positive values."}
    try:
        forms = closed_forms(as_model(left), as_model(right), verdict)
    except NoFormulas as none:
        return {"forms": [], "reason": f"No formulas are known: {none}."}
    return {"forms": [{"text": f.text, "certainty": f.checked} for f in forms], "reason": ""}


def find_values(request: Json) -> Json:
    """Return the positive values of the right model that give the response of the left one at its
    values.
    """
    models = _models(request)
    values = _values(models[0], request)
    found, chains = _positive_sets(models, values), _as_chains(models)
    texts = [request["left"].strip(), request["right"].strip()]
    left, right = map(name_of, chains) if chains else texts
    damping = ["--undamped"] if chains and not chains[0].damped else []
    given = ",".join(f"{name}={value}" for name, value in values.items())
    return {
        "given": values,
        "sets": [{n: _spell(x) for n, x in one.items()} for one in found.sets],
        "extent": EXTENTS.get(found.extent, found.extent),
        "command": command("equivalents", left, "--to", right, *damping, "--set", given),
    }


def show_motion(request: Json) -> Json:
    """Return both machines for the picture in motion, with values: those of the right one give the
    response of the left one where such are known.
    """
    left, right = _models(request)
    machines = [_machine(model) for model in (left, right)]
    one, two = machines
    if one is None or two is None:
        return {"machines": [], "values": [], "same": False}
    values = dict(zip(_names(one), start_values_of(one), strict=True))
    exact = {name: str(Fraction(str(x))) for name, x in values.items()}
    sets = _positive_sets((left, right), exact).sets
    other = dict(zip(_names(two), start_values_of(two), strict=True))
    if sets:
        other |= {name: float(x) for name, x in sets[0].items()}
    return {
        "machines": [drawing_of(one), drawing_of(two)],
        "values": [list(values.values()), list(other.values())],
        "same": bool(sets),
    }


def write_evidence(request: Json) -> Json:
    """Return the verdict with all that `disting verify` needs."""
    return {"file": verdict_file(*_models(request))}


def _models(request: Json) -> Pair:
    """Both models, in the order of the request."""
    notation = request.get("notation", "")
    return model_of(request["left"], notation), model_of(request["right"], notation)


def _verdict(models: Pair) -> Verdict:
    with Store.open(None) as store:
        return compare(*models, engine=Engine(store=store))


def _values(model: Chain | AnyModel, request: Json) -> dict[str, str]:
    """Values of the left model, checked; raises InputError."""
    start = start_values(model, request["left"], request.get("notation", ""))
    values: dict[str, str] = start | request.get("values", {})
    network = network_behind(model)
    if network is not None:
        point_of(network, values)
    return values


@dataclass(frozen=True, slots=True)
class PositiveSets:
    """Positive sets of values, and how many there are in words."""

    extent: str = "none"
    sets: tuple[Mapping[str, Any], ...] = ()


def _positive_sets(models: Pair, values: Mapping[str, str]) -> PositiveSets:
    """Positive values of the right model with the response of the left one at its values: of two
    chains as the command finds them for their names, by theorems.
    """
    chains = _as_chains(models)
    if chains:
        (listing,) = chain_equivalents(chains[0], values, chains[1]).listings
        members = (m for m in listing.members if m.signs is Signs.POSITIVE)
        return PositiveSets(listing.sentence, tuple(m.exact or m.values for m in members))
    left, right = map(as_model, models)
    with Store.open(None) as store:
        found = model_equivalents(left, [right], values, engine=Engine(store=store))
    if not found:
        return PositiveSets()
    extent, sets = found[0].sets
    return PositiveSets(extent, tuple(one for where, one in sets if where is Domain.POSITIVE))


def _as_chains(models: Pair) -> tuple[Chain, Chain] | None:
    """Both models, if both are chains with as many elements of the same kinds."""
    left, right = map(as_chain, models)
    return None if left is None or right is None or left.damped != right.damped else (left, right)


def _machine(model: Chain | AnyModel) -> Network | None:
    """The machine that can be shown in motion."""
    network = network_behind(model)
    return None if network is None else machine_of(as_model(network))


def _names(machine: Network) -> list[str]:
    """Names of the values in the order of the page."""
    names = drawing_of(machine)["names"]
    return list(names) if isinstance(names, list) else []


def _spell(value: Any) -> str:
    """A value as text, rounded where its fraction is long."""
    return spell(value) if len(str(value)) <= LONGEST else spell(float(value))
