"""Where the programs and scenes are, and what `adstar` says."""

import csv
import io
import os
import pathlib
import subprocess

import numpy as np

PROGRAMS = pathlib.Path(os.environ["ADSTAR_PROGRAMS"])
SOURCE = pathlib.Path(os.environ["ADSTAR_SOURCE"])
SCENES = SOURCE / "configs" / "scenes"


def adstar(*words):
    """Its output; it must end well."""
    done = subprocess.run([PROGRAMS / "adstar", *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def rows_of(text):
    """CSV by column, each a list of texts."""
    rows = list(csv.DictReader(io.StringIO(text)))
    return {column: [row[column] for row in rows] for column in rows[0]}


def numbers(texts):
    """What is not known is NaN."""
    return np.array([float(text) if text else np.nan for text in texts])


def assert_same_bits(array, texts):
    np.testing.assert_array_equal(np.asarray(array, dtype=float), numbers(texts))


def assert_same_table(table, columns):
    """A structured array has a CSV's columns, in its order, and the bits of its numbers."""
    assert list(table.dtype.names) == list(columns)
    for name, texts in columns.items():
        if table.dtype[name].kind == "U":
            assert list(table[name]) == texts, name
        else:
            assert_same_bits(table[name], texts)
