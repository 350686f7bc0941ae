"""Logs as HDF5 or CSV, as a whole or not at all."""

import os
import pathlib
import tempfile

import h5py
from columns import Refusal


def write_hdf5(columns, path):
    with h5py.File(path, "w", track_order=False) as file:
        for name, values in columns.items():
            file.create_dataset(name, data=values, track_times=False)


def write_csv(columns, path):
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join(columns) + "\n")
        for row in zip(*columns.values()):
            file.write(",".join(repr(float(value)) for value in row) + "\n")


WRITERS = {".h5": write_hdf5, ".hdf5": write_hdf5, ".csv": write_csv}


def write(columns, path):
    """Puts the finished file in place under its name. Numbers read back bit for bit."""
    if path.suffix not in WRITERS:
        raise Refusal(f"{path}: logs are written as .h5 or .csv, not '{path.suffix}'; choose one of them")
    if path.exists() and not path.is_file():
        raise Refusal(f"{path}: is not a regular file; choose another output")
    with tempfile.TemporaryDirectory(prefix=".warmjoint.convert.", dir=path.parent) as folder:
        partial = pathlib.Path(folder) / path.name
        WRITERS[path.suffix](columns, partial)
        os.replace(partial, path)
