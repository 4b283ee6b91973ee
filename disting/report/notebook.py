"""Display of an object in a notebook: a drawing, a table, a plot with matplotlib on given axes or
on a new figure; and a chain as formulas or numbers. Lists of models and networks have tables too:
candidates before a fit, what is the same, which explain a measurement.

The rooms below access it as `disting.model.presentation.Presenter`, which `Notebook` is. Each piece
of HTML is complete in itself, without a style sheet, in the notebook's own colours wherever a
colour means nothing.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import singledispatch
from typing import TYPE_CHECKING, Any

import numpy as np
from markupsafe import Markup, escape

from disting.algebra.symbols import Expr
from disting.behaviour.transfer import transfer_function
from disting.catalogs import Catalog
from disting.catalogs.sizes import SizesCatalog
from disting.conditions.inclusion import Inclusion
from disting.equivalence import Equivalents
from disting.equivalence.duplicates import Duplicate, Gate
from disting.errors import DistingError
from disting.evidence.positive import PositiveFinding
from disting.export import state_space, to_control
from disting.fit import Candidate, Selection
from disting.fit.judge.explanation import Level
from disting.fit.results.networks import NetworkSelection
from disting.fit.results.selection import response_of
from disting.fit.search.candidates import reference
from disting.fit.search.data import check_range
from disting.general import GlobalIdentifiability, MatrixModel, Model, ModelList
from disting.measurement import FrequencyResponse, Look
from disting.measurement.arrays import Real
from disting.measurement.look_text import fact_rows
from disting.model.chain import Chain, StateSpace
from disting.model.family import Family
from disting.network.network import Network
from disting.planning.power import Plan, is_trusted
from disting.questions.identifiability.answer import Identifiability
from disting.report.drawing import chain_svg
from disting.report.fit.plan_words import chance
from disting.report.fit.sentences import quantity_rows
from disting.report.fit.words import name, readable, response_unit, typeset
from disting.report.network_drawing import network_svg
from disting.report.scene import FILE_PALETTE, Ink, Layer, Path, Scene, svg
from disting.report.words import SAID, headline, plural, raise_exponents, title
from disting.simulation.mechanics import check_values, frequency_response
from disting.statistics.scatter import scatter
from disting.verdict.decisions import Decisions
from disting.verdict.meaning import meaning_sentence as measured
from disting.verdict.model_equivalents import ModelEquivalent
from disting.verdict.next_experiments import Menu
from disting.verdict.next_words import AnyMenu, anywhere, conclusion
from disting.verdict.result import Relation, Verdict

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH, HEIGHT, EDGE = 280.0, 90.0, 6.0
MOST = 400  # points


def curve(x: Real, y: Real, title: str) -> str:
    """Stand-alone SVG of positive values over rising positive places, shape (n,) each."""
    at = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST)).astype(int))
    across, up = (_scale_to_one(np.log(values[at])) for values in (x, y))
    points = tuple(
        (EDGE + (WIDTH - 2 * EDGE) * float(a), HEIGHT - EDGE - (HEIGHT - 2 * EDGE) * float(b))
        for a, b in zip(across, up, strict=True)
    )
    return svg(Scene(WIDTH, HEIGHT, (Layer("curve", (Path(points, Ink.SENSOR),)),), title))


def _scale_to_one(values: Real) -> Real:
    """From 0 to 1; 1/2 where they are all the same."""
    span = float(np.ptp(values))
    return np.asarray((values - values.min()) / span if span else np.full(len(values), 0.5))


LONGEST = 12  # rows, columns or drawings that are shown of many
FILLS = {
    Relation.DISTINGUISHABLE: (Ink.DISTINGUISHABLE, Ink.ON_DISTINGUISHABLE, "≠"),
    Relation.INDISTINGUISHABLE: (Ink.INDISTINGUISHABLE, Ink.ON_INDISTINGUISHABLE, "="),
    Relation.SOMETIMES: (Ink.SOMETIMES, Ink.ON_SOMETIMES, "≈"),
    Relation.UNDECIDED: (Ink.UNDECIDED, Ink.PAPER, "?"),
}
"""Ground, letter and sign of a relation: the colours of the pages, and a sign."""


def block(*parts: str) -> str:
    """Parts below each other."""
    return Markup("<div>{}</div>").format(Markup("").join(p for p in parts if p))


def line(text: str, *, bold: bool = False) -> Markup:
    """A line of text, escaped."""
    inside = Markup("<strong>{}</strong>").format(text) if bold else escape(text)
    return Markup("<p>{}</p>").format(inside)


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> Markup:
    """A table; cells that are Markup stay as they are."""
    top = Markup("").join(Markup("<th>{}</th>").format(h) for h in head)
    body = Markup("").join(
        Markup("<tr>{}</tr>").format(Markup("").join(map(_cell, row))) for row in rows
    )
    return Markup("<table><thead><tr>{}</tr></thead><tbody>{}</tbody></table>").format(top, body)


def facts(rows: Iterable[tuple[str, object]]) -> Markup:
    """Names and their values; those without are omitted."""
    body = Markup("").join(
        Markup("<tr><th>{}</th>{}</tr>").format(name, _cell(value)) for name, value in rows if value
    )
    return Markup("<table><tbody>{}</tbody></table>").format(body)


def matrix(names: Sequence[str], relation: Callable[[int, int], Relation]) -> Markup:
    """The relations of models counted from 0, the first `LONGEST` of them, with a legend."""
    shown = range(min(len(names), LONGEST))
    rows = (
        (Markup("<strong>{}</strong>").format(names[i]), *(_field(i, j, relation) for j in shown))
        for i in shown
    )
    return table(["", *(names[j] for j in shown)], rows) + line(
        ", ".join(f"{sign} {SAID[r]}" for r, (_, _, sign) in FILLS.items())
    )


def more(total: int, what: str, hint: str) -> Markup:
    """That the first of many are shown, and what shows the rest; nothing where all are."""
    return line(f"The first {LONGEST} of {total} {what}. {hint}") if total > LONGEST else Markup("")


def _field(i: int, j: int, relation: Callable[[int, int], Relation]) -> Markup:
    if i == j:
        return Markup("<td></td>")
    the_relation = relation(i, j)
    ground, letter, sign = FILLS[the_relation]
    style = f"text-align:center;background:{FILE_PALETTE[ground]};color:{FILE_PALETTE[letter]}"
    return Markup('<td style="{}" title="{}">{}</td>').format(style, SAID[the_relation], sign)


def _cell(value: object) -> Markup:
    if isinstance(value, Markup) and value.startswith("<td"):
        return value
    return Markup('<td style="text-align:left">{}</td>').format(value)


COLUMNS = (
    "misfit: J, of data that a fit has not seen; badly known: condition index, critical above 30;"
    " weight: how likely it is beside the others (Akaike)."
)


@singledispatch
def table_of(shown: Any) -> str:
    """The object as a piece of HTML; raises TypeError for a kind that is not known here."""
    raise TypeError(f"a notebook has no table for {type(shown).__name__}")


@table_of.register
def _verdict(shown: Verdict) -> str:
    every = shown.relation is Relation.INDISTINGUISHABLE and not shown.has_exceptions
    rows = [
        ("holds for", f"{'all' if every else 'generic'} {shown.domain} parameters"),
        ("certainty", raise_exponents(shown.sure)),
        ("rests on", shown.rule),
        ("equivalents exist", _inclusion(shown, shown.image)),
        ("limits exist", _inclusion(shown, shown.closure)),
        (f"positive {shown.left}", _share(shown.left_positive, shown.right)),
        (f"positive {shown.right}", _share(shown.right_positive, shown.left)),
        ("given up", "; ".join(shown.notes)),
    ]
    return block(line(shown.sentence, bold=True), line(measured(shown)), facts(rows))


def _inclusion(shown: Verdict, inclusion: Inclusion) -> str:
    """Whose generic models have an equivalent, or are a limit, on the other side."""
    return {
        Inclusion.EQUAL: "of both, over complex parameters",
        Inclusion.LEFT_IN_RIGHT: f"of {shown.left} in {shown.right}, over complex parameters",
        Inclusion.RIGHT_IN_LEFT: f"of {shown.right} in {shown.left}, over complex parameters",
        Inclusion.NEITHER: "of neither",
    }.get(inclusion, "")


def _share(finding: PositiveFinding | None, other: str) -> str:
    return "" if finding is None else f"{finding.share} with a positive equivalent {other}"


@table_of.register
def _catalog(shown: Catalog) -> str:
    names = [f"A{number}" for number in range(1, len(shown.family) + 1)]
    hint = "catalog.matrix() has them all, catalog.plot() draws them, catalog.models() lists them."
    return block(
        line(title(shown), bold=True),
        line(f"{headline(shown)}."),
        matrix(names, lambda i, j: shown.relation(i + 1, j + 1)),
        more(len(names), "models", hint),
    )


@table_of.register
def _decisions(shown: Decisions) -> str:
    names = [s.name for s in shown.subjects]
    groups = "; ".join(", ".join(names[i] for i in members) for members in shown.classes())
    return block(
        line(f"{plural(len(names), 'model')} over {shown.query.view.domain} parameters", bold=True),
        matrix(names, shown.relation),
        line(f"Indistinguishable among themselves: {groups or 'none'}."),
        more(len(names), "models", "relation(i, j) tells each pair."),
    )


@table_of.register
def _family(shown: Family) -> str:
    head = f"{plural(len(shown), 'chain')} of {plural(shown.n_masses, 'mass', 'masses')}"
    drawings = Markup("").join(
        Markup("<figure>{}<figcaption>{}</figcaption></figure>").format(
            Markup(chain_svg(chain)), f"A{number}"
        )
        for number, chain in list(enumerate(shown, 1))[:LONGEST]
    )
    style = "display:flex;flex-wrap:wrap;align-items:end"
    return block(
        line(head, bold=True),
        Markup('<div style="{}">{}</div>').format(style, drawings),
        more(len(shown), "chains", "family[13] is the next one."),
    )


@table_of.register
def _identifiability(shown: Identifiability) -> str:
    alone = {c.text: c.unique for c in shown.singles}
    rows = (
        (p, "determinable" if p in alone else "not by itself", alone.get(p, ""))
        for p in shown.parameters
    )
    combinations = ", ".join(shown.combinations)
    return block(
        line(shown.sentence, bold=True),
        table(["parameter", "from the response", "one value only"], rows),
        line(f"{plural(shown.rank, 'independent combination')}: {combinations}."),
    )


@table_of.register
def _global(shown: GlobalIdentifiability) -> str:
    local = shown.local.identifiable
    rows = (
        (p, "determinable" if p in local else "not by itself", "yes" if p in shown.unique else "")
        for p in shown.local.parameters
    )
    return block(
        line(shown.sentence, bold=True),
        table(["parameter", "from the response", "one value only"], rows),
    )


@table_of.register
def _response(shown: FrequencyResponse) -> str:
    low, high = readable(shown.frequency[0], 4), readable(shown.frequency[-1], 4)
    size = np.abs(shown.G)
    unit = f" [{response_unit(shown)}]" if response_unit(shown) else ""
    rows = [
        ("lines", f"{len(shown)}, {low} to {high} Hz"),
        ("shows", f"{shown.sensor} per input{unit}"),
        ("amplitude", f"{readable(float(size.min()))} to {readable(float(size.max()))}"),
        ("input", typeset(str(shown.input))),
        ("output", typeset(str(shown.output))),
        ("known of the noise", _noise(shown)),
        ("origin", shown.origin),
        ("notes", "; ".join((*shown.notes, *shown.suspicions))),
    ]
    picture = curve(shown.frequency, size, "Amplitude over frequency, both logarithmic")
    return block(line("Frequency response", bold=True), Markup(picture), facts(rows))


@table_of.register
def _look(shown: Look) -> str:
    response = shown.response
    head = ("column", "name", "unit", "role", "quantity", "why")
    used = [column for column in shown.columns if column.is_used]
    rows = (
        (c.number or "", c.name, typeset(c.unit), c.role, shown.quantity_of(c), shown.reason(c))
        for c in used[:LONGEST]
    )
    picture = ""
    if response is not None:
        size, words = np.abs(response.G), "Amplitude over frequency, both logarithmic"
        picture = Markup(curve(response.frequency, size, words))
    return block(
        line(response.origin if response is not None else shown.file, bold=True),
        table(head, rows),
        picture,
        facts(fact_rows(shown)),
    )


def _noise(shown: FrequencyResponse) -> str:
    rows = [("standard deviations", shown.deviation), ("coherence", shown.coherence)]
    return ", ".join(what for what, values in rows if values is not None) or "nothing"


@table_of.register
def _selection(shown: Selection) -> str:
    head = [
        "candidate",
        "",
        "parameters",
        "misfit",
        "χ² per line",
        "badly known",
        "weight",
        "excluded",
    ]
    first = list(shown.candidates[:LONGEST])
    chosen = [c for c in shown.candidates[LONGEST:] if c is shown.selected]
    rows = (_candidate(c, c is shown.selected) for c in (*first, *chosen))
    if shown.question:
        names, *readings = quantity_rows(shown)
        return block(line(shown.question, bold=True), table(names, readings))
    return block(
        line(_describe_selected(shown), bold=True),
        line(_describe_explanation(shown)),
        table(head, rows),
        more(len(shown.candidates), "candidates", "selection.candidates has them all."),
        line(COLUMNS),
        *map(line, _members(shown)),
    )


def _describe_selected(shown: Selection) -> str:
    if shown.selected is None:
        return "No candidate is admissible."
    return f"Selected: {reference(shown.selected.chain)}, {name(shown.selected.chain)}."


def _describe_explanation(shown: Selection) -> str:
    explanation = shown.explanation
    which = reference(shown.described.chain)
    if explanation.noisy:
        return "The data are mostly noise."
    says = "explains" if explanation.explains else "does not explain"
    fully = " fully" * (explanation.level is Level.NEARLY)
    chi2 = readable(explanation.chi2)
    return f"{which} {says} the data{fully}: χ² per line {chi2}, from {shown.validation}."


def _candidate(shown: Candidate, chosen: bool) -> tuple[object, ...]:
    label = reference(shown.chain)
    return (
        Markup("<strong>{}</strong>").format(label) if chosen else label,
        name(shown.chain),
        shown.n_parameters,
        readable(shown.j_test),
        readable(shown.chi2),
        readable(shown.practical.condition_index),
        readable(shown.akaike_weight, 2),
        "; ".join(shown.reasons),
    )


def _members(shown: Selection) -> Iterator[str]:
    for member in shown.members:
        same = ", ".join(dict.fromkeys(twin.name for twin in member.twins))
        yield f"Not excluded: {member.name}{f'; the same response: {same}' if same else ''}."


@table_of.register
def _equivalents(shown: Equivalents) -> str:
    rows = [
        (listing.name, m.signs, ", ".join(f"{p} = {v:.5g}" for p, v in m.values.items()), m.origin)
        for listing in shown.listings
        for m in listing.members
    ]
    return block(
        line(f"Parameter vectors with the transfer function of {shown.name}", bold=True),
        table(["structure", "signs", "values", "from"], rows[:LONGEST]),
        more(len(rows), "vectors", "Iterate over it for all."),
    )


@table_of.register(Model)
@table_of.register(MatrixModel)
def _model(shown: Model | MatrixModel) -> str:
    return block(line(shown.name, bold=True), line(_formula(shown)))


@table_of.register
def _models(shown: ModelList) -> str:
    rows = [(m.name, ", ".join(m.parameters), _formula(m)) for m in shown][:LONGEST]
    return block(
        line(shown.title or plural(len(shown), "model"), bold=True),
        table(["model", "parameters", "transfer function"], rows),
        more(len(shown), "models", "Iterate over it for all."),
    )


@table_of.register
def _sizes(shown: SizesCatalog) -> str:
    rows = [(c.name, plural(len(c.family), "model")) for c in shown.catalogs]
    return block(line(f"{shown.name}: all pairs of", bold=True), table(["catalogue", ""], rows))


def _formula(shown: Model | MatrixModel) -> str:
    """G(s), where it is short enough to be read."""
    if isinstance(shown, MatrixModel):
        outputs, inputs = shown.shape
        return f"{plural(outputs, 'output')}, {plural(inputs, 'input')}"
    if shown.n_terms <= 30:
        return str(shown)
    return f"{plural(shown.n_states, 'state')}, {shown.n_terms} terms"


@table_of.register(Menu)
def _further(shown: AnyMenu) -> str:
    rows = ((own, conclusion(shown, k)) for k, own in enumerate(shown.names))
    enough = anywhere(shown)
    return block(
        line(f"What to measure next on {', '.join(shown.names)}", bold=True),
        line(f"Enough wherever it is done: {enough}.") if enough else "",
        table(["if it is", "then"], rows),
    )


@table_of.register
def _plan(shown: Plan) -> str:
    model, rival = shown.names
    rows = [
        ("answer", shown.answer),
        ("verdict", "" if shown.verdict is None else shown.verdict.sentence),
        ("power now", chance(shown.power)),
        ("effort needed", f"{readable(shown.factor)} times" if shown.noncentrality else ""),
        ("doubt", "" if is_trusted(shown) else "the rival's best fit may not have been found"),
    ]
    return block(line(f"To tell {model} from {rival}", bold=True), facts(rows))


@table_of.register
def _gate(shown: Gate) -> str:
    groups = [(group[0], ", ".join(group[1:])) for group in shown.groups]
    rows = [(name, identifiability.sentence) for name, identifiability in shown.parameters.items()]
    return block(
        line(f"{plural(len(rows), 'model')} to be fitted", bold=True),
        table(["model", "what data determine"], rows[:LONGEST]),
        table(["kept", "the same"], groups[:LONGEST]) if groups else "",
    )


@table_of.register
def _duplicate(shown: Duplicate) -> str:
    parts = [line(shown.verdict.sentence, bold=True)]
    for f in shown.formulas:
        parts += [line(f"where {', '.join(f.where)}")] if f.where else []
        parts.append(facts((*f.steps, *f.values)))
    return block(*parts)


@table_of.register
def _equivalent(shown: ModelEquivalent) -> str:
    _, sets = shown.sets
    return block(
        line(shown.verdict.sentence, bold=True),
        *(facts((name, str(value)) for name, value in entries.items()) for _, entries in sets),
    )


@table_of.register
def _networks(shown: NetworkSelection) -> str:
    rows = [(f.network.name, readable(f.chi2), f.excluded_by) for f in shown.fits]
    return block(
        line(shown.sentence, bold=True),
        table(["network", "chi2 per line", "excluded by"], rows[:LONGEST]),
        more(len(rows), "networks", "fits has all."),
    )


Style = Mapping[str, Any]
POINTS = 600  # of a model's line
MOST_LINES = 5  # structures that are drawn of a selection
MOST_NAMED = 30  # models whose numbers have room beside a matrix


@singledispatch
def drawn_on(shown: Any, ax: Any, style: Style) -> Any:
    """The object on axes, which are returned; raises TypeError for a kind that is not known."""
    raise TypeError(f"there is no plot of {type(shown).__name__}")


@drawn_on.register(FrequencyResponse)
def _plot_response(shown: FrequencyResponse, ax: Any, style: Style) -> "tuple[Axes, ...]":
    panels = _panels(ax)
    phase = np.unwrap(np.angle(shown.G))
    _bode(panels, shown.frequency, np.abs(shown.G), phase, style)
    unit = response_unit(shown)
    panels[0].set_ylabel(f"Amplitude [{unit}]" if unit else f"{shown.sensor} per input")
    if "label" in style:
        panels[0].legend()
    return panels


@drawn_on.register(Selection)
def _plot_selection(shown: Selection, ax: Any, style: Style) -> "tuple[Axes, ...]":
    """Measured lines as dots, structures as lines, whose phases stay close to those of the dots."""
    fitted_response = shown.test
    dots = {"linestyle": "none", "marker": ".", "color": "0.55", "label": "measured"}
    panels = _plot_response(fitted_response, ax, dots)
    omega = np.geomspace(fitted_response.omega[0], fitted_response.omega[-1], POINTS)
    chosen = [m.candidate for m in shown.members[:MOST_LINES]] or [shown.described]
    beside = float(np.mean(np.unwrap(np.angle(fitted_response.G))))
    for candidate in chosen:
        response = response_of(candidate, shown.task, omega)
        phase = np.unwrap(np.angle(response))
        phase += 2 * np.pi * np.round((beside - phase.mean()) / (2 * np.pi))
        lines = {"label": reference(candidate.chain)}
        _bode(panels, omega / (2 * np.pi), np.abs(response), phase, lines)
    panels[0].legend()
    return panels


@drawn_on.register(Catalog)
def _plot_catalog(shown: Catalog, ax: Any, style: Style) -> "Axes":
    axes: Axes = _pyplot().subplots(figsize=(6, 6), layout="constrained")[1] if ax is None else ax
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    size, order = len(shown.family), list(Relation)
    colours = {r: FILE_PALETTE[ground] for r, (ground, _, _) in FILLS.items()}
    numbers = range(1, size + 1)
    fields = np.ma.masked_equal(
        [[-1 if i == j else order.index(shown.relation(i, j)) for j in numbers] for i in numbers],
        -1,
    )
    palette = ListedColormap([colours[r] for r in order])
    edges = (0.5, size + 0.5)
    axes.imshow(fields, cmap=palette, vmin=0, vmax=len(order) - 1, extent=(*edges, *edges[::-1]))
    if size <= MOST_NAMED:
        axes.set_xticks(list(numbers))
        axes.set_yticks(list(numbers))
    axes.set_title(f"{title(shown)}: positive parameters")
    relations = [r for r in order if (fields == order.index(r)).any()]
    entries = [Patch(color=colours[r], label=SAID[r]) for r in relations]
    axes.legend(handles=entries, loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=2)
    return axes


def _bode(panels: "Sequence[Axes]", hertz: Real, size: Real, phase: Real, style: Style) -> None:
    panels[0].loglog(hertz, size, **style)
    for panel in panels[1:2]:
        panel.semilogx(hertz, np.degrees(phase), **style)
        panel.set_ylabel("Phase [degree]")
    for panel in panels:
        panel.grid(True, linewidth=0.5, alpha=0.5)
    panels[-1].set_xlabel("Frequency [Hz]")


def _panels(ax: Any) -> "tuple[Axes, ...]":
    """Amplitude and phase of a new figure, or what is given: one axes, or two in any sequence."""
    if ax is None:
        figure = _pyplot().figure(figsize=(7, 5), layout="constrained")
        return tuple(figure.subplots(2, 1, sharex=True, height_ratios=[3, 2]))
    parts = tuple(np.ravel(np.asarray(ax, dtype=object)))
    if len(parts) not in (1, 2):
        raise DistingError(f"a Bode diagram has one or two axes, not {len(parts)}")
    return parts


def _pyplot() -> Any:
    try:
        from matplotlib import pyplot
    except ImportError:
        raise DistingError("a plot needs matplotlib; install it: pip install matplotlib") from None
    return pyplot


class Notebook:
    """Draws what a notebook requests; it keeps nothing."""

    def html(self, shown: Any, /) -> str:
        """The object as a piece of an HTML page; raises TypeError for what has none."""
        return table_of(shown)

    def svg(self, shown: Chain | Network, /) -> str:
        """The drawing of a chain or a network on white paper, which is right in light and dark
        notebooks.
        """
        return chain_svg(shown) if isinstance(shown, Chain) else network_svg(shown)

    def transfer_function(self, shown: Chain, /) -> Expr:
        """G(s) from force to sensor."""
        return transfer_function(shown)

    def frequency_response(self, shown: Chain, values: Mapping[str, float], omega: Any, /) -> Any:
        """G(j omega) with numbers."""
        return frequency_response(shown, values, np.asarray(omega, dtype=float))

    def state_space(self, shown: Chain, values: Mapping[str, float], /) -> StateSpace:
        """The matrices with numbers."""
        return state_space(shown, check_values(shown, values))

    def to_control(self, shown: Chain, values: Mapping[str, float], /) -> Any:
        """The same for python-control."""
        return to_control(shown, check_values(shown, values))

    def scatter(self, shown: FrequencyResponse, /) -> tuple[float, str]:
        """Median over the lines of sigma / (|G| sqrt 2), and the source that it is known from.
        Raises InputError for numbers that a fit does not compute with.
        """
        check_range(shown)
        known = scatter(shown)
        return known.typical, known.source

    def plot(self, shown: Any, ax: Any, style: Mapping[str, Any], /) -> Any:
        """The object on axes of matplotlib; raises TypeError for what has no plot."""
        return drawn_on(shown, ax, style)
