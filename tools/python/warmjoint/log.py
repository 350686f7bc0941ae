"""Recordings of one joint, from arrays, data frames and files."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core

Array = npt.NDArray[np.float64]
Joint = Literal["rotary", "linear"]
COLUMNS = ("time", "position", "velocity", "torque", "motor_position", "load", "temperature")


class Log:
    """A recording of one joint, prepared for a fit. All columns are [N] arrays in SI.

    time (s) increases; position is in rad or m, torque in N.m or N; velocity (rad/s or m/s), motor_position (rad), load (N.m
    or N) and temperature (degC) may be left out, or position where there is a velocity: gravity and maps cannot be told then. unit, scale and wrap say how the arrays are meant, as the options of
    `warmjoint identify` do: unit={"position": "deg", "torque": "A"} with torque_constant (N.m/A at the joint), scale={"torque": -1},
    wrap=360 for a sensor that starts again after a turn. gear: motor turns for each turn of the joint. trim and shortest_hold (s)
    leave out the ends of constant-speed segments, and short ones.

    Raises BadInput for what cannot be used.
    """

    def __init__(self, *, time: npt.ArrayLike, torque: npt.ArrayLike, position: npt.ArrayLike | None = None,
                 velocity: npt.ArrayLike | None = None, motor_position: npt.ArrayLike | None = None,
                 load: npt.ArrayLike | None = None, temperature: npt.ArrayLike | None = None, joint: Joint = "rotary",
                 unit: Mapping[str, str] | None = None, scale: Mapping[str, float] | None = None, gear: float = 1,
                 torque_constant: float = 0, wrap: float = 0, trim: float = 0, shortest_hold: float = 0,
                 name: str = "log") -> None:
        given = dict(zip(COLUMNS, (time, position, velocity, torque, motor_position, load, temperature), strict=True))
        columns = {key: _column(key, values) for key, values in given.items() if values is not None}
        settings = _settings([name], joint=joint, unit=unit, scale=scale, gear=gear, torque_constant=torque_constant,
                             wrap=wrap, trim=trim, shortest_hold=shortest_hold)
        self._core = _core.log_of_columns(columns, settings)

    @classmethod
    def _of(cls, core: _core.Log) -> Log:
        log = cls.__new__(cls)
        log._core = core
        return log

    @classmethod
    def from_pandas(cls, frame: Any, *, unit: Mapping[str, str] | None = None, **named: Any) -> Log:
        """The log in a data frame: time="t_s", position="q" name its columns; those that are not named have our names.

        A column of dates is taken in seconds from its first entry. Other arguments are those of Log.
        """
        columns = {key: named.pop(key, key) for key in COLUMNS}
        found = {key: frame[name] for key, name in columns.items() if name in frame}
        needed = ("time", "torque") if "velocity" in found else ("time", "position", "torque")
        lacking = [key for key in needed if key not in found]
        if lacking:
            raise _core.BadInput(f"frame: has no column '{columns[lacking[0]]}'; it has {', '.join(map(str, frame))}; "
                                 f"name it, as {lacking[0]}='...'")
        for key, column in found.items():
            if np.issubdtype(column.dtype, np.datetime64):
                column = (column - column.iloc[0]).dt.total_seconds()
            elif np.issubdtype(column.dtype, np.timedelta64):
                column = column.dt.total_seconds()
            found[key] = column.to_numpy()
        return cls(unit=unit, **found, **named)

    @property
    def time(self) -> Array:
        """[N] s."""
        return self._core.time

    @property
    def position(self) -> Array:
        """[N] rad or m; the integral of the velocity where none was given."""
        return self._core.position

    @property
    def velocity(self) -> Array:
        """[N] rad/s or m/s; the slope of the positions where none was given."""
        return self._core.velocity

    @property
    def torque(self) -> Array:
        """[N] in `torque_unit`."""
        return self._core.torque

    @property
    def motor_position(self) -> Array | None:
        """[N] rad."""
        return self._core.motor_position

    @property
    def load(self) -> Array | None:
        """[N] N.m or N."""
        return self._core.load

    @property
    def temperature(self) -> Array | None:
        """[N] degC."""
        return self._core.temperature

    @property
    def joint(self) -> Joint:
        return self._core.joint

    @property
    def torque_unit(self) -> str:
        """N.m, N, or A where a current was logged."""
        return self._core.torque_unit

    @property
    def gear(self) -> float:
        return self._core.gear

    @property
    def source(self) -> str:
        """The file that it came from, or its name."""
        return self._core.source

    @property
    def notes(self) -> list[str]:
        """What reading made of the columns, one phrase each."""
        return self._core.notes

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes it as .csv or .h5, in SI, so that it reads back bit for bit."""
        self._core.save(os.fspath(path))

    def __len__(self) -> int:
        return self._core.size

    def __repr__(self) -> str:
        seconds = self.time[-1] - self.time[0] if len(self) else 0
        return f"<Log {self.source}: {len(self)} samples in {seconds:.4g} s, {self.joint} joint, torque in {self.torque_unit}>"


def read(path: str | os.PathLike[str] | Sequence[str | os.PathLike[str]], *, map: Mapping[str, str] | None = None,
         joint: Joint = "rotary", unit: Mapping[str, str] | None = None, scale: Mapping[str, float] | None = None,
         columns: Sequence[str] | None = None, rate: float = 0, gear: float = 1, torque_constant: float = 0, wrap: float = 0,
         trim: float = 0, shortest_hold: float = 0) -> Log:
    """Reads a recording: a table of text, HDF5 or MATLAB; several of one joint, each from a cold start, as one.

    map={"position": "q_m"} names the columns of the file. columns=["time", "position", "torque"] stand in place of the header that
    a text file lacks; rate (Hz) makes the time that a file lacks. The other arguments are those of Log. Raises BadInput.
    """
    paths = [path] if isinstance(path, (str, os.PathLike)) else list(path)
    settings = _settings([os.fspath(one) for one in paths], joint=joint, unit=unit, scale=scale,
                         columns=list(columns or []), rate=rate, gear=gear, torque_constant=torque_constant, wrap=wrap,
                         trim=trim, shortest_hold=shortest_hold)
    return Log._of(_core.read_log({**settings, "map": dict(map or {})}))


@dataclasses.dataclass(frozen=True)
class Check:
    """What a log holds, and what can be identified from it. `data` is what `warmjoint check --format json` prints."""

    data: dict[str, Any]
    text: str

    @property
    def faults(self) -> list[str]:
        """Where the log contradicts itself, one sentence each."""
        return list(self.data["faults"])

    @property
    def can_identify(self) -> dict[str, bool]:
        """{kind of friction: whether the motion shows it}."""
        return {one["what"]: one["sufficient"] for one in self.data["excitation"]}

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{one['what']}</th><td>{'yes' if one['sufficient'] else 'no'}</td><td>{one['reason']}</td></tr>"
                       for one in self.data["excitation"])
        return f"<table><tr><th>friction</th><th>can be identified</th><th>why</th></tr>{rows}</table>"


def check(log: Log) -> Check:
    """What the motion of a log can tell."""
    return Check(*_core.check(log._core))


def _column(name: str, values: npt.ArrayLike) -> Array:
    try:
        column = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as refusal:
        raise _core.BadInput(f"{name}: is no array of numbers ({refusal})") from None
    if column.ndim != 1:
        raise _core.BadInput(f"{name}: has the shape {column.shape}; give one number for each sample, [N]")
    return column


def _settings(files: list[str], **settings: Any) -> dict[str, Any]:
    """Of a recording source; what is left out is at its default."""
    return {"files": files, **{key: dict(value) if isinstance(value, Mapping) else value
                               for key, value in settings.items() if value is not None}}
