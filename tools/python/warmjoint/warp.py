"""Friction in mujoco_warp (mujoco-warp 4.0, warp-lang 1.19), in as many worlds as one likes.

    model, friction = wj.split(robot)                          # robot: what attach returned
    m = mjw.put_model(model)
    d = mjw.put_data(model, mujoco.MjData(model), nworld=1024)
    worlds = wj.warp.put_friction(friction, m, nworld=1024)
    mjw.step(m, d)
    worlds.energy.numpy()                                      # [worlds x joints]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from warmjoint._core import BadInput
from warmjoint.engine_checks import check_engine, settled_energies_of, version_of
from warmjoint.friction_arrays import FrictionArrays
from warmjoint.friction_tables import tables

try:
    import mujoco_warp as mjw
    import warp as wp
except ImportError:
    raise ImportError("warmjoint.warp needs mujoco_warp: pip install mujoco-warp==4.0.0 warp-lang==1.19.0") from None

from warmjoint import warp_kernel as kernel

TESTED = {"mujoco-warp": "4.0.0", "warp-lang": "1.19.0"}
"""The versions that the tests ran with."""
MOST_TURNS = 8


class WarpFriction:
    """The friction of all worlds: Warp's arrays [worlds x joints], as of the last computation of forces.

    Each is one array that stays, so that a captured graph goes on with it.
    """

    def __init__(self, friction: FrictionArrays, m: Any, nworld: int):
        self.friction = friction
        self.joints = friction.joints
        """Names of the joints."""
        self.nworld = nworld
        with wp.ScopedDevice(m.qpos0.device):
            self._joints = _joints(friction, m.nv)
            self._states = _states(friction, nworld, m)
            self._scratch = _scratch(nworld, m.nv)
        self._needs_load = bool((friction.numbers["load_gain"] != 0).any()) or any(
            axis["quantity"] == "load" for _, one in friction.maps for axis in one["axes"])
        self.reset()

    @property
    def force(self) -> Any:
        """F, which opposes the motion, N.m or N."""
        return self._states.force

    @property
    def energy(self) -> Any:
        """E, by which the level has changed, N.m or N; double precision."""
        return self._states.total

    @property
    def loss(self) -> Any:
        """W, W."""
        return self._states.loss

    @property
    def held(self) -> Any:
        """Whether friction holds the joint."""
        return self._states.held

    @property
    def ambient_rise(self) -> Any:
        """[worlds] Ts - T0, K; may be written."""
        return self._states.ambient

    @property
    def turns(self) -> Any:
        """[worlds x trees] How many turns the search for what slides took, at most 8."""
        return self._states.turns

    def reset(self, mask: npt.ArrayLike | None = None, warm: npt.ArrayLike | None = None, speed: float | None = None) -> None:
        """Relaxes the bristles and sets the heat, of the worlds in `mask` ([worlds], all where not given). warm: 0 cold, 1 settled at `speed`
        (rad/s or m/s; 1 or 0.1 where not given), any share of it, one, [joints] or [worlds x joints]; where not given the heat is that
        with which the friction was attached. mjw.reset_data resets the worlds that it is given by itself."""
        chosen = np.ones(self.nworld, dtype=bool) if mask is None else np.asarray(mask, dtype=bool)
        if chosen.shape != (self.nworld,):
            raise BadInput(f"mask: has shape {chosen.shape}; give [{self.nworld}]")
        energy = np.broadcast_to(self.friction.initial_energy.T, (self.nworld, len(self.joints), 2))
        if warm is not None:
            energy = settled_energies_of(self.friction, self.nworld, warm, speed)
        new = {"time": -1.0, "stretch": 0.0, "next_stretch": 0.0, "slip": 0.0, "next_slip": 0.0, "first": 0, "second": 0}
        for name, value in (*new.items(), ("energy", energy), ("next_energy", energy), ("total", energy.sum(axis=2))):
            array = getattr(self._states, name)
            values = array.numpy()
            values[chosen] = np.broadcast_to(value, values.shape)[chosen]
            array.assign(values)

    def put_state(self, load: npt.ArrayLike, energy: npt.ArrayLike, slip: npt.ArrayLike = 0.0) -> None:
        """With what the next step of all worlds begins, [worlds x joints] each, as the plugin and `reference.State` hold it. load: of the
        bristle, N.m or N; energy: [2 x worlds x joints] E1 and E2, N.m or N; slip: -1, 0 or 1, of stiction."""
        friction = self.friction
        self.reset()
        stretch = np.zeros((self.nworld, self._states.stretch.shape[1]))
        per_load = friction.timestep**2 / (friction.stiffness * friction.inertia)
        stretch[:, friction.dofs] = np.broadcast_to(load, (self.nworld, len(self.joints))) * per_load
        stages = np.moveaxis(np.broadcast_to(energy, (2, self.nworld, len(self.joints))), 0, -1)
        slips = np.broadcast_to(slip, (self.nworld, len(self.joints)))
        for name, values in (("stretch", stretch), ("energy", stages), ("slip", slips)):
            getattr(self._states, name).assign(np.ascontiguousarray(values))
            getattr(self._states, f"next_{name}").assign(np.ascontiguousarray(values))

    def __call__(self, m: Any, d: Any) -> None:
        """What the engine calls after it has written the passive forces."""
        if self._needs_load:
            mjw.rne(m, d)
        wp.launch(
            kernel.step_friction,
            dim=(self.nworld, m.ntree),
            inputs=[d.time, d.qpos, d.qvel, d.M, d.qfrc_bias, m.M_rownnz, m.M_rowadr, m.M_colind, m.tree_dofadr, m.tree_dofnum, m.dof_damping,
                    self.friction.timestep, MOST_TURNS, self._joints, self._states, self._scratch],
            outputs=[d.qfrc_passive],
            device=d.qvel.device,
        )


def put_friction(friction: FrictionArrays, m: Any, nworld: int) -> WarpFriction:
    """Gives the model its friction: sets m.callback.passive, so that mjw.step steps it.

    friction: of `split`, whose numbers are of one world or of `nworld` (FrictionArrays.changed); viscous is m.dof_damping.
    m: mjw.put_model of the model that `split` returned. Raises BadInput for RK4, a flag that switches passive forces or implicit
    damping off, another timestep, maps over more than two quantities, and numbers for another count of worlds.
    """
    version_of("mujoco-warp", TESTED)
    check_engine(friction, integrator=int(m.opt.integrator), disableflags=int(m.opt.disableflags), timestep=m.opt.timestep.numpy(), nv=int(m.nv),
                 nworld=nworld)
    if m.callback.passive is not None and not isinstance(m.callback.passive, WarpFriction):
        raise BadInput("m.callback.passive: holds a callback already; call it from a function of your own, beside the friction's")
    found = WarpFriction(friction, m, nworld)
    m.callback.passive = found
    return found


def _floats(values: npt.ArrayLike) -> Any:
    return wp.array(np.asarray(values, dtype=np.float32), dtype=float)


def _ints(values: npt.ArrayLike) -> Any:
    return wp.array(np.asarray(values, dtype=np.int32), dtype=int)


def _stacked(columns: Sequence[npt.ArrayLike]) -> npt.NDArray[np.float64]:
    """[1 or worlds x J x columns]"""
    rows = [np.atleast_2d(np.asarray(column, dtype=np.float64)) for column in columns]
    worlds = max(len(row) for row in rows)
    return np.stack([np.broadcast_to(row, (worlds, row.shape[1])) for row in rows], axis=-1)


def _joints(friction: FrictionArrays, nv: int) -> Any:
    found = kernel.Joints()
    of_dof = np.full(nv, -1)
    of_dof[friction.dofs] = np.arange(len(friction.dofs))
    found.of_dof, found.position = _ints(of_dof), _ints(friction.positions)
    found.shape = _floats(np.stack([friction.inertia, friction.stiffness, friction.damping, friction.gear], axis=1))
    number, of = friction.numbers, friction.levels()
    found.law = _floats(_stacked([of.positive, of.negative, of.rise, of.static, of.velocity, of.exponent, of.breaks_away.astype(float),
                                  number["load_gain"], number["viscous_per_energy"]]))
    ratios = [friction.timestep / number[f"{stage}thermal_time_constant"] for stage in ("", "second_")]
    cooling = [-np.expm1(-ratio) for ratio in ratios]
    heat = _stacked([number["thermal_gain"] * cooling[0], np.exp(-ratios[0]), number["second_thermal_gain"] * cooling[1], np.exp(-ratios[1]),
                     cooling[0] * number["level_per_temperature"]])
    found.heat = wp.array(heat, dtype=wp.float64)
    return _with_maps(found, friction)


def _with_maps(found: Any, friction: FrictionArrays) -> Any:
    maps = sorted(tables(friction), key=lambda one: one.joint)
    found.map_begin = _ints(np.searchsorted([one.joint for one in maps], np.arange(len(friction.joints) + 1)))
    sizes = [one.values.size for one in maps]
    found.map_factor, found.map_offset = _ints([one.factor for one in maps]), _ints(np.cumsum([0, *sizes])[: len(maps)])
    found.axis_int = _ints(np.array([[[axis.quantity, axis.count, axis.circle] for axis in one.axes] for one in maps]).reshape(-1, 2, 3))
    found.axis_float = _floats(np.array([[[axis.first, 1 / axis.step] for axis in one.axes] for one in maps]).reshape(-1, 2, 2))
    found.values = _floats(np.concatenate([one.values.reshape(-1) for one in maps]) if maps else np.zeros(1))
    return found


def _states(friction: FrictionArrays, nworld: int, m: Any) -> Any:
    found, joints = kernel.States(), len(friction.joints)
    found.time = wp.zeros((nworld, m.ntree), dtype=float)
    found.turns = wp.zeros((nworld, m.ntree), dtype=int)
    for name in ("stretch", "next_stretch"):
        setattr(found, name, wp.zeros((nworld, m.nv), dtype=float))
    for name in ("first", "second"):
        setattr(found, name, wp.zeros((nworld, m.nv), dtype=int))
    for name in ("slip", "next_slip", "force", "loss"):
        setattr(found, name, wp.zeros((nworld, joints), dtype=float))
    for name in ("energy", "next_energy"):
        setattr(found, name, wp.zeros((nworld, joints, 2), dtype=wp.float64))
    found.total = wp.zeros((nworld, joints), dtype=wp.float64)
    found.held = wp.zeros((nworld, joints), dtype=bool)
    found.ambient = wp.zeros(nworld, dtype=float)
    found.start_energy = wp.array(friction.initial_energy.T.copy(), dtype=wp.float64)
    return found


def _scratch(nworld: int, nv: int) -> Any:
    found = kernel.Scratch()
    for name in ("inertia", "factor"):
        setattr(found, name, wp.zeros((nworld, nv, nv), dtype=float))
    for name in ("lower", "upper", "aim", "damped", "slip", "force"):
        setattr(found, name, wp.zeros((nworld, nv), dtype=float))
    found.taken = wp.zeros((nworld, nv), dtype=int)
    return found
