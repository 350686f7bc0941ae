"""A position actuator of mjlab that brings the friction of its joints.

Run by hand with mjlab 1.6.0 on a CPU; not run on a GPU. mjlab pins MuJoCo 3.11, and warmjoint.warp was tested with 4.0:
pip install mjlab, then pip install mujoco==4.0.0 mujoco-warp==4.0.0. Two joints on their servos in 4 worlds stay within 2.4e-7 rad of the plugin over
2 s, without restarts. On CUDA call sim.create_graph() after scene.initialize: mjlab captures a step before actuators are initialized.

    WarmPositionActuatorCfg(target_names_expr=(".*",), stiffness=80.0, damping=10.0, robot="g1.xml",
                            frictions={".*_knee": "knee.json"}, prefix="robot/")
"""

import dataclasses

import numpy as np
import warmjoint as wj
from mjlab.actuator import Actuator, BuiltinPositionActuator, BuiltinPositionActuatorCfg


@dataclasses.dataclass(kw_only=True)
class WarmPositionActuatorCfg(BuiltinPositionActuatorCfg):
    """robot: MJCF of the robot alone; frictions: as wj.attach takes them; prefix: of its names in the scene. One of these for each scene,
    since the friction acts on all of a model's joints at once."""

    robot: str
    frictions: dict
    prefix: str = ""

    def build(self, entity, target_ids, target_names):
        return WarmPositionActuator(self, entity, target_ids, target_names)


class WarmPositionActuator(Actuator):
    """Sets the friction once the model is compiled. It is no BuiltinPositionActuator, since mjlab knows those by their exact class."""

    compute = BuiltinPositionActuator.compute

    def edit_spec(self, spec, target_names):
        BuiltinPositionActuator.edit_spec(self, spec, target_names)
        # friction's viscous is the joints' damping, and frictionloss would come on top
        _, self.friction = wj.split(wj.attach(self.cfg.robot, self.cfg.frictions, timestep=0.005))
        for name, friction in zip(self.friction.joints, self.friction.frictions):
            joint = spec.joint(name)
            joint.damping[0], joint.frictionloss = friction["parameters"].get("viscous", 0.0), 0.0

    def initialize(self, mj_model, model, data, device):
        super().initialize(mj_model, model, data, device)
        # of mjlab's view of a model the model
        self.worlds = wj.warp.put_friction(self.friction.in_model(mj_model, self.cfg.prefix), model.struct, data.nworld)

    def reset(self, env_ids=None):
        super().reset(env_ids)
        mask = np.zeros(self.worlds.nworld, dtype=bool)
        mask[slice(None) if env_ids is None else env_ids if isinstance(env_ids, slice) else env_ids.cpu().numpy()] = True
        self.worlds.reset(mask, warm=0.5)
