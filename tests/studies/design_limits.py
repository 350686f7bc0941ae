#!/usr/bin/env python3
"""Whether designed motions keep to their limits, whatever these are, and whether the same seed gives the same bytes.

    design_limits.py PROGRAM [--designs 100] [--robot FILE] [--minutes 2]

Each design has limits, priors, minutes and a seed by chance. Of each the positions, velocities and accelerations of its motion are looked at between
all corners, and the friction of each of its draws at the motion's speeds against the torque. Of every tenth the bytes of a second run are compared.
With --robot its joints move together, and MuJoCo (of this Python) looks at links and torques along the motion; 0.01 m apart.
"""

import argparse
import json
import pathlib
import random
import subprocess
import tempfile

TINY = 1e-6  # of a limit: what nine decimals of a corner leave


def draw(chance):
    """Options, and the limits that they ask for."""
    fastest = 10 ** chance.uniform(-1, 0.5)
    slowest = fastest * 10 ** chance.uniform(-2, -0.5)
    acceleration = fastest * 10 ** chance.uniform(0.3, 1.3)
    limits = {"velocity": (slowest, fastest), "acceleration": acceleration}
    if chance.random() < 0.8:
        lower = chance.uniform(-3, 3)
        limits["position"] = (lower, lower + fastest**2 / acceleration * chance.uniform(6.1, 60))
    if chance.random() < 0.5:
        limits["torque"] = 10 ** chance.uniform(0, 2)
    texts = [f"{name}={value[0]!r}..{value[1]!r}" if isinstance(value, tuple) else f"{name}={value!r}" for name, value in limits.items()]
    options = ["--limits", ",".join(texts), "--minutes", chance.choice([2, 3, 5]), "--hold", round(10 ** chance.uniform(0.3, 1.3), 2),
               "--seed", chance.randrange(2**32), "--identifier", "nominal-ls", "--for", chance.choice(["D", "friction", "viscous"])]
    return options, limits


def corners(path):
    """{joint or "": [(time, position, velocity)]} of a motion.csv."""
    head, *rows = [line.split(",") for line in path.read_text().split()]
    names = [column.removesuffix("position").removesuffix("_") for column in head[1::2]]
    return {name: [(float(row[0]), float(row[1 + 2 * j]), float(row[2 + 2 * j])) for row in rows] for j, name in enumerate(names)}


def worst(motion, limits):
    """What breaks a limit, by name."""
    found = set()
    lower, upper = limits.get("position", (-1e9, 1e9))
    slack = TINY * max(1, abs(lower), abs(upper)) if "position" in limits else 0
    for (t0, q0, v0), (t1, q1, v1) in zip(motion, motion[1:], strict=False):
        slope = (v1 - v0) / (t1 - t0)
        inner = [q0, q1] + ([q0 - v0**2 / 2 / slope] if v0 * v1 < 0 else [])
        if min(inner) < lower - slack or max(inner) > upper + slack:
            found.add("position")
        if max(abs(v0), abs(v1)) > limits["velocity"][1] * (1 + TINY):
            found.add("velocity")
        # a ramp lasts v / a; its ends are known to 1e-9 s
        if abs(v1 - v0) > limits["acceleration"] * (t1 - t0 + 3e-9) * (1 + TINY) + 2e-9:
            found.add("acceleration")
    return found


def most_friction(friction, speed):
    return sum(value * (speed if name == "viscous" else 1) for name, value in friction["parameters"].items())


def single(program, folder, chance):
    """(violations, whether it was refused)"""
    options, limits = draw(chance)
    done = subprocess.run([program, "design", *map(str, options), "-o", folder / "a"], capture_output=True, text=True, check=False)
    if done.returncode == 2:
        return set(), True
    if done.returncode != 0:
        return {f"status {done.returncode}: {' '.join(map(str, options))}"}, False
    motion = corners(folder / "a/motion.csv")[""]
    found = worst(motion, limits)
    design = json.loads((folder / "a/design.json").read_text())
    if "torque" in limits:
        fastest = max(abs(one[2]) for one in motion)
        if any(most_friction(one["friction"], fastest) > limits["torque"] * (1 + 1e-6) for one in design["draws"]):
            found.add("torque")
    if chance.random() < 0.1:
        subprocess.run([program, "design", *map(str, options), "-o", folder / "b"], capture_output=True, check=True)
        if any((folder / "b" / path.name).read_bytes() != path.read_bytes() for path in (folder / "a").iterdir()):
            found.add("bytes")
    return found, False


def robots(program, folder, chance, file, minutes):
    """The same of a robot's joints."""
    import mujoco
    import numpy as np

    options = ["--joint", ".*", "--minutes", minutes, "--seed", chance.randrange(2**32), "--identifier", "nominal-ls", "--hold", round(chance.uniform(3, 12), 2),
               "--limits", f"velocity=0.05..{chance.uniform(0.3, 2):.3f},acceleration={chance.uniform(3, 10):.3f}"]
    done = subprocess.run([program, "design", file, *map(str, options), "-o", folder / "a"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {f"status {done.returncode}: {done.stderr}"}, False
    motions = corners(folder / "a/motion.csv")
    design = json.loads((folder / "a/design.json").read_text())
    found = set()
    for name, motion in motions.items():
        limits = design["joints"][name]["settings"]["limits"]
        found |= {f"{one} of {name}" for one in worst(motion, {key: tuple(value) if isinstance(value, list) else value
                                                              for key, value in limits.items() if value is not None})}
    # links and torques
    model = mujoco.MjModel.from_xml_path(file)
    data, torque = mujoco.MjData(model), np.zeros(model.nv)
    model.geom_margin[:] = 0.05
    table = np.array([motion for motion in motions.values()])
    places = [model.joint(name).qposadr[0] for name in motions]
    dofs = [model.joint(name).dofadr[0] for name in motions]
    touching = None
    efforts = [design["joints"][name]["settings"]["limits"]["torque"] or np.inf for name in motions]
    for time in np.arange(0, 60 * minutes, 0.0071):
        k = min(int(np.searchsorted(table[0, :, 0], time, side="right")), table.shape[1] - 1)
        before, after = table[:, k - 1], table[:, k]
        slope = (after[:, 2] - before[:, 2]) / (after[:, 0] - before[:, 0])
        passed = time - before[:, 0]
        data.qpos[places] = before[:, 1] + passed * (before[:, 2] + slope * passed / 2)
        data.qvel[dofs], data.qacc[dofs] = before[:, 2] + slope * passed, slope
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        near = {tuple(sorted(model.body_weldid[model.geom_bodyid[one.geom]])) for one in data.contact[: data.ncon] if one.dist < 0.01}
        touching = near if touching is None else touching
        # those that touch at the start touch in every pose, or it would not have begun there
        if near - touching:
            found.add("links")
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 1, torque)
        takes = np.abs(torque[dofs] + model.dof_armature[dofs] * data.qacc[dofs])
        if (takes > efforts).any():
            found.add("torque")
    return found, False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--designs", type=int, default=100)
    parser.add_argument("--robot")
    parser.add_argument("--minutes", type=int, default=2, help="of a robot's designs")
    asked = parser.parse_args()
    chance, broken, refused = random.Random(1), [], 0
    for number in range(asked.designs):
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made)
            found, no = robots(asked.program, folder, chance, asked.robot, asked.minutes) if asked.robot else single(asked.program, folder, chance)
        refused += no
        if found:
            broken.append(number)
            print(number, sorted(found), flush=True)
    print(f"{asked.designs} designs, {refused} refused, {len(broken)} of the others break a limit")


main()
