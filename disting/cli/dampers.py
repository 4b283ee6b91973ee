"""disting dampers: which sets of ground dampers of one model, or of all models of a size, can be
distinguished.
"""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import combinations
from textwrap import fill

from disting.catalogs.dampers import (
    SHIPPED_SIZES,
    DamperFamily,
    DamperSets,
    DamperTable,
    damper_catalog,
    damper_family,
    dampers,
    spell,
    write,
)
from disting.cli.arguments import add_damped, add_masses, add_out, add_work, is_damped
from disting.cli.output import emit, emitted_lines, written_file
from disting.cli.relations import relations_in_words
from disting.cli.workers import Work, announce, engine_for
from disting.conditions.rule import RULES
from disting.errors import InputError
from disting.model.chain import text_drawing
from disting.model.family import MOST_MASSES, Family
from disting.model.names import extras_of, name_of, read_together
from disting.model.question import Domain
from disting.verdict.joint import classes_safety, joint_in_words
from disting.verdict.result import Relation

SIGNS = {
    Relation.DISTINGUISHABLE: ".",
    Relation.INDISTINGUISHABLE: "=",
    Relation.SOMETIMES: "s",
    Relation.UNDECIDED: "?",
}
MEANING = {
    ".": "distinguishable",
    "=": "indistinguishable",
    "s": "indistinguishable for some only",
    "?": "undecided",
}
# of a pair that is open over positive parameters and indistinguishable over complex ones
COMPLEX_ONLY = "c"
NOT_ASKED = (
    "positive parameters are not examined here: use 'disting compare' or 'disting dampers N:I'"
)
WIDTH = 80  # columns of a terminal
FIXED = "\xa0"  # a space at which no line ends
SETS = "0 no damper to the ground, 1+3 dampers at masses 1 and 3"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = (
        "a model (masses:number, as 'disting models' lists it), or a number of masses: all its"
        " models, all against all"
    )
    parser.add_argument("model", metavar="N:I|N", help=text)
    names = [s.value for s in DamperSets]
    text = (
        "one damper at a time (single, as in the paper's Fig. 14) or all 2^N sets (default: single)"
    )
    parser.add_argument("--sets", choices=names, default=DamperSets.SINGLE.value, help=text)
    names = [Domain.POSITIVE.value, Domain.COMPLEX.value]
    text = (
        "parameters for which verdicts on one model hold (default: positive); those on a whole"
        " family hold for complex ones"
    )
    parser.add_argument("--domain", choices=names, default="", help=text)
    parser.add_argument(
        "--csv",
        type=written_file,
        metavar="FILE",
        help="write all pairs as CSV; - is standard output",
    )
    add_damped(parser)
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """Print the table, or write it as CSV."""
    if options.model.isdecimal():
        return _whole_family(options)
    (chain,) = read_together([options.model], damped=is_damped(options))
    if extras_of(chain):
        raise InputError(
            f"every set of dampers is examined: name the model without {extras_of(chain)}"
        )
    domain = Domain(options.domain or Domain.POSITIVE)
    with engine_for(options) as (engine, pool, progress):
        job = partial(
            dampers,
            chain,
            options.sets,
            engine=engine,
            executor=pool,
            progress=progress,
        )
        table, over_complex = job(domain=domain), job(domain=Domain.COMPLEX)
    if options.csv:
        emit(options.csv, table.to_csv())
    if options.csv != "-":
        shown = f"{matrix(table, over_complex)}\n{legend(domain)}\n\n{summary(table, over_complex)}"
        sys.stdout.write(f"{name_of(chain)}  {text_drawing(chain)}\n\n{shown}\n")
    return 0


def add_build_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `disting catalog dampers`."""
    add_masses(parser, default="3 4 5")
    add_out(parser, "catalog")
    add_work(parser)


def build(options: argparse.Namespace) -> int:
    """Compute the classes of whole families with all sets of dampers, undamped and damped, and
    write their files.
    """
    with engine_for(options) as (engine, pool, progress):
        for n in options.masses or SHIPPED_SIZES:
            for damped in (False, True):
                family = damper_family(
                    n,
                    damped=damped,
                    folder=options.out,
                    engine=engine,
                    executor=pool,
                    progress=progress,
                )
                print(f"{write(family, engine.settings, options.out)}: {count_line(family)}")
    return 0


def _whole_family(options: argparse.Namespace) -> int:
    """All models of a size with all sets: by classes, pairs only as they are written; over
    complex parameters.
    """
    if options.domain == Domain.POSITIVE:
        raise InputError(
            "whole families are decided over complex parameters; over positive ones ask for one"
            " model, such as 3:4"
        )
    family = _family(int(options.model), options)
    if options.csv:
        emitted_lines(options.csv, family.csv_lines())
    if options.csv == "-":
        return 0
    rules = ", ".join(
        f"{n} by {_rule(rule)}" for rule, n in family.found.counts_by_rule().items() if rule
    )
    groups = family.classes()
    print(f"{count_line(family)}\n{rules}")
    print(
        f"{len(groups)} classes of indistinguishable models, the largest of"
        f" {max(map(len, groups), default=0)}"
    )
    print(NOT_ASKED)
    return 0


def _family(n: int, options: argparse.Namespace) -> DamperFamily:
    """The shipped classes, or computed where there are none."""
    if not 1 <= n <= MOST_MASSES:
        raise InputError(f"families of 1 to {MOST_MASSES} masses are listed, not of {n}")
    which = DamperSets(options.sets)
    if n in SHIPPED_SIZES and which is DamperSets.ALL:
        return damper_catalog(n, damped=is_damped(options))
    announce(Work.DAMPERS, {n: len(Family(n)) * len(which.of(n))}, options.jobs)
    with engine_for(options) as (engine, pool, progress):
        return damper_family(
            n,
            damped=is_damped(options),
            which=which,
            engine=engine,
            executor=pool,
            progress=progress,
        )


def count_line(family: DamperFamily) -> str:
    """Models, pairs and how surely all of it holds, in one line."""
    counts = family.found.counts()
    phrase = ", ".join(f"{n} {relation}" for relation, n in counts.items())
    head = f"{len(family)} models, {sum(counts.values())} pairs, over complex parameters: {phrase}"
    return f"{head}; {joint_in_words(classes_safety(family.found))}"


def _rule(rule: str) -> str:
    return RULES[rule].in_words()


def matrix(table: DamperTable, over_complex: DamperTable) -> str:
    """A line a set, a column a set, a sign where they meet."""

    def sign(i: int, j: int) -> str:
        """Of two sets."""
        return "\\" if i == j else _sign(table, over_complex, i, j)

    return grid([spell(s) for s in table.sets], sign)


def grid(names: Sequence[str], sign: Callable[[int, int], str]) -> str:
    """The signs of all pairs of names (line, column), at most 80 columns wide. Where the names are
    too wide for the heads of the columns, their numbers do, one digit below the other, in blocks.
    """
    columns = range(len(names))
    block = list(_block(names, [names], columns, sign))
    if len(block[0]) <= WIDTH:
        return "\n".join(block) + "\n"
    digits, longest = len(str(len(names))), max(map(len, names))
    numbers = [f"{k:>{digits}}" for k in range(1, len(names) + 1)]
    heads = [f"{k} {name:>{longest}}" for k, name in zip(numbers, names, strict=True)]
    tops = [[number[place] for number in numbers] for place in range(digits)]
    fit = (WIDTH - len(heads[0])) // 2
    parts = (columns[k : k + fit] for k in range(0, len(names), fit))
    return "\n\n".join("\n".join(_block(heads, tops, part, sign)) for part in parts) + "\n"


def _block(
    heads: Sequence[str],
    tops: Sequence[Sequence[str]],
    columns: Sequence[int],
    sign: Callable[[int, int], str],
) -> Iterator[str]:
    """Some columns of a matrix below the lines of their heads."""
    margin, widths = max(map(len, heads)), [len(tops[0][j]) for j in columns]

    def line(head: str, cells: Iterable[str]) -> str:
        """A head and its cells."""
        aligned = (f"{cell:>{width}}" for cell, width in zip(cells, widths, strict=True))
        return f"{head:>{margin}} {' '.join(aligned)}"

    for top in tops:
        yield line("", (top[j] for j in columns))
    for i, head in enumerate(heads):
        yield line(head, (sign(i, j) for j in columns))


def _sign(table: DamperTable, over_complex: DamperTable, i: int, j: int) -> str:
    text = SIGNS[table.decided.relation(i, j)]
    same = over_complex.decided.relation(i, j) is Relation.INDISTINGUISHABLE
    return COMPLEX_ONLY if text == "?" and same else text


def legend(domain: Domain) -> str:
    """Legend of the signs, with the parameter domain."""
    signs = ", ".join(
        f"{sign} {meaning}"
        for sign, meaning in MEANING.items()
        if sign != "s" or domain is not Domain.COMPLEX
    )
    more = (
        f", {COMPLEX_ONLY} undecided but indistinguishable over complex ones"
        if domain is not Domain.COMPLEX
        else ""
    )
    meaning = f"{signs}{more}".replace(" ", FIXED).replace(f",{FIXED}", ", ")
    lines = fill(f"over {domain} parameters: {meaning}", WIDTH, break_long_words=False)
    return f"{lines.replace(FIXED, ' ')}\n{SETS}"


def summary(table: DamperTable, over_complex: DamperTable) -> str:
    """Number of pairs by relation, and the groups that cannot be distinguished."""
    pairs = list(combinations(range(len(table.sets)), 2))
    counts = relations_in_words(table.decided.relation(i, j) for i, j in pairs)
    signs = [_sign(table, over_complex, i, j) for i, j in pairs]
    open_ones = signs.count(COMPLEX_ONLY)
    more = f" ({open_ones} of them indistinguishable over complex parameters)" if open_ones else ""
    groups = [" ".join(map(spell, group)) for group in table.classes() if len(group) > 1]
    over = f"over {table.domain} parameters"
    same = "".join(f"\nindistinguishable {over}: {group}" for group in groups)
    return f"{len(table.sets)} sets, {len(pairs)} pairs, {over}: {counts}{more}{same}"
