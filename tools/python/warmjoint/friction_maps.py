"""Maps of a friction in numpy: sums of Gaussian kernels over where a joint is, Eqs. (10) to (16)."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

TURN = 2 * math.pi
STILL = float(np.finfo(np.float64).tiny)
"""A speed that is on its side of 0 and changes nothing else, rad/s or m/s."""


def kernels(axis: dict[str, Any], kind: str, x: float) -> FloatArray:
    """[centres] The kernels of an axis at x. With the sides apart, those of the other side are 0, and all are at 0."""
    centres = np.asarray(axis["centres"], dtype=np.float64)
    present = np.sign(x) * np.sign(centres) > 0 if axis.get("sides", "together") == "apart" else np.ones(len(centres), dtype=bool)
    if not present.any():
        return np.zeros(len(centres))
    distance = x - centres
    period = axis.get("period")
    if period is not None:
        distance -= period * np.floor(distance / period + 0.5)
    exponent = -((distance / axis["width"]) ** 2) / 2
    # normalised ones as seen from the nearest, so that they do not become 0/0 far from all centres
    if kind == "normalised":
        exponent = exponent - exponent[present].max()
    found: FloatArray = np.exp(np.minimum(exponent, 0.0)) * present
    return found / found.sum() if kind == "normalised" else found


def map_value(friction_map: dict[str, Any], point: dict[str, float]) -> float:
    """The kernels' sum without the factor. point: by quantity, rad or m, rad, rad/s or m/s, N.m or N, N.m or N."""
    kind = friction_map.get("kernels", "normalised")
    by_axis = [kernels(axis, kind, point[axis["quantity"]]) for axis in friction_map["axes"]]
    weights = np.asarray(friction_map["weights"], dtype=np.float64).reshape([len(one) for one in by_axis])
    for one in by_axis:
        weights = np.tensordot(one, weights, axes=(0, 0))
    return float(weights)


def map_level(friction_map: dict[str, Any], side: int, position: float, gear: float, speed: float, energy: float, load: float) -> float:
    """What a map adds to the level on one side, 1 or -1, N.m or N. position: rad or m; speed: |v|, rad/s or m/s; energy, load: N.m or N."""
    motor = gear * position
    velocity = side * max(speed, STILL)
    point = {"position": position, "motor_position": motor - TURN * math.floor(motor * (1 / TURN)), "velocity": velocity,
             "energy": energy, "load": load}
    factor = {"one": 1.0, "direction": float(side), "velocity": velocity}[friction_map.get("factor", "one")]
    return side * factor * map_value(friction_map, point)


def largest_at_rest(friction_map: dict[str, Any]) -> float:
    """The most that a map adds to a level at rest, N.m or N, by its weights."""
    if friction_map.get("factor") == "velocity":
        return 0.0
    weights = np.abs(np.asarray(friction_map["weights"], dtype=np.float64))
    if friction_map.get("kernels", "normalised") == "normalised":
        return float(weights.max())
    # of plain kernels those of one axis overlap
    overlap = 1.0
    for axis in friction_map["axes"]:
        overlap *= max(float(kernels(axis, "plain", x).sum()) for x in itertools.chain(axis["centres"]))
    return float(weights.max() * overlap)
