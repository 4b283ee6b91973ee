"""One answer whether it is computed without a cache, computed into one, or read from it: bytes of
what the commands print, and of what evidence is once it has been written and read.
"""

import json
from itertools import combinations, product
from typing import get_args

import pytest
from hypothesis import Phase, given, settings, strategies as st

from disting import Engine, Experiment, Family, Quantity, Query, View, verify
from disting.algebra.certainty import Certainty
from disting.evidence.decision import THEOREMS, Exclusion, Theorem
from disting.evidence.general import AtInverse, OfPart, Replacement
from disting.evidence.kind import is_well_typed, read
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import (
    BothWays,
    Empirical,
    PositiveEvidence,
    PositiveFinding,
    RealWitnesses,
    Share,
)
from disting.experiments.experiment import MeasuredChain
from disting.general.model_files import read_models
from disting.verdict.cascade import decide
from disting.verdict.result import Verdict
from disting.verdict.verification import Status
from tests.cli.process import called

MODELS = {
    "title": "of every kind",
    "models": [
        {"name": "cascade", "A": [["-k10-k12", 0], ["k12", "-k20"]], "B": [1, 0], "C": [0, 1]},
        {"name": "two poles", "num": ["a"], "den": [1, "b+c", "b*c"]},
        {"name": "low pass", "num": ["k"], "den": ["T", 1]},
        {"name": "lag", "G": "h/(1 + U*s)"},
        {"name": "chain", "chain": "2:1", "damped": False},
        {"name": "other chain", "chain": "2:2+b1"},
        {"name": "of a number", "num": ["a"], "den": [1, 3]},
        {"name": "of another number", "num": ["a"], "den": [1, 4]},
    ],
}
MATRICES = {
    "models": [
        {"name": "two outputs", "G": [["1/(m*s**2 + k)"], ["s/(m*s**2 + k)"]]},
        {"name": "the same", "G": [["a/(s**2 + b)"], ["a*s/(s**2 + b)"]]},
        {"name": "less", "A": [["-p", 0], [1, "-q"]], "B": [1, 0], "C": [[1, 0], [0, 1]]},
    ]
}
DOMAINS = ("complex", "real", "positive")
COMPARED = [
    # shipped, computed, of two sizes, under experiments of every kind, of another quantity
    ("3:2", "3:5", "--undamped"),
    ("2:1+b1", "2:1+b2", "--undamped"),
    ("4:1", "4:5", "--undamped", "--quantity", "velocity"),
    ("2:1", "2:1+lag", "--undamped"),
    ("3:1", "2:1"),
    ("2:1+delay", "2:3"),
    ("3:2", "3:5", "--undamped", "--also", "lock=2/3"),
    ("2:1", "2:2", "--also", "inertia=1/1:1/2", "--also", "sensor=2/2"),
    ("2:1", "2:1+b1", "--undamped", "--also", "force=2/2"),
    ("2:2", "2:2", "--also", "spring=1:3"),
]
OTHERS = [
    ("verdicts", "3", "--undamped", "--json", "-"),
    ("verdicts", "2", "--representation", "markov", "--csv", "-"),
    ("verdicts", "1-2", "--json", "-"),
    ("next", "3:1", "3:11", "--json", "-"),
    ("next", "2:1+b1", "2:1+b2", "--csv", "-"),
    (
        "equivalents",
        "3:1",
        "--to",
        "3",
        "--set",
        "m1=1,m2=2,m3=3,k12=5,k23=7",
        "--undamped",
        "--json",
    ),
    ("equivalents", "2:1", "--to", "2:1", "--undamped", "--formulas"),
    ("models", "2", "--identifiability"),
    ("models", "2", "--also", "lock=2"),
]


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Files of models, of one port and of two."""
    folder = tmp_path_factory.mktemp("models")
    paths = {}
    for name, data in (("single", MODELS), ("matrices", MATRICES)):
        paths[name] = folder / f"{name}.json"
        paths[name].write_text(json.dumps(data))
    return paths


def three_ways(words, folder):
    """What a command prints without a cache, into a new one, and from it."""
    cache = folder / "cache.sqlite3"
    without, cold, warm = (called(*words, cache=c) for c in ("off", cache, cache))
    assert without.returncode == cold.returncode == warm.returncode == 0, without.stderr
    assert without.stdout == cold.stdout == warm.stdout
    return without.stdout


@pytest.mark.sampled(5)
@pytest.mark.full
@pytest.mark.parametrize("words", COMPARED, ids=" ".join)
def test_verdicts_on_chains(words, tmp_path):
    for domain in DOMAINS:
        text = three_ways(("compare", *words, "--domain", domain, "--json"), tmp_path)
        assert verify(json.loads(text)).status is Status.HOLDS
    file = tmp_path / "verdict.json"
    file.write_text(text)
    three_ways(("verify", file), tmp_path)


@pytest.mark.full
@pytest.mark.parametrize("words", OTHERS, ids=" ".join)
def test_lists_of_chains(words, tmp_path):
    three_ways(words, tmp_path)


@pytest.mark.full
@pytest.mark.parametrize(("name", "domain"), [*product(("single", "matrices"), DOMAINS)])
def test_files_of_models(name, domain, files, tmp_path):
    file = files[name]
    three_ways(("verdicts", file, "--domain", domain, "--json", "-"), tmp_path)
    three_ways(("models", file), tmp_path)
    one, two = list(read_models(file))[:2]
    words = (f"{file}:{one.name}", f"{file}:{two.name}", "--domain", domain, "--json")
    text = three_ways(("compare", *words), tmp_path)
    assert verify(json.loads(text)).status is Status.HOLDS


def read_back(verdict):
    """After it was written and read."""
    return Verdict.from_dict(json.loads(json.dumps(verdict.to_dict())))


def evidence_of(verdict):
    """All records of evidence that a verdict has."""
    found = verdict.inclusions
    both = () if found is None else (found.image, found.closure)
    shares = (x for x in (verdict.left_positive, verdict.right_positive) if x is not None)
    return [x.evidence for x in (verdict, *both, *shares)]


def refuse_differences(verdicts):
    """Each is as it is read after it was written, and every field of its evidence has its type."""
    for verdict in verdicts:
        assert all(map(is_well_typed, evidence_of(verdict)))
        assert repr(read_back(verdict).evidence) == repr(verdict.evidence)
        assert read_back(verdict) == verdict


@pytest.mark.full
@pytest.mark.parametrize("view", [View.POSITIVE, View.REAL, View.EXACT, View.COMBINED])
@pytest.mark.parametrize("damped", [False, True])
def test_evidence_that_is_made_is_that_which_is_read(view, damped):
    engine = Engine()
    chains = [
        *((f"3:{i}", c) for i, c in enumerate(Family(3, damped, Quantity.VELOCITY), 1)),
        *((f"2:{i}", c) for i, c in enumerate(Family(2, damped, Quantity.VELOCITY), 1)),
    ]
    decided = engine.decisions([engine.subject(*one) for one in chains], Query(view))
    refuse_differences(decided.verdict(*pair) for pair in combinations(range(len(chains)), 2))


@pytest.mark.full
@pytest.mark.parametrize("view", [View.POSITIVE, View.REAL, View.EXACT])
@pytest.mark.parametrize("name", ["single", "matrices"])
def test_evidence_of_models_is_that_which_is_read(view, name, files):
    subjects = Engine().general_subjects(read_models(files[name]).models)
    refuse_differences(decide(*pair, Query(view)) for pair in combinations(subjects, 2))


@pytest.mark.full
@pytest.mark.parametrize("view", [View.POSITIVE, View.REAL, View.EXACT])
def test_evidence_under_experiments_is_that_which_is_read(view):
    experiments = [Experiment(), Experiment(sensor=2), Experiment(locked=1)]
    measured = [
        Engine().measured_subject(f"{n}:{i}", MeasuredChain(chain, tuple(experiments)))
        for n in (2, 3)
        for i, chain in list(enumerate(Family(n, False), 1))[:4]
    ]
    refuse_differences(decide(*pair, Query(view)) for pair in combinations(measured, 2))


KINDS = sorted(
    {*get_args(Evidence), *get_args(InclusionEvidence), *get_args(PositiveEvidence)},
    key=lambda kind: kind.kind,
)


EVIDENCE_OF_SHARES = sorted(get_args(PositiveEvidence), key=lambda kind: kind.kind)
theorems = st.sampled_from(sorted(THEOREMS))
known = {
    Theorem: {"name": theorems},
    Exclusion: {"name": st.just("decay")},
    Replacement: {"inner": st.builds(Theorem, name=theorems)},
    AtInverse: {"inner": st.builds(Theorem, name=theorems)},
    OfPart: {"inner": st.builds(Theorem, name=theorems)},
}


def made_of(kind):
    """Evidence of a kind with any fields of the types that it says."""
    if kind is RealWitnesses:
        return st.builds(kind, with_one=findings)
    return st.builds(kind, findings, findings) if kind is BothWays else plainly(kind)


def plainly(kind):
    """The same of a kind that holds no findings."""
    return st.builds(kind, **known.get(kind, {}))


findings = st.builds(PositiveFinding, st.just(Share.UNKNOWN), reason=st.text()) | st.builds(
    PositiveFinding,
    st.sampled_from([share for share in Share if share is not Share.UNKNOWN]),
    st.just(Certainty.BOUNDED),
    st.integers(100, 200),
    st.sampled_from(EVIDENCE_OF_SHARES).flatmap(plainly),
    st.none() | st.just(Empirical(3, 5, 1)),
)


@pytest.mark.full
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.kind)
@settings(max_examples=15, phases=[Phase.generate])
@given(st.data())
def test_every_kind_of_evidence_is_read_as_it_was_written(kind, data):
    made = data.draw(made_of(kind))
    text = json.dumps(made.to_dict())
    again = read(json.loads(text), KINDS)
    assert is_well_typed(made) and is_well_typed(again)
    assert again == made and repr(again) == repr(made)
    assert json.dumps(again.to_dict()) == text
