"""The command `equivalents`: what it says, and its exit status."""

import json

import pytest

from tests.cli.process import called

VALUES = "m1=1,m2=2,m3=3,k12=100,k23=70"


def equivalents(*arguments):
    kind = () if "--damped" in arguments else ("--undamped",)
    return called("equivalents", *arguments, *kind)


def test_one_structure():
    done = called(
        "equivalents",
        "3:1",
        "--to",
        "3:11",
        "--damped",
        "--set",
        VALUES,
        "--set",
        "d12=0.1,d23=3/10",
    )
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert lines[0] == "3:1  [1FS]=[2]=[3]"
    assert "3:11  #=[1]=[2fs]   [3FS]   1 parameter set, all there are" in lines
    assert [line.split() for line in lines if line.startswith("  m1 ")] == [["m1", "4.8"]]
    assert (
        lines[-1]
        == "No experiment with this force and sensor tells it from 3:11 with the positive values"
        " above."
    )


def test_a_family():
    done = equivalents("3:4", "--to", 3, "--set", VALUES)
    assert done.returncode == 0
    assert (
        "3:2, 3:3, 3:5, 3:7, 3:9, 3:10: none exists, with positive parameters or any others: proven"
        in done.stdout
    )
    assert "tells it from 3:1, 3:6, 3:8 or 3:11" in done.stdout


def test_json():
    done = equivalents("3:4", "--to", 3, "--set", VALUES, "--json")
    said = json.loads(done.stdout)
    assert [len(listing["equivalents"]) for listing in said["listings"]] == [
        1,
        0,
        0,
        2,
        0,
        2,
        0,
        1,
        0,
        0,
        1,
    ]
    assert all(
        m["signs"] == "positive" and m["residual"] < 1e-12
        for li in said["listings"]
        for m in li["equivalents"]
    )


@pytest.mark.full
def test_formulas_in_three_languages():
    assert "m1'  = m2\n" in equivalents("3:4", "--to", "3:1", "--formulas").stdout
    assert r"k_{12}' &= k_{12} + k_{23}" in equivalents("3:4", "--to", "3:1", "--latex").stdout
    source = equivalents("3:4", "--to", "3", "--sympy").stdout
    space = {}
    exec(source, space)
    assert "equivalent" in space


def test_formulas_of_larger_chains_are_checked_with_a_bound():
    said = called("equivalents", "4:1", "--to", "4:29", "--damped", "--formulas").stdout
    assert "; identity of the transfer functions checked, probability of error at most 2^-" in said
    said = called("equivalents", "3:1", "--to", "3:11", "--damped", "--formulas").stdout
    assert "; identity of the transfer functions proven" in said


def test_a_ratio_that_all_springs_share_is_said_to_be_special():
    values = "m1=1,m2=2,m3=3,k12=100,k23=70,d12=1"
    arguments = "3:1", "--to", "3:11", "--damped", "--set", values, "--set"
    said = "All springs have the same ratio k/d here; other ratios may rule out some of these."
    assert called("equivalents", *arguments, "d23=0.7").stdout.rstrip().endswith(said)
    assert said not in called("equivalents", *arguments, "d23=0.8").stdout


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("3:1", "--to", "3:11"), "values of the given model are needed"),
        (("3:1", "--to", "3:11", "--set", "m1=1"), "the value of m2, m3, k12, k23 is missing"),
        (("3:1", "--to", "3:11", "--set", VALUES + ",m1=2"), "m1 is given twice"),
        (("3:1", "--to", "3:11", "--set", VALUES.replace("m1=1", "m1=0")), "m1 = 0"),
        (("3:1", "--to", "3:11", "--set", "m1"), "name=number"),
        (("1:1+b1", "--to", "1", "--set", "m1=1,b1=0"), "remove +b1 and its value"),
        (("1:1+b1", "--to", "1", "--set", "m1=1,b1=-1"), "is another model"),
        (("3:12", "--to", "3", "--set", VALUES), "models 1 to 11"),
        (("3:1", "--to", "x", "--set", VALUES), "masses:number"),
        (("3:1", "--set", VALUES), "--to"),
    ],
)
def test_bad_input_is_one_sentence(arguments, words):
    done = equivalents(*arguments)
    assert done.returncode == 2 and done.stdout == ""
    assert (
        words in done.stderr
        and len(done.stderr.splitlines()) == 1
        and done.stderr.startswith("disting: ")
    )


def test_the_last_sentence_says_among_what_it_was_looked_for():
    done = equivalents("2:2+delay", "--to", 2, "--set", "m1=1,m2=2,k12=100,Td=0.01")
    assert "2:1+delay: none exists, with positive parameters or any others: proven" in done.stdout
    said = (
        "No other of the 3 structures of 2 masses, undamped, with a dead time, searched gives this"
        " transfer function with"
    )
    assert f"\n{said} positive values." in done.stdout
