"""MATLAB files with objects, written by the layout of the format alone."""

import struct

import numpy as np

# class of the matrix, type of the element
NUMBERS = {"f8": (6, 9), "u4": (13, 6), "i4": (12, 5), "u1": (9, 2)}


def element(kind, content):
    return struct.pack("<II", kind, len(content)) + content + bytes(-len(content) % 8)


def whole(*values):
    return element(5, struct.pack(f"<{len(values)}i", *values))


def head(kind, shape, name, complex_=False):
    return (
        element(6, struct.pack("<II", kind | 0x800 * complex_, 0))
        + whole(*shape)
        + element(1, name.encode())
    )


def matrix(value, name=""):
    """A variable: an array, a text, a list (cells), a dictionary (a struct), or a tuple (an
    object: its number, its class).
    """
    if isinstance(value, tuple):
        return opaque(
            matrix(np.array([[0xDD000000], [2], [1], [1], [value[0]], [value[1]]], "u4")),
            name,
            "frd",
        )
    if isinstance(value, str):
        return element(14, head(4, (1, len(value)), name) + element(4, value.encode("utf-16-le")))
    if isinstance(value, list):
        return element(
            14, head(1, (len(value), 1), name) + b"".join(matrix(part) for part in value)
        )
    if isinstance(value, dict):
        fields = b"".join(field.encode().ljust(32, b"\0") for field in value)
        inner = b"".join(matrix(part) for part in value.values())
        return element(
            14, head(2, (1, 1), name) + struct.pack("<HHi", 5, 4, 32) + element(1, fields) + inner
        )
    value = np.atleast_2d(value)
    complex_ = np.iscomplexobj(value)
    of, kind = NUMBERS["f8" if complex_ else value.dtype.str[1:]]
    parts = (value.real, value.imag) if complex_ else (value,)
    return element(
        14,
        head(of, value.shape, name, complex_)
        + b"".join(element(kind, p.tobytes("F")) for p in parts),
    )


def opaque(inner, name, class_):
    flags = element(6, struct.pack("<II", 17, 0))
    return element(
        14, flags + b"".join(element(1, text.encode()) for text in (name, "MCOS", class_)) + inner
    )


def tables(objects):
    """The tables of the objects' properties, and the cells of these."""
    names = sorted({name for held in objects for name in held})
    cells, entries, listed = [], struct.pack("<II", 0, 0), struct.pack("<6I", *[0] * 6)
    for number, held in enumerate(objects, 1):
        words = [len(held)]
        for name, value in held.items():
            words += [names.index(name) + 1, 1, len(cells)]
            cells.append(value)
        entries += struct.pack(f"<{len(words)}I", *words) + bytes(4 * (len(words) % 2))
        listed += struct.pack("<6I", 1, 0, 0, 0, number, number)
    text = b"".join(name.encode() + b"\0" for name in names)
    text += bytes(-len(text) % 8)
    begins = np.cumsum([40 + len(text), 32, 0, len(listed), len(entries)])
    begins = [*begins, *[begins[-1]] * 3]
    return struct.pack("<II8I", 4, len(names), *begins) + text + bytes(32) + listed + entries, cells


def file_of(variables, objects):
    """Content of a file: variables by name, and what the objects 1, 2, .. hold."""
    meta, cells = tables(objects)
    wrapped = [np.frombuffer(meta, "u1")[:, None], np.empty((0, 0)), *cells, np.empty((0, 0))]
    mcos = opaque(matrix(wrapped), "", "FileWrapper__")
    fields = struct.pack("<HHi", 5, 4, 5) + element(1, b"MCOS\0")
    inner = b"\x00\x01IM\0\0\0\0" + element(14, head(2, (1, 1), "") + fields + mcos)
    body = b"".join(matrix(value, name) for name, value in variables.items())
    start = b"MATLAB 5.0 MAT-file".ljust(116) + struct.pack("<Q", 128 + len(body)) + b"\x00\x01IM"
    return start + body + matrix(np.frombuffer(inner, "u1")[:, None])
