"""Variables of MATLAB files: version 5 to 7 by `mat5`, 4 by SciPy, 7.3 (an HDF5 file) by h5py."""

import io
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.measurement import mat5, mat5_objects
from disting.measurement.stored import Stored, stored_responses
from disting.measurement.variables import Arrays

HDF5 = b"\x89HDF\r\n\x1a\n"


def variables(path: Path) -> Arrays:
    """The variables of a file by name, read when called; raises InputError for what is no MATLAB
    file, now or then.

    Numbers in structs are called `struct.field`.
    """
    with path.open("rb") as stream:
        head = stream.read(520)
    if HDF5 in (head[:8], head[512:]):  # MATLAB puts 512 bytes of its own before it
        return _hdf5(path)
    content = path.read_bytes()
    if mat5.is_version_5(content):
        found = list(mat5.variables(content))
        fields = {
            name: partial(np.asarray, array)
            for one in found
            for name, array in mat5_objects.numbers_in(one).items()
        }
        return fields | {variable.name: partial(_whole, variable, path) for variable in found}
    if b"\0" not in content[:4]:  # version 4 begins with a small number
        raise InputError(f"{path.name} is no MATLAB file")
    return {name: partial(_loaded, content, name, path) for name in _listed(content, path)}


def responses(path: Path) -> dict[str, Stored]:
    """The frequency responses that a file keeps as objects, by name."""
    content = path.read_bytes()
    return stored_responses(content) if mat5.is_version_5(content) else {}


def _whole(variable: mat5.Variable, path: Path) -> NDArray[Any]:
    try:
        return variable.read()
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None


def _listed(content: bytes, path: Path) -> set[str]:
    import scipy.io

    found = _foreign(
        partial(scipy.io.whosmat, io.BytesIO(content)),
        f"{path.name} is no MATLAB file that can be read",
    )
    return {str(entry[0]) for entry in found}


def _loaded(content: bytes, name: str, path: Path) -> NDArray[Any]:
    import scipy.io

    load = partial(scipy.io.loadmat, io.BytesIO(content), variable_names=[name])
    found = _foreign(load, f"{path.name}: variable {name} cannot be read")
    if name not in found:
        raise InputError(f"{path.name}: variable {name} cannot be read")
    return np.asarray(found[name])


def _hdf5(path: Path) -> Arrays:
    try:
        import h5py
    except ImportError:
        raise InputError(
            f'{path.name} is a MATLAB 7.3 file: pip install "disting[hdf5]", or save it with -v7'
        ) from None
    names = _foreign(
        partial(_datasets, h5py, path), f"{path.name} is no HDF5 file that can be read"
    )
    return {name: partial(_dataset, h5py, path, name) for name in names}


def _datasets(h5py: Any, path: Path) -> list[str]:
    """Arrays that are in the file itself; links that lead out of it are not even looked at."""
    with h5py.File(path, "r") as file:
        inside = [
            name
            for name in file
            if not name.startswith("#") and isinstance(file.get(name, getlink=True), h5py.HardLink)
        ]
        return [name for name in inside if isinstance(file[name], h5py.Dataset)]


def _dataset(h5py: Any, path: Path, name: str) -> NDArray[Any]:
    return np.asarray(
        _foreign(partial(_plain, h5py, path, name), f"{path.name}: variable {name} cannot be read")
    )


def _plain(h5py: Any, path: Path, name: str) -> NDArray[Any]:
    """Values in MATLAB's order of axes; complex numbers are stored as pairs called real and
    imag.
    """
    with h5py.File(path, "r") as file:
        if file[name].external or file[name].is_virtual:
            raise InputError(
                f"{path.name}: the values of {name} are kept in another file, which is not read;"
                " store them inside"
            )
        values = np.asarray(file[name][()])
        if "MATLAB_empty" in file[name].attrs:
            return np.empty(0)
    if values.dtype.names and {"real", "imag"} <= set(values.dtype.names):
        values = values["real"] + 1j * values["imag"]
    return values.T


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
