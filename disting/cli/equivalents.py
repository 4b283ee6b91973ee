"""The command `equivalents`: its arguments, and how models with the same transfer function are
printed.
"""

import argparse
from collections.abc import Iterator, Sequence
from fractions import Fraction

from disting.cli.arguments import add_damped, add_json, add_no_cache, add_notation
from disting.cli.output import emit
from disting.equivalence import (
    NONE,
    Equivalent,
    Equivalents,
    Listing,
    Map,
    Origin,
    Signs,
    among,
    assignments,
    chains_of,
    explicit_map,
)
from disting.equivalence.search import chain_equivalents
from disting.errors import InputError
from disting.files import json_text
from disting.model.chain import Chain, text_drawing
from disting.model.kinds import EXAMPLES
from disting.model.names import name_of, read_together
from disting.model.presentation import plural
from disting.network.notation import notations_of

ABREAST = 3  # parameter sets beside each other
NONE_HERE = "No experiment with this force and sensor"
FEW = 12  # names of structures that are told one by one
SOURCES = {
    Origin.GIVEN: "given",
    Origin.RENAMING: "renaming",
    Origin.DUALITY: "duality",
    Origin.PROPORTIONAL: "proportional",
    Origin.SYNTHESIS: "synthesis",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    _models(parser)
    text = (
        "values of all parameters of the given model, such as m1=1,m2=3/4,k12=1e3; taken exactly;"
        " of a circuit they may stand in braces, such as R{R=20}"
    )
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE,...", dest="values", help=text
    )
    text = (
        f"list what keeps the response of this experiment too: {EXAMPLES}, one or several, at"
        " masses of the given model (3/2: mass 2 of the other one, else every one is tried); may be"
        " repeated"
    )
    parser.add_argument("--also", action="append", default=[], metavar="EXPERIMENT", help=text)
    _forms(parser)
    add_damped(parser)
    add_notation(parser)
    add_no_cache(parser)


def _models(parser: argparse.ArgumentParser) -> None:
    """The given model, and those among which its equivalents are."""
    named = (
        "masses:number of the given model, as 'disting models' lists it; +b2: damper from mass 2 to"
        " the ground; +lag; +delay"
    )
    named += "; or a network such as 'R0-p(R1,C1)'; or file.json:name, a model of your own"
    parser.add_argument("model", metavar="N:I|NETWORK|FILE.json:NAME", help=named)
    others = (
        "another structure, or all of M masses (M+b1: all with this damper to the ground, M+b*:"
        " with any set of them); of a network another network; of a model in a file file.json:name,"
        " or file.json: all that are there"
    )
    parser.add_argument("--to", default="", metavar="M:J|M|NETWORK|FILE", help=others)
    text = "of a network: all networks of this family, such as circuits-5"
    parser.add_argument("--family", default="", metavar="FAMILY", help=text)


def _forms(parser: argparse.ArgumentParser) -> None:
    """Add the options for the format of the result."""
    form = parser.add_mutually_exclusive_group()
    add_json(form, "the result", alone=True)
    form.add_argument(
        "--formulas",
        action="store_true",
        help="print formulas for any values: rational ones, of networks also by square roots",
    )
    form.add_argument("--latex", action="store_true", help="print formulas in LaTeX")
    form.add_argument(
        "--sympy", action="store_true", help="print formulas as Python source for SymPy"
    )


def run(options: argparse.Namespace) -> int:
    """Print the equivalents of a model, or formulas for them."""
    if not (options.to or options.family):
        raise InputError("say among which: --to 3:11, --to 3, or of a network --family circuits-5")
    texts = (options.model, options.to)
    if options.notation or any(notations_of(text) or ".json" in text for text in texts):
        from disting.cli.model_equivalents import run as run_models

        return run_models(options)
    if options.family or not options.to:
        raise InputError(
            "--family belongs to networks; of a numbered chain say --to 3 or --to 3:11"
        )
    if options.formulas or options.latex or options.sympy:
        if options.also:
            raise InputError("--also asks for values, not for formulas: leave one of them away")
        (chain,) = read_together([options.model], damped=options.damped)
        print("\n".join(_formulas(chain, chains_of(options.to, chain), options)))
        return 0
    if not options.values:
        example = "--set m1=1,m2=2,.. (or --formulas for formulas)"
        raise InputError(f"values of the given model are needed: {example}")
    values = assignments(options.values)
    equivalents = chain_equivalents(
        options.model, values, options.to, damped=options.damped, also=options.also
    )
    if options.json:
        emit(options.json, json_text(equivalents.to_dict(), indent=1) + "\n")
    else:
        print("\n".join(_lines(equivalents)))
    return 0


def _lines(equivalents: Equivalents) -> Iterator[str]:
    values = ", ".join(f"{name} = {_decimal(value)}" for name, value in equivalents.values.items())
    yield f"{equivalents.name}  {text_drawing(equivalents.chain)}"
    yield f"given: {values}"
    yield from (f"experiment {i}  {text}" for i, text in enumerate(equivalents.experiments, 1))
    listed = [listing for listing in equivalents.listings if listing.members]
    for listing in listed:
        yield ""
        yield from _listing(listing)
    if listed:
        yield ""
        yield (
            "difference: the largest relative difference of a transfer-function coefficient,"
            " rounding to 15 digits included"
        )
    yield ""
    yield from _list_empty(equivalents.listings)
    yield _closing(equivalents)


def _decimal(value: Fraction) -> str:
    """As a decimal where 15 digits are exact."""
    text = f"{float(value):.15g}"
    return text if Fraction(text) == value else str(value)


def _listing(listing: Listing) -> Iterator[str]:
    yield f"{listing.name}  {text_drawing(listing.chain)}   {_count(listing)}{_map_masses(listing)}"
    shown = [
        (i, member)
        for i, member in enumerate(listing.members, 1)
        if member.signs is not Signs.COMPLEX
    ]
    for group in (shown[i : i + ABREAST] for i in range(0, len(shown), ABREAST)):
        yield ""
        yield from _table(listing.chain, group)
    hidden = len(listing.members) - len(shown)
    if hidden:
        yield f"  and {hidden} complex ones, of no physical meaning (--json shows them)"


def _map_masses(listing: Listing) -> str:
    """Sentence that maps the masses of the given model to those here, where experiments name
    some.
    """
    places = ", ".join(f"{a}/{b}" for a, b in listing.places)
    return f", masses {places}" if places else ""


def _count(listing: Listing) -> str:
    count = len(listing.members)
    return f"{plural(count, 'parameter set')}, {listing.sentence}"


def _table(chain: Chain, group: Sequence[tuple[int, Equivalent]]) -> Iterator[str]:
    rows = [("", [f"set {i}" for i, _ in group])]
    rows.append(("signs", [_signs(member) for _, member in group]))
    rows += [(name, [member.text[name] for _, member in group]) for name in chain.parameters]
    rows.append(("found by", [SOURCES[member.origin] for _, member in group]))
    rows.append(
        (
            "difference",
            [f"{member.residual:.1e}" if member.residual else "exact" for _, member in group],
        )
    )
    if any(member.free_choices for _, member in group):
        rows.append(("free choices", [str(member.free_choices) for _, member in group]))
    widths = [max(len(row[1][i]) for row in rows) for i in range(len(group))]
    for label, cells in rows:
        yield f"  {label:12}" + "".join(
            f"  {cell:>{width}}" for cell, width in zip(cells, widths, strict=True)
        )


def _signs(member: Equivalent) -> str:
    return {Signs.POSITIVE: "positive", Signs.REAL: "signs mixed"}.get(member.signs, "complex") + (
        "" if member.proven else "?"
    )


def _list_empty(listings: Sequence[Listing]) -> Iterator[str]:
    """Structures without a member, grouped by their description."""
    groups: dict[str, list[str]] = {}
    for listing in listings:
        if not listing.members:
            sentence = listing.sentence if len(listings) == 1 or not listing.complete else NONE
            groups.setdefault(sentence, []).append(f"{listing.name}{_map_masses(listing)}")
    for sentence, names in groups.items():
        every = "all" if len(names) == len(listings) else "all other"
        few = len(groups) > 1 or len(names) <= FEW
        yield f"{', '.join(names) if few else f'{every} {len(names)} structures'}: {sentence}"


def _closing(result: Equivalents) -> str:
    """One sentence: what this means for an experiment."""
    others = [listing for listing in result.listings if listing.chain != result.chain]
    chains = list(dict.fromkeys(listing.chain for listing in result.listings))
    what = "responses" if result.experiments else "transfer function"
    this = f"{'these' if result.experiments else 'this'} {what}"
    who = "None of these experiments" if result.experiments else NONE_HERE
    physical = [
        f"{listing.name}{_map_masses(listing)}"
        for listing in others
        if any(m.signs is Signs.POSITIVE for m in listing.members)
    ]
    own = [
        m for listing in result.listings if listing.chain == result.chain for m in listing.members
    ]
    twins = sum(m.signs is Signs.POSITIVE and m.origin is not Origin.GIVEN for m in own)
    sentences = []
    if physical:
        sentences.append(f"{who} tells it from {_and(physical)} with the positive values above.")
    elif others and all(listing.complete for listing in others):
        sentences.append(
            f"No other of {among(chains)} gives {this} with positive values."
            if len({listing.chain for listing in others}) > 1
            else f"With positive values, {among(chains)} does not give {this}."
        )
    elif others:
        sentences.append(
            f"Among {among(chains)}, no other was found that does the same with positive values;"
            " not all are excluded."
        )
    if own and twins:
        sentences.append(f"Other positive values of the same structure give the same {what} too.")
    elif own and all(
        listing.complete for listing in result.listings if listing.chain == result.chain
    ):
        sentences.append("In its own structure no other positive values do.")
    if result.proportional and physical:
        sentences.append(
            "All springs have the same ratio k/d here; other ratios may rule out some of these."
        )
    return " ".join(sentences)


def _and(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"


def _formulas(chain: Chain, others: Sequence[Chain], options: argparse.Namespace) -> Iterator[str]:
    mark = "% " if options.latex else "# " if options.sympy else ""
    none = []
    for other in others:
        formula_map = explicit_map(chain, other)
        if formula_map is None:
            none.append(name_of(other))
            continue
        yield f"{mark}{name_of(chain)}  {text_drawing(chain)}"
        yield f"{mark}{name_of(other)}  {text_drawing(other)}   (primed)"
        yield f"{mark}by {', then '.join(formula_map.steps) or 'identity'}; {_check(formula_map)}"
        yield (
            formula_map.latex
            if options.latex
            else formula_map.python
            if options.sympy
            else formula_map.text
        )
        yield ""
    if none:
        yield f"{mark}no rational formulas known here: {', '.join(none)}"


def _check(formula_map: Map) -> str:
    if not formula_map.safety:
        return "identity of the transfer functions proven"
    sure = formula_map.certainty.in_words(formula_map.safety)
    return f"identity of the transfer functions checked, {sure}"
