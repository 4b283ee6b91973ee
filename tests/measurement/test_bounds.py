"""Files that say, or unpack to, more than is read: refused by what their headers say, before
anything is unpacked.
"""

import struct
import tracemalloc
import zlib

import numpy as np
import pytest

from disting import InputError
from disting.measurement import read
from disting.measurement.matlab import variables
from disting.measurement.source import LARGEST, source
from disting.measurement.text_table import table
from tests.measurement.matlab_objects import element, head, matrix

FREQUENCY = np.linspace(1.0, 100.0, 16)
HUGE = 2**28  # numbers
TOO_MUCH = r"'f' unpacks to 2147 MB, more than 512 MB are not read; name a file that holds"


def refused_within(megabytes, path, words):
    """Refused with these words, without much memory."""
    tracemalloc.start()
    try:
        with pytest.raises(InputError, match=words):
            read(path)
        assert tracemalloc.get_traced_memory()[1] < megabytes * 1e6
    finally:
        tracemalloc.stop()


def hdf5(path, **options):
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        for name in ("f", "G"):
            file.create_dataset(name, dtype="f8", **options)


def test_fill_values_of_hdf5_are_counted_before_they_are_made(tmp_path):
    hdf5(tmp_path / "a.mat", shape=(HUGE,), fillvalue=1.0)
    assert (tmp_path / "a.mat").stat().st_size < 10_000
    refused_within(10, tmp_path / "a.mat", TOO_MUCH)


def test_a_chunk_of_hdf5_may_be_larger_than_its_array(tmp_path):
    hdf5(tmp_path / "a.mat", shape=(16,), maxshape=(None,), chunks=(HUGE,), compression="gzip")
    refused_within(10, tmp_path / "a.mat", TOO_MUCH)


@pytest.mark.full
def test_variables_are_counted_together(tmp_path):
    hdf5(tmp_path / "a.mat", shape=(LARGEST // 8 - 10,), fillvalue=1.0)
    arrays = variables(source(tmp_path / "a.mat"))
    with pytest.raises(InputError, match="'G' unpacks to 511 MB"):
        arrays["f"](), arrays["G"]()


def bomb(*filters):
    """An array of 16 numbers whose only chunk inflates to 8 MB."""

    def write(path):
        h5py = pytest.importorskip("h5py")
        with h5py.File(path, "w") as file:
            properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            properties.set_chunk((16,))
            for one in filters:
                properties.set_filter(one, values=(8,) if one == 2 else (6,) * (one == 1))
            space = h5py.h5s.create_simple((16,))
            of = h5py.h5t.IEEE_F64LE
            file["G"] = FREQUENCY
            array = h5py.h5d.create(file.id, b"f", of, space, dcpl=properties)
            array.write_direct_chunk((0,), zlib.compress(bytes(8_000_000)))

    return write


@pytest.mark.full
@pytest.mark.parametrize(
    ("filters", "words"),
    [
        ((1,), "f is damaged: a chunk of it unpacks to more than it says"),
        ((2, 1), "f is damaged: a chunk of it unpacks to more than it says"),
        ((1, 1), "f is packed in a way that is not read; save it with -v7"),
        ((1, 2), "f is packed in a way that is not read"),
        ((32000,), "f is packed in a way that is not read"),
    ],
)
def test_a_chunk_that_inflates_to_more_than_it_says(tmp_path, filters, words):
    bomb(*filters)(tmp_path / "a.mat")
    refused_within(8, tmp_path / "a.mat", words)


@pytest.mark.parametrize("options", [{}, {"shuffle": True}, {"fletcher32": True}])
def test_chunks_as_matlab_packs_them_are_read(tmp_path, options):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.mat", "w") as file:
        for name in ("f", "G"):
            file.create_dataset(name, data=FREQUENCY, chunks=(5,), compression="gzip", **options)
    assert np.array_equal(read(tmp_path / "a.mat").G.real, FREQUENCY)


def version_5(path, *parts):
    text = b"MATLAB 5.0 MAT-file".ljust(116)
    path.write_bytes(text + bytes(8) + struct.pack("<H", 0x0100) + b"IM" + b"".join(parts))


def deflated(said, content):
    """A compressed matrix that says its size, in as many bytes as one likes."""
    whole = struct.pack("<II", 14, said) + content
    return struct.pack("<II", 15, len(zlib.compress(whole))) + zlib.compress(whole)


def numbers(name, shape, content=b""):
    return head(6, shape, name) + struct.pack("<II", 9, 8 * int(np.prod(shape))) + content


def test_a_compressed_matrix_is_refused_by_the_size_that_it_says(tmp_path):
    version_5(
        tmp_path / "a.mat",
        deflated(8 * HUGE + 56, numbers("f", (1, HUGE))),
        matrix(FREQUENCY[None], "G"),
    )
    refused_within(10, tmp_path / "a.mat", TOO_MUCH)


@pytest.mark.full
def test_a_compressed_matrix_is_not_unpacked_beyond_the_size_that_it_says(tmp_path):
    version_5(
        tmp_path / "a.mat",
        deflated(8 * 16 + 56, numbers("f", (1, 16), bytes(50_000_000))),
        matrix(FREQUENCY[None], "G"),
    )
    tracemalloc.start()
    arrays = variables(source(tmp_path / "a.mat"))
    assert arrays["f"]().shape == (1, 16)
    assert tracemalloc.get_traced_memory()[1] < 5e6
    tracemalloc.stop()


def test_small_numbers_count_as_the_large_ones_that_they_become(tmp_path):
    content = head(6, (1, 300_000_000), "f", True) + struct.pack("<II", 2, 300_000_000)
    version_5(tmp_path / "a.mat", deflated(300_000_100, content), matrix(FREQUENCY[None], "G"))
    refused_within(10, tmp_path / "a.mat", "'f' unpacks to 4800 MB")


def test_structs_are_counted_too(tmp_path):
    version_5(tmp_path / "a.mat", deflated(2 * 10**9, head(2, (1, 1), "s")))
    refused_within(10, tmp_path / "a.mat", "'s' unpacks to 2000 MB")


def test_the_objects_of_a_file_are_counted_too(tmp_path):
    text = b"MATLAB 5.0 MAT-file".ljust(116)
    inner = deflated(2 * 10**9, head(9, (1, 2 * 10**9), ""))
    start = struct.pack("<Q", 128) + struct.pack("<H", 0x0100) + b"IM"
    (tmp_path / "a.mat").write_bytes(text + start + inner)
    refused_within(10, tmp_path / "a.mat", "'the objects' unpacks to 2000 MB")


@pytest.mark.parametrize("name", ["a.csv", "a.mat", "a.uff"])
def test_a_file_of_gigabytes_is_refused_unread(tmp_path, name):
    with (tmp_path / name).open("wb") as file:
        file.truncate(3 * 2**30)
    refused_within(1, tmp_path / name, "is larger than 512 MB, too large; name a file that holds")


def test_a_pipe_is_read_as_a_file_is(tmp_path):
    import os
    import threading

    os.mkfifo(tmp_path / "a.csv")
    lines = ["f [Hz],Re,Im", *(f"{f},1,{f}" for f in FREQUENCY), ""]
    threading.Thread(target=(tmp_path / "a.csv").write_text, args=["\n".join(lines)]).start()
    assert np.array_equal(read(tmp_path / "a.csv").G.imag, FREQUENCY)


def test_complex_frequencies_are_refused(tmp_path):
    version_5(
        tmp_path / "a.mat",
        element(
            14,
            head(6, (1, 16), "f", True)
            + element(9, FREQUENCY.tobytes())
            + element(9, np.ones(16).tobytes()),
        ),
        matrix(FREQUENCY[None], "G"),
    )
    with pytest.raises(InputError, match="f is complex; frequencies and times are real"):
        read(tmp_path / "a.mat")


@pytest.mark.full
def test_a_table_takes_a_few_times_its_file():
    text = "f [Hz],Re,Im\n" + "".join(f"{n},{1 / n},{n / 7}\n" for n in range(1, 10_000))
    tracemalloc.start()
    try:
        assert table(text, "a.csv").values.shape == (9_999, 3)
        assert tracemalloc.get_traced_memory()[1] < 8 * len(text)
    finally:
        tracemalloc.stop()
