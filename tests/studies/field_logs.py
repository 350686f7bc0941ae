#!/usr/bin/env python3
"""Whether intervals with fields hold, on simulated joints whose model lacks something. Printed, not tested.

    tests/studies/field_logs.py WARMJOINT [SEEDS [JOBS [OPTION]...]]        default: 4 seeds, one job, --set fields=auto

Each seed draws a joint with viscous and Coulomb friction, gravity as a sine, inertia and a constant torque, and lets it move in five ways,
with white and with autocorrelated noise: 60 s at 100 Hz. In each case something else is there: nothing; a ripple of the torque and of the
friction over the place, of 5 or 10 % of the Coulomb friction; a drift of the friction by 5 or 10 %; both; a curve over the speed;
a fall by a quarter as of a joint that warms. `identify --identifier nominal-ls --gravity sincos` answers. The truth is the mean over
the samples at which the joint moves: friction at the speeds that the answer has.
Prints for each case: answers that are ok, the share of their 95 % intervals that hold, the median half width and error, in per cent of the
friction; the worst motion. Needs NumPy.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np

STEP = 0.01  # s
LENGTH = 60.0  # s
CASES = ("nothing", "ripple 5", "ripple 10", "drift 5", "drift 10", "ripple 5 drift 5", "bent", "falls")
MOTIONS = ("holds", "reaches", "sine", "fourier", "one speed")


def smooth(x, width):
    """Moving mean over so many samples, twice."""
    kernel = np.ones(width) / width
    return np.convolve(np.convolve(x, kernel, "same"), kernel, "same")


def holds(random, speeds):
    velocity, direction = [], 1
    while len(velocity) * STEP < LENGTH:
        speed = speeds[(len(velocity) // 97) % len(speeds)] * random.uniform(0.97, 1.03)
        velocity += [direction * speed] * int(max(0.7, random.uniform(1.4, 2.2) / speed) / STEP)
        direction = -direction
    return smooth(np.array(velocity[: int(LENGTH / STEP)]), 9)


def reaches(random):
    """Moves between random places by fifth-order polynomials, with short rests."""
    place, track = 0.0, []
    while len(track) * STEP < LENGTH:
        goal, time = random.uniform(-1.2, 1.2), random.uniform(0.8, 3)
        s = np.arange(0, time, STEP) / time
        track += list(place + (goal - place) * (10 * s**3 - 15 * s**4 + 6 * s**5))
        track += [goal] * int(random.uniform(0, 0.4) / STEP)
        place = goal
    return np.gradient(np.array(track[: int(LENGTH / STEP)]), STEP)


def velocity_of(motion, random):
    time = np.arange(0, LENGTH, STEP)
    if motion == "holds":
        return holds(random, [0.12, 0.9, 0.25, 1.3, 0.5])
    if motion == "one speed":
        return holds(random, [0.45])
    if motion == "reaches":
        return reaches(random)
    if motion == "sine":
        return 0.85 * np.sin(2 * np.pi * random.uniform(0.09, 0.16) * time)
    waves = 2 * np.pi * np.array([0.04, 0.08, 0.12, 0.16, 0.2])
    return sum(random.uniform(0.1, 0.4) * w * np.cos(w * time + random.uniform(0, 6.3)) for w in waves) * 1.3


def ripple(random, place):
    """A gear with teeth, an eccentricity and two worn places; rms 1."""
    wave = random.normal() * np.sin(random.uniform(9, 16) * place + random.uniform(0, 6.3))
    wave += random.normal() * np.cos(random.uniform(1.5, 4) * place + random.uniform(0, 6.3))
    for _ in range(2):
        wave += random.normal() * 2 * np.exp(-0.5 * ((place - random.uniform(-1, 1)) / random.uniform(0.08, 0.2)) ** 2)
    wave -= wave.mean()
    return wave / max(wave.std(), 1e-9)


def drift(random, time):
    """A random walk, a bend or a wave; from -1 to 1 at most."""
    kind = random.integers(3)
    if kind == 0:
        walk = smooth(np.cumsum(random.normal(size=len(time))), 301)
        return (walk - walk.mean()) / max(np.ptp(walk) / 2, 1e-9)
    if kind == 1:
        return random.choice([-1, 1]) * (2 * (time / LENGTH) ** random.uniform(0.4, 2.5) - 1)
    return np.sin(2 * np.pi * random.uniform(0.5, 1.6) * time / LENGTH + random.uniform(0, 6.3))


def simulate(case, motion, noise, seed):
    random = np.random.default_rng([seed, MOTIONS.index(motion), noise == "coloured"])
    time = np.arange(0, LENGTH, STEP)
    velocity = velocity_of(motion, random)
    place = np.cumsum(velocity) * STEP
    place -= place.mean()
    coulomb, viscous, inertia = random.uniform(2, 9), random.uniform(1, 5), random.uniform(0.2, 1.2)
    weight = random.uniform(-6, 6, 2)
    words = case.split()
    share = {word: float(words[i + 1]) / 100 for i, word in enumerate(words) if word in ("ripple", "drift")}
    friction, torque = np.zeros(len(time)), np.full(len(time), random.normal(0, 0.3))
    if "ripple" in share:
        friction += coulomb * share["ripple"] * ripple(random, place)
        torque += coulomb * share["ripple"] * ripple(random, place)
    if "drift" in share:
        friction += coulomb * share["drift"] / 2 * drift(random, time)
    if case == "falls":
        friction -= 0.25 * coulomb * (1 - np.exp(-time / random.uniform(10, 40)))
    rise, width, power = random.uniform(0.15, 0.4), random.uniform(0.06, 0.25), random.uniform(0.5, 0.9)

    def curve(speed):
        if case != "bent":
            return coulomb + viscous * speed
        return coulomb * (1 + rise / (1 + (speed / width) ** 2)) + viscous * speed**power

    torque += np.sign(velocity) * (curve(np.abs(velocity)) + friction) + inertia * np.gradient(velocity, STEP)
    torque += weight[0] * np.sin(place) + weight[1] * np.cos(place)
    error = random.normal(size=len(time))
    if noise == "coloured":
        for i in range(1, len(error)):
            error[i] = 0.93 * error[i - 1] + math.sqrt(1 - 0.93**2) * error[i]
    torque += coulomb * (0.06 if noise == "white" else 0.04) * error
    moves = np.abs(velocity) > 0.04 * np.quantile(np.abs(velocity), 0.98)
    return np.column_stack([time, place, velocity, torque]), lambda speed: curve(abs(speed)) + friction[moves].mean()


def identify(program, options, case, motion, noise, seed):
    log, truth = simulate(case, motion, noise, seed)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        np.savetxt(path / "log.csv", log, delimiter=",", header="time,position,velocity,torque", comments="", fmt="%.9g")
        done = subprocess.run([program, "identify", path / "log.csv", "--identifier", "nominal-ls", "--gravity", "sincos", *options,
                               "-o", path / "out.json"], capture_output=True, text=True, timeout=600)
        answer = json.loads((path / "out.json").read_text()) if done.returncode in (0, 3) else {"status": "failed: " + done.stderr}
    figures = [(one["value"] - truth(one["speed"]), (one["interval95"][1] - one["interval95"][0]) / 2, truth(one["speed"]))
               for one in answer.get("friction_at_speeds", [])]
    return {"case": case, "motion": motion, "noise": noise, "seed": seed, "status": answer["status"], "figures": figures,
            "message": answer.get("message", "")}


def show(case, rows):
    ok = [row for row in rows if row["status"] == "ok"]
    figures = [(row["motion"], *figure) for row in ok for figure in row["figures"]]
    if not figures:
        print(f"{case:18s} ok 0 of {len(rows)}")
        return
    hold = np.array([abs(error) <= half for _, error, half, _ in figures])
    share = {motion: hold[[one[0] == motion for one in figures]] for motion in MOTIONS}
    share = {motion: held.mean() for motion, held in share.items() if len(held)}
    worst = min(share, key=share.get)
    print(f"{case:18s} ok {len(ok):4d} of {len(rows):4d}  hold {hold.mean():.3f} of {len(hold):5d}  half width "
          f"{100 * np.median([half / size for _, _, half, size in figures]):5.2f} %  error "
          f"{100 * np.median([abs(error) / size for _, error, _, size in figures]):5.2f} %  worst {worst} {share[worst]:.2f}", flush=True)


def main():
    program = sys.argv[1]
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 4
    jobs = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    options = sys.argv[4:] or ["--set", "fields=auto"]
    everything = []
    with ThreadPoolExecutor(jobs) as pool:
        for case in CASES:
            work = [pool.submit(identify, program, options, case, motion, noise, seed)
                    for seed in range(seeds) for motion in MOTIONS for noise in ("white", "coloured")]
            rows = [one.result() for one in work]
            show(case, rows)
            everything += rows
    show("all", everything)
    for row in everything:
        if row["status"] != "ok":
            print(f"{row['case']}, {row['motion']}, {row['noise']}, seed {row['seed']}: {row['status']}: {row['message'][:200]}")


main()
