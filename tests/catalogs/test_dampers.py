"""Ground dampers of one model: Fig. 14 of the paper, literally, and against a plain SymPy
oracle.
"""

import csv
import io
from dataclasses import replace
from itertools import combinations

import pytest
import sympy as sp

from disting import Chain, Engine, Family, InputError, Query, Relation, View, compare
from disting.catalogs.dampers import DamperSets, DamperTable, dampers, spell
from disting.cli import main
from disting.cli.dampers import grid, legend
from disting.model.question import Domain

SAME, APART = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE
ENGINE = Engine()


def table(number, which=DamperSets.SINGLE, n=3, damped=True, domain=Domain.COMPLEX):
    """Over complex parameters, as the paper has them."""
    return dampers(Family(n, damped)[number], which, domain=domain, engine=ENGINE)


def test_sets_in_the_order_of_size_then_masses():
    assert [spell(s) for s in DamperSets.SINGLE.of(3)] == ["0", "1", "2", "3"]
    assert [spell(s) for s in DamperSets.ALL.of(3)] == [
        "0",
        "1",
        "2",
        "3",
        "1+2",
        "1+3",
        "2+3",
        "1+2+3",
    ]


# Printed: "the set of candidate models was chosen appropriately with distinguishable models only".
@pytest.mark.full
@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_force_and_sensor_at_mass_1_every_two_sets_are_distinguishable(n):
    assert {relation for *_, relation, _ in table(1, DamperSets.ALL, n).rows()} == {APART}


# Printed: "for other system, e.g. A3 it would not be possible to determine the correct positions of
# dampers".
def test_a3_tells_that_there_is_a_damper_but_not_where():
    assert table(3).classes() == (((),), ((1,), (2,), (3,)))
    everything = table(3, DamperSets.ALL)
    assert everything.classes() == (((),), everything.sets[1:])


@pytest.mark.full
def test_the_eleven_models_of_fig_14():
    """Groups of single ground dampers; what is not listed is distinguishable from all."""
    found = {number: [g for g in table(number).classes() if len(g) > 1] for number in range(1, 12)}
    assert {number: groups for number, groups in found.items() if groups} == FIG_14


FIG_14 = {
    3: [((1,), (2,), (3,))],
    4: [((1,), (3,))],
    6: [((), (1,))],
    7: [((), (1,)), ((2,), (3,))],
    8: [((), (1,))],
    9: [((), (1,), (2,))],
    10: [((), (1,), (2,))],
    11: [((), (1,))],
}


@pytest.mark.full
@pytest.mark.parametrize("domain", [Domain.POSITIVE, Domain.COMPLEX])
@pytest.mark.parametrize("number", [3, 6, 8])
def test_as_compare_says(number, domain):
    found = table(number, DamperSets.ALL, domain=domain)
    view = View.POSITIVE if domain is Domain.POSITIVE else View.EXACT
    for left, right, relation, rule in found.rows():
        pair = (replace(found.chain, ground_dampers=s) for s in (left, right))
        verdict = compare(*pair, query=Query(view, inclusion=False), engine=ENGINE)
        assert (verdict.relation, verdict.decided_by) == (relation, rule)
        assert found.relation(right, left) is relation
        assert found.verdict(right, left).relation is relation


def fraction(chain, p):
    """Receptance (num, den) as polynomials in s, from the matrix written down entry by entry
    and SymPy's own inverse.
    """
    s, n = sp.Symbol("s"), chain.n_masses
    a = sp.zeros(n, n)
    for i in range(1, n + 1):
        a[i - 1, i - 1] += p[f"m{i}"] * s**2 + p.get(f"b{i}", 0) * s
        if i < n:
            k = p[f"k{i}{i + 1}"] + p[f"d{i}{i + 1}"] * s
            a[i - 1, i - 1], a[i, i] = a[i - 1, i - 1] + k, a[i, i] + k
            a[i - 1, i], a[i, i - 1] = a[i - 1, i] - k, a[i, i - 1] - k
    num = a.adjugate()[chain.meas_plus - 1, chain.act_plus - 1]
    return sp.Poly(num, s), sp.Poly(a.det(method="berkowitz"), s)


def has_equivalent(given, other):
    """Whether fixed rational parameters of the one chain have an equivalent with non-zero
    elements in the other.
    """
    values = {name: sp.Integer(3 * i * i + 5 * i + 2) for i, name in enumerate(given.parameters)}
    unknown, extra = {name: sp.Symbol(name) for name in other.parameters}, sp.Symbol("inverse")
    (n1, d1), (n2, d2) = fraction(given, values), fraction(other, unknown)
    equations = sp.Poly((n1 * d2 - n2 * d1).as_expr(), sp.Symbol("s")).coeffs()
    equations.append(extra * sp.prod(unknown.values()) - 1)
    basis = sp.groebner(equations, extra, *unknown.values(), order="grevlex", modulus=32003)
    return basis.exprs != [1]


@pytest.mark.full
@pytest.mark.parametrize("sensor", [1, 2])
def test_against_sympy(sensor):
    found = dampers(
        Chain(2, meas_plus=sensor, damped=True),
        DamperSets.ALL,
        domain=Domain.COMPLEX,
        engine=ENGINE,
    )
    for left, right in combinations(found.sets, 2):
        one, other = (replace(found.chain, ground_dampers=s) for s in (left, right))
        both = has_equivalent(one, other) and has_equivalent(other, one)
        assert (found.relation(left, right) is SAME) == both


def test_what_is_undecided_joins_no_class():
    """Conditions 1 to 9 leave the two places of one damper open."""
    chain, sets = Chain(2, damped=True), ((), (1,), (2,))
    subjects = [ENGINE.subject(spell(s), replace(chain, ground_dampers=s)) for s in sets]
    paper = DamperTable(chain, sets, ENGINE.decisions(subjects, Query(View.COMBINED)))
    assert paper.relation((1,), (2,)) is Relation.UNDECIDED
    assert paper.classes() == (((),), ((1,),), ((2,),))


def test_bad_sets_are_refused():
    found = table(1)
    for pair in (((), ()), ((), (4,)), ((1, 2), ())):
        with pytest.raises(InputError, match="two different sets"):
            found.relation(*pair)


def test_csv_of_the_command(capsys):
    assert main(["dampers", "3:3", "--damped", "--csv", "-"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert list(rows[0]) == [
        "left",
        "right",
        "relation",
        "decided_by",
        "domain",
        "damped",
        "quantity",
    ]
    assert [(r["left"], r["right"]) for r in rows] == list(combinations("0123", 2))
    assert [r["relation"] for r in rows] == ["distinguishable"] * 3 + [
        "undecided",
        "indistinguishable",
        "undecided",
    ]
    assert {r["domain"] for r in rows} == {"positive"}


def test_table_of_the_command(capsys, tmp_path):
    asked = [
        "dampers",
        "3:3",
        "--damped",
        "--sets",
        "all",
        "--domain",
        "complex",
        "--csv",
        str(tmp_path / "a3.csv"),
    ]
    assert main(asked) == 0
    shown = capsys.readouterr().out
    assert (
        "8 sets, 28 pairs, over complex parameters: 7 distinguishable, 21 indistinguishable, 0"
        " undecided" in shown
    )
    assert "indistinguishable over complex parameters: 1 2 3 1+2 1+3 2+3 1+2+3" in shown
    lines = (tmp_path / "a3.csv").read_text().splitlines()
    assert lines[7:9] == [
        "0,1+2+3,distinguishable,1,complex,true,acceleration",
        "1,2,indistinguishable,7,complex,true,acceleration",
    ]


def test_the_table_speaks_of_positive_parameters_and_says_what_is_known_of_complex_ones(capsys):
    """Dampers at masses 1 and 3 of A3 are exchanged by a symmetry; for the others only complex
    equivalents are known.
    """
    assert main(["dampers", "3:3", "--damped"]) == 0
    shown = capsys.readouterr().out
    assert shown.splitlines()[3:7] == ["0 \\ . . .", "1 . \\ c =", "2 . c \\ c", "3 . = c \\"]
    assert "over positive parameters: . distinguishable, = indistinguishable" in shown
    assert "c undecided but indistinguishable over complex ones" in shown
    assert (
        "over positive parameters: 3 distinguishable, 1 indistinguishable, 2 undecided (2 of them "
        in shown
    )
    assert "indistinguishable over positive parameters: 1 3\n" in shown


@pytest.mark.parametrize(("n_masses", "blocks"), [(3, 1), (4, 1), (5, 1), (6, 2), (7, 5)])
def test_the_table_of_all_sets_fits_a_terminal(n_masses, blocks):
    """Every sign once, in rows and columns in one order, whatever the table is broken into."""
    names = [spell(s) for s in DamperSets.ALL.of(n_masses)]
    odd = 1, len(names) - 2  # two names with signs of their own

    def sign(i: int, j: int) -> str:
        return "<" if (i, j) == odd else ">" if (j, i) == odd else "."

    shown = grid(names, sign)
    assert max(map(len, shown.splitlines())) <= 80
    parts = [part.splitlines()[-len(names) :] for part in shown.rstrip("\n").split("\n\n")]
    assert len(parts) == blocks
    for i, name in enumerate(names):
        lines = [part[i].split() for part in parts]
        signs = [s for line in lines for s in line if s in "<>."]
        assert signs == [sign(i, j) for j in range(len(names))]
        assert all(name in line[:2] for line in lines)


@pytest.mark.parametrize("domain", [Domain.POSITIVE, Domain.COMPLEX])
def test_the_legend_fits_a_terminal(domain):
    assert max(map(len, legend(domain).splitlines())) <= 80


@pytest.mark.full
def test_a_whole_family_says_that_positive_parameters_are_not_asked(capsys):
    assert main(["dampers", "2", "--no-cache", "--undamped"]) == 0
    assert (
        "positive parameters are not examined here: use 'disting compare'"
        in capsys.readouterr().out
    )
    assert main(["dampers", "2", "--domain", "positive", "--undamped"]) == 2
    assert "over complex parameters" in capsys.readouterr().err


@pytest.mark.parametrize("wrong", [["3:12"], ["0"], ["three"], ["3:1", "--sets", "two"]])
def test_bad_input_of_the_command(wrong, capsys):
    try:
        status = main(["dampers", *wrong])
    except SystemExit as left:
        status = left.code
    assert status == 2
    assert capsys.readouterr().err.startswith("disting: ")


@pytest.mark.full
def test_the_command_for_a_whole_family(capsys, tmp_path):
    assert (
        main(
            [
                "dampers",
                "2",
                "--damped",
                "--sets",
                "all",
                "--csv",
                str(tmp_path / "two.csv"),
                "--no-cache",
            ]
        )
        == 0
    )
    shown = capsys.readouterr().out
    assert (
        shown.startswith("12 models, 66 pairs, over complex parameters: ")
        and "0 undecided" in shown
    )
    rows = list(csv.DictReader((tmp_path / "two.csv").open()))
    assert len(rows) == 66 and rows[0]["left"] == "2:1" and rows[-1]["right"] == "2:3+b1+b2"
    assert sum(r["relation"] == "indistinguishable" for r in rows) == int(
        shown.split(" indistinguishable")[0].split()[-1]
    )
