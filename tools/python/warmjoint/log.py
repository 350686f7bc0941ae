"""Recordings of one joint, from arrays, data frames and files."""

from __future__ import annotations

import dataclasses
import html
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from warmjoint import _core, other_formats
from warmjoint.tables import Asked, Table, list_of, table_of, with_objects
from warmjoint.values import Array, Column, column, columns_of, kind_of, number, path_of, style_of, text_of
from warmjoint.values import named as texts_by_name

if TYPE_CHECKING:
    import pandas

Joint = Literal["rotary", "linear"]
COLUMNS = ("time", "position", "velocity", "torque", "motor_position", "load", "temperature")
READING = ("map", "joint", "unit", "scale", "columns", "rate", "gear", "torque_constant", "wrap", "trim", "shortest_hold", "topic",
           "joint_name")


class Log:
    """A recording of one joint, prepared for a fit. All columns are [N] arrays in SI.

    time (s) increases; position is in rad or m, torque in N.m or N; velocity (rad/s or m/s), motor_position (rad), load (N.m
    or N) and temperature (degC) may be left out, or position where there is a velocity: gravity and maps cannot be told then. A column
    is what NumPy, pandas, Polars, xarray or pyarrow hold; one that has a name with a unit, as frame["t_ms"], is read in that. unit, scale
    and wrap say how the arrays are meant, as the options of `warmjoint identify` do: unit={"position": "deg", "torque": "A"} with
    torque_constant (N.m/A at the joint), scale={"torque": -1}, wrap=360 for a sensor that starts again after a turn. rate (Hz) makes the
    time that is left out. gear: motor turns for each turn of the joint. trim and shortest_hold (s) leave out the ends of constant-speed
    segments, and short ones.

    log[100:2000] are some of its samples. Logs can be pickled and copied. Raises BadInput for what cannot be used.
    """

    def __init__(self, *, torque: Any, time: Any = None, position: Any = None, velocity: Any = None, motor_position: Any = None,
                 load: Any = None, temperature: Any = None, joint: Joint = "rotary", unit: Mapping[str, str] | None = None,
                 scale: Mapping[str, float] | None = None, rate: float = 0, gear: float = 1, torque_constant: float = 0,
                 wrap: float = 0, trim: float = 0, shortest_hold: float = 0, name: str = "log") -> None:
        given = dict(zip(COLUMNS, (time, position, velocity, torque, motor_position, load, temperature), strict=True))
        table = {key: values for key, values in given.items() if values is not None}
        settings = _settings([name], joint=joint, unit=unit, scale=scale, rate=rate, gear=gear, torque_constant=torque_constant,
                             wrap=wrap, trim=trim, shortest_hold=shortest_hold)
        # a series may have a name that tells its unit; two of one name are told apart by ours
        names = {key: text_of(getattr(values, "name", None) or key) for key, values in table.items()}
        if len(set(names.values())) < len(names) or any(name in COLUMNS for key, name in names.items() if name != key):
            names = {key: name if name == key else f"{key}/{name}" for key, name in names.items()}
        settings["map"] = names
        self._core = _of_table([Column(names[key], "", values) for key, values in table.items()], settings)

    @classmethod
    def _of(cls, core: _core.Log) -> Log:
        log = cls.__new__(cls)
        log._core = core
        return log

    @classmethod
    def from_frame(cls, frame: Any, *, map: Mapping[str, str] | None = None, joint: Joint = "rotary",
                   unit: Mapping[str, str] | None = None, scale: Mapping[str, float] | None = None, rate: float = 0, gear: float = 1,
                   torque_constant: float = 0, wrap: float = 0, trim: float = 0, shortest_hold: float = 0, name: str = "frame",
                   **named: str) -> Log:
        """The log in a table: a data frame of pandas or Polars, a table of pyarrow, a data set of xarray, a structured array, a dict of
        arrays. time="t_ms", position="q [deg]" name its columns, as map={...} does; those that are not named have our names, with or
        without a unit, which counts as in the header of a file. Dates are taken in seconds from the first; an index of pandas may be
        the time. Other arguments are those of Log."""
        unknown = [key for key in named if key not in COLUMNS]
        if unknown:
            raise TypeError(f"from_frame() got an unexpected keyword argument '{unknown[0]}'")
        columns = columns_of(frame)
        if columns is None:
            raise _core.BadInput(f"frame: is {kind_of(frame)}; give a data frame, or a dict of columns")
        settings = _settings([name], map={**texts_by_name("map", map), **{key: text_of(one) for key, one in named.items()}}, joint=joint, unit=unit,
                             scale=scale, rate=rate, gear=gear, torque_constant=torque_constant, wrap=wrap, trim=trim,
                             shortest_hold=shortest_hold)
        return cls._of(_of_table(columns, settings))

    from_pandas = from_frame

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
        self._core.save(path_of(path))

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame of the columns that there are, in SI, with their names as here."""
        import pandas

        return pandas.DataFrame({name: values for name, values in self._columns().items()})

    def plot(self, style: str | dict[str, Any] = "screen") -> Any:
        """Draws position, velocity and torque over time, with the samples in colour that a fit takes, as a matplotlib Figure."""
        from warmjoint.figures import along_log, view
        from warmjoint.figures.style import use

        facts, arrays = _core.shown_of_log(self._core)
        with use(style_of(style)):
            return along_log.log(view.View(view.unpacked(facts["fit"], arrays)))

    def between(self, begin: float, end: float) -> Log:
        """The samples of the times begin to end, s, end left out."""
        time = self.time
        return self[int(time.searchsorted(number("begin", begin))):int(time.searchsorted(number("end", end)))]

    def __getitem__(self, samples: slice) -> Log:
        """Samples as a log of their own, prepared again; of one recording."""
        if not isinstance(samples, slice) or samples.step not in (None, 1):
            raise TypeError("a log is cut by log[first:last]; its columns are log.time, log.torque, ...")
        try:
            first, last, _ = samples.indices(len(self))
        except TypeError:
            raise TypeError("a log is cut by log[first:last] with whole numbers; log.between(begin, end) cuts by times") from None
        return Log._of(self._core.slice(first, max(first, last)))

    def __len__(self) -> int:
        return self._core.size

    def __reduce__(self) -> tuple[Any, ...]:
        return _log_of_state, (self._core.state(),)

    def __repr__(self) -> str:
        seconds = self.time[-1] - self.time[0] if len(self) else 0
        return f"<Log {self.source}: {len(self)} samples in {seconds:.4g} s, {self.joint} joint, torque in {self.torque_unit}>"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{name}</th><td>{values.min():.5g}</td><td>{values.max():.5g}</td><td>{self._unit(name)}</td></tr>"
                       for name, values in self._columns().items())
        notes = "".join(f"<li>{html.escape(note)}</li>" for note in self.notes)
        return (f"<p>{html.escape(self.source)}: {len(self)} samples, {self.joint} joint</p>"
                f"<table><tr><th>column</th><th>smallest</th><th>largest</th><th>unit</th></tr>{rows}</table>"
                + (f"<ul>{notes}</ul>" if notes else ""))

    def _columns(self) -> dict[str, Array]:
        found = {name: getattr(self._core, name) for name in COLUMNS}
        return {name: values for name, values in found.items() if values is not None}

    def _unit(self, name: str) -> str:
        length = "rad" if self.joint == "rotary" else "m"
        force = "N.m" if self.joint == "rotary" else "N"
        return {"time": "s", "position": length, "velocity": f"{length}/s", "torque": self.torque_unit, "motor_position": "rad",
                "load": force, "temperature": "degC"}[name]


def read(path: str | bytes | os.PathLike[Any] | Sequence[str | bytes | os.PathLike[Any]], *, map: Mapping[str, str] | None = None,
         joint: Joint = "rotary", unit: Mapping[str, str] | None = None, scale: Mapping[str, float] | None = None,
         columns: Sequence[str] | None = None, rate: float = 0, gear: float = 1, torque_constant: float = 0, wrap: float = 0,
         trim: float = 0, shortest_hold: float = 0, topic: str | None = None, joint_name: str | None = None) -> Log:
    """Reads a recording: a table of text, HDF5 or MATLAB; several of one joint, each from a cold start, as one.

    Bags (rosbag1, rosbag2, MCAP), Parquet, NumPy, JSON and Excel files are read by Python's packages: pip install 'warmjoint[convert]'. What is
    left out of them is a warning. Of a bag, topic and joint_name choose one joint of JointState messages, or map names fields of others.

    map={"position": "q_m"} names the columns of the file. columns=["time", "position", "torque"] stand in place of the header that
    a text file lacks; rate (Hz) makes the time that a file lacks. The other arguments are those of Log. Raises BadInput.
    """
    paths = [path] if isinstance(path, (str, bytes, os.PathLike)) else list_of(path, "path", "give the path of a file, or a list of them")
    files = [path_of(one) for one in paths]
    settings = _settings(files, map=map, joint=joint, unit=unit, scale=scale, columns=columns, rate=rate,
                         gear=gear, torque_constant=torque_constant, wrap=wrap, trim=trim, shortest_hold=shortest_hold)
    if not any(other_formats.is_other(one) for one in files):
        try:
            return Log._of(_core.read_log(settings))
        except _core.BadInput:
            if not any(other_formats.may_hold_objects(one) for one in files):
                raise
    asked = Asked(topic, joint_name, map=settings.get("map", {}))
    logs = [_read_one(one, settings, asked) for one in files]
    return Log._of(logs[0] if len(logs) == 1 else _core.join_logs(logs))


def _read_one(file: str, settings: dict[str, Any], asked: Asked) -> _core.Log:
    """A file that the program may leave to the readers of other formats."""
    table = table_of(file, file, asked) or Table(file)
    own = {**settings, "files": [file]}
    if table.columns is None and table.text is None:
        try:
            return _core.read_log(own)
        except _core.BadInput as refusal:
            table = with_objects(table, refusal, asked)
    if table.text is not None:
        return _core.read_text(table.text, own)
    # columns that were asked for have our names
    return _of_table(table.columns or [], {**own, "map": {key: name for key, name in asked.map.items() if not name}})


@dataclasses.dataclass(frozen=True)
class Check:
    """What a log holds, and what can be identified from it. `data` is what `warmjoint check --format json` prints."""

    data: dict[str, Any]
    text: str

    @property
    def faults(self) -> list[str]:
        """Where the log contradicts itself, one sentence each."""
        return [_core.in_python(one) for one in self.data["faults"]]

    @property
    def can_identify(self) -> dict[str, bool]:
        """{kind of friction: whether the motion shows it}."""
        return {one["what"]: one["sufficient"] for one in self.data["excitation"]}

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{one['what']}</th><td>{'yes' if one['sufficient'] else 'no'}</td>"
                       f"<td>{html.escape(_core.in_python(one['reason']))}</td></tr>"
                       for one in self.data["excitation"])
        return f"<table><tr><th>friction</th><th>can be identified</th><th>why</th></tr>{rows}</table>"


def check(log: Log | Any, **reading: Any) -> Check:
    """What the motion of a log can tell. Of a path or a data frame, reading are arguments of read."""
    return Check(*_core.check(log_of(log, **reading)._core))


def log_of(given: Any, argument: str = "log", **reading: Any) -> Log:
    """A log as it is; what a path, a data frame, or several of these of one joint give. reading: arguments of read or Log.from_frame."""
    one = _one_log(given, reading)
    if one is not None:
        return one
    logs = []
    for each in list_of(given, argument, "give a Log, a path, a data frame, or a list of these"):
        part = _one_log(each, reading)
        if part is None:
            raise _core.BadInput(f"{argument}: holds {kind_of(each)}; give Logs, paths or data frames")
        logs.append(part._core)
    if not logs:
        raise _core.BadInput(f"{argument}: is an empty list; give at least one")
    return Log._of(_core.join_logs(logs))


def _one_log(given: Any, reading: dict[str, Any]) -> Log | None:
    """The log that a log, a path or a frame gives; None of what is none of these."""
    if isinstance(given, Log):
        if reading:
            raise _core.BadInput(f"{next(iter(reading))}: says how a file or a frame is read, and the log is read already; give it to read "
                                 "or Log")
        return given
    if isinstance(given, (str, bytes, os.PathLike)):
        return read(given, **reading)
    return Log.from_frame(given, **reading) if columns_of(given) is not None else None


def _of_table(columns: list[Column], settings: dict[str, Any]) -> _core.Log:
    """Of the columns that are ours alone values are looked at."""
    names = [one.name for one in columns]
    units = [one.unit for one in columns]
    values = {}
    for name, index in _core.find_in_table(names, units, settings):
        values[index], unit = column(name, columns[index].values, name if names[index] == name else f"{name} ({names[index]})")
        if unit and name in settings.get("unit", {}):
            raise _core.BadInput(f"unit: {name} tells its unit itself, {unit}; leave it out")
        units[index] = unit or units[index]
    return _core.log_of_table(names, units, values, settings)


def _log_of_state(state: dict[str, Any]) -> Log:
    return Log._of(_core.log_of_state(state))


def _settings(files: list[str], **settings: Any) -> dict[str, Any]:
    """Of a recording source; what is left out is at its default."""
    for key in ("map", "unit", "scale"):
        value = settings.get(key)
        if value is not None and not isinstance(value, Mapping):
            raise _core.BadInput(f"{key}: is {kind_of(value)}; give a dict, as {key}={{'torque': ...}}")
    if isinstance(settings.get("columns"), str):
        raise _core.BadInput("columns: is a text; give the names of all columns as a list")
    return {"files": files, **{key: dict(value) if isinstance(value, Mapping) else value
                               for key, value in settings.items() if value is not None}}
