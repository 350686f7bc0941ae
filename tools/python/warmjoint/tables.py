"""What people give as a log: files of every kind, and columns in memory. One joint's Log and a robot's log are read by these."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping, Sequence
from typing import Any

from warmjoint import _core, other_formats
from warmjoint.values import TIME, Array, Column, array_of, column, columns_of, kind_of, path_of


@dataclasses.dataclass(frozen=True)
class Asked:
    """What is asked of a file of another format: a topic and a joint of a bag, fields by our names; joints: one or all of a bag."""

    topic: str | None = None
    joint: str | None = None
    joints: str = "one"
    map: Mapping[str, str] = dataclasses.field(default_factory=dict)


@dataclasses.dataclass(frozen=True)
class Table:
    """One log: columns, or a table of text, in memory; a file that the program reads where there is neither."""

    name: str
    columns: list[Column] | None = None
    text: str | None = None


def table_of(given: Any, name: str, asked: Asked) -> Table | None:
    """The log that a path, a data frame or a dict of columns is; None of what is none of these. name: of one in memory. Raises BadInput."""
    if isinstance(given, (str, bytes, os.PathLike)):
        path = path_of(given)
        return _of_other(path, asked) if other_formats.is_other(path) else Table(path)
    columns = columns_of(given)
    return None if columns is None else Table(name, columns)


def tables_of(given: Any, argument: str, asked: Asked) -> list[Table]:
    """The logs of one of these, or of a list of them. Raises BadInput."""
    one = table_of(given, argument, asked)
    if one is not None:
        return [one]
    found = []
    for each in list_of(given, argument, "give a path, a data frame, a dict of columns, or a list of these"):
        part = table_of(each, argument, asked)
        if part is None:
            raise _core.BadInput(f"{argument}: holds {kind_of(each)}; give paths, data frames or dicts of columns")
        found.append(part)
    if not found:
        raise _core.BadInput(f"{argument}: is an empty list; give at least one")
    return found


def with_objects(table: Table, refusal: _core.BadInput, asked: Asked) -> Table:
    """A file that the program refused, as the readers of other formats see it: cells, compounds and structs. Raises the refusal where it can
    hold none, and where they refuse it, too."""
    if table.columns is not None or table.text is not None or not other_formats.may_hold_objects(table.name):
        raise refusal
    try:
        return _of_other(table.name, asked)
    except _core.BadInput:
        raise refusal from None


def numbers_of(table: Table) -> list[tuple[str, str, Array | None, str]]:
    """(name, unit, [N], why there are no numbers) of all columns; matrices [N, n] become n columns, numbered from 0. Raises BadInput for
    a matrix that has its samples in its columns."""
    parts = [(one, array_of(one.values)) for one in table.columns or []]
    samples = next((len(found) for _, found in parts if found is not None and found.ndim == 1 and len(found) > 1), None)
    numbers: list[tuple[str, str, Array | None, str]] = []
    for one, found in parts:
        if found is None or found.ndim != 2 or 1 in found.shape:
            numbers.append(_numbers(one.name, one))
            continue
        rows, count = found.shape
        if (count == samples and rows != samples) or (samples is None and count > rows):
            raise _core.BadInput(f"{one.name}: has the shape {found.shape}; give a row for each sample and a column for each joint, [N, n]: "
                                 f"its transpose")
        numbers += [_numbers(f"{one.name}{j}", Column(f"{one.name}{j}", one.unit, found[:, j])) for j in range(count)]
    return numbers


def list_of(given: Any, argument: str, remedy: str) -> list[Any]:
    if isinstance(given, (Sequence, set, frozenset)) and not isinstance(given, (str, bytes)):
        return list(given)
    raise _core.BadInput(f"{argument}: is {kind_of(given)}; {remedy}")


def _of_other(path: str, asked: Asked) -> Table:
    found = other_formats.read(path, topic=asked.topic, joint=asked.joint, joints=asked.joints, map=asked.map)
    return Table(path, text=found) if isinstance(found, str) else Table(path, found)


def _numbers(name: str, one: Column) -> tuple[str, str, Array | None, str]:
    try:
        values, unit = column(TIME, one.values, name)
    except _core.BadInput as refusal:
        return name, one.unit, None, str(refusal)
    return name, unit or one.unit, values, ""
