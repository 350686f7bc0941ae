#!/usr/bin/env python3
"""Joints that warm while their friction drifts for another reason: is the warming told, and do intervals hold? Printed, not tested.

    tests/studies/warming_drift.py WARMJOINT [LOGS [OPTION of identify]...]        default: 8 logs of each group, --fields auto

A joint like that of Table I (viscous 5 N.m.s/rad, Coulomb 15 N.m, tau 600 s, each drawn within a factor of 1.3; noise .5 N.m) moves for 20 to
60 minutes at 20 Hz, at held random speeds or by reaches. Its thermal gain is strong (-3 s/rad), weak (-.3) or 0; its friction drifts by a random walk
of 3, 5 or 10 % rms, by half a sine of 10 %, or not. Prints for each group: answers by status, claims of a warming (an ok answer whose gain has its
interval wholly below 0), the share of 95 % intervals that hold of viscous, Coulomb, gain and tau, and their median half widths in %. Of an answer without
warming the true Coulomb friction has the mean of heat and drift in it.
Needs NumPy.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
from collections import Counter

import numpy as np

STEP = 0.05  # s
GROUPS = [(gain, drift) for gain in (-3.0, -0.3, 0.0) for drift in ("none", "walk 3", "walk 5", "walk 10", "half sine")]
NAMES = ("viscous", "coulomb", "thermal_gain", "thermal_time_constant")


def held(random, count):
    velocity = []
    while len(velocity) < count:
        velocity += [random.choice([-1, 1]) * random.uniform(0.1, 1)] * int(random.uniform(3, 12) / STEP)
    return np.array(velocity[:count])


def reaches(random, count):
    place, track = 0.0, []
    while len(track) < count:
        goal, time = random.uniform(-1.2, 1.2), random.uniform(0.8, 3)
        s = np.arange(0, time, STEP) / time
        track += list(place + (goal - place) * (10 * s**3 - 15 * s**4 + 6 * s**5)) + [goal] * int(random.uniform(0, 0.4) / STEP)
        place = goal
    return np.gradient(np.array(track[:count]), STEP)


def drift_of(kind, random, count):
    """A share of the Coulomb friction, from 0 at the start. [count]"""
    x = np.linspace(0, 1, count)
    if kind == "none":
        return np.zeros(count)
    if kind == "half sine":
        return random.choice([-0.1, 0.1]) * np.sin(np.pi * x)
    walk = np.cumsum(random.standard_normal(count))
    return walk / np.sqrt(np.mean(walk**2)) * float(kind.split()[1]) / 100


def log_of(gain, drift, seed):
    """Rows of time, position, velocity and torque, the truth by name, and that of an answer without warming."""
    random = np.random.default_rng([seed, round(-10 * gain), len(drift), ord(drift[-1])])
    count = int(random.uniform(1200, 3600) / STEP)
    scale = lambda: np.exp(random.uniform(-1, 1) * np.log(1.3))
    truth = dict(zip(NAMES, (5 * scale(), 15 * scale(), gain * scale(), 600 * scale())))
    velocity = (held if seed % 2 else reaches)(random, count)
    speed, sign = np.abs(velocity), np.sign(velocity)
    cold = truth["viscous"] * speed + truth["coulomb"]
    pole, energy = np.exp(-STEP / truth["thermal_time_constant"]), np.empty(count)
    heat = 0.0
    for i in range(count):
        energy[i] = heat
        heat = pole * heat + (1 - pole) * truth["thermal_gain"] * speed[i] * (cold[i] + heat)
    level = cold + energy + truth["coulomb"] * drift_of(drift, random, count)
    torque = sign * level + 0.5 * random.standard_normal(count)
    position = np.concatenate([[0], np.cumsum((velocity[1:] + velocity[:-1]) / 2) * STEP])
    # of an answer without warming: Coulomb friction with the mean of heat and drift
    mean = {"viscous": truth["viscous"], "coulomb": np.mean((level - truth["viscous"] * speed)[speed > 0.02])}
    return np.column_stack([np.arange(count) * STEP, position, velocity, torque]), truth, mean


def answer(program, folder, rows, options):
    np.savetxt(folder / "log.csv", rows, delimiter=",", header="time,position,velocity,torque", comments="", fmt="%.8g")
    done = subprocess.run([program, "identify", "-q", "--start", "cold", folder / "log.csv", *options, "-o", folder / "estimate.json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 2, 3):
        raise SystemExit(f"exit status {done.returncode}\n{done.stderr}")
    return json.loads((folder / "estimate.json").read_text())


def main():
    program, logs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 8
    options = sys.argv[3:] or ["--fields", "auto"]
    for gain, drift in GROUPS:
        status, claims, widths = Counter(), 0, {name: [] for name in NAMES}
        holds = {name: [] for name in NAMES}
        for seed in range(1, logs + 1):
            rows, warm, mean = log_of(gain, drift, seed)
            with tempfile.TemporaryDirectory() as folder:
                found = answer(program, pathlib.Path(folder), rows, options)
            status[found["status"]] += 1
            if found["status"] != "ok":
                continue
            truth = warm if "thermal_gain" in found["parameters"] else mean
            for name in NAMES:
                interval = (found["parameters"].get(name) or {}).get("interval95")
                if not interval:
                    continue
                claims += name == "thermal_gain" and interval[1] < 0
                if gain or name in NAMES[:2]:
                    holds[name].append(interval[0] <= truth[name] <= interval[1])
                    widths[name].append(50 * (interval[1] - interval[0]) / abs(truth[name]))
        share = lambda values: f"{np.mean(values):.2f}" if values else " -  "
        print(f"gain {gain:4}, {drift:10s} claims {claims:3} of {logs}  hold", *(share(holds[name]) for name in NAMES), " half widths",
              *(f"{np.median(widths[name]):.2g} %" if widths[name] else "-" for name in NAMES), " ", dict(status), flush=True)


if __name__ == "__main__":
    main()
