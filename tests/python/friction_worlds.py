"""Robots, frictions and torques with which plugin, reference and ports are compared."""

import os
import pathlib

import mujoco
import numpy as np
import pytest

SHARED = pathlib.Path(os.environ.get("WARMJOINT_SHARED") or pathlib.Path(__file__).resolve().parents[3] / "shared")
SEGMENTS = {"panda": ("franka_emika_panda/panda_nohand_nomesh.xml", None), "iiwa": ("kuka_iiwa_14/iiwa14_nomesh.xml", 0.001),
            "ur5e": ("universal_robots_ur5e/ur5e_nomesh.xml", 0.002)}
ROBOTS = (*SEGMENTS, "humanoid")
HEAT = {"thermal_gain": -0.02, "thermal_time_constant": 20.0}
LAWS = {
    "coulomb": {"coulomb": 1.0},
    "viscous_coulomb": {"viscous": 0.3, "coulomb": 1.0},
    "asymmetric": {"viscous": 0.3, "coulomb_positive": 1.0, "coulomb_negative": 0.8},
    "stribeck": {"viscous": 0.3, "coulomb": 0.8, "static": 1.0, "stribeck_velocity": 0.2},
    "asymmetric_stribeck": {"viscous": 0.3, "coulomb_positive": 0.8, "coulomb_negative": 0.7, "static_rise": 0.2, "stribeck_velocity": 0.2,
                            "stribeck_exponent": 1.3},
    "stiction": {"viscous": 0.3, "coulomb": 0.8, "static": 1.0},
}
LEVEL_NUMBERS = ("viscous", "coulomb", "coulomb_positive", "coulomb_negative", "static", "static_rise")
POSITION_MAP = {"axes": [{"quantity": "position", "centres": [-1.5, -0.5, 0.5, 1.5], "width": 0.6}], "weights": [0.2, -0.1, 0.15, 0.0],
                "factor": "direction"}
RIPPLE_MAP = {"axes": [{"quantity": "motor_position", "centres": [0, 1.5708, 3.1416, 4.7124], "width": 0.8, "period": 2 * np.pi},
                       {"quantity": "velocity", "centres": [-1.0, -0.3, 0.3, 1.0], "width": 0.5, "sides": "apart"}],
              "weights": [0.1, 0.05, 0.02, 0, 0, 0.1, 0, 0.05, 0.03, 0, 0.1, 0, 0, 0.02, 0.05, 0.1]}


def friction(law, level, **more):
    """A law with its levels times `level`, N.m."""
    parameters = {name: value * (level if name in LEVEL_NUMBERS else 1) for name, value in LAWS[law].items()}
    return {"law": law, "parameters": parameters, "thermal": HEAT, **more}


def everything(level):
    """A friction with two heats, an ambient, a slope that falls, load and two maps."""
    return {"law": "stribeck", "parameters": {name: value * (level if name in LEVEL_NUMBERS else 1) for name, value in LAWS["stribeck"].items()},
            "thermal": {**HEAT, "second": {"thermal_gain": -0.01, "thermal_time_constant": 90.0}}, "gear": 5.0,
            "level_per_temperature": -0.01 * level, "viscous_per_energy": 0.05, "load_gain": 0.02,
            "maps": [{**one, "weights": [level * weight for weight in one["weights"]]} for one in (POSITION_MAP, RIPPLE_MAP)]}


# of a humanoid: name, what it hangs on, place there, hinges, length and mass of a link
LIMBS = (("leg_l", "pelvis", "0 0.1 -0.1", 6, 0.14, 2.5), ("leg_r", "pelvis", "0 -0.1 -0.1", 6, 0.14, 2.5),
         ("arm_l", "pelvis", "0 0.2 0.25", 4, 0.15, 1.2), ("arm_r", "pelvis", "0 -0.2 0.25", 4, 0.15, 1.2))
# of one of 29 joints
MORE_LIMBS = (("waist", "pelvis", "0 0 0.1", 3, 0.05, 3.0), *LIMBS[:2],
              ("arm_l", "waist2", "0 0.2 0.25", 7, 0.12, 1.0), ("arm_r", "waist2", "0 -0.2 0.25", 7, 0.12, 1.0))


def humanoid(limbs=LIMBS):
    """A free base with legs and arms, without contacts."""
    def bodies(on):
        text = []
        for name, root, first, hinges, length, mass in limbs:
            if root != on:
                continue
            for k in range(hinges):
                place = first if k == 0 else f"0 0 {-length}"
                axis = ("0 1 0", "1 0 0", "0 0 1")[k % 3]
                text.append(f'<body pos="{place}"><joint name="{name}{k}" axis="{axis}" armature="0.02" damping="0.2"/>'
                            f'<geom type="capsule" fromto="0 0 0 0.02 0 {-length}" size="0.04" mass="{mass}"/>')
            text += [*bodies(f"{name}{hinges - 1}"), "</body>" * hinges]
        return text

    return "".join(['<mujoco model="humanoid"><option timestep="0.002"/><default><geom contype="0" conaffinity="0"/></default><worldbody>',
                    '<body name="pelvis" pos="0 0 1"><freejoint name="base"/><geom type="box" size="0.12 0.15 0.25" mass="30"/>', *bodies("pelvis"),
                    "</body></worldbody></mujoco>"])


def bare_spec(robot):
    """The robot without drives and stops, in Euler's steps of 2 ms."""
    if robot == "humanoid":
        return mujoco.MjSpec.from_string(humanoid())
    name, armature = SEGMENTS[robot]
    path = SHARED / "robots" / name
    if not path.exists():
        pytest.skip(f"{path} is not there (WARMJOINT_SHARED)")
    spec = mujoco.MjSpec.from_file(str(path))
    for actuator in list(spec.actuators):
        spec.delete(actuator)
    for key in list(spec.keys):
        spec.delete(key)
    spec.option.timestep, spec.option.integrator = 0.002, mujoco.mjtIntegrator.mjINT_EULER
    for joint in spec.joints:
        joint.frictionloss = 0
        # no stops
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
        if armature is not None:
            joint.armature = armature
    return spec


def hinges(spec):
    return [joint.name for joint in spec.joints if joint.type != mujoco.mjtJoint.mjJNT_FREE]


def levels(spec):
    """{joint: N.m} 20 % of the weight that a joint may bear at rest, and what its step of 2 ms carries of it."""
    model = spec.copy().compile()
    data = mujoco.MjData(model)
    random, most = np.random.default_rng(0), np.zeros(model.nv)
    for _ in range(20):
        for joint in hinges(spec):
            data.qpos[model.joint(joint).qposadr[0]] = random.uniform(-1, 1)
        mujoco.mj_forward(model, data)
        most = np.maximum(most, np.abs(data.qfrc_bias))
    found = {}
    for joint in hinges(spec):
        dof = model.joint(joint).dofadr[0]
        inertia = 1 / model.dof_invweight0[dof]
        found[joint] = float(min(0.2 + 0.2 * most[dof], 0.3 * 0.05 * 0.64 * inertia / model.opt.timestep**2))
    return found


def frictions(spec, law):
    given = levels(spec)
    return {joint: everything(level) if law == "everything" else friction(law, level) for joint, level in given.items()}


class Torques:
    """Torques [nv] on the joints with friction that change every 20 ms, N.m: strong and weak, so that joints stick and slip."""

    def __init__(self, model, names, level, seed=1):
        self.dofs = np.array([model.joint(joint).dofadr[0] for joint in names])
        self.level = np.array([level[joint] for joint in names])
        self.random, self.values, self.until = np.random.default_rng(seed), np.zeros(model.nv), 0.0

    def at(self, time):
        if time >= self.until - 1e-9:
            self.until += 0.02
            self.values[self.dofs] = self.level * self.random.uniform(-1, 1, len(self.dofs)) * self.random.choice([0.8, 4.0], len(self.dofs))
        return self.values


