"""What the functions on verdicts take: matrices of a state space, a domain, a quantity by its name
on the command line, and the old name of an argument.
"""

import numpy as np
import pytest
from sympy import symbols

from disting import (
    InputError,
    MatrixModel,
    Model,
    Query,
    View,
    alternatives,
    compare,
    compare_everywhere,
    equivalents,
    everywhere_file,
    explicit_map,
    findings,
    gate,
    global_identifiability,
    identifiability,
    local_identifiability,
    network_of,
    transfer_function,
    verdict_file,
    verify,
)

INPUT, OUTPUT = [["1"], ["0"]], [["0", "1"]]
LEAKS = [["-k12-k01", "0"], ["k12", "-k02"]], INPUT, OUTPUT
EXCHANGE = [["-k12-k01", "k21"], ["k12", "-k21"]], INPUT, OUTPUT
OSCILLATOR = np.array([[0.0, 1.0], [-2.0, -3.0]]), np.array([[0.0], [1.0]]), np.array([[1.0, 0.0]])


def test_a_printed_verdict_is_its_sentence():
    found = compare("3:1", "3:11")
    assert str(found) == found.sentence and "(equivalents with positive parameters)" in str(found)
    assert (
        repr(found).startswith("<Verdict: 3:1 and 3:11") and found.relation == "indistinguishable"
    )


@pytest.mark.full
def test_matrices_are_compared_as_the_models_that_they_make():
    found = compare(LEAKS, EXCHANGE, domain="complex")
    models = [Model.from_state_space(*m, name=n) for m, n in ((LEAKS, "a"), (EXCHANGE, "b"))]
    assert found.relation is compare(*models, query=Query(View.EXACT)).relation
    assert (found.left, found.right) == ("state space 1", "state space 2")
    assert compare((*LEAKS, 0), models[0], domain="complex").relation == "indistinguishable"
    both = [["1", "0"], ["0", "1"]]
    assert identifiability((*LEAKS[:2], both)).level == "global"
    assert verify(verdict_file(LEAKS, EXCHANGE, domain="complex")).status == "holds"
    assert findings(LEAKS, EXCHANGE)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (
            LEAKS[:2],
            r"\(A, B, C\) or \(A, B, C, D\), not 2 entries; for a transfer function",
        ),
        (OSCILLATOR, "numbers only: write a name such as 'k'"),
        ((*LEAKS[:2], [["0", "1", "1"]]), "C is 1 x 2"),
    ],
)
def test_other_tuples_are_refused_with_the_remedy(wrong, words):
    with pytest.raises(InputError, match=words):
        compare(wrong, EXCHANGE)


@pytest.mark.full
def test_matrices_are_models_everywhere():
    values = {"k12": 1, "k01": 2, "k02": 3}
    (found,) = equivalents(LEAKS, values, EXCHANGE)
    assert found.verdict.right == "state space 2"
    assert alternatives(LEAKS, values, EXCHANGE).equivalents
    of_symbols = {symbols(name): value / 2 for name, value in values.items()}
    (half,) = equivalents(LEAKS, of_symbols, EXCHANGE)  # floats by their decimal text
    assert half.values.equivalents
    assert gate([LEAKS, EXCHANGE]).kept[0].startswith("state space ")
    assert local_identifiability(LEAKS).rank == 3
    assert global_identifiability(LEAKS).local.rank == 3


@pytest.mark.parametrize("kind", [Model, MatrixModel])
def test_a_class_that_is_given_matrices_names_its_constructor(kind):
    with pytest.raises(InputError, match=rf"given to {kind.__name__}\.from_state_space"):
        kind(*OSCILLATOR)


@pytest.mark.parametrize("network", ["R0-p(R1,C1)", network_of("R0-p(R1,C1)"), LEAKS])
def test_formulas_of_other_models_are_found_elsewhere(network):
    with pytest.raises(InputError, match="use equivalents or alternatives"):
        explicit_map(network, "3:1")


@pytest.mark.full
def test_a_domain_is_that_of_the_command_line():
    for domain, view in (("complex", View.EXACT), ("real", View.REAL), ("positive", View.POSITIVE)):
        assert compare(LEAKS, EXCHANGE, domain=domain) == compare(
            LEAKS, EXCHANGE, query=Query(view)
        )
    everywhere = compare_everywhere("2:1", "2:2", ["sensor=2"], domain="complex")
    assert {verdict.domain for _, verdict in everywhere.verdicts} == {"complex"}
    (first, *_) = everywhere_file("2:1", "2:2", ["sensor=2"], domain="complex")["verdicts"]
    assert first["query"]["view"] == "exact"


def test_a_domain_and_a_query_agree():
    query = Query(View.COMBINED, ("1", "4"))
    assert compare("3:1", "3:4", domain="complex", query=query).domain == "complex"
    with pytest.raises(InputError, match="query is over complex parameters, domain is real"):
        compare("3:1", "3:4", domain="real", query=query)


CALLS = {
    compare: ("2:1", "2:2"),
    findings: ("2:1", "2:2"),
    identifiability: ("2:1",),
    transfer_function: ("2:1",),
    verdict_file: ("2:1", "2:2"),
    compare_everywhere: ("2:1", "2:2", []),
    everywhere_file: ("2:1", "2:2", []),
}


@pytest.mark.parametrize("function", CALLS, ids=lambda f: f.__name__)
def test_the_old_name_of_quantity_is_accepted_with_a_warning(function):
    with pytest.warns(DeprecationWarning, match="the argument sensor is now called quantity"):
        old = function(*CALLS[function], sensor="velocity")
    assert old == function(*CALLS[function], quantity="velocity")
    with pytest.raises(InputError, match="give quantity alone"):
        function(*CALLS[function], sensor="velocity", quantity="velocity")
