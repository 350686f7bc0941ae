"""What the tests of the engines share with those of the package: robots, frictions and torques, and how the plugin moves them."""

import dataclasses
import pathlib
import sys

import mujoco
import numpy as np
import pytest
import warmjoint as wj
from warmjoint import mujoco_plugin
from warmjoint.friction_arrays import FrictionArrays

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))

import friction_worlds as worlds

SECONDS, SEGMENT = 3.0, 50  # s, and steps between two restarts
STATES = ("bristle load", "energy", "second energy", "slip")


@dataclasses.dataclass
class Motion:
    """What the plugin does, from S states that are .1 s apart: arrays [steps x S x ...]."""

    bare: mujoco.MjModel
    friction: FrictionArrays
    start: dict  # qpos, qvel and each of STATES, [S x ...]
    torque: np.ndarray  # [SEGMENT x S x nv] N.m
    qpos: np.ndarray
    qvel: np.ndarray
    energy: np.ndarray  # [SEGMENT x S x J] with which a step began
    held: np.ndarray
    rise: float


def plugin_motion(robot, law):
    spec = worlds.bare_spec(robot)
    level = worlds.levels(spec)
    attached = wj.attach(spec, worlds.frictions(spec, law))
    bare, friction = wj.split(attached)
    model = attached.spec.compile()
    data = mujoco.MjData(model)
    sensed = attached.bind(model, data)
    joints = mujoco_plugin.joints_of(model)
    torques = worlds.Torques(model, friction.joints, level)
    rise = 7.0 if law == "everything" else 0.0
    data.plugin_state[model.plugin_stateadr[0] + 2] = rise
    starts, rows = [], []
    for step in range(round(SECONDS / bare.opt.timestep)):
        if step % SEGMENT == 0:
            held = {name: np.zeros(len(joints)) for name in STATES}
            for i, joint in enumerate(joints):
                for k, name in enumerate(joint["states"]):
                    held[name][i] = data.plugin_state[joint["state"] + k]
            starts.append({"qpos": data.qpos.copy(), "qvel": data.qvel.copy(), **held})
        data.qfrc_applied[:] = torques.at(data.time)
        heat = sensed.heat
        torque = data.qfrc_applied.copy()
        mujoco.mj_step(model, data)
        rows.append((torque, data.qpos.copy(), data.qvel.copy(), heat, sensed.held))
    segments = [np.array(column).reshape(len(starts), SEGMENT, -1).swapaxes(0, 1) for column in zip(*rows)]
    start = {name: np.array([one[name] for one in starts]) for name in starts[0]}
    return Motion(bare, friction, start, *segments, rise)


@pytest.fixture(scope="session")
def motion_of():
    """plugin_motion, each found once."""
    found = {}

    def motion(robot, law):
        if (robot, law) not in found:
            found[robot, law] = plugin_motion(robot, law)
        return found[robot, law]

    return motion


HINGE = """<mujoco><option timestep="0.002" gravity="0 0 0"/><worldbody><body><joint name="hinge" axis="0 1 0"/>
<geom size=".1" mass="1" pos=".4 0 0" contype="0" conaffinity="0"/></body></worldbody></mujoco>"""
WARM = {"law": "viscous_coulomb", "parameters": {"viscous": 0.5, "coulomb": 4.0},
        "thermal": {"thermal_gain": -0.3, "thermal_time_constant": 180.0}}


def settled_by_steps(speeds, h):
    """E of WARM after steps that slide at these speeds, by Eq. (22) in double precision."""
    pole, gain = float(np.exp(-h / 180.0)), -0.3 * float(-np.expm1(-h / 180.0))
    energy = 0.0
    for v in speeds.tolist():
        energy = pole * energy + gain * (0.5 * v + 4.0 + energy) * v
    return energy


def without_friction(motion, forces):
    """MuJoCo without friction from motion's starts, with the torques less these forces [steps x S x J]: the torques [steps x S x nv] in single
    precision, positions of the joints and speeds. What an engine alone differs by from that is no error of the friction's."""
    applied = motion.torque.astype(np.float32)
    applied[:, :, motion.friction.dofs] -= forces
    starts = [mujoco.MjData(motion.bare) for _ in motion.start["qpos"]]
    for world, data in enumerate(starts):
        data.qpos[:], data.qvel[:] = motion.start["qpos"][world], motion.start["qvel"][world]
    rows = []
    for torque in applied:
        for world, data in enumerate(starts):
            data.qfrc_applied[:] = torque[world]
            mujoco.mj_step(motion.bare, data)
        rows.append(([data.qpos[motion.friction.positions] for data in starts], [data.qvel.copy() for data in starts]))
    return applied, *(np.array(column) for column in zip(*rows))


def jumps(worlds_count, joints):
    """Shares of the level, [50 x worlds x joints], below 1: constant in the first world, anew every 20 ms in the others."""
    shares = np.random.default_rng(2).uniform(-0.9, 0.9, (50, worlds_count, joints))
    shares[:, 0] = 0.6
    return shares


def rests_of_plugin(model, torques):
    """Speeds of the plugin after each 20 ms. torques: [T x worlds x nv]; returns the like."""
    speeds = np.zeros(torques.shape)
    for world in range(torques.shape[1]):
        data = mujoco.MjData(model)
        for i, torque in enumerate(torques[:, world]):
            data.qfrc_applied[:] = torque
            mujoco.mj_step(model, data, 10)
            speeds[i, world] = data.qvel
    return speeds
