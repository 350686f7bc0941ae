"""Warm friction in MuJoCo's own words: joint springs with a yield (MuJoCo 4.0), whose yields a few lines set after each step from the heat.

    native = wj.native("robot.xml", {"elbow": "estimate.json"})
    data = mujoco.MjData(native.model)
    native.start(data, warm=0.5)
    native.step(data, 500)
    native.heat
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
import numpy.typing as npt

from warmjoint import mujoco_plugin
from warmjoint._core import BadInput
from warmjoint.engine_checks import settled_energies_of
from warmjoint.friction_arrays import FloatArray, FrictionArrays, arrays_of
from warmjoint.mujoco_attach import Attached, FrictionLike, Integrator, attach_form, text_of_spec
from warmjoint.values import numbers, of_kind, text, whole

# a joint's spring and its friction, as sim/library/drive_springs.cc reads it
_SPRING = np.dtype([("joint", "i4"), ("position", "i4"), ("dof", "i4"), ("plastic", "i4"), ("stiffness", "f8"), ("level", "f8"), ("rise", "f8"),
                    ("velocity", "f8"), ("exponent", "f8"), ("gain", "f8", 2), ("ratio", "f8", 2)], align=True)


def native(model: mujoco.MjSpec | str | os.PathLike[str], frictions: Mapping[str, FrictionLike], *, approximate: bool = False,
           armatures: Mapping[str, float] | None = None, timestep: float | None = None, integrator: Integrator | None = None) -> Native:
    """Friction on joints of a robot as joint springs with a yield, which need no plugin, in any language that MuJoCo speaks.

    The spring's stiffness k follows from inertia and step: the stiffest mode of all springs, M^-1 h^2 K, is 1 at most over 32 poses. Its yield is
    level / k, the damping the friction's viscous. A joint gives way by level / k before it slides.

    model, frictions, armatures (kg.m^2 or kg), timestep (s), integrator: as of `attach`; the spec is changed.
    approximate: what a spring cannot hold (sides, stiction, maps, a bristle of the law's own, load_gain, viscous_per_energy,
        level_per_temperature, too little viscous) is left out or replaced, and `notices` say by how much that is off.
    Raises BadInput for these unless approximate, with the nearest numbers that hold for a step too long, and for a spring of the joint's own,
    other integrators than Euler, implicit and implicitfast, and MuJoCo before 4.0.
    """
    if isinstance(frictions, Mapping) and not frictions:
        raise BadInput("frictions: is empty; give a friction by joint or pattern")
    attached, answer = attach_form(model, frictions, {"form": "native", "numbers": True, "approximate": approximate}, armatures, timestep, integrator)
    return Native(attached, answer["springs"])


class Native:
    """A model whose joint springs hold friction, and the driver of their yields. Arrays are [joints]."""

    def __init__(self, attached: Attached, springs: list[dict[str, Any]]):
        self.spec = attached.spec
        """The spec with the springs, the one that was given where one was."""
        self.notices = attached.notices
        """What was changed besides, one sentence each."""
        self._springs = {spring["name"]: spring for spring in springs}
        self._take(self.spec.compile(), "")

    def _take(self, model: mujoco.MjModel, prefix: str) -> None:
        self.model = model
        """The compiled model, whose `jnt_springyield` the driver sets."""
        names = [prefix + name for name in self._springs]
        ids = np.array([mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in names])
        if (ids < 0).any() or (model.jnt_plasticadr[ids] < 0).any():
            raise BadInput("model: lacks joints with the springs; compile it from a spec that holds this one, and give its prefix")
        described = [{"name": name, "friction": spring["friction"], "inertia": 1.0, "bristle": {"stiffness": 1.0, "damping": 1.0},
                      "initial_energy": [*spring["initial_energy"], 0.0, 0.0][:2], "linear": bool(model.jnt_type[one] == mujoco.mjtJoint.mjJNT_SLIDE)}
                     for name, spring, one in zip(names, self._springs.values(), ids)]
        self.friction: FrictionArrays = arrays_of(model, described)
        """The friction as the springs hold it."""
        self.joints = list(self.friction.joints)
        """Names of the joints."""
        self.ids = ids
        """Of the joints in the model."""
        self.places = model.jnt_plasticadr[ids]
        """In mjData.plastic."""
        self.stiffness: FloatArray = np.array([spring["stiffness"] for spring in self._springs.values()])
        """k, N.m/rad or N/m."""
        number, h = self.friction.numbers, self.friction.timestep
        gains = np.array([number["thermal_gain"], number["second_thermal_gain"]])
        ratios = h / np.array([number["thermal_time_constant"], number["second_thermal_time_constant"]])
        self.pole: FloatArray = np.exp(-ratios)
        """[2 x joints] What stays of each stage's heat after a step."""
        self.gain: FloatArray = gains * -np.expm1(-ratios)
        """[2 x joints] What a loss of 1 W adds to it, N.m or N."""
        self._energy: FloatArray = np.ascontiguousarray(self.friction.initial_energy, dtype=np.float64).copy()
        of = self.friction.levels()
        self._table = np.zeros(len(ids), dtype=_SPRING)
        for name, values in (("joint", ids), ("position", self.friction.positions), ("dof", self.friction.dofs), ("plastic", self.places),
                             ("stiffness", self.stiffness), ("level", of.positive), ("rise", of.rise), ("velocity", of.velocity), ("exponent", of.exponent),
                             ("gain", gains.T), ("ratio", ratios.T)):
            self._table[name] = values
        self._start_energy, self._time = self._energy.copy(), -np.inf
        # addresses for the compiled driver: of the model; of the data that was driven last; of springs and heat
        self._data: mujoco.MjData | None = None
        self._driven: tuple[int, int, int, int, int] = (0, 0, 0, 0, 0)
        self._worlds: Any = None  # of Warp
        self.warm(mujoco.MjData(model), 0)

    def __repr__(self) -> str:
        return "\n".join([f"friction on {', '.join(self.joints)} as springs with a yield, without a plugin", *self.notices])

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_data": None}  # a copy has addresses of its own

    @property
    def xml(self) -> str:
        """The model as MJCF text, with the yields of a joint as warm as it began; any MuJoCo 4.0 loads it."""
        return text_of_spec(self.spec)

    @property
    def energy(self) -> FloatArray:
        """[2 x joints] E1 and E2, N.m or N; with qpos, qvel and plastic of the data the state of a run. It can be set."""
        return self._energy

    @energy.setter
    def energy(self, energy: npt.ArrayLike) -> None:
        given = numbers("energy", energy)
        if given.shape != self._energy.shape:
            raise BadInput(f"energy: has shape {given.shape}; give [2 x {len(self.joints)}]")
        self._energy[:] = given

    @property
    def heat(self) -> FloatArray:
        """E, by which the level has changed, N.m or N; below 0 where the joint is warm."""
        heat: FloatArray = self._energy.sum(axis=0)
        return heat

    def bind(self, model: mujoco.MjModel, prefix: str = "") -> Native:
        """The driver of a model that the spec was compiled to, or of a scene that holds it under a prefix; cold."""
        of_kind("model", model, mujoco.MjModel)
        text("prefix", prefix)
        other = Native.__new__(Native)
        other.spec, other.notices, other._springs = self.spec, self.notices, self._springs
        other._take(model, prefix)
        return other

    def start(self, data: mujoco.MjData, warm: npt.ArrayLike | None = None, speed: float | None = None) -> None:
        """Relaxes the springs where the joints are, and sets the heat; call it after mj_resetData and where a pose was set. warm: 0 cold, 1 settled
        at `speed` (rad/s or m/s; 1 or 0.1 where not given), any share of it, one or [joints]; where not given as the friction begins."""
        self._check(data)
        self._start_energy = self.friction.initial_energy.copy()
        if warm is not None:
            self._start_energy = settled_energies_of(self.friction, 1, warm, speed)[0].T.copy()
        self._energy[:] = self._start_energy
        self._time = data.time
        data.plastic[self.places] = data.qpos[self.friction.positions]
        self.warm(data, 0)

    def step(self, data: mujoco.MjData, nstep: int = 1) -> None:
        """Steps the model by MuJoCo, and after each step sets the yields from the heat. data: of `model`, one at a time. A pose that was set anew begins
        with relaxed springs, and a run whose time went back with the heat of the last `start`."""
        self._check(data)
        if data.time < self._time:
            self._energy[:] = self._start_energy
            self.warm(data, 0)
        count = whole("nstep", nstep)
        try:
            error = mujoco_plugin.step_springs(*self._driven, count)
        except SystemError as found:  # of a callback in Python
            raise (found.__cause__ or found) from None
        if error:
            raise mujoco.FatalError(error.decode(errors="replace"))
        self._time = data.time

    def warm(self, data: mujoco.MjData, steps: int = 1) -> None:
        """The driver by itself, after so many steps by other means: heat and yields; after none, yields alone. What is no finite number counts as 0."""
        self._check(data)
        mujoco_plugin.warm_springs(*self._driven, whole("steps", steps))

    def update(self, m: Any, d: Any) -> Any:
        """The driver for the worlds of mujoco_warp, on the device: call it after each mjw.step(m, d). m: mjw.put_model(native.model), whose
        jnt_springyield becomes one row a world. Returns the worlds' heat, `WarpNative`, which the first call makes."""
        from warmjoint import warp_native

        if self._worlds is None or self._worlds.m is not m or self._worlds.nworld != d.qvel.shape[0]:
            self._worlds = warp_native.WarpNative(self, m, d)
        self._worlds.update(d)
        return self._worlds

    def _check(self, data: mujoco.MjData) -> None:
        """Makes `data` the one that is driven."""
        if data is self._data:
            return
        of_kind("data", data, mujoco.MjData)
        if len(data.plastic) != self.model.nplastic or len(data.qvel) != self.model.nv:
            raise BadInput("data: is of another model; make it by mujoco.MjData(native.model)")
        self._data = data
        self._driven = (self.model._address, data._address, self._table.ctypes.data, len(self.joints), self._energy.ctypes.data)
