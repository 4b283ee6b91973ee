"""Structures folded to mechanics: hand-made sets, and every structure in exactly one line."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from disting.cli.fit_text import fit_text
from disting.fit.judge.admissible import Rule
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.mechanics import fold
from disting.fit.judge.members import Member
from disting.fit.search.candidates import figure_1, reference
from disting.fit.search.estimate import Estimate
from disting.fit.select import select
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import chain_of
from disting.report.fit.answer import list_lines, list_structures
from disting.report.fit.mechanics_words import fold_names, headline, structure_in_words
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.sentences import first_lines, suspicions
from disting.statistics.covariance import Noise
from disting.statistics.practical import Practical, Thresholds
from tests.fit.drives import OMEGA, response


def member(name, j=1.0, **zero):
    """A structure of which all values are 1; those of `zero` are below that value only."""
    chain = chain_of(name, Family(1, damped=True)) if isinstance(name, str) else name
    values = dict.fromkeys(chain.parameters, 1.0)
    nothing = np.zeros(0)
    criteria = Practical(chain.parameters, {}, 1.0, (1.0,), {}, {})
    fitted = Candidate(
        chain, Estimate(chain, values, j), criteria, j, 1.0, (), nothing, nothing, Noise(nothing)
    )
    intervals = {n: (0.0, zero[n]) if n in zero else (0.9, 1.1) for n in values}
    return Member(fitted, (), (), (), intervals)


def folded(*names):
    return fold([member(name) for name in names])


def test_what_differs_in_the_actuator_only_is_one_line_with_the_best_cost():
    both = fold([member("2:1+b1+delay", 7.0), member("3:1"), member("2:1+b1+lag", 6.0)])
    assert [line.name for line in both.lines] == ["2:1+b1", "3:1"]
    first = both.lines[0]
    assert [m.name for m in first.members] == ["2:1+b1+delay", "2:1+b1+lag"]
    assert first.best.name == "2:1+b1+lag" and first.actuators == (("dead time",), ("lag",))
    assert both.sizes == (2, 3) and both.actuators == (("dead time",), (), ("lag",))


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (
            ["2:1+b1+delay", "2:1+b1+lag"],
            "2 masses, force and sensor at mass 1, damper d12, friction at the motor (b1);"
            " dead time or lag: not decided by this data",
        ),
        (
            ["2:1+b1+delay"],
            "2 masses, force and sensor at mass 1, damper d12, friction at the motor (b1),"
            " dead time",
        ),
        (
            ["2:1+b1", "2:1+b2"],
            "2 masses, force and sensor at mass 1, damper d12; friction at the motor (b1) or the"
            " load (b2): not decided by this data",
        ),
        (
            ["3:1+b1+b2", "4:1+b1"],  # mass 4 and its damper come with the fourth mass
            "3 or 4 masses, force and sensor at mass 1, dampers d12 and d23, friction at the motor"
            " (b1); friction at mass 2 (b2): not decided by this data",
        ),
        (
            ["1:1+lag+delay", "1:1+delay"],
            "1 mass, force and sensor at mass 1, dead time; lag or none: not decided by this data",
        ),
        (
            ["1:1+lag+delay", "1:1"],
            "1 mass, force and sensor at mass 1; lag and dead time or none: not decided by this"
            " data",
        ),
        (
            ["3:1", "3:2"],
            "3 masses; places of force, sensor and dampers: not decided by this data",
        ),
        (["3:11"], "3 masses, force and sensor between masses 2 and 3, dampers d01 and d12"),
    ],
)
def test_words_are_literally_true(names, words):
    assert structure_in_words(folded(*names)) == words


def test_a_damper_that_may_be_zero_is_not_decided():
    one, other = member("2:1+b2", d12=0.3), member("2:1+b2+lag")
    assert fold([other]).shared == ("d12", "b2") and fold([one, other]).shared == ("b2",)
    assert fold([one, member("2:1")]).undecided == ("d12", "b2")
    assert structure_in_words(fold([one, member("2:1")])) == (
        "2 masses, force and sensor at mass 1; damper d12 or friction at the load (b2): not decided"
        " by this data"
    )


def test_large_sets_are_counted():
    every = fold([member(chain) for chain in figure_1((2, 3, 4))])
    assert headline(every) == "2 to 4 masses"
    assert len(every.lines) == 4 + 8 + 16
    assert structure_in_words(every) == (
        "2 to 4 masses, force and sensor at mass 1, damper d12; friction at the motor (b1), mass 2"
        " (b2), mass 3 (b3) or mass 4 (b4), dead time, lag, both or none: not decided by this data"
    )


@pytest.mark.full
@given(st.permutations(figure_1((1, 2, 3))), st.integers(1, 40))
def test_the_lines_name_every_structure_exactly_once(chains, count):
    """Literally: the name of the line and one of the ends beside it are the name of a member."""
    chosen = [member(chain) for chain in chains[:count]]
    ends = {(): "", ("lag",): "+lag", ("dead time",): "+delay", ("lag", "dead time"): "+lag+delay"}
    lines = fold(chosen).lines
    names = [f"{line.name}{ends[parts]}" for line in lines for parts in line.actuators]
    assert sorted(names) == sorted(m.name for m in chosen)
    assert {line.chain.dead_time or line.chain.lag for line in lines} == {False}
    together = [name.partition(" (")[0] for name in fold_names(m.name for m in chosen)]
    plain = {n.removesuffix("+delay").removesuffix("+lag") for n in names}
    assert {n.removesuffix("+delay").removesuffix("+lag") for n in together} == plain
    assert len(together) == len(plain)


DRIVE = Chain(2, ground_dampers=(1,), dead_time=True)
VALUES = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0, "b1": 30.0, "Td": 2e-5}


@pytest.fixture(scope="module")
def found():
    lagging = replace(DRIVE, dead_time=False, lag=True)
    train, test = (response(DRIVE, VALUES, noise=0.02, seed=seed) for seed in (1, 2))
    return select(train, [DRIVE, lagging, replace(DRIVE, ground_dampers=())], test=test)


@pytest.mark.full
def test_text_and_data_say_the_same(found):
    lines, plain = first_lines(found), selection_to_dict(found)
    text = list(fit_text(found, found.task.cost.measured))
    assert plain["answer"] == list(lines) and len(lines) == 3
    at = text.index(lines[0])
    assert tuple(text[at : at + 3]) == lines
    assert lines[0].startswith("data: 120 lines from 5 to 300 Hz, noise 1.")
    shown = {line["name"]: line["members"] for line in plain["mechanics"]["lines"]}
    assert shown == {"2:1+b1": ["2:1+b1+delay", "2:1+b1+lag"]}
    rows = [line for line in text if line.startswith("  2:1+b1  dead time or lag  J ")]
    assert len(rows) == 1 and plain["mechanics"]["dampers"] == ["d12", "b1"]
    assert lines[1].startswith(
        "structure: 2 masses, force and sensor at mass 1, damper d12, friction at the motor (b1);"
        " dead time or lag: not decided by this data; 2:1+b1+delay explains this data (chi2 per"
    )
    assert lines[2].startswith("next: measure again where others differ from 2:1+b1+delay: ")


@pytest.mark.full
def test_the_page_lists_the_same_lines_the_best_structure_first(found):
    listed = list_lines(list_structures(found, found.task.cost.measured, None))
    plain = selection_to_dict(found)["mechanics"]["lines"]
    shown = [(line.name, sorted(s.member.name for s in line.structures)) for line in listed]
    assert shown == [(line["name"], sorted(line["members"])) for line in plain]
    assert [line.structures[0].member.name for line in listed] == [line["best"] for line in plain]
    assert listed[0].adds == "dead time or lag"


@pytest.mark.full
def test_no_suspicion_is_lost_and_none_is_said_twice(found):
    text = "\n".join(fit_text(found, found.task.cost.measured))
    for sentence in suspicions(found):
        assert text.count(sentence) == 1, sentence


@pytest.mark.full
def test_where_one_structure_is_left_nothing_is_to_decide():
    clean, again = (response(DRIVE, VALUES, noise=1e-4, seed=seed) for seed in (1, 2))
    others = [replace(DRIVE, dead_time=False), replace(DRIVE, dead_time=False, lag=True)]
    alone = select(clean, [DRIVE, *others], test=again)
    assert [m.name for m in alone.members] == [reference(DRIVE)]
    assert "this data excludes every other candidate" in first_lines(alone)[1]
    assert first_lines(alone)[2].startswith(
        "next: nothing is left to decide between the candidates; machines outside them, such as a"
        " branch or an elastic base, are not excluded"
    )


@pytest.mark.full
def test_of_too_few_lines_more_are_asked_for():
    few = select(response(DRIVE, VALUES, omega=OMEGA[::12], noise=0.01, seed=1), [DRIVE])
    assert first_lines(few)[1].startswith("structure: 10 lines are too few to judge 2:1+b1+delay")
    assert first_lines(few)[2] == "next: measure at least 18 lines"


@pytest.mark.full
def test_where_no_candidate_may_be_selected_nothing_is_called_decided():
    train = response(DRIVE, VALUES, noise=0.01, seed=1)
    strict = Thresholds(1.5, 1.5, 1.01)
    none = select(train, [DRIVE], thresholds=strict, rule=Rule.PAPER)
    assert none.selected is None and selection_to_dict(none)["mechanics"] is None
    assert "; no candidate is selected: " in first_lines(none)[1]
    assert first_lines(none)[2].startswith("next: more lines, a wider band or known parameters")
