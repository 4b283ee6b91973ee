"""Thousands of slightly damaged measurement files: refused, or read with exactly the numbers
that stand in them.
"""

import faulthandler

import numpy as np
import pytest

from disting.errors import InputError
from disting.measurement import read
from tests.attack.counts import chance, times
from tests.attack.measured_files import Hdf5, Matlab, Text, Universal

pytestmark = pytest.mark.attack
HUNG = 60  # seconds; a file of some kilobytes needs a hundredth
NEAR = 1e-12


def numbers(response):
    return list(zip(response.omega.tolist(), response.G.tolist(), strict=True))


def same(found, said):
    """Whether these are the pairs that are said, in rising frequencies."""
    if said is None or len(found) != len(said):
        return False
    left, right = np.array(found), np.array(sorted(said, key=lambda pair: pair[0]))
    return bool(np.all(abs(left - right) <= NEAR * abs(right)))


@pytest.mark.parametrize(
    ("kind", "number"), [(Text, 6000), (Matlab, 2500), (Universal, 1000), (Hdf5, 500)]
)
def test_files(tmp_path, counts, kind, number):
    draw, wrong = chance(kind.__name__), []
    pytest.importorskip({Hdf5: "h5py", Universal: "pyuff"}.get(kind, "numpy"))
    for _ in range(times(number)):
        made = kind(draw)
        path = tmp_path / f"a{kind.suffix}"
        path.write_bytes(made.content())
        good = numbers(read(path))
        assert same(good, made.said(made.content()))
        content = made.damage(draw)
        path.write_bytes(content)
        counts["tried"] += 1
        faulthandler.dump_traceback_later(HUNG, exit=True)
        try:
            found = numbers(read(path))
        except InputError as reason:
            counts["refused"] += 1
            counts["refused without need"] += same(good, made.said(content))
            if len(str(reason)) > 2000:
                wrong.append(("long", str(reason)[:100]))
            continue
        except Exception as escaped:
            wrong.append((repr(escaped), content))
            continue
        finally:
            faulthandler.cancel_dump_traceback_later()
        said = made.said(content)
        if same(found, said) or (said is None and found == good):
            counts["accepted rightly"] += 1
        else:
            wrong.append((f"{len(found)} lines, not {said and len(said)}", content))
    counts["wrong"] = len(wrong)
    assert not wrong, "\n".join(f"{reason}: {content!r}" for reason, content in wrong)
