"""Columns of a log: fields with indices, and what is refused."""

import difflib
import re

import numpy

FIELD = re.compile(r"^(.*?)(?:\[(\d+)\])?$")


class Refusal(Exception):
    """An input that cannot be used: place, value, remedy."""


def nearest(name, known):
    """Words that name what there is, the nearest first."""
    close = difflib.get_close_matches(name, known, 1)
    start = f"did you mean '{close[0]}'? " if close else ""
    shown = ", ".join(sorted(known)[:20]) + (", ..." if len(known) > 20 else "")
    return f"{start}it has: {shown or 'none'}"


def split(field):
    """(name, index or None) of "q[3]"."""
    name, index = FIELD.match(field).groups()
    return name, None if index is None else int(index)


def vector(values, name, index, place):
    """One number a sample: values [N], or [N x M] with an index below M."""
    values = numpy.asarray(values)
    if values.dtype == object and len(values):
        sizes = {len(one) for one in values if one is not None}
        if len(sizes) != 1:
            raise Refusal(f"{place}: {name} has lists of different lengths")
        values = numpy.stack(values)
    if values.dtype.kind not in "fiub":
        raise Refusal(f"{place}: {name} holds no numbers")
    if values.ndim == 2 and index is not None:
        if index >= values.shape[1]:
            raise Refusal(f"{place}: {name} has {values.shape[1]} entries; an index is at most {values.shape[1] - 1}")
        return values[:, index].astype(float)
    if values.ndim != 1 or index is not None:
        wanted = f"give an index, {name}[0] to {name}[{values.shape[1] - 1}]" if values.ndim == 2 else "it has one number a sample"
        raise Refusal(f"{place}: {name} has {values.ndim} dimensions; {wanted}")
    return values.astype(float)


def pick(place, known, fields, take):
    """{column: vector} of the fields asked for, or of all that are one number a sample. take: name -> values."""
    if not fields:
        found = {name: take(name) for name in known}
        found = {name: values for name, values in found.items() if values.ndim == 1 and values.dtype.kind in "fiub"}
        if not found:
            raise Refusal(f"{place}: no column is one number a sample; {nearest('', known)}; name entries with --map position=NAME[0]")
        return {name: values.astype(float) for name, values in found.items()}
    chosen = {}
    for column, field in fields.items():
        name, index = split(field)
        if name not in known:
            raise Refusal(f"{place}: has no '{name}' (for {column}); {nearest(name, known)}")
        chosen[column] = vector(take(name), name, index, place)
    return chosen


def require_one_length(place, columns):
    first, length = next((name, len(values)) for name, values in columns.items())
    if length == 0:
        raise Refusal(f"{place}: holds no samples")
    for name, values in columns.items():
        if len(values) != length:
            raise Refusal(f"{place}: {name} has {len(values)} samples where {first} has {length}; choose columns with --map")
