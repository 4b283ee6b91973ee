"""Variables of MATLAB files: version 5 to 7 by `mat5`, 4 by SciPy, 7.3 (an HDF5 file) by h5py.

Arrays in an HDF5 file, such as MATLAB writes as version 7.3, with bounds that h5py has not.

A file of two kilobytes may say that it holds gigabytes: of fill values that were never written, in
chunks larger than the array, or in one chunk that inflates to any size, whatever is said of it. So
the sizes of array and chunks are read from the headers, and chunks are inflated once, piece by
piece, before the library does it. This needs to know how they are packed: shuffled, deflated, with
a checksum, in this order, as MATLAB and h5py do it.
"""

import io
import warnings
import zlib
from collections.abc import Callable
from functools import partial
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.measurement import mat5, mat5_objects
from disting.measurement.matlab_models import ResponseObject, stored_responses
from disting.measurement.source import Allowance, Source, Take
from disting.measurement.variables import Arrays

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

    with _opened(file) as inside:
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
    with _opened(file) as inside:
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


def _opened(file: Source) -> Any:
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
    """Whether deflated bytes are more than `most`, without keeping them."""
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
    return {name: partial(_loaded, file, name) for name in _listed(file)}


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
        said = str(error)
        raise InputError(said if file.name in said else f"{file.name}: {said}") from None


def _listed(file: Source) -> set[str]:
    import scipy.io

    contents = _foreign(
        partial(scipy.io.whosmat, io.BytesIO(file.content)),
        f"{file.name} is no MATLAB file that can be read",
    )
    return {str(entry[0]) for entry in contents}


def _loaded(file: Source, name: str) -> NDArray[Any]:
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
