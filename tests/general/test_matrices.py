"""Models with several inputs and outputs: identifiability beside published answers and plain SymPy,
verdicts, files, bad input.
"""

import json
from random import Random

import pytest
from sympy import Matrix, Rational, symbols

from disting import (
    Chain,
    Domain,
    Experiment,
    InputError,
    Level,
    MatrixModel,
    Model,
    ModelList,
    Query,
    View,
    alternatives,
    compare,
    global_identifiability,
    identifiability,
    local_identifiability,
    read_models,
    write_models,
)
from disting.general.behaviour import GeneralModel
from tests.cli.process import called
from tests.general.plain_matrices import determined, has_other, names_of, system

G, L, N = Level.GLOBAL, Level.LOCAL, Level.NOT


def compartments(edges, inputs, outputs, leaks=()):
    """A, B, C of vessels: `a21` from 1 to 2, `a01` a leak of 1."""
    n = max(max(e) for e in edges)
    a = [["0"] * n for _ in range(n)]
    for i, j in edges:
        a[j - 1][i - 1] += f"+a{j}{i}"
        a[i - 1][i - 1] += f"-a{j}{i}"
    for i in leaks:
        a[i - 1][i - 1] += f"-a0{i}"
    b = [[int(i == j) for j in inputs] for i in range(1, n + 1)]
    return a, b, [[int(i == j) for j in range(1, n + 1)] for i in outputs]


FIVE = [(1, 2), (2, 1), (2, 3), (3, 1), (3, 2)]
SIX = [*FIVE, (1, 3)]
THREE_IN_A_ROW = [["-a1", "b1", 0], ["a1", "-a2-b1", "b2"], [0, "a2", "-b2"]]
BILIRUBIN = [
    ["-k21-k31-k41-k01", "k12", "k13", "k14"],
    ["k21", "-k12", 0, 0],
    ["k31", 0, "-k13", 0],
    ["k41", 0, 0, "-k14"],
]
# Answers of the tests of StructuralIdentifiability.jl 0.4 (linear_compartment, identifiability and
# identifiable_functions): what is determined there for generic initial states is so at rest.
PUBLISHED = {
    "five edges, 2 to 1": (compartments(FIVE, [2], [1]), "N N L N G", "a32 a13 a21 a23 a12"),
    "five edges, 2 to 2": (compartments(FIVE, [2], [2]), "N N L N N", "a32 a13 a21 a23 a12"),
    "six edges and a leak": (
        compartments(SIX, [1, 2], [3], [1]),
        "G G G G G G G",
        "a21 a31 a12 a32 a13 a23 a01",
    ),
    "six edges": (compartments(SIX, [1, 2], [3]), "N G N G N N", "a21 a31 a12 a32 a13 a23"),
    "five edges and a leak": (
        compartments(FIVE, [1, 3], [3], [1]),
        "G G G G G G",
        "a21 a12 a32 a13 a23 a01",
    ),
    "five edges": (compartments(FIVE, [1, 3], [3]), "N N N N N", "a21 a12 a32 a13 a23"),
    "diagonal": (
        (
            [["l1", 0, 0], [0, "l2", 0], [0, 0, "l3"]],
            [["b1", 0, 0], [0, "b2", 0], [0, 0, "b3"]],
            [[1, 1, 1]],
        ),
        "G G G G G G",
        "l1 l2 l3 b1 b2 b3",
    ),
    "three in a row": ((THREE_IN_A_ROW, [[1], [0], [0]], [[1, 0, 0]]), "G G G G", "a1 a2 b1 b2"),
    "two in a row": (
        ([["-a1", "a21"], [0, "-a2-a21"]], [[0], [1]], [[1, 0]]),
        "L L G",
        "a1 a2 a21",
    ),
    "bilirubin": (
        (BILIRUBIN, [[1], [0], [0], [0]], [[1, 0, 0, 0]]),
        "G L L L L L L",
        "k01 k12 k13 k14 k21 k31 k41",
    ),
}
# Nothing is seen of what flows into vessel 1 where the others are empty at first.
AT_REST = {
    "two sources": compartments([(2, 1), (3, 1)], [1], [1]),
    "sources in a row": compartments([(2, 1), (3, 1), (3, 2)], [1], [1]),
}
OWN = {
    "both seen": ([["-a-b", 0], ["a", "-c"]], [[1], [0]], [[1, 0], [0, 1]]),
    "hidden gain": ([["-a", 0], ["b", "-c"]], [[1], [0]], [[1, 0], [0, "d"]]),
    "swapped": ([["-a", 0], [0, "-b"]], [[1], [1]], [["c", "d"], [1, 1]]),
}


def levels(answers, names):
    by_letter = {"G": G, "L": L, "N": N}
    pairs = zip(answers.split(), names.split(), strict=True)
    return {name: by_letter[letter] for letter, name in pairs}


@pytest.mark.thin(1)
@pytest.mark.parametrize(("space", "answers", "names"), PUBLISHED.values(), ids=PUBLISHED)
def test_published_answers(space, answers, names):
    found = identifiability(MatrixModel.from_state_space(*space), domain="complex")
    several = {Level.EXCHANGES: L}  # which is local, and more
    assert {n: several.get(x, x) for n, x in found.levels.items()} == levels(answers, names)
    assert found.safety >= 100 and found.reason == ""


@pytest.mark.parametrize("space", AT_REST.values(), ids=AT_REST)
def test_at_rest_nothing_is_seen_of_other_vessels(space):
    found = identifiability(MatrixModel.from_state_space(*space))
    assert set(found.levels.values()) == {N} and found.rank == 0


EVERY = {name: case[0] for name, case in PUBLISHED.items()} | AT_REST | OWN


@pytest.mark.full
@pytest.mark.parametrize("space", EVERY.values(), ids=EVERY)
def test_ranks_beside_plain_sympy(space):
    plain, draw = system(*space), Random("ranks")
    point = {n: Rational(draw.randint(2, 99), draw.randint(2, 99)) for n in names_of(*plain)}
    rank, seen = determined(*plain, point)
    found = local_identifiability(MatrixModel.from_state_space(*space))
    assert (found.rank, list(found.identifiable)) == (rank, seen)


@pytest.mark.full
@pytest.mark.parametrize("space", OWN.values(), ids=OWN)
def test_other_values_beside_plain_sympy(space):
    plain, draw = system(*space), Random("values")
    point = {n: draw.randint(2, 10**8) for n in names_of(*plain)}
    found = identifiability(MatrixModel.from_state_space(*space), domain="complex")
    for name, level in found.levels.items():
        if level is not N:
            assert (level is G) is not has_other(*plain, point, name), name


@pytest.mark.parametrize("name", ["six edges", "two in a row", "diagonal"])
def test_the_search_case_by_case_says_the_same(name):
    space, answers, names = PUBLISHED[name]
    found = global_identifiability(MatrixModel.from_state_space(*space), tries=4)
    expected = levels(answers, names)
    assert set(found.unique) <= {n for n, level in expected.items() if level is G}
    assert found.local.rank == identifiability(MatrixModel.from_state_space(*space)).rank


def test_one_entry_alone_is_a_model():
    space = [["-a-b", "c"], ["a", "-c"]], [1, 0], [1, 0]
    one, matrix = Model.from_state_space(*space), MatrixModel.from_state_space(*space)
    assert matrix.rows == ((one,),)
    found = [identifiability(m) for m in (one, matrix)]
    assert found[0].levels == found[1].levels and found[0].rank == found[1].rank


@pytest.mark.full
def test_sensors_of_a_chain_are_rows_of_a_matrix():
    """Two ways to the same answer: experiments on a chain, and the matrix written by hand."""
    k12, k23, m1, m2, m3, s = symbols("k12 k23 m1 m2 m3 s")
    stiffness = Matrix(
        [
            [m1 * s**2 + k12, -k12, 0],
            [-k12, m2 * s**2 + k12 + k23, -k23],
            [0, -k23, m3 * s**2 + k23],
        ]
    )
    column = (s**2 * stiffness.inv())[:, 0].applyfunc(lambda x: x.cancel())
    for i, j in ((3, 2), (2, 3), (3, 1)):
        by_hand = MatrixModel.from_transfer_functions([[column[i - 1]], [column[j - 1]]])
        chain = Chain(3, act_plus=1, meas_plus=i, damped=False)
        measured = identifiability(chain, experiments=[Experiment(), Experiment(sensor=j)])
        found = identifiability(by_hand)
        assert found.levels == {n: measured.levels[n] for n in found.levels}
        assert (found.rank, found.freedom) == (measured.rank, measured.freedom)


EXACT = Query(View.EXACT)
ONE = MatrixModel.from_transfer_functions([["1/(s+a)"], ["b/((s+a)*(s+c))"]], name="one")
CROSSED = MatrixModel.from_transfer_functions([["1/(s+a)"], ["b/((s+d)*(s+c))"]], name="crossed")
RENAMED = MatrixModel.from_transfer_functions([["1/(s+z)"], ["y/((s+z)*(s+x))"]], name="renamed")
OTHERWISE = MatrixModel.from_state_space([["-k12-k01", 0], ["k12", "-k02"]], [1, 0], Matrix.eye(2))


@pytest.mark.parametrize("view", [View.EXACT, View.POSITIVE])
def test_a_renaming_is_seen(view):
    found = compare(ONE, RENAMED, query=Query(view))
    assert found.relation.value == "indistinguishable"
    assert found.decided_by == ("6" if view is View.EXACT else "admissible")


def test_entries_that_agree_one_by_one_differ_together():
    """One pole in common or none: each entry can be what that of the other model is."""
    for at in (0, 1):
        sides = [m.rows[at][0] for m in (ONE, CROSSED)]
        assert compare(*sides, query=EXACT).relation.value == "indistinguishable"
    assert compare(ONE, CROSSED, query=EXACT).relation.value == "distinguishable"


def test_the_same_over_complex_parameters_and_for_some_positive_ones():
    assert compare(ONE, OTHERWISE, query=EXACT).relation.value == "indistinguishable"
    found = compare(ONE, OTHERWISE)
    assert found.relation.value == "sometimes" and found.certainty.value == "proven"


def test_an_entry_that_is_zero_is_part_of_the_form():
    full, triangular = (
        MatrixModel.from_transfer_functions([["1/(s+a)", corner], ["b/(s+a)", "1/(s+b)"]])
        for corner in ("c/(s+a)", 0)
    )
    assert GeneralModel(triangular).degrees[1] == (-1, 0)
    assert str(triangular).count("[[1/(a + s), 0]") == 1
    assert compare(full, triangular, query=EXACT).relation.value == "distinguishable"
    assert identifiability(triangular).level is G


def test_a_matrix_of_one_entry_is_that_transfer_function():
    one = Model.from_transfer_function("a*b", "s + a*b", name="one")
    same, other = (
        MatrixModel.from_transfer_functions([[text]], name="matrix")
        for text in ("c/(s + c)", "c/(s + 1)")
    )
    for pair in ((one, same), (same, one), (same, same)):
        assert compare(*pair, query=EXACT).relation.value == "indistinguishable"
        assert compare(*pair).relation.value == "indistinguishable"
    assert compare(one, other).relation.value == "distinguishable"


@pytest.mark.full
def test_entries_with_other_leading_coefficients_are_solved_together():
    one = MatrixModel.from_transfer_functions([["1/(a*s + 1)"], ["b/(c*s + 1)"]])
    found = alternatives(one, {"a": 2, "b": 3, "c": 5}, one)
    assert [x.values for x in found.within(Domain.COMPLEX)] == [{"a": 2, "b": 3, "c": 5}]


def test_transposed_twins():
    """A symmetric state space shows the same whichever way it is driven."""
    a, b, c = [["-a", "c"], ["c", "-b"]], [[1], ["g"]], [[1, 0], [0, 1]]
    one = MatrixModel.from_state_space(a, b, c, name="driven")
    other = MatrixModel.from_state_space(a, c, [[1, "g"]], name="measured")
    assert one.shape == (2, 1) and other.shape == (1, 2)
    assert [e.content for e in one.entries] == [e.content for e in other.entries]


def test_files(tmp_path):
    models = [
        {"name": "space", "A": [["-a", 0], ["b", "-c"]], "B": [1, 0], "C": [[1, 0], [0, 1]]},
        {"name": "matrix", "G": [["1/(s+z)", 0], ["0.5*y/((s+z)*(s+x))", "s/(s+1)"]]},
        {"name": "through", "A": [["-a"]], "B": [[1, "b"]], "C": [1], "D": [[0, "d"]]},
        {"name": "single", "A": [["-a"]], "B": [1], "C": [1]},
    ]
    path = tmp_path / "models.json"
    path.write_text(json.dumps({"models": models}))
    found = read_models(path)
    assert [type(m) for m in found] == [MatrixModel, MatrixModel, MatrixModel, Model]
    assert [m.shape for m in found if isinstance(m, MatrixModel)] == [(2, 1), (2, 2), (1, 2)]
    again = read_models(write_models(tmp_path / "again.json", ModelList(found.models)))
    assert again.models == found.models and [m.name for m in again] == [m.name for m in found]


@pytest.mark.full
def test_the_command_line_tells_of_files(tmp_path):
    path = tmp_path / "two.json"
    models = [
        {"name": "one", "G": [["1/(s+a)"], ["b/((s+a)*(s+c))"]]},
        {"name": "renamed", "G": [["1/(s+z)"], ["y/((s+z)*(s+x))"]]},
    ]
    path.write_text(json.dumps({"models": models}))
    assert called("models", path).stdout.splitlines() == [
        f"{name}: 3 parameters, all globally identifiable." for name in ("one", "renamed")
    ]
    assert "these are the same: one, renamed" in called("verdicts", path).stdout
    assert called("compare", f"{path}:one", f"{path}:renamed").stdout.startswith("INDIST")


BAD = {
    "A is square": lambda: MatrixModel.from_state_space([["a", 1]], [1], [1]),
    "B is 2 x 1 .*, not 1 x 1": lambda: MatrixModel.from_state_space(
        [["a", 0], [0, 1]], [1], [1, 0]
    ),
    "B is 1 x 2 .*, not 2 x 2": lambda: MatrixModel.from_state_space(
        [["a"]], [[1, 0], [0, 1]], [1]
    ),
    "C is 1 x 1 .*, not 1 x 2": lambda: MatrixModel.from_state_space([["a"]], [1], [[1, 0]]),
    "D is 1 x 2 .*, not 1 x 1": lambda: MatrixModel.from_state_space([["a"]], [[1, 1]], [1], 3),
    "frequency variable s": lambda: MatrixModel.from_state_space([["s"]], [[1, 1]], [1]),
    "the transfer function is zero": lambda: MatrixModel.from_state_space([["a"]], [[0, 0]], [1]),
    "at least one parameter": lambda: MatrixModel.from_transfer_functions([["1/s", "1/s"]]),
    "equally many entries": lambda: MatrixModel.from_transfer_functions([["a"], ["a", "b"]]),
    "list of rows": lambda: MatrixModel.from_transfer_functions(["a", "b"]),
    "100 entries at most": lambda: MatrixModel.from_transfer_functions([["a"] * 101]),
    "the same outputs and inputs: one has 2 x 1": lambda: compare(
        ONE, MatrixModel.from_transfer_functions([["a/s", "b/s"]])
    ),
    "they have no masses to measure at": lambda: identifiability(ONE, experiments=[Experiment()]),
    "1 outputs and 2 inputs": lambda: Model.from_state_space([["a"]], [[1, 1]], [1]),
}


@pytest.mark.thin(8)
@pytest.mark.parametrize(("said", "call"), BAD.items(), ids=BAD)
def test_bad_input(said, call):
    with pytest.raises(InputError, match=said):
        call()
