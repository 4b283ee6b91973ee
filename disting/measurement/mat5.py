"""Arrays of numbers in a MATLAB file of version 5 to 7, read by NumPy alone.

SciPy's reader crashes the interpreter on some damaged files, and its listing stops at objects that
it does not know (of the Control System Toolbox, for example); only arrays of numbers are needed
here. Layout (MathWorks, "MAT-File Format"): a header of 128 bytes, then elements. An element is
its type and size (32 bits each) and content, filled to eight bytes; a small one has size and type
in 16 bits each and at most four bytes of content. A compressed element holds one matrix. A matrix
holds elements: flags and class, dimensions, name, real part, imaginary part, in the order of
Fortran.
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError

HEADER = 128
MATRIX, COMPRESSED = 14, 15
OPAQUE = 17  # class of an object, whose parts are another kind's: no dimensions before its name
TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
NUMBERS = range(6, 16)  # classes: double, single, integers of 8 to 64 bits
IS_COMPLEX = 0x800
# what damaged bytes raise
DAMAGE = (struct.error, zlib.error, ValueError, KeyError, IndexError, OverflowError, MemoryError)
HEAD = 512  # bytes that surely hold flags, dimensions and name


@dataclass(frozen=True, slots=True)
class Variable:
    """A matrix of a file, not yet read: name, class, bytes, whether they are compressed, and
    the order of bytes.
    """

    name: str
    kind: int
    body: bytes
    compressed: bool
    order: str

    def read(self) -> NDArray[Any]:
        """The array; raises InputError where it is none of numbers, or damaged."""
        try:
            return array(self.matrix(), self.order)
        except DAMAGE as error:
            raise InputError(f"{self.name} cannot be read: {error}") from None

    def matrix(self) -> bytes:
        """The matrix's elements, unpacked."""
        return _matrix(zlib.decompress(self.body)) if self.compressed else self.body


def is_version_5(content: bytes) -> bool:
    """Whether a file begins like one of version 5 to 7."""
    return len(content) >= HEADER and content[126:128] in (b"IM", b"MI")


def matrices(content: bytes, order: str, start: int) -> Iterator[bytes]:
    """Yield the matrices among the elements from `start` on, unpacked."""
    for kind, body in elements(content[start:], order):
        if kind in (MATRIX, COMPRESSED):
            yield body if kind == MATRIX else _matrix(zlib.decompress(body))


def variables(content: bytes) -> Iterator[Variable]:
    """Yield the matrices that have a name, as far as the file is whole."""
    order = "<" if content[126:128] == b"IM" else ">"
    at = HEADER
    while at + 8 <= len(content):
        kind, size = struct.unpack_from(order + "II", content, at)
        body = content[at + 8 : at + 8 + size]
        at += 8 + size
        try:
            head = (
                _matrix(zlib.decompressobj().decompress(body, HEAD))
                if kind == COMPRESSED
                else body[:HEAD]
            )
            name, of = (
                (_name(head, order), flags(head, order) & 0xFF)
                if kind in (MATRIX, COMPRESSED)
                else ("", 0)
            )
        except DAMAGE:
            continue
        if name:
            yield Variable(
                name=name, kind=of, body=body, compressed=kind == COMPRESSED, order=order
            )


def _name(head: bytes, order: str) -> str:
    parts = _parts(head, order, 3)
    return parts[1 if flags(head, order) & 0xFF == OPAQUE else 2].tobytes().decode("ascii")


def _matrix(element: bytes) -> bytes:
    """Content of an element without its type and size."""
    return element[8:]


def elements(matrix: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """Yield type and content of the elements of a matrix; raises ValueError where one is cut
    off.
    """
    at = 0
    while at < len(matrix):
        kind, size = struct.unpack_from(order + "II", matrix, at)
        start = at + 8
        if kind >> 16:
            kind, size, start = kind & 0xFFFF, kind >> 16, at + 4
        if start + size > len(matrix):
            raise ValueError("an element is cut off")
        yield kind, matrix[start : start + size]
        at = start + -(-size // 8) * 8 if start == at + 8 else at + 8


def flags(matrix: bytes, order: str) -> int:
    """Class of a matrix, in the lowest byte, and what it is besides."""
    return int(_parts(matrix, order, 1)[0][0])


def array(matrix: bytes, order: str) -> NDArray[Any]:
    """The numbers of a matrix; raises one of `DAMAGE` where it has none, or where it is damaged."""
    of = flags(matrix, order)
    if of & 0xFF not in NUMBERS:
        raise ValueError("no array of numbers")
    parts = _parts(matrix, order, 5 if of & IS_COMPLEX else 4)
    shape = tuple(int(n) for n in parts[1])
    if len(parts) < 4 + bool(of & IS_COMPLEX) or any(
        part.size != prod(shape) for part in parts[3:]
    ):
        raise ValueError("the numbers do not fill the dimensions")
    whole = parts[3] + 1j * parts[4] if of & IS_COMPLEX else parts[3]
    return np.asarray(whole).reshape(shape, order="F")


def _parts(matrix: bytes, order: str, count: int) -> list[NDArray[Any]]:
    """The first elements of a matrix, at most `count`, as arrays."""
    return [
        np.frombuffer(content, dtype=order + TYPES[kind])
        for kind, content in islice(elements(matrix, order), count)
    ]
