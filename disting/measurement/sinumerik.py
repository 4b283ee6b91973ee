"""Traces of a Sinumerik control: XML with signals and records.

    <traceData><dataFrame><frameHeader dropOuts="0"/>
      <dataSignal id="f1" name=".." interval="0.002"/>
      <rec time="0" f1="1.5" f2="0"/><rec time="0.002" f2="1"/> ..

A record leaves out what has not changed: the value before holds. The unit of a signal has a name of
the control's own, which implies no unit: none is read. Signals of the interval that most of them
have are read, and the others are named.
"""

from collections import Counter
from collections.abc import Iterator
from xml.etree.ElementTree import Element, ParseError, fromstring

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.table import Table

ROOT, FRAMES, TIME = "<traceSession", "traceData/dataFrame", "time"
HEAD = 2000  # characters within which the root begins


def read_trace(text: str, origin: str) -> Table | None:
    """The table of a trace, its time [s] first; None for any other text. Raises InputError for what
    is no whole trace of one frame.
    """
    if ROOT not in text[:HEAD]:
        return None
    try:
        frames = fromstring(text).findall(f".//{FRAMES}")
    except ParseError as error:
        message = f"this trace is no whole XML ({error}); export it again"
        raise InputError(f"{origin}: {message}") from None
    if len(frames) != 1:
        raise InputError(f"{origin}: a trace of {len(frames)} frames; export one")
    return _table(frames[0], origin)


def _table(frame: Element, origin: str) -> Table:
    header, records = frame.find("frameHeader"), frame.findall("rec")
    lost = header.get("dropOuts", "0") if header is not None else "0"
    if lost.strip() not in ("", "0"):
        raise InputError(f"{origin}: samples of this trace are lost ({lost}); record it again")
    signals = [s for s in frame.findall("dataSignal") if s.get("id")]
    intervals = Counter(s.get("interval", "") for s in signals)
    if not intervals or not records:
        raise InputError(f"{origin}: this trace has no signals or no records")
    usual = intervals.most_common(1)[0][0]
    kept = [s for s in signals if s.get("interval", "") == usual]
    rest = [f"{_name(s)} (each {s.get('interval')} s)" for s in signals if s not in kept]
    keys = [TIME, *(s.attrib["id"] for s in kept)]
    columns = [list(_numbers(records, key, origin)) for key in keys]
    return Table(
        ("time [s]", *map(_name, kept)),
        np.array(columns).T,
        tuple(range(1, len(records) + 1)),
        (),
        origin,
        left_out=f"left out: {enumeration(rest)}, not each {usual} s" if rest else "",
    )


def _name(signal: Element) -> str:
    return (signal.get("name") or signal.get("description") or signal.attrib["id"]).strip()


def _numbers(records: list[Element], key: str, origin: str) -> Iterator[float]:
    """Values of a signal; what a record leaves out is as before."""
    value = None
    for n, record in enumerate(records, 1):
        text = record.get(key)
        if text is not None:
            try:
                value = float(text)
            except ValueError:
                where = f"{origin}, record {n}, {key}"
                raise InputError(f"{where}: {short(text)} is no number") from None
        if value is None or (key == TIME and text is None):
            raise InputError(f"{origin}: record {n} of this trace has no value of {key}")
        yield value
