"""Maps of a friction as tables over one or two quantities, which engines in single precision look up: cubic between four points of each axis."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

from warmjoint._core import BadInput
from warmjoint.friction_arrays import FrictionArrays
from warmjoint.friction_maps import TURN, kernels

QUANTITIES = ("position", "motor_position", "velocity", "energy", "load")
FACTORS = ("one", "direction", "velocity")
# Points for each width of a kernel, and for each width of the change from one normalised kernel to the next. Why: the cubic is off by at most
# 0.0234 (step / width)^4 |f''''|, with |f''''| up to 3 for a kernel of height 1: 1e-6 of it
_PER_WIDTH = 16
_MOST_POINTS = 4096


@dataclasses.dataclass(frozen=True)
class Axis:
    """Points at first + i step, count of them; around a circle where it is one. Beyond its ends the value at the end counts."""

    quantity: int  # place in QUANTITIES; velocity is |v| with a table for each side
    first: float
    step: float
    count: int
    circle: bool


@dataclasses.dataclass(frozen=True)
class Table:
    """A map of one joint: [2 x count x count] the sums of kernels forwards and backwards, N.m or N (over rad/s or m/s where the factor is
    velocity)."""

    joint: int
    factor: int  # place in FACTORS
    axes: tuple[Axis, Axis]
    values: NDArray[np.float32]


def tables(friction: FrictionArrays) -> list[Table]:
    """Of all joints. Raises BadInput, by the joint's name, for maps over more than two quantities."""
    return [_table(friction, joint, one) for joint, one in friction.maps]


def _table(friction: FrictionArrays, joint: int, friction_map: dict[str, Any]) -> Table:
    axes, kind = friction_map["axes"], friction_map.get("kernels", "normalised")
    name = friction.joints[joint]
    if len(axes) > 2:
        raise BadInput(f"joint '{name}': a map over {len(axes)} quantities runs in the plugin alone; engines take one or two")
    for axis in axes:
        if axis.get("sides", "together") == "apart" and axis["quantity"] != "velocity":
            raise BadInput(f"joint '{name}': a map's sides are apart over {axis['quantity']}; engines take that over velocity alone")
    found = [_axis(name, axis, kind) for axis in axes]
    shapes = []
    for axis, points in zip(axes, found):
        at = points.first + points.step * np.arange(points.count)
        sides = (at, -at) if axis["quantity"] == "velocity" else (at, at)
        # what is at rest is on its side of 0
        shapes.append([np.array([kernels(axis, kind, x if x != 0 else sign * 1e-300) for x in side]) for side, sign in zip(sides, (1, -1))])
    weights = np.asarray(friction_map["weights"], dtype=np.float64).reshape([len(axis["centres"]) for axis in axes])
    if len(axes) == 1:
        values = np.array([side @ weights for side in shapes[0]])[:, :, None]
        found.append(Axis(0, 0.0, 1.0, 1, False))
    else:
        values = np.array([one @ weights @ other.T for one, other in zip(*shapes)])
    factor = FACTORS.index(friction_map.get("factor", "one"))
    return Table(joint, factor, (found[0], found[1]), values.astype(np.float32))


def _axis(name: str, axis: dict[str, Any], kind: str) -> Axis:
    centres, width, period = np.asarray(axis["centres"], dtype=np.float64), float(axis["width"]), axis.get("period")
    gaps = np.diff(centres)
    # from one normalised kernel to the next the value changes over width^2 / gap
    scale = min(width, width**2 / gaps.max()) if kind == "normalised" and len(gaps) else width
    reach = 16 * max(width, width**2 / gaps.min()) if kind == "normalised" and len(gaps) else 8 * width
    quantity = axis["quantity"]
    if period is None and quantity == "motor_position":
        period = TURN
    if period is not None:
        first, last = 0.0, float(period)
    elif quantity == "velocity":
        first, last = 0.0, float(np.abs(centres).max() + reach)
    else:
        first, last = float(centres[0] - reach), float(centres[-1] + reach)
    count = int(np.ceil((last - first) / scale * _PER_WIDTH)) + 1
    if count > _MOST_POINTS:
        raise BadInput(f"joint '{name}': a map over {quantity} needs {count} points, more than {_MOST_POINTS}; take wider kernels")
    count = max(count, 4)
    step = (last - first) / (count if period is not None else count - 1)
    return Axis(QUANTITIES.index(quantity), first, step, count, period is not None)
