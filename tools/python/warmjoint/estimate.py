"""Identification, and what it answers."""

from __future__ import annotations

import dataclasses
import html
import math
import os
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core
from warmjoint.friction import Friction, settled_energies
from warmjoint.log import Array, Log


class Rejected(RuntimeError):
    """An estimate that must not be used: raise_if_rejected says why."""


@dataclasses.dataclass(frozen=True)
class Parameter:
    """An estimated parameter in SI. std and ci95 (95 % confidence interval) are None where they do not exist."""

    name: str
    value: float
    unit: str
    std: float | None
    ci95: tuple[float, float] | None

    def __repr__(self) -> str:
        interval = f" ({self.ci95[0]:.5g} .. {self.ci95[1]:.5g})" if self.ci95 else ""
        return f"{self.name} = {self.value:.5g}{interval} {self.unit}"


@dataclasses.dataclass(frozen=True)
class Prediction:
    """An estimate along a log of N samples."""

    time: Array  # [N] s
    torque: Array  # [N] predicted, N.m or N
    heat: Array  # [N] E, N.m or N
    compared: npt.NDArray[np.bool_]  # [N] samples that the metrics run over
    metrics: dict[str, float]  # rmse and mae in N.m or N, fit in %


class Estimate:
    """What an identifier answers. `data` is estimate.json as a dict.

    `status` is ok, not_converged, not_identifiable, inadequate_model or bad_data; but for ok there are no numbers to use, and
    `message` says why and what helps. estimate["coulomb"] is a Parameter.
    """

    def __init__(self, data: dict[str, Any], log: Log | None = None) -> None:
        self.data = data
        self.log = log

    @property
    def status(self) -> str:
        return str(self.data["status"])

    @property
    def ok(self) -> bool:
        return self.status == "ok"

    @property
    def message(self) -> str:
        return str(self.data["message"])

    @property
    def identifier(self) -> str:
        return str(self.data["identifier"])

    @property
    def parameters(self) -> dict[str, Parameter]:
        """Each estimated parameter by its name."""
        return {name: Parameter(name, _number(row["value"]), row["unit"], row.get("std"),
                                tuple(row["interval95"]) if row.get("interval95") else None)
                for name, row in self.data["parameters"].items()}

    def __getitem__(self, name: str) -> Parameter:
        found = self.parameters
        if name not in found:
            raise KeyError(f"'{name}' was not estimated; there are {', '.join(found) or 'no parameters: ' + self.message}")
        return found[name]

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
        if not band:
            return value
        half = 1.96 * self._deviation(fitted, speed, position, heat)
        return value, value - half, value + half

    def temperature_rise(self, heat: npt.ArrayLike | None = None, watts_per_kelvin: float | None = None) -> Any:
        """How warm the friction has become, at `heat` (E, N.m or N; that at the end of the log where it is left out).

        E = k W, with k the thermal gain: E / k is the constant loss in W that would hold this heat. Over the joint's
        thermal conductance, watts_per_kelvin, that is the rise in K; without it the loss itself is given."""
        energy = self.state_end if heat is None else np.asarray(heat, dtype=np.float64)
        loss = energy / self["thermal_gain"].value
        return loss if watts_per_kelvin is None else loss / watts_per_kelvin

    @property
    def state_end(self) -> float:
        """E at the end of the log, N.m or N; 0 where nothing warms."""
        rows = self.data.get("state_end") or {}
        return float(sum(row["value"] for name, row in rows.items() if name.endswith("energy")))

    def predict(self, log: Log, initial: Literal["cold", "end"] | float = "cold") -> Prediction:
        """The torque along another log of the joint. initial: heat at its first sample: cold, the end of this estimate's own log, or
        the heat that sliding at a speed (rad/s or m/s) settles at. Raises BadInput where nothing can be compared."""
        found = _core.predict(self.data, log._core, self._energies(initial))
        return Prediction(found["time"], found["torque"], found["energy"], found["compared"] > 0, found["metrics"])

    def figures(self) -> dict[str, dict[str, Any]]:
        """Every figure of this estimate as data, {name: figure}: panels, series and axes, which plot() draws. Figures of the log need
        the log that it was identified from."""
        return _core.figures(self.data, self.log._core if self.log else None)

    def plot(self, figure: str = "", ax: Any = None, style: str | dict[str, Any] = "screen") -> Any:
        """Draws one of figures() and returns the matplotlib Figure: "fit" where none is named, data, fit and verdict on one page.
        ax: axes that a figure of one plot is drawn into, "friction_curve" where none is named. style: screen, paper, or changes of
        them as {"base": "paper", "rc": {"font.family": "serif"}}."""
        from warmjoint import draw

        found = self.figures()
        name = figure or ("fit" if ax is None else "friction_curve")
        if name not in found:
            raise _core.BadInput(f"figure: this estimate gives no '{name}'; it gives {', '.join(found)}")
        return draw.draw(found[name], style=style, ax=ax)

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes one self-contained web page: verdict, what to do next, parameters, the log, pictures, tests and assumptions."""
        from warmjoint import draw, page

        if self.log is None:
            raise _core.BadInput("report: the estimate comes from a file; identify its log again, or use `warmjoint report`")
        with open(path, "w", encoding="utf-8") as file:
            file.write(page.fill("log", _core.log_page(self.data, self.log._core), draw))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes estimate.json, which `warmjoint attach`, scenarios and the plugin read."""
        _core.write_estimate(self.data, os.fspath(path))

    def to_json(self) -> str:
        """The text of estimate.json."""
        return _core.estimate_to_json(self.data)

    def __repr__(self) -> str:
        return "\n".join([f"<Estimate by {self.identifier}: {self.status}>", *(f"  {one!r}" for one in self.parameters.values()),
                          f"  {self.message}"])

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{one.name}</th><td>{one.value:.5g}</td><td>{_interval(one)}</td><td>{one.unit}</td></tr>"
                       for one in self.parameters.values())
        return (f"<p><b>{self.status}</b> ({html.escape(self.identifier)}): {html.escape(self.message)}</p>"
                f"<table><tr><th>parameter</th><th>value</th><th>95 % interval</th><th>unit</th></tr>{rows}</table>")

    def _energies(self, initial: str | float) -> list[float]:
        if initial == "cold":
            return []
        if initial == "end":
            rows = self.data.get("state_end") or {}
            return [float(rows[name]["value"]) for name in ("energy", "second_energy") if name in rows]
        if isinstance(initial, str):
            raise _core.BadInput(f"initial: is '{initial}'; it must be cold, end or a speed")
        return settled_energies(self.data["friction"], float(initial))

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


def identify(log: Log | Sequence[Log], method: str = "auto", *, gravity: Literal["none", "sincos", "paired"] = "none",
             motion: Literal["chosen", "constant", "any"] = "chosen", start: Literal["cold", "unknown", "estimated"] = "cold",
             relevance: float = 0.1, holdout: float | Log = 0.3, force: bool = False, **options: Any) -> Estimate:
    """Friction from a log, or from several of one joint, each from a cold start: what `warmjoint identify` does.

    method: one of identifiers(); options: its own, as law="asymmetric". gravity, motion, start, relevance and force are the options of
    the program. holdout: a share of the log's end, or another log, for figures on unseen data; 0: none. Mathematics that
    fails gives a status and a message; BadInput is raised for names and values that cannot be used. Other threads run meanwhile,
    and Ctrl-C ends it.
    """
    one = log if isinstance(log, Log) else Log._of(_core.join_logs([each._core for each in log]))
    settings = {"identifier": method, "gravity": gravity, "motion": motion, "start": start, "relevance": relevance,
                "void_numbers": "show" if force else "withhold",
                "options": {name: _word(value) for name, value in options.items()}}
    share, other = (0.0, holdout._core) if isinstance(holdout, Log) else (float(holdout), None)
    return Estimate(_core.identify(one._core, settings, share, other), one)


def identifiers() -> dict[str, Any]:
    """{name: {"summary", "options": {name: {"value", "allowed", "meaning"}}}}"""
    return {one["name"]: {"summary": one["summary"],
                          "options": {option["name"]: {"value": option["default"], "allowed": option["allowed"],
                                                       "meaning": option["meaning"]} for option in one["options"]}}
            for one in _core.identifiers()}


def load(path: str | os.PathLike[str]) -> Estimate:
    """Reads estimate.json. Raises BadInput."""
    return Estimate(_core.read_estimate(os.fspath(path)))


def _word(value: Any) -> str:
    """An option as the command line has it."""
    if isinstance(value, (tuple, list)):
        return ":".join(map(_word, value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)


def _interval(one: Parameter) -> str:
    return f"{one.ci95[0]:.5g} .. {one.ci95[1]:.5g}" if one.ci95 else ""
