"""Structs and objects in a MATLAB file of version 5 to 7, as far as frequency responses are kept
in them.

An object (`frd`, `idfrd`) is a matrix of class 17 that holds whole numbers only: 0xDD000000, the
number of dimensions, those, the numbers of its objects, and that of its class. Its content is in
the subsystem at the end of the file, to which bytes 116 to 123 of the header lead: numbers of eight
bits that are a file themselves, in it a struct with a field MCOS, in this an object that is a cell
array. Its first cell has the tables, of whole numbers of 32 bits: version, count of names, where
eight tables begin; the names, each ended by a zero byte; then, by these beginnings, classes (0),
properties by what the class's saveobj gave (1), objects (2: six numbers each, the 4th and 5th give
the entry of 1 or of 3), properties (3). A property is name, kind and value: a cell (kind 1),
counted from the third one, or else a name or a small number, which no response needs. MathWorks
does not publish this; it is what files show. Objects of older versions (class 3) are stored like
structs.
"""

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.measurement import mat5
from disting.measurement.mat5 import Bytes
from disting.measurement.source import Take

CELL, STRUCT, OBJECT, CHARACTERS = 1, 2, 3, 4
MAGIC = 0xDD000000
IN_A_CELL = 1
DEEPEST = 8  # structs in structs
MOST = 4096  # fields and cells that are looked at
FIRST_CELL, NAMES = 2, 40  # of a value; of the names, in bytes


@dataclass(frozen=True, slots=True)
class Reference:
    """An object by its number in the subsystem."""

    number: int


def tree(matrix: Bytes, order: str, deep: int = 0) -> Any:
    """Array, text, list (cells), dictionary (a struct of one element), `Reference`, or None for
    what is none of these.
    """
    if not matrix:
        return np.empty(0)
    kind = mat5.flags(matrix, order) & 0xFF
    if kind in mat5.NUMBERS:
        return _or_reference(mat5.array(matrix, order))
    parts = list(mat5.elements(matrix, order))
    if kind == mat5.OPAQUE:
        return tree(parts[-1][1], order, deep)
    if kind == CHARACTERS:
        return _text(*parts[3], order)
    if kind not in (CELL, STRUCT, OBJECT) or deep == DEEPEST:
        return None
    inner = [
        tree(content, order, deep + 1)
        for type_, content in parts[3:][:MOST]
        if type_ == mat5.MATRIX
    ]
    return (
        inner
        if kind == CELL
        else dict(zip(_fields(parts, order, 3 + (kind == OBJECT)), inner, strict=False))
    )


def objects(content: bytes, take: Take) -> "Objects | None":
    """The subsystem of a file, None where it has none."""
    order = "<" if content[126:128] == b"IM" else ">"
    at = struct.unpack_from(order + "Q", content, 116)[0]
    inner = (
        next(mat5.matrices(memoryview(content), order, at, take), None)
        if mat5.HEADER <= at < len(content)
        else None
    )
    if inner is None:
        return None
    data = mat5.array(inner, order).astype(np.uint8).tobytes()
    order = "<" if data[2:4] == b"IM" else ">"
    for matrix in mat5.matrices(data, order, 8, take):
        variables = tree(matrix, order)
        cells = variables.get("MCOS") if isinstance(variables, dict) else None
        if isinstance(cells, list) and cells and isinstance(cells[0], np.ndarray):
            return Objects(cells, cells[0].astype(np.uint8).tobytes(), order)
    return None


def numbers_in(variable: mat5.Variable, take: Take) -> dict[str, NDArray[Any]]:
    """Arrays of numbers in a struct by name, `struct.field`; nothing for what is no struct, or
    damaged.
    """
    try:
        matrix = variable.matrix(take) if variable.kind in (STRUCT, OBJECT) else b""
        return _numbers(variable.name, tree(matrix, variable.order)) if matrix else {}
    except mat5.DAMAGE:
        return {}


def _numbers(name: str, value: Any) -> dict[str, NDArray[Any]]:
    parts = (
        [(f"{name}.{field}", part) for field, part in value.items()]
        if isinstance(value, dict)
        else []
    )
    entries = {inner: part for inner, part in parts if isinstance(part, np.ndarray) and part.size}
    return entries | {
        key: array for inner, part in parts for key, array in _numbers(inner, part).items()
    }


@dataclass(frozen=True, eq=False, slots=True)
class Objects:
    """Cells of a subsystem, the tables in the first of them, and their order of bytes."""

    cells: list[Any]
    tables: bytes
    order: str

    def properties(self, of: Reference) -> dict[str, Any]:
        """Properties of an object, by name; objects in it as `Reference`. Raises one of
        `mat5.DAMAGE`.
        """
        begins = struct.unpack_from(self.order + "8I", self.tables, 8)
        names = self.tables[NAMES : begins[0]].decode("latin-1").split("\0")
        saved, plain = struct.unpack_from(
            self.order + "6I", self.tables, begins[2] + 24 * of.number
        )[3:5]
        table, entry = (1, saved) if saved else (3, plain)
        values = self._entry(begins[table], begins[table + 1], entry)
        return {
            names[name - 1]: self.cells[FIRST_CELL + value]
            for name, kind, value in values
            if kind == IN_A_CELL
        }

    def _entry(self, begin: int, end: int, number: int) -> NDArray[np.uint32]:
        """The properties of entry `number`, shape (n, 3): a count, then three numbers each,
        filled to eight bytes.
        """
        words = np.frombuffer(self.tables[begin:end], self.order + "u4")
        at = 2  # an entry of nothing comes first
        for _ in range(number - 1):
            at += 1 + 3 * int(words[at])
            at += at % 2
        return words[at + 1 :][: 3 * int(words[at])].reshape(-1, 3)


def _or_reference(values: NDArray[Any]) -> NDArray[Any] | Reference:
    """A reference is known by its first number; dimensions lie between their count and the
    number of the object.
    """
    flat = values.ravel()
    if values.dtype.kind != "u" or values.dtype.itemsize != 4 or flat.size < 6 or flat[0] != MAGIC:
        return values
    return Reference(int(flat[2 + int(flat[1])]))


def _fields(parts: list[tuple[int, Bytes]], order: str, at: int) -> list[str]:
    """Names of the fields, none for an array of structs: the length of each, then all, filled
    with zeros.
    """
    if np.any(np.frombuffer(parts[1][1], order + "i4") != 1):
        return []
    length = struct.unpack(order + "i", parts[at][1])[0]
    names = bytes(parts[at + 1][1]).decode("latin-1")
    return [names[i : i + length].split("\0")[0] for i in range(0, len(names), length)]


def _text(type_: int, content: Bytes, order: str) -> str:
    """Characters of one line; 16 bits each as a rule."""
    wide = "utf-16-le" if order == "<" else "utf-16-be"
    return bytes(content).decode({4: wide, 17: wide, 16: "utf-8"}.get(type_, "latin-1")).strip()
