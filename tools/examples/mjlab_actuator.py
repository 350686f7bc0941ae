"""A position actuator of mjlab that brings the friction of its joints.

Not run: mjlab 1.6 pins mujoco-warp 3.11, and warmjoint.warp was tested with 4.0. Its classes are those of mjlab 1.6.0's source.

    WarmPositionActuatorCfg(target_names_expr=(".*",), stiffness=80.0, damping=10.0, robot="g1.xml",
                            frictions={".*_knee": "knee.json"}, prefix="robot/")
"""

import dataclasses

import warmjoint as wj
from mjlab.actuator import BuiltinPositionActuator, BuiltinPositionActuatorCfg


@dataclasses.dataclass(kw_only=True)
class WarmPositionActuatorCfg(BuiltinPositionActuatorCfg):
    """robot: MJCF of the robot alone; frictions: as wj.attach takes them; prefix: of its names in the scene. One of these for each scene,
    since the friction acts on all of a model's joints at once."""

    robot: str
    frictions: dict
    prefix: str = ""

    def build(self, entity, target_ids, target_names):
        return WarmPositionActuator(self, entity, target_ids, target_names)


class WarmPositionActuator(BuiltinPositionActuator):
    """Sets the friction once the model is compiled; compute stays that of the position actuator."""

    def edit_spec(self, spec, target_names):
        super().edit_spec(spec, target_names)
        # friction's viscous is the joints' damping, and frictionloss would come on top
        _, self.friction = wj.split(wj.attach(self.cfg.robot, self.cfg.frictions, timestep=0.005))
        for name, friction in zip(self.friction.joints, self.friction.frictions):
            joint = spec.joint(name)
            joint.damping[0], joint.frictionloss = friction["parameters"].get("viscous", 0.0), 0.0

    def initialize(self, mj_model, model, data, device):
        super().initialize(mj_model, model, data, device)
        self.worlds = wj.warp.put_friction(self.friction.in_model(mj_model, self.cfg.prefix), model, data.nworld)

    def reset(self, env_ids):
        super().reset(env_ids)
        mask = [world in set(env_ids.tolist()) for world in range(self.worlds.nworld)]
        self.worlds.reset(mask, warm=0.5)
