#!/usr/bin/env python3
"""What designed motions give against what was foretold of them, and against random speeds of the same minutes.

    designed_motion.py PROGRAM [--realizations 100] [--minutes 20]

Prints for a joint whose friction falls by two thirds, and for one that hardly warms, designed by an exact prior and by ranges: the standard
deviation of each parameter over the realizations, over the one that design.json has for it; the Cramer-Rao standard deviation of the time
constant, over the median of that of random speeds, of which each realization has others; and the same of three fifths of the minutes.
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


def designed(program, folder, prior, aim, minutes):
    """(corners, design.json)"""
    (folder / "prior.json").write_text(json.dumps(prior))
    call(program, "design", "--prior", folder / "prior.json", "--noise", 0.5, "--for", aim, "--minutes", minutes, "--identifier", "energy-ml",
         "--limits", "velocity=0.05..1", "-o", folder / "motion")
    rows = [line.split(",") for line in (folder / "motion/motion.csv").read_text().split()[1:]]
    return [[float(time), float(velocity)] for time, _, velocity in rows], json.loads((folder / "motion/design.json").read_text())


def estimates(program, folder, truth, motion, minutes, realizations):
    """[{parameter: value}] of realizations of an ideal joint."""
    suite = {"name": "designed", "question": "How well is it known?", "realizations": realizations, "seed": 1, "identifiers": [{"name": "energy-ml"}],
             "scenario": {"plant": "ideal", "friction": friction(truth), "motion": motion, "noise": {"torque": 0.5}, "sampling": {"rate": 20},
                          "duration": 60 * minutes}}
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--realizations", type=int, default=100)
    parser.add_argument("--minutes", type=float, default=20)
    asked = parser.parse_args()
    tau = "thermal_time_constant"
    for label, truth in (("strong", STRONG), ("weak", WEAK)):
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made)
            random = estimates(asked.program, folder, truth, {"speeds": {"uniform": [0.1, 1]}, "hold": 10}, asked.minutes, asked.realizations)
            for prior, what, minutes in ((friction(truth), "exact prior", asked.minutes), (ranges(truth), "ranges", asked.minutes),
                                         (friction(truth), "exact prior", 0.6 * asked.minutes)):
                corners, design = designed(asked.program, folder, prior, tau, minutes)
                rows = estimates(asked.program, folder, truth, {"corners": corners}, minutes, asked.realizations)
                foretold = design["foretold"][-1]["parameters"]
                over = ", ".join(f"{name} {statistics.stdev(values_of(rows, name)) / foretold[name]['std']:.3f}" for name in truth)
                print(f"{label}, {what}, {minutes:g} min, {len(values_of(rows, tau))} answers: realised over foretold {over}; "
                      f"bound of tau over the median of random speeds {median_bound(rows, tau) / median_bound(random, tau):.3f}", flush=True)


main()
