"""A format of measured data is a module and a row of the table: both, written into a copy of the
package, are at work.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

import disting

MODULE = """
import json

import numpy as np

from disting.measurement.response import FrequencyResponse


def read_json(file, *, sensor="acceleration"):
    data = json.loads(file.content)
    G = np.array(data["re"]) + 1j * np.array(data["im"])
    return FrequencyResponse(np.array(data["omega"]), G, sensor=sensor, origin=file.name)
"""
ROW = """FORMATS = (
    Format(
        name="JSON",
        fits=lambda file, head: head.lstrip().startswith(b"{"),
        response=lambda file, options: checked(read_json, options, file)(file, **options),
    ),
"""
USE = """
from disting import InputError
from disting.measurement import read

found = read("response.json", sensor="velocity")
print(found.sensor, found.G[0], len(found))
for options in ({"column": 2}, {"input": "u", "output": "y"}):
    try:
        read("response.json", **options)
    except InputError as error:
        print(error)
"""
IMPORT = "from disting.measurement.table import Table\n"


def test_a_format_is_a_row_of_the_table(tmp_path):
    shipped = Path(disting.__file__).parent
    shutil.copytree(shipped, tmp_path / "disting", ignore=shutil.ignore_patterns("__pycache__"))
    folder = tmp_path / "disting" / "measurement"
    (folder / "json_file.py").write_text(MODULE, encoding="utf-8")
    text = (folder / "formats.py").read_text(encoding="utf-8")
    for old, new in (
        ("FORMATS = (\n", ROW),
        (IMPORT, IMPORT + "from disting.measurement.json_file import read_json\n"),
    ):
        assert text.count(old) == 1
        text = text.replace(old, new)
    (folder / "formats.py").write_text(text, encoding="utf-8")
    omega = np.linspace(1.0, 100.0, 30)
    data = {"omega": omega.tolist(), "re": omega.tolist(), "im": (-omega).tolist()}
    (tmp_path / "response.json").write_text(json.dumps(data), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", USE],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "velocity (1-1j) 30",
        "response.json: unknown option column; known for this format: sensor",
        "response.json: time series are read from MATLAB and text files",
    ]
