"""Identification, and what it answers."""

from __future__ import annotations

import copy
import html
import math
import os
import sys
import textwrap
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core
from warmjoint.answers import FrictionAtSpeed, Parameter, Prediction, Residuals, interval_text, value_text
from warmjoint.compensate import Compensator
from warmjoint.export import EngineFormat, Export, export_frictions
from warmjoint.friction import Friction, settled_energies
from warmjoint.log import READING, Log, log_of
from warmjoint.values import Array, flag, kind_of, number, numbers, path_of, shown, style_of

if TYPE_CHECKING:
    import pandas


class Void(UserWarning):
    """A number was asked for that the estimate does not have: it is nan."""


class Rejected(RuntimeError):
    """An estimate that must not be used: raise_if_rejected says why."""


class Estimate:
    """What an identifier answers. `data` is estimate.json as a dict.

    `status` is ok, not_converged, not_identifiable, inadequate_model or bad_data; but for ok there are no numbers to use, and `message`
    says why and what helps. estimate["coulomb"] is a Parameter; its value is nan, with a warning, unless the estimate is ok or was made or
    loaded with force=True. Estimates can be copied and pickled: one of a log that was read from files is small and reads them again, one of
    a log in memory brings the log along, which figures and residuals need (`without_log` leaves it out).
    """

    def __init__(self, data: dict[str, Any], log: Log | None = None, force: bool = False) -> None:
        self.data = data
        self.force = flag("force", force)
        self._log = log

    def __getstate__(self) -> dict[str, Any]:
        """Without a log that can be read again."""
        return {**self.__dict__, "_log": None if self._is_on_disk() else self._log}

    def __deepcopy__(self, memo: dict[int, Any]) -> Estimate:
        return Estimate(copy.deepcopy(self.data, memo), self._log, self.force)

    def without_log(self) -> Estimate:
        """The same with its numbers alone: what needs the log needs one again, from `load`."""
        return Estimate(self.data, None, self.force)

    def _is_on_disk(self) -> bool:
        """Whether the estimate names files of its log, and all are there."""
        files = (_core.recording(self.data) or {}).get("files") or []
        return bool(files) and all(map(os.path.exists, files))

    @property
    def log(self) -> Log | None:
        """The log that it was identified from; of a loaded estimate its recording, read again where its files are there, else None."""
        if self._log is None and self._is_on_disk():
            self._log = Log._of(_core.read_log(_core.recording(self.data) or {}))
        return self._log

    @property
    def status(self) -> str:
        return str(self.data["status"])

    @property
    def ok(self) -> bool:
        return self.status == "ok"

    @property
    def message(self) -> str:
        """Why, and what helps, with arguments of Python's functions; `data` has the program's own words."""
        return _core.in_python(str(self.data["message"]))

    @property
    def warnings(self) -> list[str]:
        """What must be known before the numbers are used, a clause each."""
        return [_core.in_python(one) for one in self.data.get("warnings", [])]

    @property
    def remedies(self) -> list[dict[str, Any]]:
        """What the message recommends to try, as arguments: wj.identify(log, **estimate.remedies[0]); those that say how a file is read,
        as scale, are for read, or for identify with a path."""
        calls = [{name: value for name, value in call.items() if name not in ("relevance", "force")}
                 for call in _core.calls_in(str(self.data["message"]))]
        return [call for i, call in enumerate(calls) if call and call not in calls[:i]]

    @property
    def identifier(self) -> str:
        return str(self.data["identifier"])

    @property
    def parameters(self) -> dict[str, Parameter]:
        """Each estimated parameter by its name."""
        self._warn_of_void()
        return self._rows()

    def __getitem__(self, name: str) -> Parameter:
        found = self._rows()
        if not isinstance(name, str) or name not in found:
            raise KeyError(f"{shown(name)} was not estimated; there are {', '.join(found) or 'no parameters: ' + self.message}")
        self._warn_of_void()
        return found[name]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self.data["parameters"]

    def __iter__(self) -> Iterator[str]:
        """The names of the parameters."""
        return iter(self.data["parameters"])

    @property
    def covariance(self) -> tuple[list[str], Array] | None:
        """Names [p] and covariance [p, p] of the parameters that have intervals, by noise alone; None where there is none."""
        known = self.data.get("covariance")
        return (list(known["parameters"]), np.array(known["matrix"], dtype=np.float64)) if known else None

    @property
    def residuals(self) -> Residuals:
        """Torque less fit. Raises Rejected where there is no friction, BadInput without the log."""
        found = _core.residuals(self.data, self._need_log("residuals")._core)
        if found is None:
            raise Rejected(self.message)
        return Residuals(*found)

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame of the parameters: value, std, lower, upper (95 % interval), unit."""
        import pandas

        rows = {one.name: {"value": one.value, "std": math.nan if one.std is None else one.std, "lower": (one.ci95 or (math.nan,))[0],
                           "upper": (one.ci95 or (math.nan,))[-1], "unit": one.unit} for one in self._rows().values()}
        return pandas.DataFrame.from_dict(rows, orient="index", columns=["value", "std", "lower", "upper", "unit"])

    @property
    def friction_at_speeds(self) -> list[FrictionAtSpeed]:
        """What the joint brakes with at a low, the median and a high speed of the log, forwards and backwards, cold and, where a
        law warms, at the log's warmest moment. These are known where the parameters trade off; empty where no number is."""
        return [FrictionAtSpeed(row["speed"], row["value"], row["std"], tuple(row["interval95"]), row.get("unit", ""),
                                row.get("speed_unit", ""), row.get("energy"))
                for row in self.data.get("friction_at_speeds") or []]

    @property
    def metrics(self) -> dict[str, float]:
        """Agreement with all the data: rmse and mae in N.m or N, fit in %, fpe."""
        return dict(self.data["metrics"] or {})

    @property
    def holdout(self) -> dict[str, float]:
        """The same of a second fit on samples that it has not seen; empty where there is none."""
        return dict(self.data["holdout"] or {})

    @property
    def fitted(self) -> Friction:
        """The friction as a value. Raises Rejected where there is none."""
        if not self.data.get("friction"):
            raise Rejected(self.message)
        return Friction.from_dict(self.data["friction"])

    def raise_if_rejected(self) -> Estimate:
        """This estimate, if its status is ok; raises Rejected with its message otherwise."""
        if not self.ok:
            raise Rejected(f"{self.status}: {self.message}")
        return self

    def friction(self, speed: npt.ArrayLike, position: npt.ArrayLike = 0.0, heat: npt.ArrayLike = 0.0,
                 band: bool = False) -> Any:
        """Friction of steady sliding, N.m or N, at speed (rad/s or m/s), position (rad or m) and heat E (N.m or N; 0: cold), each of
        any shape that NumPy broadcasts. band: (value, lower, upper), the 95 % band of the law's parameters to first order."""
        fitted = self.fitted
        value = fitted(speed, position, heat)
        if not flag("band", band):
            return value
        half = 1.96 * self._deviation(fitted, speed, position, heat)
        return value, value - half, value + half

    def loss(self, heat: npt.ArrayLike | None = None) -> Any:
        """The constant loss in W that would hold a heat E, N.m or N: E / k with the thermal gain k, since E = k W. heat: that at the end
        of the log where it is left out."""
        energy = self.state_end if heat is None else numbers("heat", heat)
        return energy / self["thermal_gain"].value

    def temperature_rise(self, watts_per_kelvin: float, heat: npt.ArrayLike | None = None) -> Any:
        """How much warmer the joint is than its surroundings, K, at a heat E (N.m or N; that at the end of the log where it is left out):
        its loss over the joint's thermal conductance."""
        conductance = number("watts_per_kelvin", watts_per_kelvin)
        if not conductance > 0:
            raise _core.BadInput(f"watts_per_kelvin: is {conductance:g}; it must be above 0 W/K")
        return self.loss(heat) / conductance

    @property
    def state_end(self) -> float:
        """E at the end of the log, N.m or N; 0 where nothing warms."""
        rows = self.data.get("state_end") or {}
        return float(sum(row["value"] for name, row in rows.items() if name.endswith("energy")))

    def predict(self, log: Log, initial: Literal["cold", "end"] | float = "cold") -> Prediction:
        """The torque along another log of the joint. initial: heat at its first sample: cold, the end of this estimate's own log, or
        the heat that sliding at a speed (rad/s or m/s) settles at. Raises BadInput where nothing can be compared."""
        found = _core.predict(self.data, log_of(log)._core, self._energies(initial))
        return Prediction(found["time"], found["torque"], found["energy"], found["compared"] > 0, found["metrics"])

    def figures(self) -> dict[str, dict[str, dict[str, Array]]]:
        """What each figure of this estimate shows, {name: {series: {x, y, ...}}}: arrays of what plot() draws. Figures of the log need the log
        that it was identified from."""
        from warmjoint.figures import style

        with style.use("screen"):
            return {name: sheet.series() for name, (make, _) in self._source().figures().items() if (sheet := make()) is not None}

    def _source(self) -> Any:
        from warmjoint.figures import families, view

        facts, arrays = _core.shown_of_estimate(self.data, self.log._core if self.log else None)
        return families.Source({**view.unpacked(facts, arrays), "kind": "estimate"})

    def plot(self, figure: str = "", ax: Any = None, style: str | dict[str, Any] = "screen") -> Any:
        """Draws one of figures() and returns the matplotlib Figure: "fit" where none is named, data, fit and verdict on one page.
        ax: axes that a figure of one panel is drawn into, "friction_curve" where none is named. style: screen, paper, or changes of
        them as {"base": "paper", "rc": {"font.family": "serif"}}."""
        from warmjoint.figures import families
        from warmjoint.figures.style import use

        if not isinstance(figure, str):
            raise _core.BadInput(f"figure: is {kind_of(figure)}; give the name of one of figures()")
        source, name = self._source(), figure or ("fit" if ax is None else "friction_curve")
        family = source.figures()
        with use(style_of(style)):
            if ax is not None and not hasattr(ax, "get_xlabel"):
                raise _core.BadInput(f"ax: is a value of the type {type(ax).__name__}; give axes of matplotlib")
            if ax is not None and name in families.PANELS and source.view is not None:
                families.PANELS[name](ax, source.view)
                return ax.figure
            sheet = family[name][0]() if name in family else None
        if sheet is None:
            if name in family and self.log is None:
                self._need_log(f"figure: '{name}'")
            raise _core.BadInput(f"figure: this estimate gives no {shown(name)}; it gives {', '.join(self.figures())}")
        if ax is not None:
            raise _core.BadInput(f"'{name}' has {len(sheet.axes)} panels, and axes take one: {' or '.join(families.PANELS)}; leave ax out")
        return sheet

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes one self-contained web page: verdict, what to do next, parameters, the log, pictures, tests and assumptions."""
        from warmjoint.figures import pages, view

        log = self._need_log("report")
        facts, arrays = _core.shown_on_page(self.data, log._core)
        _core.write_text(path_of(path), pages.fill("log", view.unpacked(facts, arrays)))

    def compensator(self, **how: Any) -> Compensator:
        """What compensates this friction on a robot, from a cold joint on; its doubts are those of the estimate. how: share, dead_band,
        correct and the other arguments of Compensator. Raises Rejected where there is no friction."""
        if not self.data.get("friction"):
            raise Rejected(self.message)
        return Compensator(self, **how)

    def export(self, to: EngineFormat, *, warm: float = 0.0, speed: float | None = None, joint: str = "") -> Export:
        """The friction as the numbers that another engine takes: what `warmjoint export` does. to: mjcf, urdf, physx, isaaclab or mjlab,
        or the whole friction as code of a controller (c, cpp or python), as its parameters (ros2) or as an FMU, which take neither warm nor speed.
        warm: 0 cold, 1 as warm as sliding at `speed` makes it (rad/s or m/s; the log's median where not given). joint: its name in what
        the engine reads, which physx, isaaclab, mjlab and ros2 need. The text has as many digits as the interval supports, `joints` has all.
        Raises BadInput for an estimate without friction, or with one in amperes."""
        return export_frictions(self.data, to, warm=warm, speed=speed, joint=joint)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes estimate.json, which `warmjoint attach`, scenarios and the plugin read."""
        _core.write_estimate(self.data, path_of(path))

    def to_json(self) -> str:
        """The text of estimate.json."""
        return _core.estimate_to_json(self.data)

    def __repr__(self) -> str:
        return "\n".join([f"<Estimate by {self.identifier}: {self.status}>", *(f"  {one!r}" for one in self.friction_at_speeds),
                          *(f"  {one!r}" for one in self._shown()),
                          textwrap.fill(self.message, 100, initial_indent="  ", subsequent_indent="  ", break_long_words=False)])

    def _repr_html_(self) -> str:
        at_speeds = [Parameter(repr(one).split(" = ")[0], one.value, one.unit, one.std, one.ci95) for one in self.friction_at_speeds]
        rows = "".join(f"<tr><th>{one.name}</th><td>{value_text(one, 5)}</td><td>{interval_text(one)}</td><td>{one.unit}</td></tr>"
                       for one in [*at_speeds, *self._shown()])
        return (f"<p><b>{self.status}</b> ({html.escape(self.identifier)}): {html.escape(self.message)}</p>"
                f"<table><tr><th>parameter</th><th>value</th><th>95 % interval</th><th>unit</th></tr>{rows}</table>")

    def _rows(self) -> dict[str, Parameter]:
        void = self._is_void()
        return {name: Parameter(name, math.nan if void else _number(row["value"]), row["unit"], None if void else row.get("std"),
                                tuple(row["interval95"]) if row.get("interval95") and not void else None)
                for name, row in self.data["parameters"].items()}

    def _is_void(self) -> bool:
        return not self.ok and not self.force

    def _warn_of_void(self) -> None:
        if self._is_void() and self.data["parameters"]:
            warnings.warn(f"{self.status}: {self.message}; values are nan, force=True gives the numbers", Void, stacklevel=3)

    def _need_log(self, what: str) -> Log:
        if self.log is not None:
            return self.log
        files = (_core.recording(self.data) or {}).get("files")
        why = f"its recording {', '.join(files)} is not there" if files else "it was not made of a file"
        raise _core.BadInput(f"{what} needs the log, and {why}; give it: load(path, log=wj.read(...))")

    def _shown(self) -> list[Parameter]:
        """The parameters without the discrete pair, which repeats gain and time constant, and a delay below two half widths of its interval."""
        def is_hidden(one: Parameter) -> bool:
            if one.name == "torque_delay" and one.ci95:
                return abs(one.value) <= one.ci95[1] - one.ci95[0]
            return one.name in ("thermal_gain_discrete", "thermal_pole")

        return [one for one in self._rows().values() if not is_hidden(one)]

    def _energies(self, initial: str | float) -> list[float]:
        if isinstance(initial, str):
            if initial == "cold":
                return []
            if initial == "end":
                rows = self.data.get("state_end") or {}
                return [float(rows[name]["value"]) for name in ("energy", "second_energy") if name in rows]
            raise _core.BadInput(f"initial: is {shown(initial)}; it must be cold, end or a speed")
        return settled_energies(self.fitted.data, number("initial", initial))

    def _deviation(self, fitted: Friction, *place: npt.ArrayLike) -> Array:
        """Standard deviation of the friction at places: sqrt(d^T C d), d its derivatives by the parameters, C their correlations
        with deviations as wide as the intervals that the estimate gives them."""
        known = self.data.get("covariance")
        if not known:
            raise Rejected("the estimate has no covariance, so its friction has no band")
        # intervals reach as far as the covariance and what was found beside the noise
        intervals = {name: self.parameters[name].ci95 for name in known["parameters"] if name in self.parameters}
        half = {name: (ends[1] - ends[0]) / 2 for name, ends in intervals.items() if ends}
        names = list(half)
        rows = [known["parameters"].index(name) for name in names]
        covariance = np.asarray(known["matrix"], dtype=np.float64)[np.ix_(rows, rows)]
        by_noise = np.sqrt(np.diag(covariance))
        std = np.array(list(half.values())) / 1.96
        covariance = covariance * np.outer(std / by_noise, std / by_noise)
        derivatives = []
        for name, deviation in zip(names, std, strict=True):
            try:
                step = 0.01 * deviation
                derivatives.append((fitted.changed(name, step)(*place) - fitted.changed(name, -step)(*place)) / (2 * step))
            except _core.BadInput:  # of gravity, inertia or lag, which are no friction
                derivatives.append(np.zeros(np.broadcast_shapes(*(np.shape(one) for one in place))))
        d = np.stack(derivatives)
        spread: Array = np.sqrt(np.maximum(np.einsum("i...,ij,j...->...", d, covariance, d), 0))
        return spread


def identify(log: Log | str | os.PathLike[str] | Sequence[Any] | Any, method: str = "auto", *,
             gravity: Literal["none", "sincos", "paired"] = "none", motion: Literal["chosen", "constant", "any"] = "chosen",
             start: Literal["cold", "unknown", "estimated"] = "cold", relevance: float = 0.1, holdout: float | Log | Any = 0.3,
             force: bool = False, progress: bool | Callable[[str], object] | None = None, **options: Any) -> Estimate:
    """Friction from a log, or from several of one joint, each from a cold start: what `warmjoint identify` does.

    log: a Log, the path of a file, a data frame, or a list of these; of a path or a frame options may hold arguments of read, as
    unit={"position": "deg"}. method: one of identifiers(); options: its own, as law="asymmetric". gravity, motion, start, relevance and
    force are the options of the program. holdout: a share of the log's end, or another log, for figures on unseen data; 0: none.
    progress: True prints to stderr what a fit tries, a function is called with it some times a second; where it is left out, fits that
    last are told of on a terminal. Mathematics that fails gives a status and a message; BadInput is raised for names and values that
    cannot be used. Other threads run meanwhile, and Ctrl-C ends it.
    """
    one = log_of(log, **{name: options.pop(name) for name in READING if name in options})
    settings = {"identifier": method, "gravity": gravity, "motion": motion, "start": start, "relevance": relevance,
                "void_numbers": "show" if flag("force", force) else "withhold",
                "options": {name: _word(name, value) for name, value in options.items()}}
    if isinstance(holdout, (int, float, np.number)) and not isinstance(holdout, bool):
        share, other = number("holdout", holdout), None
    else:
        share, other = 0.0, log_of(holdout, "holdout")._core
    with _Progress(progress) as told:
        return Estimate(_core.identify(one._core, settings, share, other, told), one, force)


class _Progress:
    """Tells what a fit tries: to a function, or on one line of stderr, which it clears in the end."""

    def __init__(self, wanted: bool | Callable[[str], object] | None) -> None:
        if wanted is not None and not isinstance(wanted, bool) and not callable(wanted):
            raise _core.BadInput(f"progress: is {kind_of(wanted)}; give True, False or a function of a text")
        self._function = wanted if callable(wanted) else None
        self._is_on = bool(wanted) or (wanted is None and sys.stderr is not None and sys.stderr.isatty())
        self._begin, self._shown, self._width = time.monotonic(), "", 0

    def __enter__(self) -> Callable[[str], None] | None:
        return self._tell if self._is_on else None

    def __exit__(self, *_: object) -> None:
        if self._width:
            print("\r" + " " * self._width, end="\r", file=sys.stderr, flush=True)

    def _tell(self, words: str) -> None:
        seconds = time.monotonic() - self._begin
        if self._function:
            if words != self._shown:
                self._function(words)
            self._shown = words
            return
        # fits that last alone, and not more often than can be read
        line = f"warmjoint: {seconds:.0f} s{', ' + words if words else ''}"[:79]
        if seconds > 2 and line != self._shown:
            print("\r" + line.ljust(self._width), end="", file=sys.stderr, flush=True)
            self._shown, self._width = line, max(self._width, len(line))


def identifiers() -> dict[str, Any]:
    """{name: {"summary", "options": {name: {"value", "allowed", "meaning"}}}}"""
    return {one["name"]: {"summary": one["summary"],
                          "options": {option["name"]: {"value": option["default"], "allowed": option["allowed"],
                                                       "meaning": option["meaning"]} for option in one["options"]}}
            for one in _core.identifiers()}


def load(path: str | os.PathLike[str], log: Log | Any = None, force: bool = False) -> Estimate:
    """Reads estimate.json, or library:MACHINE/JOINT. log: the recording that it was identified from, for its figures; without it the files that the estimate
    names are read where they are there. force: as of identify. Raises BadInput."""
    try:
        data = _core.read_estimate(path_of(path))
    except _core.BadInput:
        if _is_of_robot(path_of(path)):
            raise _core.BadInput(f"{path_of(path)}: holds a robot's joints, and no estimate of one; read it by load_robot(path)[joint]") from None
        raise
    return Estimate(data, None if log is None else log_of(log), force)


def _is_of_robot(path: str) -> bool:
    """Whether a file is a robot.json."""
    try:
        tree = _core.read_json(path)
    except _core.BadInput:
        return False
    return isinstance(tree, dict) and isinstance(tree.get("joints"), dict)


def _word(name: str, value: Any) -> str:
    """An option as the command line has it."""
    parts = value if isinstance(value, (tuple, list)) else [value]
    words = []
    for part in parts:
        if not isinstance(part, (str, bool, int, float, np.number, np.bool_)):
            raise _core.BadInput(f"{name}: is {kind_of(part)}; give a number or a text")
        try:
            words.append(str(part).lower() if isinstance(part, (bool, np.bool_)) else str(part))
        except ValueError:  # of whole numbers with thousands of digits
            raise _core.BadInput(f"{name}: is a whole number beyond 64 bits; give a smaller one") from None
    return ":".join(words)


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)
