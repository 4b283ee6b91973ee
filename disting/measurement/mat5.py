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
from disting.measurement.source import Take

HEADER = 128
MATRIX, COMPRESSED = 14, 15
OPAQUE = 17  # class of an object, whose parts are another kind's: no dimensions before its name
TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
NUMBERS = range(6, 16)  # classes: double, single, integers of 8 to 64 bits
IS_COMPLEX = 0x800
# what damaged bytes raise
DAMAGE = (struct.error, zlib.error, ValueError, KeyError, IndexError, OverflowError, MemoryError)
HEAD = 512  # bytes that surely hold flags, dimensions and name
Bytes = bytes | memoryview


@dataclass(frozen=True, slots=True)
class Variable:
    """A matrix of a file, not yet read: name, class, the size [bytes] in its header, numbers taken
    as those of eight bytes; its bytes, whether they are compressed, their order.
    """

    name: str
    kind: int
    size: int
    body: Bytes
    compressed: bool
    order: str

    def read(self, take: Take) -> NDArray[Any]:
        """The array; raises InputError where it is none of numbers, damaged or too large."""
        try:
            return array(self.matrix(take), self.order)
        except DAMAGE as error:
            raise InputError(f"{self.name} cannot be read: {error}") from None

    def matrix(self, take: Take) -> Bytes:
        """The matrix's elements, unpacked; raises InputError where they are too large."""
        take(self.name, self.size)
        return _matrix(unpack(self.body, self.order)) if self.compressed else self.body


def is_version_5(content: bytes) -> bool:
    """Return True if a file begins like one of version 5 to 7."""
    return len(content) >= HEADER and content[126:128] in (b"IM", b"MI")


def matrices(content: Bytes, order: str, start: int, take: Take) -> Iterator[Bytes]:
    """Yield the matrices among the elements from `start` on, unpacked; raises InputError where
    one is too large.
    """
    for kind, body in elements(content[start:], order):
        if kind == COMPRESSED:
            take("the objects", _element_size(zlib.decompressobj().decompress(body, HEAD), order))
        if kind in (MATRIX, COMPRESSED):
            yield body if kind == MATRIX else _matrix(unpack(body, order))


def unpack(body: Bytes, order: str) -> bytes:
    """A compressed element, at most as many bytes as stated in its header."""
    packer = zlib.decompressobj()
    head = packer.decompress(body, HEAD)
    return head + packer.decompress(
        packer.unconsumed_tail, max(_element_size(head, order) - len(head), 1)
    )


def _element_size(element: bytes, order: str) -> int:
    """Size of an element with its header, as the header states."""
    return 8 + int(struct.unpack_from(order + "I", element, 4)[0])


def variables(content: bytes) -> Iterator[Variable]:
    """Yield the matrices that have a name, as far as the file is whole."""
    order, whole = "<" if content[126:128] == b"IM" else ">", memoryview(content)
    at = HEADER
    while at + 8 <= len(content):
        kind, size = struct.unpack_from(order + "II", content, at)
        body = whole[at + 8 : at + 8 + size]
        at += 8 + size
        try:
            if kind in (MATRIX, COMPRESSED):
                yield _variable(body, kind == COMPRESSED, order)
        except DAMAGE:
            continue


def _variable(body: memoryview, compressed: bool, order: str) -> Variable:
    """A matrix by its head; raises one of `DAMAGE` where it is damaged or has no name."""
    first = zlib.decompressobj().decompress(body, HEAD) if compressed else b""
    head = _matrix(first) if compressed else body[:HEAD]
    name, of = _name(head, order), flags(head, order)
    if not name:
        raise ValueError("no name")
    numbers = _count(head, order) * (16 if of & IS_COMPLEX else 8) if of & 0xFF in NUMBERS else 0
    return Variable(
        name=name,
        kind=of & 0xFF,
        size=max(numbers, _element_size(first, order) if compressed else len(body)),
        body=body,
        compressed=compressed,
        order=order,
    )


def _count(head: Bytes, order: str) -> int:
    """Number of elements of an array, from its dimensions."""
    return prod(max(int(n), 0) for n in _parts(head, order, 2)[1])


def _name(head: Bytes, order: str) -> str:
    parts = _parts(head, order, 3)
    return parts[1 if flags(head, order) & 0xFF == OPAQUE else 2].tobytes().decode("ascii")


def _matrix(element: Bytes) -> Bytes:
    """Content of an element without its type and size."""
    return element[8:]


def elements(matrix: Bytes, order: str) -> Iterator[tuple[int, Bytes]]:
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


def flags(matrix: Bytes, order: str) -> int:
    """Class of a matrix, in the lowest byte, and its flags."""
    return int(_parts(matrix, order, 1)[0][0])


def array(matrix: Bytes, order: str) -> NDArray[Any]:
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


def _parts(matrix: Bytes, order: str, count: int) -> list[NDArray[Any]]:
    """The first elements of a matrix, at most `count`, as arrays."""
    return [
        np.frombuffer(content, dtype=order + TYPES[kind])
        for kind, content in islice(elements(matrix, order), count)
    ]
