"""How often intervals of identify-robot hold the truth, on logs of a robot whose description is wrong by a tenth.

    robot_wrong_inertials.py PROGRAM ROBOT.xml fourier|moves REALIZATIONS OUT.json [OPTION of identify-robot]...

Aim: coverage of 95 % intervals and rms error over the reported deviation, by parameter, with the description as prior and, as peers take it
(least squares), as true. Data: 20 minutes at 100 Hz, sums of four sines a joint, or moves between six places with rests; rigid torque of the true robot by mj_inverse, friction with load (gravity and Coriolis) and warming, white noise; masses, places and
inertias of the description are off by 10 % each. One joint does not warm. No engine steps: nothing but the noise and the description is wrong.
Prints each kind of parameter with the p of an exact binomial test against 95 %; failures count as such.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

STEP = .01  # s


METHODS = {"the description as prior": [], "least squares with the description as true": ["--inertials", "exact"]}


def motion(kind, k, n):
    random = np.random.default_rng(k)
    t = np.arange(0, 1200, STEP)
    centre = np.resize([0, -1.5, 1.5, -1.5, -1.5, 0], n)
    if kind == "moves":  # 2 s from place to place by a cosine, .6 s of rest
        places = centre + random.uniform(-.8, .8, (6, n))
        i, x = np.divmod(t, 2.6)
        x, i = np.clip(x / 2, 0, 1)[:, None], i.astype(int)
        way, w = places[(i + 1) % 6] - places[i % 6], np.pi / 2 * (x < 1)
        return t, places[i % 6] + way * (.5 - .5 * np.cos(np.pi * x)), way * .5 * w * np.sin(np.pi * x), way * .5 * w**2 * np.cos(np.pi * x)
    w, a, p = 2 * np.pi * random.uniform(.03, .25, (4, n)), random.uniform(.05, .35, (4, n)), random.uniform(0, 6.28, (4, n))
    q, v, acc = (sum(a[i] * w[i] ** m * np.sin(np.outer(t, w[i]) + p[i] + m * np.pi / 2) for i in range(4)) for m in range(3))
    return t, q + centre, v, acc


def passive(path):
    model = mujoco.MjModel.from_xml_path(path)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    for column in (model.dof_damping, model.dof_frictionloss, model.dof_armature, model.jnt_stiffness):
        column[:] = 0
    return model


def torques(model, q, v, acc):
    """Rigid torque, and its part by gravity and Coriolis forces."""
    data = mujoco.MjData(model)
    all_, carried = np.empty_like(q), np.empty_like(q)
    for i in range(len(q)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q[i], v[i], acc[i]
        mujoco.mj_inverse(model, data)
        all_[i], carried[i] = data.qfrc_inverse, data.qfrc_bias
    return all_, carried


def draw(seed, n):
    random = np.random.default_rng(5000 + seed)
    size = np.where(np.arange(n) < n // 2, 1, .25)
    truth = {"viscous": random.uniform(3, 12, n) * size, "coulomb_positive": random.uniform(4, 12, n) * size,
             "thermal_time_constant": random.uniform(150, 400, n), "thermal_gain": -random.uniform(.15, .4, n),
             "rotor_inertia": size * random.uniform(.8, 1.2, n), "load_gain": .04 * ((np.arange(n) % 5 == 1) | (np.arange(n) == 2)) * random.uniform(.5, 1.5, n)}
    truth["coulomb_negative"] = truth["coulomb_positive"] * random.uniform(.85, 1.15, n)
    truth["coulomb"] = (truth["coulomb_positive"] + truth["coulomb_negative"]) / 2
    truth["thermal_gain"][random.integers(n)] = 0
    return truth, random


def friction(truth, v, carried):
    sign, speed = np.sign(v), np.abs(v)
    level = truth["viscous"] * speed + truth["coulomb_positive"] * (v > 0) + truth["coulomb_negative"] * (v < 0) + truth["load_gain"] * np.abs(carried)
    pole, force, energy = np.exp(-STEP / truth["thermal_time_constant"]), np.empty_like(v), np.zeros(v.shape[1])
    for i in range(len(v)):
        now = np.maximum(level[i] + energy, 0)
        force[i] = sign[i] * now
        energy = pole * energy + (1 - pole) * truth["thermal_gain"] * speed[i] * now
    return force


class Count:
    """What one method answers, beside the truth."""

    def __init__(self):
        self.found, self.claimed, self.warm, self.failed = {}, 0, 0, 0

    def add(self, answer, truth):
        for j, estimate in enumerate(answer["joints"].values()):
            parameters = estimate["parameters"]
            self.failed += estimate["status"] != "ok"
            warms = truth["thermal_gain"][j] != 0
            self.warm += warms and "thermal_gain" in parameters
            self.claimed += not warms and "thermal_gain" in parameters
            for key, value in (*((key, one[j]) for key, one in truth.items()), ("gain", 1)):
                one = parameters.get(key)
                if one and one["interval95"] and (warms or not key.startswith("thermal")):
                    lower, upper = one["interval95"]
                    self.found.setdefault(key, []).append((lower <= value <= upper, (one["value"] - value) / one["std"]))

    def report(self):
        report = {"not ok": self.failed, "warming found": self.warm, "warming claimed falsely": self.claimed}
        for key, rows in self.found.items():
            held = [one[0] for one in rows]
            report[key] = {"of": len(held), "coverage": float(np.mean(held)), "rms over deviation": float(np.sqrt(np.mean([one[1] ** 2 for one in rows]))),
                           "p": _binomial(sum(held), len(held), .95)}
        return report


def simulate(robot, kind, seed, motions):
    """Time, positions, torques, the wrong description and the truth of one realization."""
    n = passive(robot).nv
    if seed % 3 not in motions:
        t, q, v, acc = motion(kind, seed % 3, n)
        motions[seed % 3] = (t, q, v, acc, *torques(passive(robot), q, v, acc))
    t, q, v, acc, rigid, carried = motions[seed % 3]
    truth, random = draw(seed, n)
    wrong = passive(robot)
    wrong.body_mass[:] *= 1 + .1 * random.standard_normal(wrong.nbody)
    wrong.body_ipos[:] *= 1 + .1 * random.standard_normal((wrong.nbody, 3))
    wrong.body_inertia[:] *= 1 + .1 * random.standard_normal((wrong.nbody, 1))
    noise = np.where(np.arange(n) < n // 2, .5, .15)
    torque = rigid + truth["rotor_inertia"] * acc + friction(truth, v, carried) + noise * random.standard_normal(v.shape)
    return t, q, torque, wrong, truth


def main():
    program, robot, kind, count, out, *options = sys.argv[1:]
    motions, counts = {}, {name: Count() for name in METHODS}
    for seed in range(1, int(count) + 1):
        t, q, torque, wrong, truth = simulate(robot, kind, seed, motions)
        n = q.shape[1]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            mujoco.mj_saveModel(wrong, str(folder / "robot.mjb"))
            header = ",".join(["time", *(f"q{j}" for j in range(n)), *(f"torque{j}" for j in range(n))])
            np.savetxt(folder / "log.csv", np.column_stack([t, q, torque]), delimiter=",", header=header, comments="", fmt="%.9g")
            for method, own in METHODS.items():
                subprocess.run([program, "identify-robot", folder / "robot.mjb", folder / "log.csv", "-o", folder / "robot.json", *own, *options],
                               capture_output=True, check=False)
                counts[method].add(json.loads((folder / "robot.json").read_text()), truth)
        report = {"robot": robot, "motion": kind, "realizations": seed, **{name: one.report() for name, one in counts.items()}}
        pathlib.Path(out).write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
        print(f"{seed} of {count}", flush=True)
    print(json.dumps(report, indent=2))


def _binomial(k, n, p):
    """P(at most k of n) at a rate of p."""
    log = np.concatenate([[0], np.cumsum(np.log(np.arange(1, n + 1)))])
    i = np.arange(k + 1)
    return float(np.sum(np.exp(log[n] - log[i] - log[n - i] + i * np.log(p) + (n - i) * np.log(1 - p))))


main()
