"""Variables of MATLAB files: version 5 to 7 by `mat5`, 4 by SciPy, 7.3 (an HDF5 file) by h5py.

Arrays in an HDF5 file, such as MATLAB writes as version 7.3, with bounds that h5py has not.

A file of two kilobytes may claim to hold gigabytes: of fill values that were never written, in
chunks larger than the array, or in one chunk that inflates to any size, whatever its header states.
So the sizes of array and chunks are read from the headers, and chunks are inflated once, piece by
piece, before the library does it. This needs to know how they are packed: shuffled, deflated, with
a checksum, in this order, as MATLAB and h5py do it.

Frequency responses that a MATLAB file keeps as objects: `frd` (Control System Toolbox),
`idfrd` (System Identification).
"""

import io
import warnings
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError, enumeration, short
from disting.measurement import mat5, mat5_objects
from disting.measurement.arrays import Complex, Real
from disting.measurement.column_words import Role, Why, matching
from disting.measurement.mat5_objects import OBJECT, STRUCT, Objects, Reference, objects, tree
from disting.measurement.response import (
    ASSUMED_ACCELERATION,
    FrequencyResponse,
    Signal,
    as_sign,
)
from disting.measurement.scaling import in_omega, taken_unit
from disting.measurement.source import Allowance, Source, Take
from disting.measurement.understanding import record_format, with_unit
from disting.measurement.variables import Arrays, real_part
from disting.model.chain import Sensor, as_sensor

HOLDERS = (STRUCT, OBJECT, mat5.OPAQUE)  # classes of variables in which responses may be
DEFAULT_UNIT = "rad/TimeUnit"  # of MATLAB, where an object names none


@dataclass(frozen=True, eq=False)
class ResponseObject:
    """A response object: frequencies, shape (n_f,), in `unit`; response, shape (n_y, n_u, n_f);
    dead times [s], (n_y, n_u).

    `variance`, shape (n_y, n_u, n_f), is var Re G + var Im G, or None.
    """

    frequency: Real
    unit: str
    response: Complex
    dead_time: Real
    variance: Real | None
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]

    def at(self, index: Sequence[int]) -> tuple[int, int]:
        """Output and input, from 0, of both numbers or of those axes that have more than one;
        raises InputError for others.
        """
        shape = self.response.shape[:2]
        items = iter(index)
        chosen = (
            tuple(index)
            if len(index) == 2
            else tuple(next(items, -1) if n > 1 else 0 for n in shape)
        )
        if any(not 0 <= i < n for i, n in zip(chosen, shape, strict=True)) or len(index) > 2:
            raise InputError(
                f"the object holds {shape[0]} x {shape[1]} responses (outputs x inputs); choose"
                " one, from 1, as NAME[2,1]"
            )
        return chosen[0], chosen[1]


def stored_responses(content: bytes, take: Take) -> dict[str, ResponseObject]:
    """The response objects of a MATLAB file of version 5 to 7 by name, `frf.Pv` where a struct
    holds them.
    """
    stored = dict[str, ResponseObject]()
    try:
        subsystem = objects(content, take)
    except mat5.DAMAGE:
        subsystem = None
    for variable in mat5.variables(content):
        try:
            if variable.kind in HOLDERS:
                stored |= _within(
                    variable.name, tree(variable.matrix(take), variable.order), subsystem
                )
        except mat5.DAMAGE:
            continue  # what is damaged is no response
    return stored


def from_object(
    stored_response: ResponseObject,
    name: str,
    origin: str,
    *,
    index: int | Sequence[int] | None = None,
    frequency_unit: str | None = None,
    quantity: Sensor | str | None = None,
    sign: int = 1,
) -> FrequencyResponse:
    """Response from a stored one; options as in `variables.from_variables`."""
    output, input = stored_response.at((index,) if isinstance(index, int) else tuple(index or ()))
    omega, noted = in_omega(stored_response.frequency, stored_response.unit, frequency_unit, name)
    response = (
        stored_response.response[output, input]
        * np.exp(-1j * omega * stored_response.dead_time[output, input])
        * as_sign(sign)
    )
    deviation = (
        None
        if stored_response.variance is None
        else np.sqrt(stored_response.variance[output, input])
    )
    chosen = FrequencyResponse(
        omega,
        response,
        deviation,
        sensor=as_sensor(quantity or Sensor.ACCELERATION),
        input=stored_response.inputs[input],
        output=stored_response.outputs[output],
        origin=f"{origin}, {name}",
    )
    unit = taken_unit(omega, stored_response.frequency)
    words = f"frequency in {unit}, complex response of the object {name}"
    assumed = None if quantity else ASSUMED_ACCELERATION
    parts = [(f"{name}.Frequency", Role.FREQUENCY, unit), (f"{name}.Response", Role.RESPONSE, "")]
    parts += [] if deviation is None else [(f"{name}.Covariance", Role.DEVIATION, "")]
    read = chosen.noted(assumed).doubted(*([noted] if noted else []))
    why = Why.OPTION if frequency_unit else Why.BY_NUMBERS if noted else Why.FORMAT
    return read.read_as(words, with_unit(record_format(parts), Role.FREQUENCY, unit, why))


def chosen_response(stored: Mapping[str, ResponseObject], asked: str | None, origin: str) -> str:
    """The requested name, or the only one; raises InputError listing them."""
    names = list(stored)
    found = matching(names, asked) if asked else []
    if len(found) == 1:
        return names[found[0]]
    if asked is None and len(stored) == 1:
        return next(iter(stored))
    wrong = (
        f"has no frequency response {short(asked)}"
        if asked
        else "holds several frequency responses"
    )
    raise InputError(
        f"{origin} {wrong}; choose one by --read response=NAME: {enumeration(sorted(stored))}"
    )


def _within(name: str, value: Any, subsystem: Objects | None) -> dict[str, ResponseObject]:
    """Responses in a variable and in the fields of structs; objects in objects are not searched."""
    held = _properties(value, subsystem) if isinstance(value, Reference) else value
    stored_response = _response(held) if isinstance(held, dict) else None
    if stored_response is not None:
        return {name: stored_response}
    parts = value.items() if isinstance(value, dict) else ()
    return {
        key: response
        for field, part in parts
        for key, response in _within(f"{name}.{field}", part, subsystem).items()
    }


def _properties(of: Reference, subsystem: Objects | None) -> dict[str, Any]:
    """Properties of an object and of its data, without the underscores that the toolboxes end
    them with.
    """
    if subsystem is None:
        return {}
    outer = {name.rstrip("_"): value for name, value in subsystem.properties(of).items()}
    data = outer.get("Data")
    return (subsystem.properties(data) if isinstance(data, Reference) else {}) | outer


def _response(held: Mapping[str, Any]) -> ResponseObject | None:
    """The response that an object, or a struct of its form, holds; None where it holds none."""
    frequency, response = held.get("Frequency"), held.get("Response", held.get("ResponseData"))
    if (
        not isinstance(frequency, np.ndarray)
        or not isinstance(response, np.ndarray)
        or not frequency.size
    ):
        return None
    shape = response.shape if response.ndim == 3 else (1, 1, response.size)
    if shape[-1] != frequency.size:
        return None
    units = [
        held[name]
        for name in ("FrequencyUnit", "FreqUnits", "Units")
        if isinstance(held.get(name), str) and held[name]
    ]
    return ResponseObject(
        real_part(frequency, "the frequencies of an object").ravel(),
        _in_seconds(units[0] if units else DEFAULT_UNIT, held.get("TimeUnit")),
        response.reshape(shape).astype(np.complex128),
        _dead_time(held.get("Delay"), _number(held.get("Ts")), shape[:2]),
        _variance(held.get("CovarianceData", held.get("Covariance")), shape),
        *(_signals(held, side, n) for side, n in (("Input", shape[1]), ("Output", shape[0]))),
    )


def _in_seconds(unit: str, time: Any) -> str:
    """Name of a unit of frequency; that of time is the second unless stated otherwise."""
    if isinstance(time, str) and time not in ("", "seconds"):
        return f"{unit} with time in {time}"
    return {"rad/TimeUnit": "rad/s", "cycles/TimeUnit": "Hz"}.get(unit, unit)


def _number(value: Any) -> float:
    return float(value.item().real) if isinstance(value, np.ndarray) and value.size == 1 else 0.0


def _dead_time(delay: Any, step: float, shape: tuple[int, ...]) -> Real:
    """Dead times of inputs, outputs and both, shape (n_y, n_u), in seconds; stored in sampling
    periods in a discrete object.
    """
    total = np.zeros(shape)
    for name, axes in (("Input", (1, shape[1])), ("Output", (shape[0], 1)), ("IO", shape)):
        value = delay.get(name) if isinstance(delay, dict) else None
        if isinstance(value, np.ndarray) and value.size:
            total = total + (
                np.broadcast_to(value.real, axes) if value.size == 1 else value.real.reshape(axes)
            )
    return np.asarray(total * (step if step > 0 else 1.0), dtype=np.float64)


def _variance(covariance: Any, shape: tuple[int, ...]) -> Real | None:
    """var Re G + var Im G from a covariance of shape (n_y, n_u, n_f, 2, 2); None where there is
    none.
    """
    if not isinstance(covariance, np.ndarray) or covariance.shape != (*shape, 2, 2):
        return None
    return np.asarray(
        np.maximum(covariance[..., 0, 0] + covariance[..., 1, 1], 0.0), dtype=np.float64
    )


def _signals(held: Mapping[str, Any], side: str, count: int) -> tuple[Signal, ...]:
    names, units = (_texts(held.get(f"{side}{part}"), count) for part in ("Name", "Unit"))
    return tuple(Signal(name, unit) for name, unit in zip(names, units, strict=True))


def _texts(value: Any, count: int) -> list[str]:
    """One text a channel; empty ones where the object has none."""
    channels = [value] if isinstance(value, str) else value if isinstance(value, list) else []
    texts = [text if isinstance(text, str) else "" for text in channels]
    return texts if len(texts) == count else [""] * count


SHUFFLE, DEFLATE, CHECKSUM = 2, 1, 3  # numbers of HDF5
PACKED = tuple(
    (*shuffled, *deflated, *checked)
    for shuffled in ((), (SHUFFLE,))
    for deflated in ((), (DEFLATE,))
    for checked in ((), (CHECKSUM,))
)
PIECE = 1 << 20  # bytes that are inflated at once
HDF5 = b"\x89HDF\r\n\x1a\n"


def datasets(file: Source) -> list[str]:
    """Arrays that are in the file itself; links that lead out of it are not even looked at."""
    import h5py

    with _open_file(file) as inside:
        own = [
            name
            for name in inside
            if not name.startswith("#")
            and isinstance(inside.get(name, getlink=True), h5py.HardLink)
        ]
        return [name for name in own if isinstance(inside[name], h5py.Dataset)]


def dataset(file: Source, name: str, take: Take) -> NDArray[Any]:
    """Values in MATLAB's order of axes; complex numbers are stored as pairs called real and imag.

    Raises InputError for what is kept elsewhere, or is no array of numbers, and by `take`, which
    gets the size, before anything is unpacked.
    """
    with _open_file(file) as inside:
        array = inside[name]
        if array.external or array.is_virtual:
            raise InputError(
                f"{file.name}: the values of {name} are kept in another file, which is not read;"
                " store them inside"
            )
        if array.dtype.hasobject:
            raise InputError(f"{file.name}: {name} is no array of numbers")
        take(name, _size(array))
        _check_chunks(array, f"{file.name}: {name}")
        if "MATLAB_empty" in array.attrs:
            return np.empty(0)
        values = np.asarray(array[()])
    if values.dtype.names and {"real", "imag"} <= set(values.dtype.names):
        values = values["real"] + 1j * values["imag"]
    return values.T


def _open_file(file: Source) -> Any:
    import h5py

    return h5py.File(io.BytesIO(file.content), "r")


def _size(array: Any) -> int:
    """Bytes of an array, and of one chunk where that is larger; numbers have eight bytes at least,
    for so many they get.
    """
    each = max(array.dtype.itemsize, 16 if array.dtype.names else 8)
    return int(each * max(array.size or 0, prod(array.chunks or (0,))))


def _check_chunks(array: Any, where: str) -> None:
    """Raise InputError where a chunk may inflate to more than a chunk holds."""
    properties = array.id.get_create_plist()
    packed = tuple(properties.get_filter(i)[0] for i in range(properties.get_nfilters()))
    if packed not in PACKED:
        raise InputError(f"{where} is packed in a way that is not read; save it with -v7")
    if DEFLATE not in packed:
        return
    most = array.dtype.itemsize * prod(array.chunks)
    for i in range(array.id.get_num_chunks()):
        mask, content = array.id.read_direct_chunk(array.id.get_chunk_info(i).chunk_offset)
        if not mask and _inflates_beyond(content, most):
            raise InputError(f"{where} is damaged: a chunk of it unpacks to more than it says")


def _inflates_beyond(content: bytes, most: int) -> bool:
    """Return True if the deflated bytes expand to more than `most`, which is tested without keeping
    them.
    """
    packer, size = zlib.decompressobj(), 0
    while content and not packer.eof and size <= most:
        size += len(packer.decompress(content, PIECE))
        content = packer.unconsumed_tail
    return size > most


def variables(file: Source) -> Arrays:
    """The variables of a file by name, read when called; raises InputError for what is no MATLAB
    file or unpacks to more than 512 MB, now or then.

    Numbers in structs are called `struct.field`.
    """
    content, allowance = file.content, Allowance(file.name)
    if HDF5 in (content[:8], content[512:520]):  # MATLAB puts 512 bytes of its own before it
        return _hdf5(file, allowance.take)
    if mat5.is_version_5(content):
        the_variables = list(mat5.variables(content))
        fields = {
            name: partial(np.asarray, array)
            for variable in the_variables
            for name, array in mat5_objects.numbers_in(variable, allowance.take).items()
        }
        whole = {
            variable.name: partial(_whole, variable, file, allowance.take)
            for variable in the_variables
        }
        return fields | whole
    if b"\0" not in content[:4]:  # version 4 begins with a small number
        raise InputError(f"{file.name} is no MATLAB file")
    return {name: partial(_load_array, file, name) for name in _list_names(file)}


def responses(file: Source) -> dict[str, ResponseObject]:
    """The frequency responses that a file keeps as objects, by name; raises InputError where they
    unpack to more than 512 MB.
    """
    if not mat5.is_version_5(file.content):
        return {}
    return stored_responses(file.content, Allowance(file.name).take)


def _whole(variable: mat5.Variable, file: Source, take: Take) -> NDArray[Any]:
    try:
        return variable.read(take)
    except InputError as error:
        message = str(error)
        raise InputError(message if file.name in message else f"{file.name}: {message}") from None


def _list_names(file: Source) -> set[str]:
    import scipy.io

    contents = _foreign(
        partial(scipy.io.whosmat, io.BytesIO(file.content)),
        f"{file.name} is no MATLAB file that can be read",
    )
    return {str(entry[0]) for entry in contents}


def _load_array(file: Source, name: str) -> NDArray[Any]:
    import scipy.io

    load = partial(scipy.io.loadmat, io.BytesIO(file.content), variable_names=[name])
    value = _foreign(load, f"{file.name}: variable {name} cannot be read")
    if name not in value:
        raise InputError(f"{file.name}: variable {name} cannot be read")
    return np.asarray(value[name])


def _hdf5(file: Source, take: Take) -> Arrays:
    try:
        import h5py  # noqa: F401
    except ImportError:
        raise InputError(
            f'{file.name} is a MATLAB 7.3 file: pip install "disting[hdf5]", or save it with -v7'
        ) from None
    refusal = f"{file.name} is no HDF5 file that can be read"
    names = _foreign(partial(datasets, file), refusal)
    return {name: partial(_dataset, file, name, take) for name in names}


def _dataset(file: Source, name: str, take: Take) -> NDArray[Any]:
    read = partial(dataset, file, name, take)
    return np.asarray(_foreign(read, f"{file.name}: variable {name} cannot be read"))


def _foreign(call: Callable[[], Any], refusal: str) -> Any:
    """The value of a call into another library, any error of which means that the file is
    damaged.
    """
    try:
        with warnings.catch_warnings():
            # such as an unknown order of bytes: the numbers would be wrong
            warnings.simplefilter("error", UserWarning)
            return call()
    except InputError:
        raise
    except Exception as error:  # damaged files raise whatever the library meets first
        raise InputError(f"{refusal}: {type(error).__name__}: {error}") from None
