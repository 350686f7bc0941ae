"""Whether the intervals of a robot's joints hold where something is there that the model lacks. Printed, not tested.

    tests/studies/robot_fields.py WARMJOINT ROBOT.xml [SEEDS [JOBS [OPTION of identify-robot]...]]        default: 2 seeds, one job

Each log is 300 s at 100 Hz of a robot whose description is wrong by 10 %, in four motions: six places in a fixed order, places in random order,
teleoperation, and sums of sines. In each case something else is there: nothing; a ripple of the torque over the angle, of 5 % of the Coulomb
friction; one of the friction; many of both; a drift of the friction by 5 %; a curve over the speed. The truth is the mean over the samples at
which the joint moves: friction at the speeds that the answer has, Coulomb friction, and, but under the curve, viscous friction. The mean of
a torque counts as friction that differs between the directions, from which no log tells it.
Prints for each case and motion the share of 95 % intervals that hold and the median half width in per cent: of viscous, of Coulomb friction in
both directions, of the friction at speeds. Needs NumPy and MuJoCo.
"""

import pathlib
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np
import robot_wrong_inertials as robots

STEP = robots.STEP
LENGTH = 300.0  # s
CASES = ("nothing", "torque", "friction", "many", "drift", "curve")
MOTIONS = ("six places", "random order", "teleoperation", "fourier")


def reaches(random, n, goals):
    """Moves of one to three seconds by fifth-order polynomials, with rests. goals: of the next place"""
    place, track = goals(0), []
    k = 1
    while len(track) * STEP < LENGTH:
        goal, time = goals(k), random.uniform(1, 3)
        s = np.arange(0, time, STEP)[:, None] / time
        track += list(place + (goal - place) * (10 * s**3 - 15 * s**4 + 6 * s**5))
        track += [goal] * int(random.uniform(0.1, 0.6) / STEP)
        place, k = goal, k + 1
    return np.array(track[: int(LENGTH / STEP)])


def motion(kind, random, n):
    """Angles. [N x n] rad"""
    centre = np.resize([0, -1.5, 1.5, -1.5, -1.5, 0], n)
    time = np.arange(0, LENGTH, STEP)
    if kind == "six places":
        places = centre + random.uniform(-0.8, 0.8, (6, n))
        return reaches(random, n, lambda k: places[k % 6])
    if kind == "random order":
        return reaches(random, n, lambda _: centre + random.uniform(-0.8, 0.8, n))
    if kind == "teleoperation":
        # a hand: noise between .03 and .5 Hz
        w = 2 * np.pi * np.exp(random.uniform(np.log(0.03), np.log(0.5), (24, n)))
        a = random.normal(size=(24, n)) * 0.12 * (2 * np.pi * 0.1 / w) ** 0.5
    else:
        w, a = 2 * np.pi * random.uniform(0.03, 0.25, (4, n)), random.uniform(0.05, 0.35, (4, n))
    phase = random.uniform(0, 2 * np.pi, w.shape)
    return centre + sum(a[i] * np.sin(np.outer(time, w[i]) + phase[i]) for i in range(len(w)))


def waves(random, place, case):
    """A ripple over the angle, rms 1: one sine, or many and worn places."""
    if case != "many":
        return np.sqrt(2) * np.sin(random.uniform(4, 14) * place + random.uniform(0, 6.3))
    wave = sum(random.normal() * np.sin(random.uniform(2, 16) * place + random.uniform(0, 6.3)) for _ in range(4))
    wave += sum(2 * random.normal() * np.exp(-0.5 * ((place - random.choice(place)) / random.uniform(0.1, 0.2)) ** 2) for _ in range(2))
    return (wave - wave.mean()) / max(wave.std(), 1e-9)


def lacking(case, random, place, velocity, level):
    """What the model lacks: torque and friction along the log, and a curve over the speed. level: Coulomb friction, N.m"""
    torque, friction, curve = np.zeros(len(place)), np.zeros(len(place)), lambda speed: 0 * speed
    if case in ("torque", "many"):
        torque = 0.05 * level * waves(random, place, case)
    if case in ("friction", "many"):
        friction = 0.05 * level * waves(random, place, case)
    if case == "drift":
        walk = np.cumsum(random.normal(size=len(place)))
        friction = 0.05 * level * (walk - walk.mean()) / (np.ptp(walk) / 2)
    if case == "curve":
        fast = np.quantile(np.abs(velocity), 0.95)
        rise, width = random.uniform(0.15, 0.35) * level, random.uniform(0.08, 0.25) * fast
        curve = lambda speed: rise / (1 + (speed / width) ** 2)
    return torque, friction, curve


def simulate(robot, kind, case, seed):
    """Time, angles and torques of a log, the description, and the truth of each joint."""
    random = np.random.default_rng([seed, MOTIONS.index(kind)])
    model = robots.passive(robot)
    n = model.nv
    time = np.arange(0, LENGTH, STEP)
    q = motion(kind, random, n)
    v = np.gradient(q, STEP, axis=0)
    a = np.gradient(v, STEP, axis=0)
    rigid, carried = robots.torques(model, q, v, a)
    truth, draws = robots.draw(seed, n)
    wrong = robots.described(robot, draws)
    noise = np.where(np.arange(n) < n // 2, 0.5, 0.15)
    torque = rigid + truth["rotor_inertia"] * a + noise * random.standard_normal(v.shape)
    joints = []
    for j in range(n):
        sign, speed = np.sign(v[:, j]), np.abs(v[:, j])
        level = truth["coulomb"][j]
        load, friction, curve = lacking(case, random, q[:, j], v[:, j], level)
        over_load = truth["load_gain"][j] * np.abs(carried[:, j])
        coulomb = np.where(sign > 0, truth["coulomb_positive"][j], truth["coulomb_negative"][j])
        torque[:, j] += load + sign * (coulomb + truth["viscous"][j] * speed + curve(speed) + friction + over_load)
        moves = speed > 0.02 * speed.max()
        joints.append({"viscous": None if case == "curve" else truth["viscous"][j], "curve": curve,
                       "coulomb_positive": truth["coulomb_positive"][j] + friction[moves].mean() + load[moves].mean(),
                       "coulomb_negative": truth["coulomb_negative"][j] + friction[moves].mean() - load[moves].mean(),
                       "slope": truth["viscous"][j], "load": truth["load_gain"][j], "carried": np.abs(carried[:, j]), "velocity": v[:, j]})
    return time, q, torque, wrong, joints


def true_friction(joint, speed):
    """The friction at a signed speed, under the mean load of the samples near it."""
    level = joint["coulomb_positive"] if speed > 0 else joint["coulomb_negative"]
    nearest = np.argsort(np.abs(joint["velocity"] - speed))[: len(joint["velocity"]) // 20]
    load = joint["load"] * joint["carried"][nearest].mean()
    return level + joint["slope"] * abs(speed) + joint["curve"](abs(speed)) + load


def judge(answer, joints):
    """Rows (what, holds, half width in per cent, error in per cent), and the number of joints that are not ok."""
    rows, refused = [], 0
    for estimate, joint in zip(answer["joints"].values(), joints, strict=True):
        if estimate["status"] != "ok":
            refused += 1
            continue
        truths = {"viscous": joint["viscous"]}
        if joint["viscous"] is not None:
            truths |= {name: joint[name] for name in ("coulomb_positive", "coulomb_negative")}
        for name, truth in truths.items():
            row = estimate["parameters"].get(name)
            if truth is None or not row or not row["interval95"]:
                continue
            low, high = row["interval95"]
            rows.append(("coulomb" if "coulomb" in name else name, low <= truth <= high, 50 * (high - low) / truth, 100 * abs(row["value"] / truth - 1)))
        if joint["load"]:
            continue  # which load an answer's figure is under, only the program knows to the last per cent
        for row in estimate["friction_at_speeds"]:
            truth = true_friction(joint, row["speed"])
            low, high = row["interval95"]
            rows.append(("at speeds", low <= truth <= high, 50 * (high - low) / truth, 100 * abs(row["value"] / truth - 1)))
    return rows, refused


def one(program, robot, kind, case, seed, options):
    time, q, torque, wrong, joints = simulate(robot, kind, case, seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mujoco.mj_saveModel(wrong, str(folder / "robot.mjb"))
        answer = robots.identify(program, folder / "robot.mjb", time, q, torque, folder, "--unit", "position=rad", *options)
    return judge(answer, joints)


def say(name, rows, refused):
    words = []
    for what in ("viscous", "coulomb", "at speeds"):
        own = [row for row in rows if row[0] == what]
        if own:
            held, half, error = np.mean([row[1] for row in own]), np.median([row[2] for row in own]), np.median([row[3] for row in own])
            words.append(f"{what} {held:.3f} of {len(own)} hold, +- {half:.2f} %, error {error:.2f} %")
    print(f"{name:28} {'; '.join(words)}; not ok: {refused}", flush=True)


def main():
    program, robot, *more = sys.argv[1:]
    seeds, jobs, options = int(more[0]) if more else 2, int(more[1]) if len(more) > 1 else 1, more[2:]
    for case in CASES:
        of_case, refused_in_all = [], 0
        for kind in MOTIONS:
            with ThreadPoolExecutor(jobs) as pool:
                answers = list(pool.map(lambda seed, kind=kind, case=case: one(program, robot, kind, case, seed, options), range(1, seeds + 1)))
            rows = [row for found, _ in answers for row in found]
            refused = sum(refused for _, refused in answers)
            say(f"{case}, {kind}", rows, refused)
            of_case += rows
            refused_in_all += refused
        say(f"{case}, all motions", of_case, refused_in_all)


if __name__ == "__main__":
    main()
