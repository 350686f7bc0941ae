"""What the engines of warmjoint.warp and warmjoint.mjx refuse, and the heat with which their worlds begin."""

from __future__ import annotations

import importlib.metadata
import warnings
from collections.abc import Mapping

import mujoco
import numpy as np
import numpy.typing as npt

from warmjoint._core import BadInput
from warmjoint.friction import place_of, settled_energies
from warmjoint.friction_arrays import FloatArray, FrictionArrays
from warmjoint.mujoco_bound import USUAL_LINEAR_SPEED, USUAL_SPEED
from warmjoint.values import number, numbers


class Untested(UserWarning):
    """An engine of another version than the tests ran with."""


def version_of(package: str, tested: Mapping[str, str]) -> None:
    """Warns of a minor version that the tests did not run with."""
    has = importlib.metadata.version(package)
    if has.split(".")[:2] != tested[package].split(".")[:2]:
        warnings.warn(f"{package} is {has}; warmjoint was tested with {tested[package]}", Untested, stacklevel=3)


def check_engine(friction: FrictionArrays, *, integrator: int, disableflags: int, timestep: npt.ArrayLike, nv: int, nworld: int | None) -> None:
    """Raises BadInput for what the ports do not step. timestep: s, of all worlds."""
    flags, kinds = mujoco.mjtDisableBit, mujoco.mjtIntegrator
    if integrator == kinds.mjINT_RK4:
        raise BadInput("the model's integrator is RK4, whose stages the friction would step; take Euler, implicit or implicitfast")
    if integrator == kinds.mjINT_EULER and disableflags & flags.mjDSBL_EULERDAMP:
        raise BadInput("the model's flag eulerdamp is disabled, so that its friction's viscous would be explicit; enable it, or take implicitfast")
    if disableflags & flags.mjDSBL_DAMPER:
        raise BadInput("the model's flag damper is disabled, and with it friction's viscous part; enable it")
    check_timestep(friction, timestep)
    if len(friction.dofs) and int(friction.dofs.max()) >= nv:
        raise BadInput(f"the model has {nv} degrees of freedom, fewer than the friction needs; put the model that split returned")
    if nworld is not None and friction.worlds not in (None, nworld):
        raise BadInput(f"the friction's numbers are for {friction.worlds} worlds, and there are {nworld}")
    friction.check_give()


def check_timestep(friction: FrictionArrays, timestep: npt.ArrayLike) -> None:
    """Raises BadInput where a world's timestep, s, is not that of the friction. Why 1e-6: single precision is worth 6e-8."""
    steps = np.asarray(timestep, dtype=np.float64)
    if not (np.abs(steps - friction.timestep) <= 1e-6 * friction.timestep).all():
        raise BadInput(f"the model's timestep is {', '.join(f'{one:g}' for one in np.unique(steps))} s, and its friction is for {friction.timestep:g} s; "
                       "attach with that timestep and split again")


def settled_energies_of(friction: FrictionArrays, nworld: int, warm: npt.ArrayLike, speed: float | None) -> FloatArray:
    """[worlds x J x 2] E1 and E2 of worlds that are so warm: a share of what their own friction settles at, N.m or N. warm: one, [J] or
    [worlds x J]; speed: rad/s or m/s. Raises BadInput."""
    share = numbers("warm", warm)
    try:
        share = np.broadcast_to(share, (nworld, len(friction.joints)))
    except ValueError:
        raise BadInput(f"warm: has shape {share.shape}; give one number, [{len(friction.joints)}] or [{nworld} x {len(friction.joints)}]") from None
    if not np.isfinite(share).all() or (share < 0).any():
        raise BadInput("warm: must be 0 or more, 1 settled")
    given = None if speed is None else number("speed", speed)
    rows = friction.worlds or 1
    settled = np.zeros((rows, len(friction.joints), 2))
    for row in range(rows):
        for i in range(len(friction.joints)):
            at = given if given is not None else USUAL_LINEAR_SPEED if friction.linear[i] else USUAL_SPEED
            heats = settled_energies(with_numbers(friction, i, row), at)
            settled[row, i, : len(heats)] = heats
    return share[:, :, None] * settled


def with_numbers(friction: FrictionArrays, joint: int, world: int) -> dict[str, object]:
    """What the friction file of a joint would hold with the numbers of a world."""
    data = {**friction.frictions[joint], "parameters": dict(friction.frictions[joint]["parameters"])}
    if "thermal" in data:
        data["thermal"] = {key: dict(one) if isinstance(one, dict) else one for key, one in data["thermal"].items()}
    for name, values in friction.numbers.items():
        found = place_of(data, name)
        if found and found[1] in found[0]:
            found[0][found[1]] = float(values[world, joint] if values.ndim == 2 else values[joint])
    return data
