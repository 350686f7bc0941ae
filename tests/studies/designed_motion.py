#!/usr/bin/env python3
"""What designed motions give against what was foretold of them, and against random speeds of the same minutes.

    designed_motion.py PROGRAM [--realizations 100] [--minutes 20] [--robots]

Prints for a joint whose friction falls by two thirds, and for one that hardly warms, designed by an exact prior and by ranges: the standard
deviation of each parameter over the realizations, over the one that design.json has for it; the Cramer-Rao standard deviation of the time
constant, over the median of that of random speeds, of which each realization has others; and the same of three fifths of the minutes.

--robots: the first of these for a joint of three robots in MuJoCo, whose drives follow the motion, in the robots' own limits.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

STRONG = {"viscous": 5, "coulomb": 15, "thermal_gain": -3, "thermal_time_constant": 600}
WEAK = STRONG | {"thermal_gain": -0.1}


def friction(values):
    """What a friction file holds."""
    return {"law": "viscous_coulomb", "parameters": {name: values[name] for name in ("viscous", "coulomb")},
            "thermal": {name: values[name] for name in ("thermal_gain", "thermal_time_constant")}}


def ranges(values):
    """The same, with the time constant known to a factor of three and the gain to one of two."""
    gain = values["thermal_gain"]
    return friction(values) | {"thermal": {"thermal_gain": {"uniform": [2 * gain, gain / 2]},
                                           "thermal_time_constant": {"log_uniform": [200, 1800]}}}


def call(program, *words):
    return subprocess.run([program, *map(str, words)], check=True, capture_output=True, text=True).stdout


def designed(program, folder, prior, aim, minutes, noise=0.5, limits="velocity=0.05..1", robot=()):
    """(motion of a scenario, design.json)"""
    (folder / "prior.json").write_text(json.dumps(prior))
    call(program, "design", *robot, "--prior", folder / "prior.json", "--noise", noise, "--for", aim, "--minutes", minutes, "--identifier", "energy-ml",
         "--limits", limits, "-o", folder / "motion")
    rows = [[float(cell) for cell in line.split(",")] for line in (folder / "motion/motion.csv").read_text().split()[1:]]
    return ({"corners": [[time, velocity] for time, _, velocity in rows], "start": rows[0][1]},
            json.loads((folder / "motion/design.json").read_text()))


def estimates(program, folder, truth, motion, minutes, realizations, plant=None, noise=0.5):
    """[{parameter: value}] of realizations of a joint, an ideal one by default."""
    suite = {"name": "designed", "question": "How well is it known?", "realizations": realizations, "seed": 1, "identifiers": [{"name": "energy-ml"}],
             "scenario": {"plant": "ideal", "friction": friction(truth), "motion": motion, "noise": {"torque": noise}, "sampling": {"rate": 20},
                          "duration": 60 * minutes} | (plant or {})}
    (folder / "suite.yaml").write_text(json.dumps(suite))
    subprocess.run(["rm", "-rf", folder / "run"], check=True)
    call(program, "run", folder / "suite.yaml", "-o", folder / "run", "--jobs", 1)
    lines = [line.split(",") for line in (folder / "run/results.csv").read_text().splitlines()]
    return [dict(zip(lines[0], line, strict=False)) for line in lines[1:]]


def values_of(rows, name):
    """Of the answers that stand."""
    return [float(row[name]) for row in rows if row["status"] == "ok"]


def median_bound(rows, name):
    """Of the Cramer-Rao standard deviation, which depends on the motion of each realization."""
    return statistics.median(float(row[f"{name}_bound"]) for row in rows)


def over_foretold(rows, design, truth):
    """The standard deviation of each parameter over the one that was foretold, as text."""
    foretold = design["foretold"][-1]["parameters"]
    return ", ".join(f"{name} {statistics.stdev(values_of(rows, name)) / foretold[name]['std']:.3f}" for name in truth)


# robot and joint with a friction of the size of theirs, its noise and limits
ROBOTS = [("rotary", "hinge", STRONG, 0.5, "velocity=0.05..1"),
          ("irb140_like", "joint_1", {"viscous": 12, "coulomb": 23, "thermal_gain": -0.6, "thermal_time_constant": 400}, 0.8, "velocity=0.05..1.5"),
          ("linear_axis", "carriage", {"viscous": 200, "coulomb": 20, "thermal_gain": -4, "thermal_time_constant": 300}, 0.5,
           "velocity=0.005..0.1,acceleration=1")]


def on_robots(program, minutes, realizations):
    for robot, joint, truth, noise, limits in ROBOTS:
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made)
            motion, design = designed(program, folder, friction(truth), "D", minutes, noise, limits, (robot, "--joint", joint))
            plant = {"plant": "mujoco", "robot": robot, "joint": joint, "sampling": {"rate": 20, "sensor_rate": 200}}
            rows = estimates(program, folder, truth, motion, minutes, realizations, plant, noise)
            print(f"{robot}, {minutes:g} min, {len(values_of(rows, 'viscous'))} answers: realised over foretold {over_foretold(rows, design, truth)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--realizations", type=int, default=100)
    parser.add_argument("--minutes", type=float, default=20)
    parser.add_argument("--robots", action="store_true")
    asked = parser.parse_args()
    if asked.robots:
        return on_robots(asked.program, asked.minutes, asked.realizations)
    tau = "thermal_time_constant"
    for label, truth in (("strong", STRONG), ("weak", WEAK)):
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made)
            random = estimates(asked.program, folder, truth, {"speeds": {"uniform": [0.1, 1]}, "hold": 10}, asked.minutes, asked.realizations)
            for prior, what, minutes in ((friction(truth), "exact prior", asked.minutes), (ranges(truth), "ranges", asked.minutes),
                                         (friction(truth), "exact prior", 0.6 * asked.minutes)):
                motion, design = designed(asked.program, folder, prior, tau, minutes)
                rows = estimates(asked.program, folder, truth, motion, minutes, asked.realizations)
                print(f"{label}, {what}, {minutes:g} min, {len(values_of(rows, tau))} answers: realised over foretold {over_foretold(rows, design, truth)}; "
                      f"bound of tau over the median of random speeds {median_bound(rows, tau) / median_bound(random, tau):.3f}", flush=True)
    return None

main()
