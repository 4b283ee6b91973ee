"""The text that keys and random points are made of tells everything, whatever `repr` shows."""

from fractions import Fraction
from itertools import combinations

from disting import Chain, Experiment, Family, Model, Query, Settings, View
from disting.algebra.certainty import about
from disting.algebra.content import full_text
from disting.behaviour.sample import Representation
from disting.experiments.experiment import MeasuredChain
from disting.verdict.engine import profile_key

CHAIN = (
    "Chain(n_masses=2, gap=0, act_minus=0, act_plus=1, meas_minus=0, meas_plus=2,"
    " sensor=<Sensor.ACCELERATION: 'acceleration'>, damped=True, ground_dampers=(1,), lag=False,"
    " dead_time=False)"
)


def test_a_chain_is_written_as_the_shipped_catalogues_saw_it():
    """Their evidence holds at points that are drawn by labels with this text."""
    chain = Chain(2, meas_plus=2, damped=True, ground_dampers=(1,))
    assert full_text(chain) == CHAIN
    assert about("label", chain) == "label:cf4e88e3ae912a6cd8c00a4044409dbf"


def test_what_is_inside_is_written_too():
    measured = MeasuredChain(Chain(1, damped=False), (Experiment(inertias={1: "1/2"}),))
    text = full_text([{"a": (measured, 1.5)}])
    assert text.startswith("[{'a': (MeasuredChain(chain=Chain(n_masses=1, ")
    assert "inertias=((1, Fraction(1, 2)),)" in text and text.endswith(", 1.5)}]")
    assert full_text(((Fraction(1, 2),),)) == "((Fraction(1, 2),),)" and full_text(()) == "()"


def test_models_that_look_alike_have_texts_and_keys_of_their_own():
    """Short texts for a reader leave coefficients out."""
    models = [
        Model.from_transfer_function([f"{k}*a"], [1, "b"], name="same name") for k in (1, 2, 3)
    ]
    assert len({repr(m) for m in models}) == 1
    assert len({full_text(m) for m in models}) == 3
    assert len({profile_key(m, Representation.TF, 0, Settings()) for m in models}) == 3


def test_all_chains_of_a_size_differ_in_text():
    chains = [*Family(4, damped=False), *Family(4, damped=True)]
    assert all(full_text(a) != full_text(b) for a, b in combinations(chains, 2))
    assert full_text(Query()) != full_text(Query(View.EXACT))
