"""The friction of one joint as a value."""

from __future__ import annotations

import copy
import os
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core
from warmjoint.log import Array

# heat and what joins a law, which a friction file keeps apart from the law's own parameters
THERMAL = ("thermal_gain", "thermal_time_constant", "ambient", "second")
OPTIONS = ("gear", "level_per_temperature", "viscous_per_energy", "load_gain", "torque_unit", "maps")


class Friction:
    """A friction law with its parameters, its warming and its maps; what a friction file holds.

        Friction(law="viscous_coulomb", viscous=5, coulomb=15, thermal_gain=-3, thermal_time_constant=600)

    Parameters are named as in files (`laws()` lists them), in SI. `data` is the friction file as a dict.
    Raises BadInput for names and values that the law does not have.
    """

    data: dict[str, Any]

    def __init__(self, law: str = "viscous_coulomb", **values: Any) -> None:
        data: dict[str, Any] = {"law": law}
        thermal = {name: values.pop(name) for name in THERMAL if name in values}
        data.update({name: values.pop(name) for name in OPTIONS if name in values})
        if thermal:
            data["thermal"] = thermal
        self.data = _core.complete_friction({**data, "parameters": values})

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Friction:
        """Of what a friction file holds."""
        friction = cls.__new__(cls)
        friction.data = _core.complete_friction(data)
        return friction

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Friction:
        """Reads a friction file, or the friction of an estimate file."""
        return cls.from_dict(_core.read_friction(os.fspath(path)))

    @property
    def law(self) -> str:
        return str(self.data["law"])

    @property
    def parameters(self) -> dict[str, float]:
        """The law's parameters, SI."""
        return dict(self.data["parameters"])

    def __call__(self, speed: npt.ArrayLike, position: npt.ArrayLike = 0.0, heat: npt.ArrayLike = 0.0,
                 load: npt.ArrayLike = 0.0) -> Array:
        """Friction of steady sliding, N.m or N, at speed (rad/s or m/s, signed), position (rad or m), heat E (N.m or N; 0: cold)
        and transmitted load (N.m or N). Arguments of any shapes that NumPy broadcasts; so is the result. 0 at speed 0."""
        given = np.broadcast_arrays(*(np.asarray(one, dtype=np.float64) for one in (speed, position, heat, load)))
        names = ("speed", "position", "energy", "load")
        places = {name: np.ascontiguousarray(one.ravel()) for name, one in zip(names, given, strict=True)}
        return np.asarray(_core.force(self.data, places)).reshape(given[0].shape)

    def settled_heat(self, speed: float) -> float | None:
        """E of a joint that has slid at `speed` (rad/s or m/s) for long, N.m or N; 0 without warming, None where the losses
        grow for ever."""
        energies = _core.settled_energy(self.data, speed)
        return None if energies is None else float(sum(energies))

    def to_json(self) -> str:
        """The text of a friction file."""
        return _core.friction_to_json(self.data)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a friction file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_json())

    def changed(self, name: str, by: float) -> Friction:
        """The same with one parameter, named as in estimates, changed by `by`."""
        data = copy.deepcopy(self.data)
        found = place_of(data, name)
        if found is None:
            raise _core.BadInput(f"'{name}' is no parameter of this friction; it has {', '.join(data['parameters'])}")
        holder, key = found
        holder[key] = holder.get(key, 0) + by
        return Friction.from_dict(data)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Friction) and self.data == other.data

    def __repr__(self) -> str:
        values = {**self.parameters, **{name: value for name, value in self.data.get("thermal", {}).items() if name != "second"}}
        maps = f", {len(self.data['maps'])} map(s)" if self.data.get("maps") else ""
        return f"Friction({self.law}, " + ", ".join(f"{name}={value:.6g}" for name, value in values.items()) + maps + ")"


def place_of(data: dict[str, Any], name: str) -> tuple[dict[str, Any], str] | None:
    """Where a number that estimates and models call `name` stands in a friction file's content: its map and its key there."""
    heat = data.get("thermal", {})
    if name in data["parameters"]:
        return data["parameters"], name
    if name.startswith("second_") and name.removeprefix("second_") in heat.get("second", {}):
        return heat["second"], name.removeprefix("second_")
    if name in heat:
        return heat, name
    return (data, name) if name in OPTIONS else None


def settled_energies(data: dict[str, Any], speed: float) -> list[float]:
    """E1 and, with a second stage, E2, N.m or N, that sliding at a speed (rad/s or m/s) settles at; empty where nothing warms. data: of a
    friction file. Raises BadInput where the losses grow for ever."""
    energies = _core.settled_energy(data, speed)
    if energies is None:
        raise _core.BadInput(f"friction: never settles at {speed} rad/s or m/s: thermal_gain times the speed must stay below 1; "
                             "give a smaller speed")
    return energies


def laws(joint: Literal["rotary", "linear"] = "rotary") -> dict[str, Any]:
    """{law: {"equation", "parameters": {name: {"symbol", "unit", "meaning", "default"}}}}"""
    found = {}
    for law in _core.laws():
        # behind the laws comes what joins any of them, first its warming
        if law["name"] == "thermal":
            break
        parameters = {one["name"]: {**{key: one[key] for key in ("symbol", "meaning", "default")}, "unit": one["unit"][joint]}
                      for one in law["parameters"]}
        found[law["name"]] = {"equation": law["equation"], "parameters": parameters}
    return found
