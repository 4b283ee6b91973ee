"""Files of models: what is read is what was written, and what is not understood is refused by
name.
"""

import json
from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st

from disting import Chain, InputError, Model, ModelList, Quantity, read_models, write_models
from disting.general.model_files import LARGEST, MOST_MODELS, models_of, models_text

WHOLE = """{"title": "Leaks & drives", "s": "p", "models": [
  {"name": "two leaks", "A": [["-k12-k01", 0], ["k12", "-k02"]], "B": [1, 0], "C": [0, 1]},
  {"name": "with feedthrough", "A": [["-a"]], "B": [["b"]], "C": [[1]], "D": [["d"]]},
  {"name": "low pass", "num": ["k"], "den": ["T", 1]},
  {"name": "band pass", "num": "k*p", "den": "p**2 + 0.1*w*p + w**2"},
  {"name": "notch", "G": "(p**2 + w**2)/(p**2 + 2*z*w*p + w**2)"},
  {"name": "drive", "chain": "2:1+b2", "damped": true, "quantity": "velocity"}]}"""


def file(folder, text):
    path = folder / "models.json"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def refused(folder, text):
    """The one sentence by which a file is refused, without the file's name."""
    with pytest.raises(InputError) as caught:
        read_models(file(folder, text))
    said = str(caught.value)
    assert "\n" not in said and said.startswith(f"{folder}/models.json")
    return said.removeprefix(f"{folder}/models.json").lstrip(": ")


def one(**entry):
    return json.dumps({"models": [{"name": "x", **entry}]})


def test_every_form_is_read_as_the_constructors_make_it(tmp_path):
    found = read_models(file(tmp_path, WHOLE))
    assert found.title == "Leaks & drives" and len(found) == 6
    leaks = Model.from_state_space([["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1])
    drive = Chain(2, damped=True, quantity=Quantity.VELOCITY, ground_dampers=(2,))
    by_hand = [
        leaks,
        Model.from_transfer_function("d + b/(s + a)"),
        Model.from_transfer_function(["k"], ["T", 1]),
        Model.from_transfer_function("10*k*s", "10*s**2 + w*s + 10*w**2"),
        Model.from_transfer_function("(s**2 + w**2)/(s**2 + 2*z*w*s + w**2)"),
        Model.from_chain(drive),
    ]
    assert list(found) == by_hand
    assert [m.name for m in found][:2] == ["two leaks", "with feedthrough"]
    assert found["low pass"] == by_hand[2]


def test_numbers_are_taken_as_they_are_written(tmp_path):
    found = read_models(file(tmp_path, one(num=["k"], den=[0.1, 12345678901234567890123])))["x"]
    assert found == Model.from_transfer_function(["k"], [Fraction(1, 10), 12345678901234567890123])
    text = '{"models": [{"name": "x", "num": [1e-30], "den": ["a", 0.30000000000000000000001]}]}'
    assert read_models(file(tmp_path, text))["x"] == Model.from_transfer_function(
        [Fraction(1, 10**30)], ["a", Fraction(30000000000000000000001, 10**23)]
    )


PARAMETERS = sp.symbols("a b c")
entries = st.builds(
    lambda terms: sum(
        n * sp.Mul(*(p**e for p, e in zip(PARAMETERS, es, strict=True))) for n, es in terms
    ),
    st.lists(st.tuples(st.integers(-9, 9), st.tuples(*[st.integers(0, 2)] * 3)), max_size=3),
)
names = st.text(
    st.characters(codec="utf-8", categories=["L", "N", "P", "S"]), min_size=1, max_size=20
)


@pytest.mark.full
@settings(max_examples=30, deadline=None)
@given(
    num=st.lists(entries, min_size=1, max_size=2),
    den=st.lists(entries, min_size=2, max_size=4),
    title=names,
    name=names,
)
def test_what_is_written_is_read_back(num, den, title, name, tmp_path_factory):
    try:
        model = Model.from_transfer_function(num, den, name=name)
    except InputError:
        return
    path = tmp_path_factory.mktemp("round") / "a.json"
    found = ModelList((model,), title)
    read = read_models(write_models(path, found))
    assert read == found and [m.name for m in read] == [name]
    assert models_text(read) == models_text(found)


def test_a_parameter_that_cancels_is_kept(tmp_path):
    model = Model.from_transfer_function("k*c*a", "(s + a)*c", name="x")
    assert model.parameters == ("a", "c", "k")
    again = read_models(write_models(tmp_path / "a.json", ModelList((model,))))
    assert again["x"].parameters == ("a", "c", "k") and again["x"] == model


REFUSED = {
    "is not a key of a model": one(num=["k"], den=["T", 1], gain=2),
    "is not a key of the file": '{"model": [], "models": [{"name": "x", "G": "1/(s+a)"}]}',
    "'num' is given twice": '{"models": [{"name": "x", "num": [1], "num": [2], "den": ["a"]}]}',
    "model 'x': a model is a state space": one(),
    "this one is num and G": one(num=["k"], G="k/(s + a)"),
    "model 1 has no name": '{"models": [{"G": "1/(s + a)"}]}',
    "model 1 is not an object": '{"models": ["1/(s + a)"]}',
    "names 2 models; give each": '{"models": [{"name": "x", "G": "1/(s+a)"}, {"name": "x", "G": "a"}]}',
    "one object in braces": '[{"name": "x", "G": "1/(s + a)"}]',
    "a list of models": '{"models": []}',
    '"models" is a list': '{"models": {"name": "x"}}',
    "model 'x': A is square": one(A=[["a", 1]], B=[1], C=[1]),
    "model 'x': A is a matrix": one(A=[1], B=[1], C=[1]),
    "model 'x': B is 1 x 1": one(A=[["a"]], B=[1, 2], C=[1]),
    "model 'x': \"C\" is missing": one(A=[["a"]], B=[1]),
    "model 'x': the transfer function is zero": one(A=[["a"]], B=[0], C=[1]),
    "model 'x': the denominator": one(num=["a"], den=[0]),
    "at least one parameter": one(num=[1], den=[1, 2]),
    "not of type NoneType": one(num=["a"], den=None),
    "not of type dict": one(num={"s": 1}, den=["a", 1]),
    "is no expression": one(G="k/(s +"),
    "is not a rational expression": one(G="exp(a)"),
    "a matrix of transfer functions is a list of rows": one(G=["k"]),
    "contain the frequency variable s": one(num=["s"], den=["a", 1]),
    "s is the frequency variable": '{"s": "p", "models": [{"name": "x", "G": "1/(p + s)"}]}',
    "is the name of the frequency variable": '{"s": "2*p", "models": [{"name": "x", "G": "a"}]}',
    "NaN is not a number": '{"models": [{"name": "x", "num": [NaN], "den": ["a", 1]}]}',
    "-Infinity is not a number": '{"models": [{"name": "x", "num": [-Infinity], "den": ["a", 1]}]}',
    "digits and zeros at most": '{"models": [{"name": "x", "num": [1e999999999], "den": ["a"]}]}',
    "remove +delay": one(chain="3:1+delay"),
    "a chain of more than 6 masses": one(chain="7:1"),
    "a chain of more than": one(chain="99:1"),
    "for instance 3:4": one(chain="three"),
    "the 3-mass family has": one(chain="3:99"),
    '"chain" is a text': one(chain=3),
    '"damped" is true or false': one(chain="3:1", damped="yes"),
    '"sensor" is position': one(chain="3:1", sensor="torque"),
    '"title" is a text': '{"title": 5, "models": [{"name": "x", "G": "a"}]}',
    "the title has 1 to 200": json.dumps({"title": "a\nb", "models": [{"name": "x", "G": "a"}]}),
    "its name has 1 to 60": '{"models": [{"name": "a\\u001b[2J", "G": "a"}]}',
    "not ' x'": '{"models": [{"name": " x", "G": "a"}]}',
    "printable characters, with": '{"models": [{"name": "\\ud800", "G": "a"}]}',
    "this is not JSON": '{"models": [',
    "not text in UTF-8": b"\xff\xfe{",
    "nested too deeply": "[" * 100_000,
    "is larger than 5 MB": b" " * (LARGEST + 1),
    "more than 300": json.dumps({"models": [{"name": "x"}] * (MOST_MODELS + 1)}),
}  # fmt: skip


@pytest.mark.thin(8)
@pytest.mark.parametrize("cause", REFUSED)
def test_what_is_not_understood_is_refused_in_one_sentence(cause, tmp_path):
    assert cause in refused(tmp_path, REFUSED[cause])


def test_a_hostile_name_is_told_printable(tmp_path):
    said = refused(tmp_path, '{"models": [{"name": "\\u001b[2J\\u202e", "G": "a"}]}')
    assert said.isprintable()


@pytest.mark.parametrize("path", ["nowhere.json", ".", "a\0b"])
def test_a_file_that_cannot_be_read_is_named(path):
    with pytest.raises(InputError, match="cannot be read"):
        read_models(path)


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path):
    assert len(read_models(file(tmp_path, b"\xef\xbb\xbf" + WHOLE.encode()))) == 6


def test_models_of_a_list_are_found_by_their_names():
    found = models_of({"models": [{"name": "low pass", "num": ["k"], "den": ["T", "1"]}]})
    with pytest.raises(InputError, match="no model is called 'high pass'; the models are low pass"):
        found["high pass"]
