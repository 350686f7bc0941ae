"""How often intervals of identify-robot hold the truth, on logs of a robot whose description is wrong by a tenth.

    robot_wrong_inertials.py PROGRAM ROBOT.xml fourier|moves[+ripple|+coloured] REALIZATIONS OUT.json [OPTION of identify-robot]...

Aim: coverage of 95 % intervals and rms error over the reported deviation, by parameter, with the description as prior and, as peers take it
(least squares), as true. Data: 20 minutes at 100 Hz, sums of four sines a joint, or moves between six places with rests; rigid torque of the true robot by mj_inverse, friction with load (gravity and Coriolis) and warming, white noise; masses, places and
inertias of the description are off by 10 % each. One joint does not warm. No engine steps: nothing but the noise and the description is wrong. `+ripple` adds 5 % of the Coulomb friction as a sine of seven
turns of each joint, which no model has; `+coloured` as much noise again, of a correlation time of .3 s.
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


METHODS = {"the description as prior": [], "the description as true": ["--inertials", "exact"]}
POINTS = "points by least squares"
LOGARITHMS = ("thermal_time_constant", "gain")


def motion(kind, k, n, seconds=1200):
    random = np.random.default_rng(k)
    t = np.arange(0, seconds, STEP)
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


def row(seed, joint, method, key, truth, value, std, interval):
    """One parameter as a method answers it. Times constant and gain have errors of their logarithms."""
    error = np.log(value / truth) / (std / value) if key in LOGARITHMS else (value - truth) / std
    return {"seed": seed, "joint": joint, "method": method, "parameter": key, "truth": float(truth), "value": float(value), "std": float(std),
            "interval95": [float(one) for one in interval], "deviations": float(error), "holds": bool(interval[0] <= truth <= interval[1])}


def rows_of(answer, truth, seed, method):
    """What the program answers, a row a parameter; and what it claims of warming, a row a joint."""
    rows, claims = [], []
    for j, (joint, estimate) in enumerate(answer["joints"].items()):
        parameters, warms = estimate["parameters"], bool(truth["thermal_gain"][j])
        claims.append({"seed": seed, "joint": joint, "method": method, "ok": estimate["status"] == "ok", "warms": warms, "claimed": "thermal_gain" in parameters})
        for key, value in (*((key, one[j]) for key, one in truth.items()), ("gain", 1)):
            one = parameters.get(key)
            if one and one["interval95"] and (warms or not key.startswith("thermal")):
                rows.append(row(seed, joint, method, key, value, one["value"], one["std"], one["interval95"]))
    return rows, claims


def least_squares(t, q, torque, model, truth, seed, names):
    """Points by least squares with the description as true, rotor and load, as AURT fits them; white noise. A row a parameter."""
    v = np.gradient(q, STEP, axis=0)
    acc = np.gradient(v, STEP, axis=0)
    used = slice(2, -2, 5)
    v, acc, y = v[used], acc[used], torque[used]
    rigid, carried = torques(model, q[used], v, acc)
    rows = []
    for j, joint in enumerate(names):
        x = np.column_stack([v[:, j], v[:, j] > 0, -1.0 * (v[:, j] < 0), acc[:, j], np.abs(carried[:, j]) * np.sign(v[:, j])])
        moves = np.abs(v[:, j]) > .02 * np.abs(v[:, j]).max()
        x, left = x[moves], (y - rigid)[moves, j]
        inverse = np.linalg.pinv(x.T @ x)
        found = inverse @ (x.T @ left)
        variance = np.mean((left - x @ found) ** 2)
        weights = np.vstack([np.eye(5), [0, .5, .5, 0, 0]])
        for key, one in zip(("viscous", "coulomb_positive", "coulomb_negative", "rotor_inertia", "load_gain", "coulomb"), weights, strict=True):
            value, std = one @ found, np.sqrt(one @ inverse @ one * variance)
            rows.append(row(seed, joint, POINTS, key, truth[key][j], value, std, (value - 1.96 * std, value + 1.96 * std)))
    return rows


def report_of(rows, claims):
    """By method and kind of parameter: coverage with its p, rms error over deviation; warming found and claimed."""
    report = {}
    for method in dict.fromkeys(one["method"] for one in rows):
        own = [one for one in rows if one["method"] == method]
        said = [one for one in claims if one["method"] == method]
        here = report[method] = {"joints": len(said), "not ok": sum(not one["ok"] for one in said),
                                 "warm": sum(one["warms"] for one in said), "warming found": sum(one["warms"] and one["claimed"] for one in said),
                                 "warming claimed falsely": sum(one["claimed"] and not one["warms"] for one in said)} if said else {}
        for key in dict.fromkeys(one["parameter"] for one in own):
            these = [one for one in own if one["parameter"] == key]
            held = [one["holds"] for one in these]
            here[key] = {"of": len(held), "coverage": float(np.mean(held)),
                         "rms over deviation": float(np.sqrt(np.mean([one["deviations"] ** 2 for one in these]))), "p": _binomial(sum(held), len(held), .95)}
    return report


def described(robot, random):
    """A description whose masses, places and inertias are off by 10 % each."""
    wrong = passive(robot)
    wrong.body_mass[:] *= 1 + .1 * random.standard_normal(wrong.nbody)
    wrong.body_ipos[:] *= 1 + .1 * random.standard_normal((wrong.nbody, 3))
    wrong.body_inertia[:] *= 1 + .1 * random.standard_normal((wrong.nbody, 1))
    return wrong


def simulate(robot, kind, seed, motions, seconds=1200):
    """Time, positions, torques, the wrong description and the truth of one realization."""
    n = passive(robot).nv
    if seed % 3 not in motions:
        t, q, v, acc = motion(kind, seed % 3, n, seconds)
        motions[seed % 3] = (t, q, v, acc, *torques(passive(robot), q, v, acc))
    t, q, v, acc, rigid, carried = motions[seed % 3]
    return t, q, *measured(robot, seed, v, acc, rigid, carried)


def spoilt(by, seed, q, truth):
    """A torque that the model lacks."""
    if by == "ripple":
        return .05 * truth["coulomb"] * np.sin(7 * q)
    if by != "coloured":
        return 0
    n = q.shape[1]
    pole, drawn = np.exp(-STEP / .3), np.random.default_rng(9000 + seed).standard_normal(q.shape)
    noise = np.zeros_like(q)
    for i in range(1, len(q)):
        noise[i] = pole * noise[i - 1] + np.sqrt(1 - pole**2) * drawn[i]
    return np.where(np.arange(n) < n // 2, .5, .15) * noise


def measured(robot, seed, v, acc, rigid, carried):
    """Torques with friction, rotor and noise, the wrong description and the truth of one realization."""
    n = v.shape[1]
    truth, random = draw(seed, n)
    wrong = described(robot, random)
    noise = np.where(np.arange(n) < n // 2, .5, .15)
    return rigid + truth["rotor_inertia"] * acc + friction(truth, v, carried) + noise * random.standard_normal(v.shape), wrong, truth


def write(t, q, torque, file):
    """A log of all joints."""
    n = q.shape[1]
    header = ",".join(["time", *(f"q{j}" for j in range(n)), *(f"torque{j}" for j in range(n))])
    np.savetxt(file, np.column_stack([t, q, torque]), delimiter=",", header=header, comments="", fmt="%.9g")


def identify(program, robot, t, q, torque, folder, *options):
    """What identify-robot answers for a log, which it writes into a folder."""
    write(t, q, torque, folder / "log.csv")
    subprocess.run([program, "identify-robot", robot, folder / "log.csv", "-o", folder / "robot.json", *options], capture_output=True, check=False)
    return json.loads((folder / "robot.json").read_text())


def main():
    program, robot, kind, count, out, *options = sys.argv[1:]
    kind, _, by = kind.partition("+")
    motions, rows, claims = {}, [], []
    for seed in range(1, int(count) + 1):
        t, q, torque, wrong, truth = simulate(robot, kind, seed, motions)
        torque = torque + spoilt(by, seed, q, truth)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            mujoco.mj_saveModel(wrong, str(folder / "robot.mjb"))
            for method, own in METHODS.items():
                answer = identify(program, folder / "robot.mjb", t, q, torque, folder, *own, *options)
                found, said = rows_of(answer, truth, seed, method)
                rows += found
                claims += said
        rows += least_squares(t, q, torque, wrong, truth, seed, list(answer["joints"]))
        kept = {"robot": pathlib.Path(robot).stem, "motion": f"{kind} {by}".strip(), "realizations": seed, "report": report_of(rows, claims), "claims": claims, "rows": rows}
        pathlib.Path(out).write_text(json.dumps(kept) + "\n", encoding="utf-8")
        print(f"{seed} of {count}", flush=True)
    print(json.dumps(kept["report"], indent=2))


def _binomial(k, n, p):
    """P(at most k of n) at a rate of p."""
    log = np.concatenate([[0], np.cumsum(np.log(np.arange(1, n + 1)))])
    i = np.arange(k + 1)
    return float(np.sum(np.exp(log[n] - log[i] - log[n - i] + i * np.log(p) + (n - i) * np.log(1 - p))))


if __name__ == "__main__":
    main()
