"""Friction in MJX (mujoco-mjx 3.17 with jax 0.10, its back end in JAX), for jit, vmap, scan and grad.

    model, friction = wj.split(robot)                          # robot: what attach returned, with sensors or without
    m, d = mjx.put_model(model), mjx.make_data(model)
    f = wj.mjx.put_friction(friction, m)
    state = f.start()                                          # also under jit and vmap: f.start(warm=drawn)
    d, state = jax.jit(wj.mjx.step)(m, d, f, state)
    state.energy                                               # [joints]
"""

from __future__ import annotations

import dataclasses
import functools
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from warmjoint._core import BadInput
from warmjoint.engine_checks import check_engine, check_timestep, settled_energies_of, version_of
from warmjoint.friction_arrays import FloatArray, FrictionArrays, split
from warmjoint.friction_tables import QUANTITIES, Table, tables

try:
    import jax
    import jax.numpy as jp
    from mujoco import mjx

    from warmjoint.mjx_kernel import Array, Numbers, State, step_friction
except ImportError:
    raise ImportError("warmjoint.mjx needs MJX: pip install mujoco-mjx==3.17.0 jax==0.10.2") from None

if TYPE_CHECKING:
    import mujoco

    from warmjoint.mujoco_attach import Attached

TESTED = {"mujoco-mjx": "3.17.0", "jax": "0.10.2"}
"""The versions that the tests ran with."""
UNROLLED_TURNS = 4


@dataclasses.dataclass(frozen=True, eq=False)
class _Shape:
    """What does not change; compared by value, so that jit compiles once for equal frictions, copied and pickled ones among them."""

    dofs: npt.NDArray[np.int_]
    positions: npt.NDArray[np.int_]
    trees: tuple[npt.NDArray[np.int_], ...]  # degrees of freedom of each tree with friction
    inertia: npt.NDArray[np.float64]
    stiffness: npt.NDArray[np.float64]
    damping: npt.NDArray[np.float64]
    gear: npt.NDArray[np.float64]
    tables: tuple[Table, ...]
    needs_load: bool
    timestep: float
    turns: int  # 0: as many as needed, at most MOST_TURNS
    unsettled: str  # why there is no settled heat; empty where there is
    friction: FrictionArrays

    @functools.cached_property
    def _value(self) -> Any:
        return _hashable(self)

    def __hash__(self) -> int:
        return hash(self._value)

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, _Shape) and self._value == other._value)


def _hashable(value: Any) -> Any:
    """A value of arrays, maps, lists and dataclasses as tuples, numbers and bytes."""
    if dataclasses.is_dataclass(value):
        return tuple(_hashable(getattr(value, field.name)) for field in dataclasses.fields(value))
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, Mapping):
        return tuple((name, _hashable(one)) for name, one in sorted(value.items()))
    if isinstance(value, (tuple, list)):
        return tuple(_hashable(one) for one in value)
    return value


@jax.tree_util.register_pytree_node_class
@dataclasses.dataclass(frozen=True)
class MjxFriction:
    """The friction of a model's joints. A pytree whose leaves are its numbers."""

    numbers: Numbers
    _shape: _Shape

    def tree_flatten(self) -> tuple[tuple[Numbers], _Shape]:
        return (self.numbers,), self._shape

    @classmethod
    def tree_unflatten(cls, shape: _Shape, leaves: tuple[Numbers]) -> MjxFriction:
        return cls(leaves[0], shape)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints."""
        return self._shape.friction.joints

    def with_numbers(self, **numbers: Array) -> MjxFriction:
        """The same with other `Numbers`."""
        return dataclasses.replace(self, numbers=self.numbers._replace(**numbers))

    def unrolled(self, turns: int = UNROLLED_TURNS) -> MjxFriction:
        """The same with a fixed count of turns in its search for what slides, through which jax.grad goes backwards."""
        return dataclasses.replace(self, _shape=dataclasses.replace(self._shape, turns=turns))

    def in_axes(self) -> MjxFriction:
        """What jax.vmap takes as in_axes of a friction whose numbers are of many worlds: 0 for those, None for the rest."""
        return dataclasses.replace(self, numbers=Numbers(*(0 if one.ndim > _rank(name) else None for name, one in zip(Numbers._fields, self.numbers))))

    def start(self, warm: npt.ArrayLike | Array | None = None, speed: float | None = None, nworld: int | None = None) -> State:
        """The state at a reset, [J], or [worlds x J] for `nworld`; also under jit and vmap. warm: 0 cold, 1 settled, any share of it, one, [J] or
        [worlds x J]; where not given the heat with which the friction was attached. speed: at which 1 has settled, rad/s or m/s, a number;
        that of put_friction where not given. Raises BadInput for a share below 0 (of a traced one the heat is nan) and where the losses
        grow for ever."""
        friction, single = self._shape.friction, jp.zeros(()).dtype  # or double, where jax_enable_x64 is set
        if warm is None:
            stages, lost = _two_floats(friction.initial_energy, single)
        else:
            stages = self._shares(warm, nworld)[..., None, :] * self._settled(speed)
            lost = jp.zeros_like(stages)
        worlds = (nworld,) if nworld is not None else self.numbers.settled.shape[:-2]
        shape = jp.broadcast_shapes(stages.shape, (*worlds, *friction.initial_energy.shape))
        stages, lost = jp.broadcast_to(stages, shape), jp.broadcast_to(lost, shape)
        nothing, sets = jp.zeros(stages[..., 0, :].shape), jp.zeros(stages[..., 0, :].shape, jp.int32)
        return State(nothing, stages, lost, nothing, sets, sets, nothing, nothing, sets == 0)

    def _shares(self, warm: npt.ArrayLike | Array, nworld: int | None) -> Array:
        share, joints = jp.asarray(warm, jp.zeros(()).dtype), len(self.joints)
        if share.ndim > 2 or share.shape[-1:] not in ((), (1,), (joints,)) or (share.ndim == 2 and nworld not in (None, *share.shape[:1])):
            raise BadInput(f"warm: has shape {share.shape}; give one number, [{joints}] or [{nworld or 'worlds'} x {joints}]")
        right = jp.isfinite(share) & (share >= 0)
        if not isinstance(right, jax.core.Tracer) and not right.all():
            raise BadInput("warm: must be 0 or more, 1 settled")
        return jp.broadcast_to(jp.where(right, share, jp.nan), (*share.shape[:-1], joints))

    def _settled(self, speed: float | None) -> Array:
        if speed is None:
            if self._shape.unsettled:
                raise BadInput(self._shape.unsettled)
            return self.numbers.settled
        friction = self._shape.friction
        if friction.worlds is not None and self.numbers.settled.ndim == 2:
            raise BadInput("speed: is given where jax.vmap has taken the worlds apart; give it to put_friction")
        settled = np.swapaxes(settled_energies_of(friction, friction.worlds or 1, 1.0, speed), 1, 2)
        return jp.asarray(settled if friction.worlds is not None else settled[0], jp.zeros(()).dtype)


def _rank(name: str) -> int:
    """Of one world's number."""
    return 2 if name in ("gain", "time_constant", "settled") else 0 if name == "ambient_rise" else 1


def _two_floats(values: FloatArray, single: Any) -> tuple[Array, Array]:
    """Numbers, and what single precision has no room for."""
    near = values.astype(single)
    return jp.asarray(near), jp.asarray((values - near).astype(single))


def put_model(robot: Attached | mujoco.MjSpec | str | os.PathLike[str], speed: float | None = None) -> tuple[Any, MjxFriction]:
    """The model and the friction for MJX of what `attach` returned, of its spec, or of MJCF that it wrote: mjx.put_model of what `split` leaves,
    without the sensors that read the plugin, which mjx.put_model refuses, and put_friction. Raises BadInput as these."""
    bare, friction = split(robot)
    m = mjx.put_model(bare, impl="jax")
    return m, put_friction(friction, m, speed)


def put_friction(friction: FrictionArrays, m: Any, speed: float | None = None) -> MjxFriction:
    """A friction for MJX. friction: of `split`; viscous is m.dof_damping. m: mjx.put_model of the model that `split` returned. speed: at which
    `start(warm=1)` has settled, rad/s or m/s; 1 or 0.1 where not given.

    Raises BadInput for a model that still holds the plugin, RK4, flags that switch damping off, another timestep, the back end of Warp,
    and maps over more than two quantities.
    """
    version_of("mujoco-mjx", TESTED)
    if int(m.npluginstate) > 0:
        raise BadInput("the model holds plugins, which MJX leaves out without a word; put the model that split returned")
    if m.impl != mjx.Impl.JAX:
        raise BadInput(f"the model's back end is {m.impl.name}; take mjx.put_model(model, impl='jax'), or warmjoint.warp")
    check_engine(friction, integrator=int(m.opt.integrator), disableflags=int(m.opt.disableflags), timestep=np.asarray(m.opt.timestep), nv=int(m.nv),
                 nworld=None)
    number, of = friction.numbers, friction.levels()
    try:
        unsettled, settled = "", np.swapaxes(settled_energies_of(friction, friction.worlds or 1, 1.0, speed), 1, 2)
    except BadInput as refused:
        unsettled, settled = str(refused), np.zeros((1, 2, len(friction.joints)))
    columns = (of.positive, of.negative, of.rise, of.static, of.velocity, of.exponent, _stages(number, "thermal_gain"), _stages(number, "thermal_time_constant"),
               number["level_per_temperature"], number["viscous_per_energy"], number["load_gain"], of.breaks_away, 0.0,
               settled if friction.worlds is not None else settled[0])
    maps = tuple(tables(friction))
    load = bool((number["load_gain"] != 0).any()) or any(QUANTITIES[axis.quantity] == "load" for one in maps for axis in one.axes if axis.count > 1)
    trees = np.asarray(m.dof_treeid)
    shape = _Shape(dofs=friction.dofs, positions=friction.positions, trees=tuple(np.flatnonzero(trees == tree) for tree in np.unique(trees[friction.dofs])),
                   inertia=friction.inertia, stiffness=friction.stiffness, damping=friction.damping, gear=friction.gear,
                   tables=maps, needs_load=load, timestep=friction.timestep, turns=0, unsettled=unsettled, friction=friction)
    single = jp.zeros(()).dtype
    return MjxFriction(Numbers(*(jp.asarray(one, dtype=None if one is of.breaks_away else single) for one in columns)), shape)


def _stages(number: Mapping[str, FloatArray], name: str) -> FloatArray:
    """[... x 2 x J] Of both stages."""
    return np.stack(np.broadcast_arrays(number[name], number[f"second_{name}"]), axis=-2)


def step(m: Any, d: Any, f: MjxFriction, state: State) -> tuple[Any, State]:
    """mjx.step with the friction, which acts as qfrc_applied beside what stands there. One world; jax.vmap makes many of it. Raises BadInput for
    another timestep than the friction's; under jit, where the model's is no number, the motion then is nan."""
    off = jp.zeros(())
    if isinstance(m.opt.timestep, jax.core.Tracer):
        off = jp.where(jp.abs(m.opt.timestep - f._shape.timestep) <= 1e-6 * f._shape.timestep, 0.0, jp.nan)
    else:
        check_timestep(f._shape.friction, np.asarray(m.opt.timestep))
    # what it weighs here, which mjx.step finds again and the compiler keeps
    here = mjx.crb(m, mjx.com_pos(m, mjx.kinematics(m, d)))
    load = jp.zeros(len(f._shape.dofs))
    if f._shape.needs_load:
        load = mjx.rne(m, mjx.com_vel(m, here)).qfrc_bias[f._shape.dofs]
    damping = m.dof_damping[f._shape.dofs]
    after = step_friction(f, state, mjx.full_m(m, here), d.qvel, damping, d.qpos[f._shape.positions], load)
    # the engine adds the joints' damping itself
    given = d.qfrc_applied
    taken = damping * d.qvel[f._shape.dofs]
    acting = given.at[f._shape.dofs].add(jp.where(jp.isfinite(taken), taken, 0.0) - after.force + off)
    return mjx.step(m, d.replace(qfrc_applied=acting)).replace(qfrc_applied=given), after
