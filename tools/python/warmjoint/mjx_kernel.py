"""The kernel of warmjoint.mjx: a step of the friction of all joints of one world. Formulas: reference.py."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jp
import numpy as np

from warmjoint.friction_tables import FACTORS, QUANTITIES, Axis, Table

if TYPE_CHECKING:
    from warmjoint.mjx import MjxFriction

MOST_TURNS = 8
# forces of single precision are worth that much of their bounds
_ROOM = 1e-6

Array = Any  # of JAX


class Numbers(NamedTuple):
    """The numbers of a friction, [J] each, differentiable; [worlds x J] under vmap."""

    positive: Array  # kc for v > 0, N.m or N
    negative: Array
    rise: Array  # N.m or N
    static: Array  # N.m or N
    velocity: Array  # rad/s or m/s
    exponent: Array  # 1
    gain: Array  # [2 x J] N.m/W or N/W
    time_constant: Array  # [2 x J] s
    level_per_temperature: Array  # N.m/K or N/K
    viscous_per_energy: Array  # s/rad or s/m
    load_gain: Array  # 1
    breaks_away: Array  # whether the law is stiction
    ambient_rise: Array  # K, one number
    settled: Array  # [2 x J] E1 and E2 at which sliding settles, N.m or N; what warm = 1 is at a start


class State(NamedTuple):
    """What a step leaves, [J] each. `stretch`, `stages`, `lost_digits`, `slip`, `first` and `second` are what the next begins with."""

    stretch: Array  # of the bristles, rad or m
    stages: Array  # [2 x J] E1 and E2, N.m or N
    lost_digits: Array  # [2 x J] what E1 and E2 had no room for
    slip: Array  # direction of the last slide, of stiction
    first: Array  # the active sets of both projections: 1 and -1 at a bound
    second: Array
    force: Array  # F, which opposes the motion, N.m or N
    loss: Array  # W
    held: Array  # whether friction holds the joint

    @property
    def energy(self) -> Array:
        """E, by which the level has changed, N.m or N."""
        return self.stages.sum(axis=-2)


def step_friction(f: MjxFriction, state: State, inertia: Array, speed: Array, damping: Array, position: Array, load: Array) -> State:
    """The kernel: reference.step in JAX. inertia: M [nv x nv], kg.m^2 or kg; speed: v [nv], rad/s or m/s; damping, position, load: [J].

    What is no finite number of the state counts as 0; a joint whose force is none acts with no force, and its state stays."""
    number, shape, h = f.numbers, f._shape, f._shape.timestep
    state = _finite(state)
    v, energy = speed[shape.dofs], state.energy
    sides = {side: _level(f, side, state, position, v, energy, load) for side in (1, -1)}
    upper, lower = (jp.maximum(sides[side], 0.0) for side in (1, -1))
    # what joints without friction would add is undone by their slip
    nothing = jp.zeros_like(speed)
    elastic = nothing.at[shape.dofs].set(shape.stiffness / h**2 * (state.stretch + h * v))
    damped = nothing.at[shape.dofs].set(shape.damping / h * v)
    box = Box(nothing.at[shape.dofs].set(lower), nothing.at[shape.dofs].set(upper))
    sets = [jp.zeros(len(speed), jp.int32).at[shape.dofs].set(one) for one in (state.first, state.second)]
    slip, friction = nothing, nothing
    for tree in shape.trees:
        found = _hold(inertia[np.ix_(tree, tree)], elastic[tree], damped[tree], Box(box.lower[tree], box.upper[tree]),
                      sets[0][tree], sets[1][tree], shape.turns)
        slip, friction = slip.at[tree].set(found[0]), friction.at[tree].set(found[1])
        sets = [one.at[tree].set(new) for one, new in zip(sets, found[2:])]
    slip, friction, active, other = (one[shape.dofs] for one in (slip, friction, *sets))
    stretch = state.stretch + h * v - h**2 / shape.stiffness * slip

    # force and loss; a level below 0 takes from the viscous force, at most all of it
    sliding = active * v > 0
    viscous = jp.maximum(0.0, damping + number.viscous_per_energy * energy) * v
    force, loss = viscous + friction, viscous * v + sliding * jp.abs(friction * v)
    below = jp.where(v > 0, sides[1], sides[-1])
    pushed = (friction == 0) & (v != 0) & (below < 0)
    force = jp.where(pushed, jp.sign(v) * jp.maximum(0.0, jp.abs(force) + below), force)
    loss = jp.where(pushed, jp.abs(force * v), loss)
    stages, lost_digits = _heat(number, state, loss, h)
    right = jp.isfinite(force + loss + stretch + stages.sum(axis=-2))

    def kept(after: Array, before: Array) -> Array:
        return jp.where(right, after, before)

    slides = kept(jp.where(sliding, jp.sign(v), 0.0), state.slip)
    return State(kept(stretch, state.stretch), kept(stages, state.stages), kept(lost_digits, state.lost_digits), slides, active, other,
                 kept(force, 0.0), kept(loss, 0.0), ~sliding)


def _finite(state: State) -> State:
    """The state with 0 for each number of what a step begins with that is no finite one."""
    begins = ("stretch", "stages", "lost_digits", "slip")
    return state._replace(**{name: jp.where(jp.isfinite(getattr(state, name)), getattr(state, name), 0.0) for name in begins})


class Box(NamedTuple):
    """The levels of a tree, [n] each, N.m or N."""

    lower: Array
    upper: Array


def _hold(inertia: Array, elastic: Array, damped: Array, box: Box, first: Array, second: Array, turns: int) -> tuple[Array, Array, Array, Array]:
    """Slip of the bristles (rad/s^2 or m/s^2), friction (N.m or N) and both active sets of a tree, [n] each."""
    p, slip, first = _nearest(inertia, inertia @ elastic, box.lower, box.upper, first, turns)
    # a bristle within its levels has more room for its damper
    times = jp.where(first == 0, 2.0, 1.0)
    friction, _, second = _nearest(inertia, p + inertia @ damped, times * box.lower, times * box.upper, second, turns)
    return slip, friction, first, second


def _heat(number: Numbers, state: State, loss: Array, h: float) -> tuple[Array, Array]:
    """E' = E + (1 - te) (k W + kT (Ts - T0) - E), with what the sum loses carried on (Kahan)."""
    cooling = -jp.expm1(-h / number.time_constant)
    outside = jp.stack([number.level_per_temperature * number.ambient_rise, jp.zeros_like(loss)])
    change = cooling * (number.gain * loss + outside - state.stages) + state.lost_digits
    after = state.stages + change
    return after, change - (after - state.stages)


def _level(f: MjxFriction, side: int, state: State, position: Array, v: Array, energy: Array, load: Array) -> Array:
    """[J] L of one side, 1 or -1, N.m or N."""
    number, shape = f.numbers, f._shape
    coulomb = number.positive if side > 0 else number.negative
    # at rest the power has no slope
    ratio = jp.abs(v) / number.velocity
    moving = ratio > 0
    fallen = jp.where(number.exponent == 2, ratio**2, jp.where(moving, ratio, 1.0) ** number.exponent)
    share = jp.where(moving, jp.exp(-fallen), 1.0)
    slides = (side * v > 0) & (side * state.slip > 0.5)
    law = jp.where(number.breaks_away, jp.where(slides, coulomb, number.static), coulomb + number.rise * share)
    level = law + energy + number.load_gain * jp.abs(load)
    for table in shape.tables:
        j = table.joint
        motor = shape.gear[j] * position[j]
        at = dict(zip(QUANTITIES, (position[j], motor, jp.abs(v[j]), energy[j], load[j])))
        value = _look_up(table, 0 if side > 0 else 1, at)
        factor = {"one": side, "direction": 1, "velocity": jp.abs(v[j])}[FACTORS[table.factor]]
        level = level.at[j].add(factor * value)
    return level


def _look_up(table: Table, side: int, at: dict[str, Array]) -> Array:
    """A map's value, cubic between four points of each axis."""
    rows, row_weights = _points(table.axes[0], at)
    columns, column_weights = _points(table.axes[1], at)
    values = jp.asarray(table.values[side])[rows[:, None], columns[None, :]]
    return row_weights @ values @ column_weights


def _points(axis: Axis, at: dict[str, Array]) -> tuple[Array, Array]:
    """The places and weights of the points around."""
    if axis.count == 1:
        return jp.zeros(1, jp.int32), jp.ones(1)
    place = (at[QUANTITIES[axis.quantity]] - axis.first) / axis.step
    around = jp.arange(-1, 3)
    if axis.circle:
        place = place - axis.count * jp.floor(place / axis.count)
        base = jp.floor(place).astype(jp.int32)
        points = (base + around) % axis.count
    else:
        place = jp.clip(place, 0.0, axis.count - 1)
        base = jp.clip(jp.floor(place).astype(jp.int32), 1, max(1, axis.count - 3))
        points = base + around
    t = place - base
    return points, jp.stack([-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6])


def _nearest(inertia: Array, aim: Array, lower: Array, upper: Array, status: Array, turns: int) -> tuple[Array, Array, Array]:
    """reference.nearest in JAX, all wrong ones at once: force, slip and status [n]."""
    free = (upper == 0) & (lower == 0)

    def turn(status: Array) -> tuple[Array, Array, Array]:
        slips = (status != 0) | free
        bound = jp.where(free, 0.0, jp.where(status > 0, upper, jp.where(status < 0, -lower, 0.0)))
        block = jp.where(slips[:, None] & slips[None, :], inertia, 0.0) + jp.diag(jp.where(slips, 0.0, 1.0))
        slip = _solve(block, jp.where(slips, aim - bound, 0.0))
        force = aim - inertia @ slip
        room = _ROOM * (upper + lower)
        beyond = jp.where(force > upper + room, 1, jp.where(-force > lower + room, -1, 0))
        better = jp.where(free, 0, jp.where(status == 0, beyond, jp.where(status * slip < 0, 0, status)))
        return jp.where(slips, bound, jp.clip(force, -lower, upper)), slip, better

    if turns:
        for _ in range(turns - 1):
            status = turn(status)[2]
        force, slip, _ = turn(status)
        return force, slip, status

    def goes_on(carried: tuple[Array, ...]) -> Array:
        count, status, _, _, better = carried
        return (count < MOST_TURNS) & (better != status).any()

    def again(carried: tuple[Array, ...]) -> tuple[Array, ...]:
        count, _, _, _, better = carried
        return (count + 1, better, *turn(better))

    _, status, force, slip, _ = jax.lax.while_loop(goes_on, again, (1, status, *turn(status)))
    return force, slip, status


def _solve(block: Array, right: Array) -> Array:
    """The solution with a symmetric positive definite matrix, which needs no pivots. block: [n x n]. A loop, since written out it takes XLA
    minutes to compile."""

    def eliminate(k: Array, rows: Array) -> Array:
        row = rows[k] / rows[k, k]
        return (rows - rows[:, k, None] * row[None, :]).at[k].set(row)

    rows = jp.concatenate([block, right[:, None]], axis=1)
    return jax.lax.fori_loop(0, len(right), eliminate, rows)[:, -1]
