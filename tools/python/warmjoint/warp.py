"""Friction in mujoco_warp (mujoco-warp 4.0, warp-lang 1.19), in as many worlds as one likes.

    model, friction = wj.split(robot)                          # robot: what attach returned
    m = mjw.put_model(model)
    d = mjw.put_data(model, mujoco.MjData(model), nworld=1024)
    worlds = wj.warp.put_friction(friction, m, nworld=1024)
    mjw.step(m, d)
    worlds.energy.numpy()                                      # [worlds x joints]
    saved = worlds.get_state()                                 # beside d.qpos, d.qvel, d.act, d.qacc_warmstart, d.time
    worlds.set_state(saved, mask=[True] + 1023 * [False])      # back for the first world
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from warmjoint._core import BadInput
from warmjoint.engine_checks import check_engine, check_timestep, settled_energies_of, version_of
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


@dataclasses.dataclass(frozen=True)
class WarpState:
    """With what the next step of each world begins: Warp's arrays on the model's device, [worlds x joints] where nothing else is said."""

    load: Any  # of the bristles, N.m or N
    energy: Any  # [worlds x joints x 2] E1 and E2, N.m or N; double precision
    slip: Any  # direction of the last slide, of stiction: -1, 0 or 1
    turns: Any  # [worlds x trees] of the last search for what slides
    stretch: Any  # of the bristles, rad or m, from which the load follows
    status: Any  # the active set with which the search begins


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
            self._scratch = _scratch(nworld, m.nv, m.M_colind.shape[0])
            self._dofs = _ints(friction.dofs)
            self._per_load = _floats(friction.timestep**2 / (friction.stiffness * friction.inertia))
        self._device = m.qpos0.device
        # of the data whose forces were computed last
        self._clock: tuple[Any, Any] | None = None
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
        with which the friction was attached. A world whose time goes back, as by mjw.reset_data, gets that heat again by itself."""
        energy = np.broadcast_to(self.friction.initial_energy.T, (self.nworld, len(self.joints), 2))
        if warm is not None:
            energy = settled_energies_of(self.friction, self.nworld, warm, speed)
        chosen = self._chosen(mask)
        starts = self._states.start_energy.numpy().copy()
        starts[chosen.numpy()] = energy[chosen.numpy()]
        self._states.start_energy.assign(starts)
        self._put(chosen, self._begun(energy=energy))

    def get_state(self) -> WarpState:
        """With what the next step of each world begins, copied; what `set_state` puts back. With qpos, qvel, act, qacc_warmstart and time of the
        data a run goes on from there to the same bits (on a CPU)."""
        with wp.ScopedDevice(self._device):
            if self._clock is not None:
                m, time = self._clock
                wp.launch(kernel.settle, dim=(self.nworld, m.ntree),
                          inputs=[time, m.tree_dofadr, m.tree_dofnum, self.friction.timestep, self._joints, self._states])
            shape = (self.nworld, len(self.joints))
            stretch, load, status = wp.empty(shape, dtype=float), wp.empty(shape, dtype=float), wp.empty(shape, dtype=int)
            wp.launch(kernel.take, dim=shape, inputs=[self._dofs, self._per_load, self._states], outputs=[stretch, load, status])
            return WarpState(load, wp.clone(self._states.energy), wp.clone(self._states.slip), wp.clone(self._states.turns), stretch, status)

    def set_state(self, state: WarpState, mask: npt.ArrayLike | Any | None = None) -> None:
        """Lets the next step of the worlds in `mask` ([worlds] of bool, NumPy's or Warp's; all where not given) begin with a state of
        `get_state`, of as many worlds. Nothing passes through the host. A later reset by time gives the heat of the last `reset`."""
        if state.energy.shape != self._states.energy.shape:
            raise BadInput(f"state: is of [worlds x joints] = {list(state.energy.shape[:2])}, and the friction of [{self.nworld} x {len(self.joints)}]")
        self._put(self._chosen(mask), state)

    def put_state(self, load: npt.ArrayLike, energy: npt.ArrayLike, slip: npt.ArrayLike = 0.0) -> None:
        """With what the next step of all worlds begins, [worlds x joints] each, as the plugin and `reference.State` hold it. load: of the
        bristle, N.m or N; energy: [2 x worlds x joints] E1 and E2, N.m or N; slip: -1, 0 or 1, of stiction."""
        friction = self.friction
        stretch = np.asarray(load, dtype=np.float64) * friction.timestep**2 / (friction.stiffness * friction.inertia)
        stages = np.moveaxis(np.broadcast_to(energy, (2, self.nworld, len(self.joints))), 0, -1)
        self._put(self._chosen(None), self._begun(energy=stages, stretch=stretch, slip=slip))

    def _begun(self, energy: npt.ArrayLike, stretch: npt.ArrayLike = 0.0, slip: npt.ArrayLike = 0.0) -> WarpState:
        """A state in which nothing slides yet, from the host."""
        shape = (self.nworld, len(self.joints))
        with wp.ScopedDevice(self._device):
            stretched = _floats(np.broadcast_to(stretch, shape))
            stages = wp.array(np.ascontiguousarray(np.broadcast_to(energy, (*shape, 2))), dtype=wp.float64)
            turns = wp.zeros(self._states.turns.shape, dtype=int)
            return WarpState(None, stages, _floats(np.broadcast_to(slip, shape)), turns, stretched, wp.zeros(shape, dtype=int))

    def _chosen(self, mask: npt.ArrayLike | Any | None) -> Any:
        """[worlds] of bool on the device."""
        if isinstance(mask, wp.array) and mask.dtype == wp.bool and mask.shape == (self.nworld,):
            return mask
        given = mask.numpy() if isinstance(mask, wp.array) else mask
        chosen = np.ones(self.nworld, dtype=bool) if given is None else np.asarray(given, dtype=bool)
        if chosen.shape != (self.nworld,):
            raise BadInput(f"mask: has shape {chosen.shape}; give [{self.nworld}]")
        return wp.array(chosen, dtype=bool, device=self._device)

    def _put(self, chosen: Any, state: WarpState) -> None:
        wp.launch(kernel.put, dim=(self.nworld, len(self.joints)), device=self._device,
                  inputs=[chosen, self._dofs, state.stretch, state.energy, state.slip, state.status, state.turns, self._states])

    def _check(self, m: Any, d: Any) -> None:
        """Raises BadInput for data of another count of worlds, and for a timestep that was changed."""
        if d.qvel.shape[0] != self.nworld:
            raise BadInput(f"the data holds {d.qvel.shape[0]} worlds, and the friction is for {self.nworld}; put_friction(friction, m, nworld={d.qvel.shape[0]})")
        # a graph that is captured replays without this call, and a copy to the host would break it
        if not d.qvel.device.is_capturing:
            check_timestep(self.friction, m.opt.timestep.numpy())

    def __call__(self, m: Any, d: Any) -> None:
        """What the engine calls after it has written the passive forces."""
        self._check(m, d)
        self._clock = (m, d.time)
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
    found.status = wp.zeros((nworld, m.nv), dtype=int)
    for name in ("slip", "next_slip", "force", "loss"):
        setattr(found, name, wp.zeros((nworld, joints), dtype=float))
    for name in ("energy", "next_energy"):
        setattr(found, name, wp.zeros((nworld, joints, 2), dtype=wp.float64))
    found.total = wp.zeros((nworld, joints), dtype=wp.float64)
    found.held = wp.zeros((nworld, joints), dtype=bool)
    found.ambient = wp.zeros(nworld, dtype=float)
    found.start_energy = wp.zeros((nworld, joints, 2), dtype=wp.float64)
    return found


def _scratch(nworld: int, nv: int, entries: int) -> Any:
    found = kernel.Scratch()
    found.factor = wp.zeros((nworld, entries), dtype=float)
    for name in ("lower", "upper", "base", "aim", "result", "force"):
        setattr(found, name, wp.zeros((nworld, nv), dtype=float))
    found.sum = wp.zeros((nworld, nv), dtype=wp.float64)
    for name in ("taken", "status"):
        setattr(found, name, wp.zeros((nworld, nv), dtype=int))
    return found
