"""The friction of one joint as a value."""

from __future__ import annotations

import copy
import os
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core
from warmjoint.values import Array, kind_of, number, numbers, path_of, shown, together

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
        if not isinstance(data, Mapping):
            raise _core.BadInput(f"friction: is {kind_of(data)}; give what a friction file holds, as a dict")
        friction = cls.__new__(cls)
        friction.data = _core.complete_friction(data)
        return friction

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Friction:
        """Reads a friction file, or the friction of an estimate file."""
        return cls.from_dict(_core.read_friction(path_of(path)))

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
        given = together(speed=speed, position=position, energy=heat, load=load)
        return np.asarray(_core.force(self.data, _flat(given))).reshape(given["speed"].shape)

    def settled_heat(self, speed: npt.ArrayLike) -> Any:
        """E of a joint that has slid at `speed` (rad/s or m/s) for long, N.m or N; 0 without warming. Where the losses grow for ever
        None, of an array of speeds NaN."""
        speeds = numbers("speed", speed)
        settled = [_core.settled_energy(self.data, float(one)) for one in speeds.reshape(-1)]
        if speeds.ndim == 0:
            return None if settled[0] is None else float(sum(settled[0]))
        return np.array([np.nan if one is None else sum(one) for one in settled]).reshape(speeds.shape)

    def step(self, heat: npt.ArrayLike, speed: npt.ArrayLike, dt: npt.ArrayLike, position: npt.ArrayLike = 0.0,
             load: npt.ArrayLike = 0.0) -> Any:
        """E, N.m or N, after dt (s) of sliding at a steady speed (rad/s or m/s), for a controller or a simulation of one's own:
        Eq. (22), E' = E exp(-dt/tau) + k (1 - exp(-dt/tau)) W with the loss W = |F v| at the beginning. heat: E before. Arguments of any
        shapes that NumPy broadcasts; with a second stage of warming heat has a last axis of 2, E1 and E2, and so has what is returned.

            torque = friction(speed, heat=heat)
            heat = friction.step(heat, speed, dt=0.001)
        """
        energies = numbers("heat", heat)
        has_two = "second" in self.data.get("thermal", {})
        if has_two and (energies.ndim == 0 or energies.shape[-1] != 2):
            raise _core.BadInput("heat: this friction warms in two stages; give E1 and E2, [..., 2]")
        first, second = (energies[..., 0], energies[..., 1]) if has_two else (energies, np.zeros_like(energies))
        given = together(first=first, second=second, speed=speed, step=dt, position=position, load=load)
        if not (given["step"] > 0).all():
            raise _core.BadInput("dt: must be above 0 s")
        after = [np.asarray(one).reshape(given["first"].shape) for one in _core.step_heat(self.data, _flat(given))]
        if has_two:
            return np.stack(after, axis=-1)
        return after[0] if after[0].ndim else float(after[0])

    def to_json(self) -> str:
        """The text of a friction file."""
        return _core.friction_to_json(self.data)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a friction file."""
        _core.write_text(path_of(path), self.to_json())

    def changed(self, name: str, by: float) -> Friction:
        """The same with one parameter, named as in estimates, changed by `by`."""
        data = copy.deepcopy(self.data)
        found = place_of(data, name) if isinstance(name, str) else None
        if found is None:
            raise _core.BadInput(f"{shown(name)} is no parameter of this friction; it has {', '.join(data['parameters'])}")
        holder, key = found
        holder[key] = holder.get(key, 0) + number("by", by)
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


def _flat(given: dict[str, Array]) -> dict[str, Array]:
    return {name: np.ascontiguousarray(values.reshape(-1)) for name, values in given.items()}


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
    if not isinstance(joint, str) or joint not in ("rotary", "linear"):
        raise _core.BadInput(f"joint: is {shown(joint)}; give 'rotary' or 'linear'")
    found = {}
    for law in _core.laws():
        # behind the laws comes what joins any of them, first its warming
        if law["name"] == "thermal":
            break
        parameters = {one["name"]: {**{key: one[key] for key in ("symbol", "meaning", "default")}, "unit": one["unit"][joint]}
                      for one in law["parameters"]}
        found[law["name"]] = {"equation": law["equation"], "parameters": parameters}
    return found
