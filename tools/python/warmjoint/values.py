"""Columns as numbers, of whatever Python holds them in: NumPy, pandas, Polars, xarray, pyarrow, lists, numbers with units."""

from __future__ import annotations

import dataclasses
import datetime
import operator
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from warmjoint import _core

Array = npt.NDArray[np.float64]
TIME = "time"
CONTAINERS = (list, tuple, dict, set, frozenset)
KINDS = {"b": "booleans", "c": "complex numbers", "V": "records"}  # that no column has


@dataclasses.dataclass(frozen=True)
class Column:
    """A column of a table, before its values are looked at."""

    name: str
    unit: str  # as the table says beside the name; empty where it does not
    values: Any


def columns_of(table: Any) -> list[Column] | None:
    """The columns of a data frame, data set, structured array or dict of arrays; None of what is none of these."""
    if isinstance(table, np.ndarray):
        return [Column(name, "", table[name]) for name in table.dtype.names] if table.dtype.names else None
    if hasattr(table, "collect_schema") and hasattr(table, "collect"):  # of Polars, not yet computed
        table = table.collect()
    if hasattr(table, "data_vars") and hasattr(table, "coords"):  # of xarray
        return [_column_of(name, table[name]) for name in (*table.coords, *table.data_vars) if table[name].ndim in (1, 2)]
    if isinstance(table, Mapping):
        return [_column_of(name, values) for name, values in table.items()]
    if hasattr(table, "schema") and hasattr(table, "column"):  # of pyarrow
        return [_column_of(name, table.column(i)) for i, name in enumerate(table.schema.names)]
    if not hasattr(table, "columns") or len(getattr(table, "shape", ())) != 2:
        return None
    if hasattr(table, "iloc"):  # of pandas, where a name may stand twice
        found = [_column_of(name, table.iloc[:, i]) for i, name in enumerate(table.columns)]
        return found + _of_index(table.index, {one.name for one in found})
    return [_column_of(name, table[name]) for name in table.columns]


def array_of(values: Any) -> npt.NDArray[Any] | None:
    """The values as an array of any shape, NaN where a mask hides one; None of what is no array."""
    given, _ = _without_unit(values)
    if isinstance(given, (str, bytes, Mapping)) or given is None:
        return None
    try:
        return _array(given)
    except Exception:  # of any library; `column` says why
        return None


def column(name: str, values: Any, label: str = "") -> tuple[Array, str]:
    """Numbers [N], NaN where there is none, and the unit that the values themselves tell, else an empty text. Dates become seconds from
    the first of them. name: of our column; label: what messages call it. Raises BadInput for what is no column of numbers."""
    label = label or name
    values, unit = _without_unit(values)
    if isinstance(values, (str, bytes, Mapping)) or values is None:
        raise _core.BadInput(f"{label}: is {kind_of(values)}; give numbers, [N]")
    try:
        found = _array(values)
        # a column or a row of a matrix is one, too
        flat = found.reshape(-1) if found.size and found.size == max(found.shape, default=0) else found
    except Exception as refusal:  # of any library
        raise _core.BadInput(f"{label}: cannot be read as an array of numbers ({type(refusal).__name__}: {refusal})") from None
    if flat.ndim != 1:
        raise _core.BadInput(f"{label}: has the shape {found.shape}; give one number for each sample, [N]")
    kind = flat.dtype.kind
    if kind in "iuf":
        return np.ascontiguousarray(flat, dtype=np.float64), unit
    if kind in "OUST":
        return _of_objects(name, flat.astype(object), unit, label)
    if kind in "mM" and name == TIME:
        return _seconds(flat), "s"
    words = "dates or durations" if kind in "mM" else KINDS.get(kind, f"values of the type {flat.dtype}")
    raise _core.BadInput(f"{label}: holds {words}; give real numbers, [N]")


def numbers(argument: str, values: Any) -> Array:
    """Numbers of any shape. Raises BadInput for what is none, or carries a unit."""
    given, unit = _without_unit(values)
    if unit:
        raise _core.BadInput(f"{argument}: carries the unit {unit}; give plain numbers in SI")
    try:
        found = _array(given)
        if found.dtype.kind in "iufO":
            return np.asarray(found, dtype=np.float64)
    except Exception as refusal:  # of any library
        raise _core.BadInput(f"{argument}: cannot be read as numbers ({type(refusal).__name__}: {refusal})") from None
    raise _core.BadInput(f"{argument}: is {kind_of(values)}; give numbers")


def together(**given: Any) -> dict[str, Array]:
    """Numbers of arguments, broadcast to one shape. Raises BadInput where that is not possible."""
    found = {name: numbers(name, values) for name, values in given.items()}
    try:
        return dict(zip(found, np.broadcast_arrays(*found.values()), strict=True))
    except ValueError:
        shapes = ", ".join(f"{name} {values.shape}" for name, values in found.items() if values.ndim)
        raise _core.BadInput(f"{next(iter(given))}: the shapes do not fit together: {shapes}; give numbers, or arrays of one shape") from None


def number(argument: str, value: Any) -> float:
    """One number. Raises BadInput for what is none."""
    if value is None:
        raise _core.BadInput(f"{argument}: is None; give one number")
    found = numbers(argument, value)
    if found.size != 1:
        raise _core.BadInput(f"{argument}: has the shape {found.shape}; give one number")
    return float(found.reshape(-1)[0])


def whole(argument: str, value: Any) -> int:
    """A whole number from 0 to 2^64 - 1, as seeds are. Raises BadInput for what is none."""
    try:
        found = operator.index(value)
    except TypeError:
        raise _core.BadInput(f"{argument}: is {shown(value)}; give a whole number") from None
    if not 0 <= found < 2**64:
        raise _core.BadInput(f"{argument}: is {shown(found)}; it must be from 0 to 2^64 - 1")
    return found


def named(argument: str, given: Any) -> dict[str, Any]:
    """A dict whose keys are texts; nothing of None. Raises BadInput for what is none."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise _core.BadInput(f"{argument}: is {kind_of(given)}; give a dict by names")
    for key in given:
        if not isinstance(key, str):
            raise _core.BadInput(f"{argument}: has the key {shown(key)}; give names as text")
    return dict(given)


def text(argument: str, given: Any) -> str:
    """A text that UTF-8 holds. Raises BadInput for what is none."""
    try:
        if isinstance(given, str) and given.encode() is not None:
            return given
    except UnicodeEncodeError:
        raise _core.BadInput(f"{argument}: is {shown(given)}, which is no UTF-8; give a text") from None
    raise _core.BadInput(f"{argument}: is {shown(given)}; give a text")


def flag(argument: str, given: Any) -> bool:
    """True or False, of NumPy as well. Raises BadInput for what is neither."""
    if not isinstance(given, (bool, np.bool_)):
        raise _core.BadInput(f"{argument}: is {shown(given)}; give True or False")
    return bool(given)


def texts(argument: str, given: Any) -> list[str]:
    """A list of texts, or one text. Raises BadInput for what is none."""
    found = list(given) if isinstance(given, (list, tuple)) else [given]
    for one in found:
        if not isinstance(one, str):
            raise _core.BadInput(f"{argument}: is {shown(one)}; give a text, or a list of texts")
    return found


def path_of(path: Any, argument: str = "path") -> str:
    """A path as text. Raises BadInput for what is none, and for names that are no UTF-8."""
    try:
        text = os.fsdecode(path)
        text.encode()
    except TypeError:
        raise _core.BadInput(f"{argument}: is {kind_of(path)}; give the path of a file") from None
    except UnicodeEncodeError:
        raise _core.BadInput(f"{argument}: the name {path!a} is no UTF-8; rename the file") from None
    if not text:
        raise _core.BadInput(f"{argument}: is empty; give the path of a file")
    if "\0" in text:
        raise _core.BadInput(f"{argument}: the name {path!a} holds a null character; give the path of a file")
    return text


def of_kind(argument: str, given: Any, kind: type) -> None:
    """Raises BadInput for what is not of a class."""
    if not isinstance(given, kind):
        module = kind.__module__.split(".")[0]
        raise _core.BadInput(f"{argument}: is {kind_of(given)}; give a {module}.{kind.__name__}")


def style_of(style: Any) -> Any:
    """A style of pictures, as figures.style has it."""
    from warmjoint.figures import style as styles

    try:
        styles.style_of(style)
    except ValueError as none:
        raise _core.BadInput(str(none)) from None
    return style


def kind_of(value: Any) -> str:
    """What a value is, for messages."""
    return "None" if value is None else f"a value of the type {type(value).__name__}"


def shown(value: Any) -> str:
    """A value in few words, for messages."""
    if isinstance(value, CONTAINERS):  # which may hold each other without end
        return kind_of(value)
    try:
        return one_line(ascii(value))[:60]
    except ValueError:  # of numbers with thousands of digits
        return kind_of(value)


def one_line(said: object) -> str:
    """What another library says, or shows of a value, on one line."""
    return " ".join(str(said).split())


def text_of(name: Any) -> str:
    """A name as text that files could hold; levels of several have a stroke between."""
    parts = name if isinstance(name, tuple) else (name,)
    texts = [part if isinstance(part, str) else shown(part) for part in parts]
    return "/".join(text for text in texts if text).encode("utf-8", "replace").decode()


def _column_of(name: Any, values: Any) -> Column:
    attributes = getattr(values, "attrs", None)
    unit = attributes.get("units", attributes.get("unit", "")) if isinstance(attributes, Mapping) else ""
    return Column(text_of(name), unit if isinstance(unit, str) else "", values)


def _of_index(index: Any, taken: set[str]) -> list[Column]:
    """The index of a pandas frame, level by level, where it may be a column: one with a name, or of dates, durations or fractions."""
    found = []
    for i in range(index.nlevels):
        level = index.get_level_values(i)
        name = text_of(level.name) if level.name is not None else TIME if level.dtype.kind in "mMf" else ""
        if name and name not in taken:
            found.append(Column(name, "", level))
    return found


def _without_unit(values: Any) -> tuple[Any, str]:
    """Numbers, and the name of the unit that they carry as an object, of Pint or Astropy, or as an attribute, of xarray."""
    if hasattr(values, "magnitude") and hasattr(values, "units"):
        # Pint has the factors of a product by the alphabet: m*N
        return values.magnitude, ".".join(sorted(f"{values.units:~C}".split("*"), key=lambda factor: not factor.endswith("N")))
    if hasattr(values, "to_value") and hasattr(values, "unit"):
        return values.value, str(values.unit)
    return values, _column_of("", values).unit


def _array(values: Any) -> npt.NDArray[Any]:
    """An array of NumPy, with NaN, NaT or None where there is nothing: hidden by a mask, null, or missing."""
    if isinstance(values, (list, tuple)) and any(isinstance(inside, (list, tuple)) for one in values if isinstance(one, (list, tuple)) for inside in one):
        raise ValueError("lists within lists within lists")
    if isinstance(values, np.ma.MaskedArray):
        masked: Any = values
        kind = masked.dtype.kind
        nothing = np.array("NaT", masked.dtype) if kind in "mM" else np.nan
        as_it_can = masked if kind in "mM" else masked.astype(np.float64 if kind in "iuf" else object)
        return np.asarray(as_it_can.filled(nothing))
    dtype = getattr(values, "dtype", None)
    if hasattr(values, "to_numpy"):
        # extension types of pandas: zoned dates, and numbers that may be missing
        if getattr(dtype, "tz", None) is not None:
            return np.asarray(values.to_numpy(dtype="datetime64[ns]"))
        if hasattr(dtype, "na_value") and getattr(dtype, "kind", "") in "iuf":
            return np.asarray(values.to_numpy(dtype=np.float64, na_value=np.nan))
        try:
            return np.asarray(values.to_numpy())
        except (TypeError, ValueError):  # of pyarrow, which must be allowed to copy
            return np.asarray(values.to_numpy(zero_copy_only=False))
    if hasattr(values, "__iter__") and not hasattr(values, "__array__") and not hasattr(values, "__len__"):
        return np.asarray(list(values))
    return np.asarray(values)


def _seconds(found: npt.NDArray[Any]) -> Array:
    """Dates from the first of them, and durations, in s."""
    if found.dtype.kind == "M":
        there = found[~np.isnat(found)]
        found = found - there[0] if len(there) else found - found
    return np.ascontiguousarray(found / np.timedelta64(1, "s"), dtype=np.float64)


def _of_objects(name: str, found: npt.NDArray[Any], unit: str, label: str) -> tuple[Array, str]:
    """Values of Python: numbers, dates, or texts as files hold them, and what stands for nothing."""
    numbers = np.full(len(found), np.nan)
    where = np.flatnonzero([not _is_nothing(one) for one in found])
    there = [one.item() if isinstance(one, np.ndarray) and one.ndim == 0 else one for one in found[where]]
    if there and all(isinstance(one, (str, bytes)) for one in there):
        texts = [text_of(one.decode("latin-1") if isinstance(one, bytes) else one) for one in there]
        numbers[where], is_stamp = _core.read_cells(texts, label, name == TIME)
        return numbers, "s" if is_stamp else unit
    is_time = bool(there) and name == TIME and isinstance(there[0], (datetime.date, datetime.timedelta))
    for i, one in zip(where, there, strict=True):
        try:
            if is_time:
                numbers[i] = (one if isinstance(one, datetime.timedelta) else one - there[0]).total_seconds()
            elif isinstance(one, (bool, np.bool_, str, bytes, np.ndarray)):
                raise TypeError
            else:
                numbers[i] = float(one)
        except (TypeError, ValueError, OverflowError, AttributeError):
            raise _core.BadInput(f"{label}: sample {i + 1} is {shown(one)}, which is no real number; give real numbers, [N]") from None
    return numbers, "s" if is_time else unit


def _is_nothing(one: Any) -> bool:
    return one is None or type(one).__name__ in ("NAType", "NaTType") or (isinstance(one, float) and one != one)
