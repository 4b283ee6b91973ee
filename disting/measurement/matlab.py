"""Variables of MATLAB files: version 5 to 7 by `mat5`, 4 by SciPy, 7.3 (an HDF5 file) by h5py."""

import io
import warnings
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.measurement import hdf5, mat5, mat5_objects
from disting.measurement.matlab_models import Stored, stored_responses
from disting.measurement.source import Allowance, Source, Take
from disting.measurement.variables import Arrays

HDF5 = b"\x89HDF\r\n\x1a\n"


def variables(file: Source) -> Arrays:
    """The variables of a file by name, read when called; raises InputError for what is no MATLAB
    file or unpacks to more than 512 MB, now or then.

    Numbers in structs are called `struct.field`.
    """
    content, allowance = file.content, Allowance(file.name)
    if HDF5 in (content[:8], content[512:520]):  # MATLAB puts 512 bytes of its own before it
        return _hdf5(file, allowance.take)
    if mat5.is_version_5(content):
        found = list(mat5.variables(content))
        fields = {
            name: partial(np.asarray, array)
            for one in found
            for name, array in mat5_objects.numbers_in(one, allowance.take).items()
        }
        whole = {one.name: partial(_whole, one, file, allowance.take) for one in found}
        return fields | whole
    if b"\0" not in content[:4]:  # version 4 begins with a small number
        raise InputError(f"{file.name} is no MATLAB file")
    return {name: partial(_loaded, file, name) for name in _listed(file)}


def responses(file: Source) -> dict[str, Stored]:
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
        said = str(error)
        raise InputError(said if file.name in said else f"{file.name}: {said}") from None


def _listed(file: Source) -> set[str]:
    import scipy.io

    found = _foreign(
        partial(scipy.io.whosmat, io.BytesIO(file.content)),
        f"{file.name} is no MATLAB file that can be read",
    )
    return {str(entry[0]) for entry in found}


def _loaded(file: Source, name: str) -> NDArray[Any]:
    import scipy.io

    load = partial(scipy.io.loadmat, io.BytesIO(file.content), variable_names=[name])
    found = _foreign(load, f"{file.name}: variable {name} cannot be read")
    if name not in found:
        raise InputError(f"{file.name}: variable {name} cannot be read")
    return np.asarray(found[name])


def _hdf5(file: Source, take: Take) -> Arrays:
    try:
        import h5py  # noqa: F401
    except ImportError:
        raise InputError(
            f'{file.name} is a MATLAB 7.3 file: pip install "disting[hdf5]", or save it with -v7'
        ) from None
    refusal = f"{file.name} is no HDF5 file that can be read"
    names = _foreign(partial(hdf5.datasets, file), refusal)
    return {name: partial(_dataset, file, name, take) for name in names}


def _dataset(file: Source, name: str, take: Take) -> NDArray[Any]:
    read = partial(hdf5.dataset, file, name, take)
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
