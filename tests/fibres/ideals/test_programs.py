"""The rational numbers and external programs: the same fibres, other engines."""

import stat

import pytest

from disting.fibres.ideals import normalise
from disting.fibres.ideals.fibre_ideal import fibre_ideal
from disting.model.family import Family
from tests.oracles.programs import MSOLVE, PROGRAMS, SINGULAR, emptiness, installed
from tests.oracles.rational import Emptiness, fibre_over_rationals

LONG = 600  # seconds: never the reason of an answer, however busy the machine is
POINT = [3, 7, 2, 5, 11, 13, 4]
# model 1 of three damped masses searched in them
CASES = [(6, Emptiness.EMPTY), (11, Emptiness.NOT_EMPTY)]


def pair(number):
    return [normalise(Family(3, True)[k].structure) for k in (1, number)]


@pytest.mark.full
@pytest.mark.parametrize("tangent", [True, False])
@pytest.mark.parametrize(("number", "expected"), CASES)
def test_over_the_rationals(number, expected, tangent):
    assert fibre_over_rationals(*pair(number), POINT, tangent, LONG) == (expected, "")


@pytest.mark.full
def test_a_limit_over_the_rationals_is_no_answer():
    models = [normalise(Family(4, True)[k].structure) for k in (8, 19)]
    found, why = fibre_over_rationals(*models, list(range(2, 12)), True, 1.0)
    assert found is Emptiness.UNKNOWN and "out of time" in why


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda p: p.name)
@pytest.mark.parametrize(("number", "expected"), CASES)
def test_programs_where_installed(program, number, expected):
    if program.path is None:
        pytest.skip("not installed")
    assert emptiness(program, fibre_ideal(*pair(number), "test", True, 31), LONG) == (expected, "")


def test_what_is_not_installed_is_said(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert [(name, version) for name, version, _ in installed()] == [
        ("msolve", ""),
        ("Singular", ""),
    ]
    found = emptiness(MSOLVE, fibre_ideal(*pair(6), "test", True, 31), 5)
    assert found == (Emptiness.UNKNOWN, "msolve is not installed")


def test_long_primes_are_not_given_away(monkeypatch, tmp_path):
    script(monkeypatch, tmp_path, "exit 0")
    found, why = emptiness(SINGULAR, fibre_ideal(*pair(6), "test", True), 5)
    assert found is Emptiness.UNKNOWN and "31 bits" in why


def script(monkeypatch, folder, body):
    path = folder / "Singular"
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")


@pytest.mark.full
@pytest.mark.parametrize(
    ("body", "seconds", "expected"),
    [
        ("echo '[1]'", LONG, (Emptiness.EMPTY, "")),
        ("echo '[0]'", LONG, (Emptiness.NOT_EMPTY, "")),
        ("echo; echo error", LONG, (Emptiness.NOT_EMPTY, "")),
        ("echo '[1]'; exit 3", LONG, (Emptiness.UNKNOWN, "Singular: exit status 3")),
        (f"exec sleep {LONG}", 0.5, (Emptiness.UNKNOWN, "Singular: out of time")),
    ],
)
def test_only_a_clean_one_counts_as_empty(monkeypatch, tmp_path, body, seconds, expected):
    script(monkeypatch, tmp_path, body)
    assert emptiness(SINGULAR, fibre_ideal(*pair(6), "test", True, 31), seconds) == expected
