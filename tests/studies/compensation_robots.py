"""The day of compensation_day.py on one joint each of three robots that the plugin moves in MuJoCo.

    python3 tests/studies/compensation_robots.py [--hours 8]    # needs WARMJOINT_SHARED and the package with mujoco on PYTHONPATH

A velocity drive moves the joint against its weight; all others stand still. Its friction, 20 % of the weight that the joint may bear, warms in
two stages and follows surroundings that change by some degrees. The compensators know one stage with numbers 5 % off and no
surroundings. The torque is that of the friction with a noise of 3 % of its level. Prints the table of compensation_day.py for each robot; a robot passes
where the residuals of the corrected heat are never larger than those of a level without heat, and its push is within 5 % of the truth's.
"""

import argparse
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))

import compensation_day as study
import friction_worlds as worlds
import mujoco
import warmjoint as wj

JOINTS = {"ur5e": "elbow", "panda": "joint4", "iiwa": "joint4"}
TAU, SLOW_TAU = 600.0, 3600.0  # s
FALL, SLOW_FALL = 0.3, 0.1  # of the level at .55 rad/s, once settled
TEMPERATURE = 6.0  # K, largest rise of the surroundings
PER_TEMPERATURE = -0.005  # of the level for each K


def level_of(robot):
    """N.m"""
    return worlds.levels(worlds.bare_spec(robot))[JOINTS[robot]]


def friction_of(level, gain=1.0, tau=1.0, is_truth=True):
    speed = 0.55
    loss = (1 - FALL) * (level + 0.3 * level * speed) * speed
    thermal = {"thermal_gain": -FALL * level / loss * gain, "thermal_time_constant": TAU * tau}
    friction = {"law": "viscous_coulomb", "parameters": {"viscous": 0.3 * level, "coulomb": level}, "thermal": thermal}
    if is_truth:
        thermal["second"] = {"thermal_gain": -SLOW_FALL * level / loss, "thermal_time_constant": SLOW_TAU}
        friction["level_per_temperature"] = PER_TEMPERATURE * level
    return friction


def one_joint(robot):
    """The robot with that joint alone, and a drive that holds its velocity."""
    spec = worlds.bare_spec(robot)
    for joint in list(spec.joints):
        if joint.name != JOINTS[robot]:
            spec.delete(joint)
    level = level_of(robot)
    drive = spec.add_actuator(name="drive", target=JOINTS[robot], trntype=mujoco.mjtTrn.mjTRN_JOINT)
    drive.set_to_velocity(kv=20 * level)
    return wj.attach(spec, {JOINTS[robot]: friction_of(level)})


def drive_day(robot, seed, hours):
    """A Day whose friction is the plugin's."""
    attached = one_joint(robot)
    model = attached.spec.compile()
    data = mujoco.MjData(model)
    sensed = attached.bind(model, data)
    count = int(hours * 3600 / study.DT)
    asked = study.motion(seed)[:count]
    steps = round(study.DT / model.opt.timestep)
    surroundings = TEMPERATURE * np.sin(2 * np.pi * np.arange(count) * study.DT / (16 * 3600))
    place = model.plugin_stateadr[0] + 2
    found = np.zeros((count, 2))
    for i in range(count):
        data.ctrl[0], data.plugin_state[place] = asked[i], surroundings[i]
        mujoco.mj_step(model, data, steps)
        found[i] = data.qvel[0], -sensed.torque[0]
    level = level_of(robot)
    velocity, friction = found[:, 0] * (asked != 0), found[:, 1]
    # what moves, and not what creeps to its rest
    slides = np.abs(velocity) > 0.05
    velocity, friction = velocity * slides, friction * slides
    noise = np.random.default_rng(99 + seed).normal(0, 0.03 * level, count)
    return study.Day(np.arange(count) * study.DT, velocity, friction, friction + noise)


def arms_of(day, before, level):
    """{arm: [N] N.m}"""
    log, noise = day.log(), 0.03 * level
    known = wj.Friction.from_dict(friction_of(level, study.OFF, study.OFF, is_truth=False))
    doubt = {"heat_std": 0.05 * abs(known.settled_heat(0.55)), "noise": noise, "dead_band": 0}
    line = study.line_of(before, before.moves)
    cold = {"viscous": 0.3 * level, "coulomb": level}
    without_heat = wj.Friction("viscous_coulomb", **cold)
    run = lambda friction, **how: wj.Compensator(friction, **how).run(log).friction
    return {
        "none": np.zeros(len(day.time)),
        "fixed, cold": study.by_line(day, (cold["viscous"], cold["coulomb"])),
        "mean of the day before": study.by_line(day, line),
        "level without heat, never still": run(without_heat, noise=noise, dead_band=0, deviations=study.NEVER),
        "heat, open loop": run(known, correct=False, **doubt),
        "heat, corrected": run(known, **doubt),
        "truth": day.friction,
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--hours", type=int, default=8)
    hours = parser.parse_args().hours
    study.N, study.HOURS = int(hours * 3600 / study.DT), hours
    for robot in JOINTS:
        level = level_of(robot)
        print(f"\n{robot} {JOINTS[robot]}: level {level:.3g} N.m")
        print(f"{'arm':36}{'rms %':>8}{'median':>8}{'worst':>8}{'starts':>8}{'push %':>10}")
        found = {}
        for arm, friction in arms_of(day := drive_day(robot, 0, hours), drive_day(robot, 50, min(hours, 2)), level).items():
            found[arm] = study.measures(day, friction)
            print(f"{arm:36}" + "".join(f"{value:8.2f}" for value in found[arm][:4]) + f"{100 * found[arm][4] / day.rms:10.1f}")
        mine, level_alone = found["heat, corrected"], found["level without heat, never still"]
        better = all(one <= other for one, other in zip(mine[:4], level_alone[:4])) and mine[4] <= 1.05 * found["truth"][4]
        print("passes" if better else "fails")


if __name__ == "__main__":
    main()
