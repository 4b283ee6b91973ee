"""Tables of a notebook on lists of models and networks: candidates before a fit, what is the same,
which explain a measurement.
"""

from disting.equivalence.duplicates import Duplicate, Gate
from disting.fit.results.networks import NetworkSelection
from disting.report.fit.words import readable
from disting.report.notebook.markup import LONGEST, block, facts, line, more, table
from disting.report.notebook.tables import table_of as table_of
from disting.report.words import plural
from disting.verdict.model_equivalents import ModelEquivalent


@table_of.register
def _gate(shown: Gate) -> str:
    groups = [(group[0], ", ".join(group[1:])) for group in shown.groups]
    known = [(name, identifiability.sentence) for name, identifiability in shown.parameters.items()]
    return block(
        line(f"{plural(len(known), 'model')} to be fitted", bold=True),
        table(["model", "what data determine"], known[:LONGEST]),
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
        *(facts((name, str(value)) for name, value in one.items()) for _, one in sets),
    )


@table_of.register
def _networks(shown: NetworkSelection) -> str:
    rows = [(f.network.name, readable(f.chi2), f.excluded_by) for f in shown.fits]
    return block(
        line(shown.sentence, bold=True),
        table(["network", "chi2 per line", "excluded by"], rows[:LONGEST]),
        more(len(rows), "networks", "fits has all."),
    )
