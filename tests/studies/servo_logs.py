#!/usr/bin/env python3
"""Servo joints that carry a weight: which structure `auto` takes, and whether its intervals hold the truth. Printed, not tested.

    tests/studies/servo_logs.py WARMJOINT [SEEDS [JOBS]]        default: 30 seeds, one job

Each seed draws a joint, a motion and a drive, and simulates them twice: without and with friction that grows with the load.
Each log is identified twice: by `identify LOG` and by `identify LOG --gravity sincos`. These are the four arms. What is in
the joint: viscous and Coulomb friction that warm by their loss, gravity as a sine of the angle, inertia, and in two arms a
load gain. What is not: a map, the Stribeck effect, a level for each direction, gravity free over the place, in two arms a load gain.
Prints for each arm the answers by status, the intervals that hold, and the structures that are not there; then each log.
Exit status 1 where a process ends by a signal, a log with its gravity given has no answer, less than 92 % of an arm's
intervals hold, or more than a tenth of an arm's logs have a structure that is not there. Needs NumPy.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

STEP = 1e-3  # s, of the simulation
ABSENT = ("position=map", "position=motor", "position-ridge", "motor-ridge", "stribeck", "law=asymmetric", "gravity=paired")


@dataclass
class Joint:
    viscous: float  # N.m.s/rad
    coulomb: float  # N.m
    thermal_gain: float  # N.m/W
    thermal_time_constant: float  # s
    gravity_sine: float  # N.m
    gravity_cosine: float
    inertia: float  # kg.m^2
    load_gain: float


@dataclass
class Drive:
    stiffness: float  # N.m/rad
    damping: float  # N.m.s/rad
    filter: float  # s, each of two poles of the torque
    every: int  # steps a sample
    resolution: float  # rad, of the angle
    noise_velocity: float  # rad/s
    noise_torque: float  # N.m
    step_torque: float  # N.m


def draw(random):
    """A joint whose weight is 2 to 6 times its Coulomb friction, of which a warm-up takes a tenth to a third."""
    coulomb = math.exp(random.uniform(math.log(0.08), math.log(0.9)))
    weight, angle = coulomb * random.uniform(2, 6), random.uniform(-math.pi, math.pi)
    viscous, speed = coulomb * random.uniform(0.15, 0.4), 0.7
    loss = 0.6 * speed * (coulomb + viscous * speed)  # W, the joint moves in some 60 % of the time
    joint = Joint(viscous, coulomb, -coulomb * random.uniform(0.1, 0.33) / loss, random.uniform(120, 320),
                  weight * math.cos(angle), weight * math.sin(angle), 0.03 * weight * random.uniform(0.3, 1.2),
                  random.uniform(0.03, 0.09))
    drive = Drive(25 * weight, 0.8 * weight, random.uniform(1e-3, 6e-3), int(random.choice([10, 12, 16, 20])),
                  2 * math.pi / 2.0 ** random.integers(13, 17), random.uniform(0.002, 0.008), 0.08 * coulomb * random.uniform(0.5, 1.5),
                  coulomb / random.uniform(15, 80))
    return joint, drive


def wanted(random, samples):
    """Angles that a person asks for, rad: reaches of many lengths and durations, rests, and a hand that shakes. [samples]"""
    pieces, here, count = [], random.uniform(-0.5, 0.5), 0
    while count < samples:
        goal = float(np.clip(random.normal(0.2, 0.9), -1.4, 1.7))
        share = np.linspace(0, 1, max(2, int(random.uniform(0.3, 2.5) / STEP)), endpoint=False)
        pieces.append(here + (goal - here) * share**3 * (10 - 15 * share + 6 * share**2))  # least jerk
        if random.random() < 0.5:
            pieces.append(np.full(int(random.exponential(0.6) / STEP) + 1, goal))
        count, here = count + sum(len(piece) for piece in pieces[-2:] if len(piece)), goal
    angle = np.concatenate(pieces)
    angle = np.resize(angle, samples)
    # noise of some Hz, by a window of its period
    shake = np.convolve(random.standard_normal(samples + 399), np.hanning(400), "valid")
    return angle + random.uniform(0.002, 0.006) * shake / shake.std()


def simulate(joint, drive, angle):
    """Rows of time, angle, speed and filtered torque of a joint that sticks, slides and warms, under a controller. [n x 4]"""
    q, v, heat, last, first, second, rows = float(angle[0]), 0.0, 0.0, float(angle[0]), 0.0, 0.0, []
    take = STEP / (STEP + drive.filter)
    sine, cosine = joint.gravity_sine, joint.gravity_cosine
    for k, want in enumerate(angle.tolist()):
        gravity = sine * math.sin(q) + cosine * math.cos(q)
        torque = drive.stiffness * (want - q) + drive.damping * ((want - last) / STEP - v) + gravity
        last = want
        level = joint.coulomb + joint.thermal_gain * heat + joint.load_gain * abs(gravity)
        push = torque - gravity
        if v == 0 and abs(push) <= level:
            friction = push
        else:
            friction = math.copysign(level, v or push) + joint.viscous * v
            new = v + STEP * (push - friction) / joint.inertia
            v = 0.0 if v and new * v < 0 else new
        q += STEP * v
        heat += STEP * (friction * v - heat) / joint.thermal_time_constant
        first += take * (torque - first)
        second += take * (first - second)
        if k % drive.every == 0:
            rows.append((k * STEP, q, v, second))
    return np.array(rows)


def write(path, joint, drive, seed):
    random = np.random.default_rng([seed, 1])
    rows = simulate(joint, drive, wanted(random, int(random.uniform(10, 15) * 60 / STEP)))
    n = len(rows)
    rows[:, 1] = np.round(rows[:, 1] / drive.resolution) * drive.resolution
    rows[:, 2] += drive.noise_velocity * random.standard_normal(n)
    rows[:, 3] = np.round((rows[:, 3] + drive.noise_torque * random.standard_normal(n)) / drive.step_torque) * drive.step_torque
    np.savetxt(path, rows, delimiter=",", header="time,position,velocity,torque", comments="", fmt=["%.4f", "%.6f", "%.5f", "%.6f"])


def identify(program, log, arguments):
    """estimate.json, or {"status": ..} of a process that ended otherwise."""
    out = log.with_name(log.stem + ("_given" if arguments else "") + ".json")
    done = subprocess.run([program, "identify", log, *arguments, "-o", out], capture_output=True, text=True, check=False)
    if out.exists():
        return json.loads(out.read_text())
    return {"status": f"signal {-done.returncode}" if done.returncode < 0 else "bad input", "message": done.stderr}


def judge(estimate, joint, loaded):
    """(structure, words of it that are not there, {parameter: whether its interval holds})"""
    chosen = (estimate.get("choice") or {}).get("chosen", "-")
    absent = [word for word in (*ABSENT, *([] if loaded else ["load=estimated"])) if word in chosen]
    held = {}
    for name, row in (estimate.get("parameters") or {}).items() if estimate["status"] == "ok" else ():
        truth = 0 if name == "load_gain" and not loaded else getattr(joint, name, None)
        if truth is not None and row.get("interval95"):
            low, high = row["interval95"]
            held[name] = low <= truth <= high
    return chosen, absent, held


def study(program, seed, folder):
    """[(load, given, status, structure, absent, held)] of one seed"""
    results = []
    for loaded in (False, True):
        joint, drive = draw(np.random.default_rng(seed))
        if not loaded:
            joint.load_gain = 0.0
        log = pathlib.Path(folder, f"servo_{seed}{'_load' * loaded}.csv")
        write(log, joint, drive, seed)
        for given in (False, True):
            estimate = identify(program, log, ["--gravity", "sincos"] * given)
            results.append((seed, loaded, given, estimate["status"], *judge(estimate, joint, loaded)))
        log.unlink()
    return results


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    seeds = range(1, 1 + int(sys.argv[2] if len(sys.argv) > 2 else 30))
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(int(sys.argv[3]) if len(sys.argv) > 3 else 1) as pool:
        results = [one for part in pool.map(lambda seed: study(sys.argv[1], seed, folder), seeds) for one in part]
    failed = False
    for loaded in (False, True):
        for given in (False, True):
            arm = [one for one in results if one[1:3] == (loaded, given)]
            held = [holds for *_, each in arm for holds in each.values()]
            by_name = {name: [each[name] for *_, each in arm if name in each] for *_, each in arm for name in each}
            absent = sum(bool(one[5]) for one in arm)
            ok = sum(one[3] == "ok" for one in arm)
            print(f"{'with' if loaded else 'no'} load, {'--gravity sincos' if given else 'no option'}: ok {ok} of {len(arm)}; "
                  f"{sum(held)} of {len(held)} intervals hold ({100 * sum(held) / max(len(held), 1):.1f} %); "
                  f"a structure that is not there in {absent}")
            print("   ", ", ".join(f"{name} {sum(each)}/{len(each)}" for name, each in sorted(by_name.items())))
            signals = [one[3] for one in arm if one[3].startswith("signal")]
            failed |= bool(signals) or (given and ok < len(arm)) or sum(held) < 0.92 * len(held) or absent > 0.1 * len(arm)
    for seed, loaded, given, status, chosen, absent, held in results:
        missed = [name for name, holds in held.items() if not holds]
        print(f"{seed:3} {'load' if loaded else '-':4} {'given' if given else '-':5} {status:16} {chosen}"
              + (f"  not there: {' '.join(absent)}" if absent else "") + (f"  misses: {' '.join(missed)}" if missed else ""))
    return failed


if __name__ == "__main__":
    sys.exit(main())
