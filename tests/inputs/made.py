"""Inputs of the table that are made here, each by the few lines that a report of it would have."""

import numpy as np


def write_csv(path, **columns):
    """A recording, one column a name."""
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", comments="", fmt="%.9g",
               header=",".join(columns))


def write(folder):
    """All of them, into a folder."""
    for name, make in list(globals().items()):
        if name.startswith("make_"):
            make(folder)
