"""Friction compensation on a robot: what <warmjoint/compensate.h> does, from Python."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, Literal

from warmjoint import _core
from warmjoint.log import log_of
from warmjoint.values import Array, flag, kind_of, named, number

NAN = math.nan
DOUBT = ("level_std", "heat_std", "noise", "noise_time")


@dataclasses.dataclass(frozen=True)
class Compensated:
    """A compensator along a log of N samples; arrays [N]."""

    time: Array  # s
    velocity: Array  # rad/s or m/s
    torque: Array  # as logged, N.m or N
    friction: Array  # of the model with its correction, N.m or N
    residual: Array  # torque less weight, inertia and friction; nan at rest, N.m or N
    energy: Array  # heat E of all stages, N.m or N
    loss: Array  # W
    std: Array  # of friction, by what is known of its level, N.m or N
    contact: Array  # 1 where the residual is more than friction explains, else 0
    compensation: Array  # the torque that step would have given, N.m or N


class Compensator:
    """What to add to a motor's torque so that a joint moves as if it had less friction, while it warms and cools.

        compensator = estimate.compensator(share=0.9)
        while True:
            command += compensator.step(velocity, torque, dt=0.001)    # rad/s, N.m, s

    friction: an Estimate, a Friction, or what a friction file holds. How well it is known follows from an estimate, or is given:
    level_std (N.m or N, standard deviation of the cold level), heat_std (N.m or N, of the settled heat), noise (N.m or N, of a
    measured torque about the friction), noise_time (s, for which such errors last); 0 of a friction without an estimate: 2 % of the
    level, and 5 % for the noise.

    share: of the friction that is compensated, 0 to 1. dead_band (rad/s or m/s): no torque below, all of it from twice that on; where not given
    a tenth of the slowest speed of the estimate. most_speed (rad/s or m/s): a faster velocity counts as this; 1000. longest_gap (s): of a longer
    time between two samples the rest is rest; 1. contact_time (s) and deviations: a mean residual over that time, beyond so many
    deviations of what friction and noise explain, is a contact, in which the level is not corrected; 0.25 and 3.8. heat: "model" or
    "torque", what the loss comes from. correct: the level by the measured torque. Raises BadInput.
    """

    def __init__(self, friction: Any, *, level_std: float | None = None, heat_std: float | None = None, noise: float | None = None,
                 noise_time: float | None = None, share: float = 0.9, dead_band: float | None = None, most_speed: float = 0,
                 longest_gap: float = 0, contact_time: float = 0, deviations: float = 0, heat: Literal["model", "torque"] = "model",
                 correct: bool = True) -> None:
        data = friction.data if hasattr(friction, "to_json") else friction
        if not isinstance(data, Mapping):
            raise _core.BadInput(f"friction: is {kind_of(friction)}; give an Estimate, a Friction, or what a friction file holds")
        given = zip(DOUBT, (level_std, heat_std, noise, noise_time), strict=True)
        doubt = {name: number(name, value) for name, value in given if value is not None}
        settings: dict[str, Any] = {"share": number("share", share), "heat": heat, "correct": "by_torque" if flag("correct", correct) else "none"}
        numbers = {"most_speed": most_speed, "longest_gap": longest_gap, "contact_time": contact_time, "deviations": deviations}
        settings.update({name: number(name, value) for name, value in numbers.items()})
        if dead_band is not None:
            settings["dead_band"] = number("dead_band", dead_band)
        self._given = (dict(data), doubt, settings)
        self._core = _core.Compensator(*self._given)

    def step(self, velocity: float, torque: float = NAN, dt: float = 0.001, *, position: float = 0.0, motor_position: float = NAN,
             load: float = 0.0, ambient_rise: float = 0.0, reference: float = NAN) -> float:
        """A sample; returns the torque that compensates, N.m or N: finite, 0 or with the sign of the velocity it is made by.

        velocity: measured, rad/s or m/s; nan: lost. torque: measured, of the motor less weight and inertia, N.m or N; nan: none. dt: since the last
        call, s; one that is not above 0 repeats a sample. position: rad or m; motor_position: rad, where it is measured; load: that the
        joint transmits, N.m or N; ambient_rise: surroundings less those of the friction, K; reference: the velocity that is asked
        for, rad/s or m/s, by which the torque is made in place of the measured one."""
        try:
            return self._core.step(velocity, torque, dt, (position, motor_position, load, ambient_rise, reference))
        except TypeError:  # of what is no number of Python
            given = {"velocity": velocity, "torque": torque, "dt": dt, "position": position, "motor_position": motor_position, "load": load,
                     "ambient_rise": ambient_rise, "reference": reference}
            v, measured, seconds, q, motor, weight, warmer, asked = (number(name, value) for name, value in given.items())
            return self._core.step(v, measured, seconds, (q, motor, weight, warmer, asked))

    def run(self, log: Any) -> Compensated:
        """Along a log, sample by sample, and on from there. Weight and inertia that an estimate knows are taken off the torque. Raises BadInput
        where the log is in another unit, or has no position where gravity or a map needs it."""
        columns = self._core.run(log_of(log)._core)
        return Compensated(**{field.name: columns[field.name] for field in dataclasses.fields(Compensated)})

    def rest(self, seconds: float) -> None:
        """Lets the joint cool for so many seconds without motion, and what is known of it get older."""
        self._core.rest(number("seconds", seconds))

    @property
    def friction(self) -> float:
        """At the last sample, at the measured velocity and with the correction, N.m or N."""
        return float(self._core.found()["friction"])

    @property
    def residual(self) -> float:
        """Measured torque less friction at the last sample, N.m or N; nan at rest, and without a torque."""
        return float(self._core.found()["residual"])

    @property
    def energy(self) -> float:
        """Heat E of all stages, N.m or N."""
        return float(self._core.found()["energy"])

    @property
    def std(self) -> float:
        """Standard deviation of the friction by what is known of its level, N.m or N."""
        return float(self._core.found()["std"])

    @property
    def contact(self) -> bool:
        """Whether the residual is more than friction explains, so that the correction stands still."""
        return bool(self._core.found()["contact"])

    @property
    def state(self) -> dict[str, float]:
        """What is to be kept while the power is off: energy and second_energy (N.m or N), correction (N.m or N), variance."""
        state = self._core.state()
        state.pop("time")
        return state

    def restore(self, state: Mapping[str, float], seconds_off: float = NAN) -> None:
        """Goes on with a kept `state` after seconds_off without power, in which the joint cooled; nan: nobody knows for how long, so
        that half of the heat is left, with the variance of all between none and all. Raises BadInput for what is no state."""
        kept = {name: number(name, value) for name, value in named("state", state).items()}
        self._core.restore({**kept, "time": 0.0}, number("seconds_off", seconds_off))

    def __getstate__(self) -> dict[str, Any]:
        return {"given": self._given, "memory": list(self._core.memory())}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._given = state["given"]
        self._core = _core.Compensator(*self._given)
        self._core.remember(state["memory"])

    def __repr__(self) -> str:
        state = self.state
        heat = state["energy"] + state["second_energy"]
        return f"<Compensator: E {heat:.4g}, level corrected by {state['correction']:.3g}, std {self.std:.2g}>"
