"""A log with its estimate, as C++ hands it over (tools/shown/estimate_data.h): facts and columns of numbers."""

from __future__ import annotations

import os
import re
from typing import Any

import numpy as np

from .numerals import Symbols, unit_text

VERDICTS = {"ok": "the numbers can be used", "not_converged": "the search did not settle: do not use the numbers",
            "not_identifiable": "this motion cannot tell the parameters apart: there are no numbers to use",
            "inadequate_model": "the model does not describe these data: do not use the numbers", "bad_data": "these data cannot be used"}


# controls, marks of writing direction, and what XML 1.0 has no place for; tabs and line ends are of texts
_ACTIVE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufeff\ufffe\uffff]")


def printable(text: str) -> str:
    """The text with characters that act, in a terminal or a file of XML, as their codes."""
    return _ACTIVE.sub(lambda found: f"\\x{ord(found[0]):02X}" if ord(found[0]) < 0x80 else f"\\u{ord(found[0]):04X}", text)


def unpacked(facts: Any, arrays: list[Any]) -> Any:
    """The facts with arrays in the places of their marks, and texts that are printable."""
    if isinstance(facts, str):
        return printable(facts)
    if isinstance(facts, dict):
        if facts.keys() == {"array", "shape"}:
            return np.asarray(arrays[facts["array"]], float).reshape(facts["shape"])
        return {printable(key): unpacked(value, arrays) for key, value in facts.items()}
    return [unpacked(one, arrays) for one in facts] if isinstance(facts, list) else facts


class Answer:
    """What is known of an estimate, with or without its recording."""

    def __init__(self, facts: dict[str, Any]) -> None:
        self.facts = facts
        self.identifier, self.method, self.status = facts["identifier"], facts["method"], facts["status"]
        self.passed = self.status == "ok"
        self.symbols = Symbols(facts["symbols"])
        self.parameters = {row["name"]: row for row in facts["parameters"]}


class View(Answer):
    """Columns are [N] of the recording; kept ones [n]. Times in s from the first sample, torques in torque_unit, less gravity and inertia."""

    def __init__(self, facts: dict[str, Any]) -> None:
        super().__init__(facts)
        columns = facts["columns"]
        self.time, self.position, self.velocity = columns["time"], columns["position"], columns["velocity"]
        self.torque, self.rigid = columns["torque"], columns["rigid"]
        self.keep = columns["keep"] > 0
        self.motor_angle, self.fitted = columns.get("motor_angle"), columns.get("fitted")
        self.energy, self.energy_std = columns.get("energy"), columns.get("energy_std")
        self.segments = [(int(begin), int(end), speed) for begin, end, speed in facts["segments"]]
        self.has_fit, self.warms, self.has_maps = facts["has_fit"], facts["warms"], facts["has_maps"]
        self.any_motion = facts["any_motion"]
        self.void = self.has_fit and not self.passed
        self.torque_unit, self.speed_unit = unit_text(facts["torque_unit"]), unit_text(facts["velocity_unit"])
        length = self.time[-1] if self.time.size else 0
        self.time_unit, self.seconds = ("h", 3600.0) if length > 3 * 3600 else ("min", 60.0) if length > 300 else ("s", 1.0)
        self.clock = self.time / self.seconds
        path = facts["source"]
        self.source = path if ", " in path else os.path.join(os.path.basename(os.path.dirname(path)), os.path.basename(path))

    def kept(self, column: np.ndarray) -> np.ndarray:
        """[n]"""
        return column[self.keep]

    def or_gap(self, column: np.ndarray) -> np.ndarray:
        """NaN where a sample is not kept, so that lines break there. [N]"""
        return np.where(self.keep, column, np.nan)

    def residuals(self) -> np.ndarray:
        """Torque less fit at the kept samples. [n]"""
        return self.kept(self.torque - self.fitted)

    @property
    def count(self) -> int:
        return int(self.keep.sum())

    @property
    def warmest(self) -> int:
        """The sample at which the energy is of largest size."""
        return int(np.argmax(np.abs(self.energy)))

    @property
    def fit_name(self) -> str:
        return "fit (void)" if self.void else "fit"

    @property
    def dash(self) -> str:
        return "dashed" if self.void else "solid"

    @property
    def origin(self) -> str:
        return f"{self.source}, identified by {self.identifier}" if self.identifier else f"{self.source}, the truth"

    @property
    def taken_off(self) -> str:
        """Of the torque that is shown."""
        return " and ".join(["gravity"] * self.facts["has_gravity"] + ["inertia"] * self.any_motion)

    @property
    def time_name(self) -> str:
        return f"time ({self.time_unit})"

    @property
    def position_name(self) -> str:
        return f"position ({unit_text(self.facts['position_unit'])})"

    @property
    def speed_name(self) -> str:
        return f"velocity ({self.speed_unit})"

    def torque_name(self, what: str) -> str:
        return f"{what} ({self.torque_unit})"

    def of_segment(self, begin: int, end: int, column: np.ndarray) -> np.ndarray:
        """Its kept samples."""
        return column[begin:end][self.keep[begin:end]]


def quantiles(values: np.ndarray, shares: tuple[float, ...]) -> np.ndarray:
    """Over the first axis, linear between neighbours; NaN are left out, and stay where nothing is left. [shares, ...]"""
    ordered = np.sort(values, axis=0)  # NaN last
    count = np.isfinite(ordered).sum(axis=0)
    found = []
    for share in shares:
        place = share * np.maximum(count - 1, 0)
        low = np.floor(place).astype(int)
        high = np.minimum(low + 1, np.maximum(count - 1, 0))
        below, above = (np.take_along_axis(ordered, np.expand_dims(at, 0), axis=0)[0] for at in (low, high))
        found.append(below + (place - low) * (above - below))
    return np.array(found)


def quartiles(values: np.ndarray) -> np.ndarray:
    """25 %, 50 % and 75 % quantile over the first axis; NaN are left out. [3, ...]"""
    return quantiles(values, (0.25, 0.5, 0.75))


def binned_median(x: np.ndarray, y: np.ndarray, bins: int, fewest: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """Medians of y in bins of equal width over x at their middles, NaN of fewer samples."""
    low, high = (x.min(), x.max()) if x.size else (0.0, 1.0)
    width = (high - low) or 1.0
    place = np.minimum((x - low) / width * bins, bins - 1).astype(int)
    order = np.argsort(place, kind="stable")
    groups = np.split(y[order], np.searchsorted(place[order], np.arange(1, bins)))
    middles = low + (high - low) * (np.arange(bins) + 0.5) / bins
    return middles, np.array([np.median(group) if group.size >= fewest else np.nan for group in groups])
