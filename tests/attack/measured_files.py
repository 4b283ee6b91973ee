"""Files with known numbers, small damage, and what the damaged file says by an independent reading.

A reading gives pairs (frequency, response) or None where the damaged file says no numbers; it
knows one form of file only and is strict, while the readers under attack know many and guess.
"""

import io
import math
import re
import struct
import zlib

import numpy as np
import scipy.io

LINES = 12
FREQUENCY = np.round(np.geomspace(1.25, 80, LINES), 4)
RESPONSE = np.round(900 / (FREQUENCY + 2), 5) - 1j * np.round(40 / FREQUENCY + 3, 5)
NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eEdD][+-]?[0-9]+)?")
DIALECTS = ((",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", "."))
HEADERS = (
    ("f [Hz]", 2 * math.pi),
    ("f_kHz", 2e3 * math.pi),
    ("omega", 1.0),
    ("frequency/Hz", 2 * math.pi),
    ("w [rad/s]", 1.0),
)
CELLS = (
    "", "x", "-", "+", ".", "e5", "1e", "1..2", "1.2.3", "--1", "+-1", "0x10", "1_000", "1 2", "nan", "inf", "-inf", "1e400",
    "1d3", "2.5D-1", "1e+2", ".5", "5.", "#", "1,5", "1.5", "1;5", '"7.25"', "'7'", "1e-400", "-0", "0", "True", "=1+1", "1j",
    "1/2", "50%", "1.5 # note", "\u0663", "\u22121", "NULL", "1e5e5", "9" * 400,
)  # fmt: skip


TYPES_OF_4 = {0: "<f8", 10: "<f4", 20: "<i4", 30: "<i2", 40: "<u2", 50: "<u1"}
TYPES_OF_5 = dict(enumerate(("i1", "u1", "i2", "u2", "i4", "u4", "f4"), 1)) | {
    9: "f8",
    12: "i8",
    13: "u8",
}


class Text:
    """Columns of frequency, real and imaginary part in one of the dialects, with a header line."""

    suffix = ".csv"

    def __init__(self, draw):
        self.delimiter, self.decimal = draw.choice(DIALECTS)
        word, self.unit = draw.choice(HEADERS)
        word = word.replace(" ", "_") if self.delimiter == " " else word
        rows = [
            [f"{x:.{draw.choice((5, 9))}g}" for x in (f, g.real, g.imag)]
            for f, g in zip(FREQUENCY, RESPONSE, strict=True)
        ]
        table = [[cell.replace(".", self.decimal) for cell in row] for row in rows]
        self.lines = [[word, "Re", "Im"], *table]

    def content(self):
        return "".join(self.delimiter.join(line) + "\n" for line in self.lines).encode()

    def damage(self, draw):
        """One small damage below the header; the content."""
        at = draw.randrange(1, len(self.lines))
        kind = draw.choice(
            (
                "cell",
                "cell",
                "cell",
                "drop",
                "double",
                "move",
                "short",
                "long",
                "byte",
                "byte",
                "byte",
                "cut",
            )
        )
        if kind == "cell":
            self.lines[at][draw.randrange(3)] = draw.choice(CELLS)
        elif kind == "drop":
            del self.lines[at]
        elif kind == "double":
            self.lines.insert(at, list(self.lines[at]))
        elif kind == "move":
            self.lines.insert(draw.randrange(1, len(self.lines)), self.lines.pop(at))
        elif kind == "short":
            del self.lines[at][draw.randrange(3)]
        elif kind == "long":
            self.lines[at].insert(draw.randrange(4), draw.choice((*CELLS, "7")))
        content = self.content()
        start = content.index(b"\n") + 1
        if kind == "cut":
            return content[: draw.randrange(start, len(content))]
        return (
            with_bytes_changed(draw, content, start, b'0123456789.,;+-eE \t\n#"x\r\x00\xe4')
            if kind == "byte"
            else content
        )

    def said(self, content):
        try:
            text = content.decode("utf-8")
        except UnicodeDecodeError:
            text = content.decode("latin-1")
        lines = [line.strip("\n\r ") for line in re.split("\r\n|\n|\r", text)][1:]
        rows = [self._row(line) for line in lines if line and line[0] not in "#%"]
        if (
            "\0" in text
            or len(rows) < 8
            or not all(rows)
            or not all(math.isfinite(x) for row in rows for x in row)
        ):
            return None
        return [(f * self.unit, complex(re, im)) for f, re, im in rows]

    def _row(self, line):
        cells = [
            cell.strip().strip('"')
            for cell in (line.split() if self.delimiter == " " else line.split(self.delimiter))
        ]
        cells = cells[:-1] if len(cells) == 4 and not cells[-1] else cells
        plain = [cell.replace(",", ".") if self.decimal == "," else cell for cell in cells]
        good = len(plain) == 3 and all(map(NUMBER.fullmatch, plain))
        return [float(cell.lower().replace("d", "e")) for cell in plain] if good else None


class Matlab:
    """Variables f and G as SciPy writes them: version 5, plain or compressed, or 4; read by the
    definitions of the formats.
    """

    suffix = ".mat"

    def __init__(self, draw):
        self.format, compressed = draw.choice(
            (("4", False), ("5", False), ("5", False), ("5", True))
        )
        self.options = {"format": self.format, "do_compression": compressed}

    def content(self):
        stream = io.BytesIO()
        scipy.io.savemat(stream, {"f": FREQUENCY, "G": RESPONSE}, **self.options)
        return stream.getvalue()

    def damage(self, draw):
        return with_bytes_changed(draw, self.content(), 0, bytes(range(256)))

    def said(self, content):
        try:
            found = (version_4 if self.format == "4" else version_5)(content)
        except (ValueError, KeyError, IndexError, struct.error, zlib.error):
            return None
        f = next(
            (
                found[name] * unit
                for name, unit in ((b"f", 2 * math.pi), (b"F", 2 * math.pi), (b"w", 1.0))
                if name in found
            ),
            (),
        )
        g = next((found[name] for name in (b"G", b"H") if name in found), ())
        return (
            list(zip(f, g, strict=True))
            if len(f) == len(g) >= 8 and np.all(np.isfinite(f)) and np.all(np.isfinite(g))
            else None
        )


class Hdf5(Matlab):
    """The same in a file of MATLAB 7.3."""

    def content(self):
        import h5py

        stream = io.BytesIO()
        with h5py.File(stream, "w", userblock_size=512) as file:
            file["f"] = FREQUENCY
            pairs = np.zeros(LINES, dtype=[("real", "f8"), ("imag", "f8")])
            pairs["real"], pairs["imag"] = RESPONSE.real, RESPONSE.imag
            file["G"] = pairs
        return stream.getvalue()

    def said(self, content):
        """By the places where the numbers stand; what is changed elsewhere must change no
        number.
        """
        good = self.content()
        blocks = [FREQUENCY.tobytes(), RESPONSE.tobytes()]
        pieces = [content[good.index(block) :][: len(block)] for block in blocks]
        if [*map(len, pieces)] != [*map(len, blocks)]:
            return None
        f, g = np.frombuffer(pieces[0]), np.frombuffer(pieces[1], complex)
        return list(zip(2 * math.pi * f, g, strict=True))


class Universal:
    """A data set 58 in text, of equidistant frequencies; read by the columns of the format's
    definition.
    """

    suffix = ".uff"

    def __init__(self, draw):
        self.spacing = draw.choice((0, 1))

    def content(self):
        x = FREQUENCY if self.spacing == 0 else np.arange(1.0, LINES + 1)
        head = [
            "    -1", "    58", *["a"] * 5,
            "    4         0    0         1 r                 3   3 f                 1  -3",
            f"{5:10d}{LINES:10d}{self.spacing:10d}  {x[0]:11.5e}  {x[1] - x[0]:11.5e}  {0:11.5e}",
            "        18    0    0    0 NONE                 Hz",
            "        12    0    0    0 NONE                 m/s2",
            "        13    0    0    0 NONE                 N",
            "         0    0    0    0 NONE                 NONE",
        ]  # fmt: skip
        numbers = [
            n
            for f, g in zip(x, RESPONSE, strict=True)
            for n in [f] * (self.spacing == 0) + [g.real, g.imag]
        ]
        width = 6
        data = [
            "".join(f"{n:13.5e}" for n in numbers[i : i + width])
            for i in range(0, len(numbers), width)
        ]
        return "\n".join([*head, *data, "    -1", ""]).encode()

    def damage(self, draw):
        content = self.content()
        end = content.rindex(b"    -1")
        start = end - content[:end].count(b"e") // 6 * 79
        return (
            with_bytes_changed(draw, content[:end], max(0, start), b"0123456789.+-eE \nx")
            + content[end:]
        )

    def said(self, content):
        lines = content.decode("latin-1").split("\n")
        try:
            count, x0, step = int(lines[8][10:20]), float(lines[8][32:45]), float(lines[8][45:58])
            body = lines[13 : lines.index("    -1", 1)]
            numbers = [
                float(line[i : i + 13])
                for line in body
                for i in range(0, min(len(line.rstrip()), 78), 13)
            ]
        except ValueError:
            return None
        wide = 3 if self.spacing == 0 else 2
        if len(numbers) != wide * count or not all(map(math.isfinite, numbers)):
            return None
        rows = [numbers[i : i + wide] for i in range(0, len(numbers), wide)]
        x = [row[0] for row in rows] if wide == 3 else [x0 + step * i for i in range(count)]
        return [(2 * math.pi * f, complex(*row[-2:])) for f, row in zip(x, rows, strict=True)]


def with_bytes_changed(draw, content, start, alphabet):
    """One to three bytes from `start` on replaced, put in, or removed."""
    found = bytearray(content)
    for _ in range(draw.choice((1, 1, 2, 3))):
        at, new = draw.randrange(start, len(found)), bytes([draw.choice(alphabet)])
        found[at : at + draw.choice((0, 1, 1))] = draw.choice((new, new, b""))
    return bytes(found)


def version_4(content):
    """Variables of a file: each five whole numbers, a name, real parts, imaginary parts."""
    at, found = 0, {}
    while at + 20 <= len(content):
        kind, rows, columns, imaginary, length = struct.unpack_from("<5i", content, at)
        if kind not in TYPES_OF_4:
            raise ValueError("another kind")
        name, at, size = (
            content[at + 20 : at + 20 + length].rstrip(b"\0"),
            at + 20 + length,
            rows * columns,
        )
        type_ = np.dtype(TYPES_OF_4[kind])
        parts = np.frombuffer(
            content[at : at + type_.itemsize * size * (1 + (imaginary == 1))], type_
        )
        found[name] = parts[:size] + 1j * parts[size:] if imaginary == 1 else parts
        at += type_.itemsize * len(parts)
    return found


def version_5(content):
    """Variables of a file: elements of type and size, a matrix being flags, dimensions, name,
    real part, imaginary part.
    """
    order, at, found = "<" if content[126:128] == b"IM" else ">", 128, {}
    while at + 8 <= len(content):
        kind, size = struct.unpack_from(order + "2I", content, at)
        body, at = content[at + 8 : at + 8 + size], at + 8 + size
        if kind == 15:
            body = zlib.decompress(body)[8:]
        elif kind != 14:
            continue
        parts = []
        while body:
            kind, size = struct.unpack_from(order + "2I", body)
            head = 4 if kind >> 16 else 8
            kind, size = (kind & 0xFFFF, kind >> 16) if kind >> 16 else (kind, size)
            parts.append(np.frombuffer(body[head : head + size], order + TYPES_OF_5[kind]))
            body = body[8 if head == 4 else head + -(-size // 8) * 8 :]
        found[parts[2].tobytes()] = parts[3] + 1j * parts[4] if parts[0][0] & 0x800 else parts[3]
    return found
