"""The friction of a step in numpy: what the plugin does, by dense matrices and in the order of the formulas. Plugin and ports are tested against it.

    bare, friction = wj.split(robot)                           # robot: what attach returned
    model, state = bare, reference.start(friction)
    data = mujoco.MjData(model)
    stepped, state = reference.advance(model, data, friction, state)

J are the joints with friction, nv the degrees of freedom. Numbers of one world alone; RK4 and laws with bristles of their own are left out.
"""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple

import numpy as np

from warmjoint._core import BadInput
from warmjoint.friction_arrays import Bools, FloatArray, FrictionArrays, Ints, Levels
from warmjoint.friction_maps import map_level
from warmjoint.values import of_kind

DAMPER_LEVELS = 2.0
"""The damper of a bristle within its levels gives up to so many times them."""
_ROUNDING = 1e-13  # how far a force may be beyond its bound by rounding
_TURNS, _TURNS_WITHOUT_GAIN = 200, 6


@dataclasses.dataclass(frozen=True)
class State:
    """With what a step begins, [J] each."""

    load: FloatArray  # A/h^2 m z, m being the inertia at the reference pose and z the bristle's stretch, N.m or N
    energy: FloatArray  # [2 x J] E1 and E2, N.m or N
    slip: FloatArray  # the direction of the last slide, -1 or 1; 0 held. Of stiction


class Stepped(NamedTuple):
    """What a step finds, [J] each."""

    force: FloatArray  # F, which opposes the motion, N.m or N
    loss: FloatArray  # W, W
    held: Bools


def start(friction: FrictionArrays) -> State:
    """The state at a reset."""
    of_kind("friction", friction, FrictionArrays)
    count = len(friction.joints)
    return State(np.zeros(count), friction.initial_energy.copy(), np.zeros(count))


def level(friction: FrictionArrays, levels: Levels, side: int, state: State, position: FloatArray, speed: FloatArray, load: FloatArray) -> FloatArray:
    """[J] L(side) = g(side, |v|) + E + c |load| + maps, N.m or N, below 0 where friction would push. side: 1 or -1; position: [J] rad or m;
    speed: [J] v, rad/s or m/s; load: [J] N.m or N."""
    v = np.abs(speed)
    fallen = (v / levels.velocity) ** levels.exponent
    # exp(-40) is beyond the last digit
    share = np.where(v == 0, 1.0, np.exp(-fallen)) * ((v == 0) | (levels.exponent != 2) | (fallen <= 40))
    slides = (side * speed > 0) & (side * state.slip > 0.5)
    coulomb = levels.positive if side > 0 else levels.negative
    law = np.where(levels.breaks_away, np.where(slides, coulomb, levels.static), np.where(v == 0, coulomb + levels.rise, coulomb + levels.rise * share))
    heat = state.energy.sum(axis=0)
    found: FloatArray = law + heat + friction.numbers["load_gain"] * np.abs(load)
    for joint, friction_map in friction.maps:
        found[joint] += map_level(friction_map, side, position[joint], friction.gear[joint], abs(speed[joint]), heat[joint], load[joint])
    return found


def nearest(inertia: FloatArray, aim: FloatArray, lower: FloatArray, upper: FloatArray, status: Ints) -> tuple[FloatArray, FloatArray, Ints]:
    """Force, slip and status [nv] of the projection of forces onto a box in the metric of the inverse inertia matrix,

        force = argmin (x - aim)' M^-1 (x - aim),  -lower <= x <= upper,   slip = M^-1 (aim - force),

    by the active set: as long as fewer are wrong than before all of those change, else the last of them (Judice and Pires 1994).
    inertia: M [nv x nv]; status: where it begins, 1 and -1 at a bound, 0 within."""
    free = (upper == 0) & (lower == 0)
    best, left = _TURNS, _TURNS_WITHOUT_GAIN
    for _ in range(_TURNS):
        slips = (status != 0) | free
        bound = np.where(status > 0, upper, np.where(status < 0, -lower, 0.0)) * ~free
        slip = np.zeros_like(aim)
        if slips.any():
            slip[slips] = np.linalg.solve(inertia[np.ix_(slips, slips)], (aim - bound)[slips])
        force = aim - inertia @ slip
        # a joint at its bound slips to that side, one within is within
        beyond = np.where(force > (1 + _ROUNDING) * upper, 1, np.where(-force > (1 + _ROUNDING) * lower, -1, 0))
        better = np.where(free, 0, np.where(status == 0, beyond, np.where(status * slip < 0, 0, status)))
        wrong = np.flatnonzero(better != status)
        if not len(wrong):
            break
        left = _TURNS_WITHOUT_GAIN + 1 if len(wrong) < best else left
        best = min(best, len(wrong))
        status = np.where(np.isin(np.arange(len(aim)), wrong if left > 0 else wrong[-1:]), better, status)
        left -= 1
    return np.where(slips, bound, np.clip(force, -lower, upper)), slip, status


def step(friction: FrictionArrays, state: State, inertia: FloatArray, speed: FloatArray, damping: FloatArray, position: FloatArray, load: FloatArray,
         ambient_rise: float = 0.0) -> tuple[Stepped, State]:
    """One step of h seconds. inertia: M [nv x nv], kg.m^2 or kg; speed: v [nv], rad/s or m/s; damping: of the joints [J], which the engine
    adds, N.m.s/rad or N.s/m; position: [J] rad or m; load: what the joints transmit [J], N.m or N; ambient_rise: K."""
    h, m, dofs, numbers = friction.timestep, friction.inertia, friction.dofs, friction.numbers
    v, heat, levels = speed[dofs], state.energy.sum(axis=0), friction.levels()
    upper, lower = np.zeros_like(speed), np.zeros_like(speed)
    for side, bounds in ((1, upper), (-1, lower)):
        bounds[dofs] = np.maximum(0.0, level(friction, levels, side, state, position, v, load))

    # p, and the bristles' stretch after it, in rad/s^2
    stretch, damped = np.zeros_like(speed), np.zeros_like(speed)
    stretch[dofs] = state.load / m + friction.stiffness / h * v
    damped[dofs] = friction.damping / h * v
    p, slip, status = nearest(inertia, inertia @ stretch, lower, upper, np.zeros(len(speed), dtype=int))
    after = m * (stretch - slip)[dofs]
    # f, for which a bristle within its levels has more room
    times = np.where((status == 0) & ((upper != 0) | (lower != 0)), DAMPER_LEVELS, 1.0)
    f = nearest(inertia, p + inertia @ damped, times * lower, times * upper, status)[0][dofs]

    # force and loss; a level below 0 takes from the viscous force, at most all of it
    sliding = status[dofs] * v > 0
    viscous = np.maximum(0.0, damping + numbers["viscous_per_energy"] * heat) * v
    force, loss = viscous + f, viscous * v + sliding * np.abs(f * v)
    side = np.sign(v)
    own = np.where(v > 0, level(friction, levels, 1, state, position, v, load), level(friction, levels, -1, state, position, v, load))
    pushed = (f == 0) & (v != 0) & (own < 0)
    force = np.where(pushed, side * np.maximum(0.0, np.abs(force) + own), force)
    loss = np.where(pushed, np.abs(force * v), loss)

    # heat, Eq. (22)
    cooling = np.array([-np.expm1(-h / numbers[name]) for name in ("thermal_time_constant", "second_thermal_time_constant")])
    gains = np.array([numbers[name] for name in ("thermal_gain", "second_thermal_gain")])
    pole = np.array([np.exp(-h / numbers[name]) for name in ("thermal_time_constant", "second_thermal_time_constant")])
    energy = pole * state.energy + gains * cooling * loss
    energy[0] += cooling[0] * numbers["level_per_temperature"] * ambient_rise
    return Stepped(force, loss, ~sliding), State(after, energy, np.where(levels.breaks_away & sliding, side, 0.0))


def advance(model: Any, data: Any, friction: FrictionArrays, state: State, ambient_rise: float = 0.0) -> tuple[Stepped, State]:
    """One mj_step of a model without the plugin, with the friction in qfrc_applied beside what stands there."""
    import mujoco

    if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
        raise BadInput("reference: the model's integrator is RK4; take Euler, implicit or implicitfast")
    # where it is, how fast, and what it weighs
    mujoco.mj_fwdPosition(model, data)
    mujoco.mj_fwdVelocity(model, data)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    damping = model.dof_damping[friction.dofs]
    stepped, after = step(friction, state, inertia, data.qvel.copy(), damping, data.qpos[friction.positions], data.qfrc_bias[friction.dofs], ambient_rise)
    # the engine adds the joints' damping itself
    given = data.qfrc_applied.copy()
    data.qfrc_applied[friction.dofs] += damping * data.qvel[friction.dofs] - stepped.force
    mujoco.mj_step(model, data)
    data.qfrc_applied[:] = given
    return stepped, after
