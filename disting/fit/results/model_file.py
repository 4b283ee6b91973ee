"""The models in a file of a fit, read back bit-equal."""

from pathlib import Path
from typing import Any

from disting.errors import InputError, short
from disting.files import read_json
from disting.fit.search.candidates import listed_form
from disting.model.chain import Chain
from disting.network.denotation import MisnamedError, naming_of, refuse_misnamed

HUGE = 1e100  # more is no value of an element, and squares of it are no numbers any more
FIT_FILE = "a file of 'disting fit --json'"


def model_from_dict(plain: dict[str, Any]) -> tuple[Chain, dict[str, float]]:
    """Chain and parameters of a candidate's plain data, bit-equal; raises InputError for what
    is none.
    """
    chain = chain_from_dict(plain)
    try:
        values = {name: number_of(plain["parameters"][name]) for name in chain.parameters}
    except (KeyError, TypeError, ValueError) as reason:
        raise _no_model(reason) from None
    return chain, values


def chain_from_dict(plain: dict[str, Any]) -> Chain:
    """The structure alone, of a candidate or of what is named beside it; raises InputError, and
    MisnamedError for a name that denotes another structure.
    """
    try:
        (act_minus, act_plus), (meas_minus, meas_plus) = plain["actuator"], plain["sensor"]
        chain = Chain(
            plain["n_masses"],
            plain["gap"],
            act_minus,
            act_plus,
            meas_minus,
            meas_plus,
            plain["quantity"],
            plain["damped"],
            tuple(plain["ground_dampers"]),
            plain["lag"],
            plain["delay"],
            plain.get("gap_damper", False),
        )
        name = str(plain.get("name", ""))
    except (KeyError, TypeError, ValueError) as reason:
        raise _no_model(reason) from None
    refuse_misnamed(name, naming_of(name, listed_form(chain).chain))
    return chain


def number_of(value: Any, least: float = -HUGE, most: float = HUGE) -> float:
    """A number of a file, finite and between two others; raises ValueError."""
    if type(value) in (int, float) and least <= value <= most:
        return float(value)
    raise ValueError(f"{short(value)}, where a number from {least:g} to {most:g} belongs,")


def _no_model(reason: Exception) -> InputError:
    return InputError(f"this is no fitted model: {short(reason)} is missing or wrong")


def refuse_open_quantity(plain: Any, path: Path) -> None:
    """Raise InputError with the question for the sensor quantity, where a file of a fit asks it."""
    if isinstance(plain, dict) and plain.get("question"):
        raise InputError(f"{path} names no model: {plain['question']}")


def read_model(path: Path) -> tuple[Chain, dict[str, float]]:
    """The selected model of a JSON file of `disting fit`; raises InputError."""
    plain = read_json(path, FIT_FILE)
    refuse_open_quantity(plain, path)
    selected = plain.get("selected", plain) if isinstance(plain, dict) else None
    if not isinstance(selected, dict):
        raise InputError(f"{path} holds no selected model")
    try:
        return model_from_dict(selected)
    except MisnamedError as reason:
        raise InputError(f"{path}: {reason}") from None
