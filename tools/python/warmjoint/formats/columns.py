"""Columns of a log: arrays of numbers by their paths in what a file holds, and what is refused."""

import difflib
import re
from collections.abc import Mapping

import numpy
from refusal import Refusal

FIELD = re.compile(r"^(.*?)(?:\[(\d+)\])?$")
MOST_COLUMNS = 256  # of a matrix that is written whole
MOST_PATHS = 10_000  # arrays and groups of a file that are looked at
MOST_NUMBERS = 400_000_000  # of all columns that are written: 3.2 GB


def nearest(name, known):
    """Words that name what there is, the nearest first. known: names, or {name: array}."""
    close = difflib.get_close_matches(name, known, 1)
    start = f"did you mean '{close[0]}'? " if close else ""
    shown = [f"{one} ({' x '.join(map(str, known[one].shape))})" if isinstance(known, Mapping) and hasattr(known[one], "shape") else one
             for one in sorted(known)]
    return f"{start}it has: {', '.join(shown[:20]) or 'none'}" + (", ..." if len(shown) > 20 else "")


def split(field):
    """(name, index or None) of "q[3]"."""
    name, index = FIELD.match(field).groups()
    return name, None if index is None else int(index)


def plain(path):
    """A path as arrays_of spells it: "robot/q" and "robot.q", "joint{1}" and "joint[1]" are one."""
    return path.strip("/").replace("/", ".").replace("{", "[").replace("}", "]")


def kind_of(array):
    """Why an array is no column of numbers; empty where it is one. Dates are one: see seconds_of."""
    words = {"c": "is complex", "b": "holds yes and no", "U": "holds texts", "S": "holds texts", "O": "holds objects", "V": "holds records"}
    return words.get(array.dtype.kind, "")


def arrays_of(tree, place, notes):
    """{path: vector or matrix of numbers or dates} of mappings, lists and arrays within each other: "log[1].joint.q".

    What is left out is noted. Refuses two arrays of one path, and more than MOST_PATHS.
    """
    found, left_out, todo = {}, [], [("", tree)]
    for count in range(MOST_PATHS + 1):
        if not todo:
            break
        if count == MOST_PATHS:
            raise Refusal(f"{place}: holds more than {MOST_PATHS} arrays and groups; take what the log needs into a file of its own")
        path, value = todo.pop()
        if isinstance(value, Mapping):
            todo += [(f"{path}.{name}" if path else str(name), one) for name, one in value.items()]
        elif isinstance(value, (list, tuple)) or getattr(getattr(value, "dtype", None), "kind", "") == "O":
            entries = list(value if isinstance(value, (list, tuple)) else value.ravel(order="F"))
            if entries and not hasattr(entries[0], "shape") and not isinstance(entries[0], (Mapping, list, tuple)):
                left_out.append(f"'{path}' holds objects")
                continue
            todo += [(f"{path}[{i}]", one) for i, one in enumerate(entries[:MOST_PATHS])]
        elif hasattr(value, "dtype") and [length for length in value.shape if length != 1]:
            shape = [length for length in value.shape if length != 1]
            why = kind_of(value) or ("has more than two dimensions" if len(shape) > 2 else "")
            if why:
                left_out.append(f"'{path}' {why}")
            elif path in found:
                raise Refusal(f"{place}: has '{path}' twice, once with a dot in a name; rename one")
            else:
                found[path] = value
    if left_out:
        notes.append(f"left out: {', '.join(left_out[:20])}" + (f" and {len(left_out) - 20} more" if len(left_out) > 20 else ""))
    return dict(reversed(found.items()))


def length_of(arrays):
    """The number of samples: the longest of those lengths that all arrays have, else that of the first."""
    lengths = [set(array.shape) - {1} for array in arrays]
    return max(set.intersection(*lengths) or lengths[0])


def seconds_of(values):
    """(unit, [N]) of a vector: dates and durations in s, dates from the first of them on."""
    if values.dtype.kind not in "mM":
        return "", numpy.ascontiguousarray(values, dtype=float)
    start = values[0] if values.dtype.kind == "M" else numpy.timedelta64(0)
    seconds = (values - start) / numpy.timedelta64(1, "s")
    return "s", numpy.ascontiguousarray(seconds, dtype=float)


def told_unit(array):
    """The unit that a dataset of HDF5 or a variable of netCDF says; of "seconds since ..." the unit alone."""
    attributes = getattr(array, "attrs", None) or getattr(array, "__dict__", {})
    told = next((attributes[name] for name in ("unit", "units") if name in attributes), "")
    told = told.decode(errors="replace") if isinstance(told, bytes) else told
    return told.partition(" since ")[0] if isinstance(told, str) else ""


def vector(array, index, samples):
    """(unit, [N]) of a vector, or of the column of a matrix N x k or k x N."""
    told = told_unit(array)
    if len([length for length in array.shape if length != 1]) == 1:
        unit, values = seconds_of(numpy.asarray(array).reshape(-1))
    else:
        flat = array if len(array.shape) == 2 else numpy.squeeze(numpy.asarray(array))
        unit, values = seconds_of(numpy.asarray(flat[:, index] if flat.shape[0] == samples else flat[index, :]))
    return unit or told, values


def count_of(place, name, array, index, samples):
    """Columns of a matrix, 0 of a vector; refuses an index that does not fit."""
    shape = [length for length in array.shape if length != 1]
    shown = f"{name} ({' x '.join(map(str, array.shape))})"
    if len(shape) == 1:
        if index is not None:
            raise Refusal(f"{place}: {shown} is one column; leave [{index}] out")
        return 0
    count = shape[1] if shape[0] == samples else shape[0]
    if index is None:
        raise Refusal(f"{place}: {shown} has {count} columns; give an index, {name}[0] to {name}[{count - 1}]")
    if index >= count:
        raise Refusal(f"{place}: {shown} has {count} columns; an index is at most {count - 1}")
    return count


def pick(place, tree, fields, notes):
    """{column: (unit, [N])} of the fields asked for, or of all vectors and columns of matrices by their own names."""
    left_out = []
    arrays = arrays_of(tree, place, left_out)
    if not arrays:
        raise Refusal(f"{place}: holds no array of numbers; {'; '.join(left_out) or nearest('', tree)}")
    if not fields:
        notes += left_out
        return everything(place, arrays, notes)
    found = {}
    for column, field in fields.items():
        if not field:
            continue
        name, index = plain(field), None
        if name not in arrays:
            name, index = split(name)
        if name not in arrays:
            raise Refusal(f"{place}: has no '{field}' (for {column}); {nearest(name, arrays)}")
        found[column] = name, index
    samples = length_of([arrays[name] for name, _ in found.values()])
    for name, index in found.values():
        count_of(place, name, arrays[name], index, samples)
    return {column: vector(arrays[name], index, samples) for column, (name, index) in found.items()}


def everything(place, arrays, notes):
    """Every vector, and every column of matrices of as many samples, by paths without what all have in front."""
    common = min((name.rpartition(".")[0].split(".") for name in arrays), key=len)
    while common and not all(name.split(".")[:len(common)] == common for name in arrays):
        common.pop()
    front = len(".".join(common)) + 1 if common and common != [""] else 0
    vectors = [array for array in arrays.values() if len([length for length in array.shape if length != 1]) == 1]
    samples = length_of(vectors[:1] or list(arrays.values()))
    wanted, left_out = [], []
    for name, array in arrays.items():
        shape = [length for length in array.shape if length != 1]
        if len(shape) == 1:
            wanted.append((name[front:], array, None))
        elif samples in shape and min(shape) <= MOST_COLUMNS:
            wanted += [(f"{name[front:]}[{i}]", array, i) for i in range(count_of("", name, array, 0, samples))]
        else:
            left_out.append(f"'{name}' ({' x '.join(map(str, array.shape))})")
    if left_out:
        notes.append(f"left out, since they are no columns of {samples} samples: {', '.join(left_out[:20])}")
    if len(wanted) * samples > MOST_NUMBERS:
        raise Refusal(f"{place}: holds {len(wanted)} columns of {samples} samples; name those of the log with --map")
    return {name: vector(array, index, samples) for name, array, index in wanted}


def require_one_length(place, columns):
    if not columns:
        raise Refusal(f"{place}: holds no samples")
    first, length = next((name, len(values)) for name, (_, values) in columns.items())
    if length == 0:
        raise Refusal(f"{place}: holds no samples")
    for name, (_, values) in columns.items():
        if len(values) != length:
            raise Refusal(f"{place}: {name} has {len(values)} samples where {first} has {length}; choose columns with --map")
