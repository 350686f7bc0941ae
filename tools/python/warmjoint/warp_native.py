"""The driver of `native` for mujoco_warp: yields by world and joint, set on the device."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from warmjoint._core import BadInput
from warmjoint.engine_checks import settled_energies_of

try:
    import warp as wp

    from warmjoint.warp_native_kernel import drive
except ImportError:
    raise ImportError("native.update needs mujoco_warp: pip install mujoco-warp==4.0.0 warp-lang==1.19.0") from None

if TYPE_CHECKING:
    from warmjoint.native_springs import Native


class WarpNative:
    """Heat of all worlds, [worlds x joints] arrays of Warp."""

    def __init__(self, native: Native, m: Any, d: Any):
        self.m, self.nworld, self.native = m, int(d.qvel.shape[0]), native
        friction = native.friction
        if abs(float(m.opt.timestep.numpy()[0]) - friction.timestep) > 1e-6 * friction.timestep:
            raise BadInput(f"the model's timestep is {float(m.opt.timestep.numpy()[0]):g} s, and its springs are for {friction.timestep:g} s")
        if friction.worlds is not None or int(m.njnt) != native.model.njnt:
            raise BadInput("m: is another model; give mjw.put_model(native.model)")
        of = friction.levels()
        with wp.ScopedDevice(d.qvel.device):
            self._places = wp.array(np.stack([native.ids, friction.positions, friction.dofs, native.places], axis=1).astype(np.int32), dtype=int)
            numbers = np.stack([native.stiffness, of.positive, of.rise, of.velocity, of.exponent], axis=1)
            self._numbers = wp.array(numbers.astype(np.float32), dtype=float)
            self._heat = wp.array(np.stack([native.pole[0], native.gain[0], native.pole[1], native.gain[1]], axis=1), dtype=wp.float64)
            begun = np.broadcast_to(native.energy.T, (self.nworld, len(native.joints), 2))
            self.energy = wp.array(np.ascontiguousarray(begun), dtype=wp.float64)
            """[worlds x joints x 2] E1 and E2, N.m or N; double precision. May be written."""
            self._start = wp.clone(self.energy)
            self._last = wp.full((self.nworld, len(native.joints)), -np.inf, dtype=float)
            rows = np.broadcast_to(native.model.jnt_springyield, (self.nworld, native.model.njnt))
            m.jnt_springyield = wp.array(rows.astype(np.float32), dtype=float)

    def start(self, d: Any, warm: npt.ArrayLike, speed: float | None = None) -> None:
        """Sets the heat of all worlds: 0 cold, 1 settled at `speed`, any share of it, one, [joints] or [worlds x joints]; what a world
        whose time goes back gets again."""
        heats = settled_energies_of(self.native.friction, self.nworld, warm, speed)
        for one in (self.energy, self._start):
            one.assign(heats)
        self._last.fill_(np.inf)
        self.update(d)

    def update(self, d: Any) -> None:
        """Heat and yields after a step of the engine."""
        wp.launch(drive, dim=(self.nworld, len(self.native.joints)), device=d.qvel.device,
                  inputs=[d.time, d.qpos, d.qvel, self.m.dof_damping, self._places, self._numbers, self._heat, self._start, self._last],
                  outputs=[self.energy, d.plastic, self.m.jnt_springyield])
