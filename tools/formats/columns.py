"""Columns of a log: arrays of numbers by their paths in what a file holds, and what is refused."""

import difflib
import re
from collections.abc import Mapping

import numpy

FIELD = re.compile(r"^(.*?)(?:\[(\d+)\])?$")
MOST_COLUMNS = 256  # of a matrix that is written whole


class Refusal(Exception):
    """An input that cannot be used: place, value, remedy."""


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


def arrays_of(tree, path=""):
    """{path: vector or matrix of numbers} of mappings, lists and arrays within each other: "log[1].joint.q"."""
    if isinstance(tree, Mapping):
        named = {f"{path}.{name}" if path else str(name): value for name, value in tree.items()}
    elif isinstance(tree, (list, tuple)) or getattr(getattr(tree, "dtype", None), "kind", "") == "O":
        named = {f"{path}[{i}]": value for i, value in enumerate(tree if isinstance(tree, (list, tuple)) else tree.ravel(order="F"))}
    else:
        shape = [length for length in getattr(tree, "shape", ()) if length != 1]
        numbers = tree.dtype.kind in "fiub" if shape else False
        return {path: tree} if numbers and len(shape) <= 2 else {}
    found = {}
    for name, value in named.items():
        found |= arrays_of(value, name)
    return found


def length_of(arrays):
    """The number of samples: the longest of those lengths that all arrays have, else that of the first."""
    lengths = [set(array.shape) - {1} for array in arrays]
    return max(set.intersection(*lengths) or lengths[0])


def vector(array, index, samples):
    """[N] of a vector, or of the column of a matrix N x k or k x N."""
    values = numpy.squeeze(numpy.asarray(array))
    if values.ndim == 1:
        return values.astype(float)
    along = 0 if values.shape[0] == samples else 1
    return numpy.take(values, index, axis=1 - along).astype(float)


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


def pick(place, tree, fields):
    """{column: [N]} of the fields asked for, or of all vectors and columns of matrices by their own names."""
    arrays = arrays_of(tree)
    if not arrays:
        raise Refusal(f"{place}: holds no array of numbers; {nearest('', tree)}")
    if not fields:
        return everything(arrays)
    found = {}
    for column, field in fields.items():
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


def everything(arrays):
    """Every vector, and every column of matrices of as many samples, by paths without what all have in front."""
    common = min((name.rpartition(".")[0].split(".") for name in arrays), key=len)
    while common and not all(name.split(".")[:len(common)] == common for name in arrays):
        common.pop()
    front = len(".".join(common)) + 1 if common and common != [""] else 0
    vectors = [array for array in arrays.values() if numpy.squeeze(array).ndim == 1]
    samples = length_of(vectors[:1] or list(arrays.values()))
    found = {}
    for name, array in arrays.items():
        shape = [length for length in array.shape if length != 1]
        if len(shape) == 1:
            found[name[front:]] = vector(array, None, samples)
        elif samples in shape and min(shape) <= MOST_COLUMNS:
            found |= {f"{name[front:]}[{i}]": vector(array, i, samples) for i in range(count_of("", name, array, 0, samples))}
    return found


def require_one_length(place, columns):
    first, length = next((name, len(values)) for name, values in columns.items())
    if length == 0:
        raise Refusal(f"{place}: holds no samples")
    for name, values in columns.items():
        if len(values) != length:
            raise Refusal(f"{place}: {name} has {len(values)} samples where {first} has {length}; choose columns with --map")
