#!/usr/bin/env python3
"""Whether `check --until` stops with intervals that hold the truth, and where it foretold to stop.

    until.py PROGRAM [--runs 40] [--goal thermal_time_constant=3%] [--identifier energy-ml]

Each run is a joint drawn anew, at random speeds for an hour at 5 Hz. Prints how often the goal was reached, how often the interval at the stop
holds the truth, and the share of runs whose stop lies within 10 % of the minutes that were foretold at half of the time.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

JOINT = {"law": "viscous_coulomb", "parameters": {"viscous": {"uniform": [2, 10]}, "coulomb": {"uniform": [8, 20]}},
         "thermal": {"thermal_gain": {"uniform": [-4, -0.5]}, "thermal_time_constant": {"log_uniform": [200, 1200]}}}
SCENARIO = {"plant": "ideal", "friction": JOINT, "motion": {"speeds": {"uniform": [0.1, 1]}, "hold": 10}, "noise": {"torque": 0.5},
            "sampling": {"rate": 5}, "duration": 3600, "seed": 1}


def call(program, *words):
    return subprocess.run([program, *map(str, words)], check=False, capture_output=True, text=True).stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--goal", default="thermal_time_constant=3%")
    parser.add_argument("--identifier", default="energy-ml")
    asked = parser.parse_args()
    name = asked.goal.split("=")[0]
    stopped, held, ratios = 0, [], []
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        (folder / "scenario.yaml").write_text(json.dumps(SCENARIO))
        for run in range(asked.runs):
            call(asked.program, "simulate", folder / "scenario.yaml", "--realization", run, "-o", folder / "log")
            lines = (folder / "log/recording.csv").read_text().splitlines(keepends=True)
            truth = json.loads((folder / "log/truth.json").read_text())["friction"]

            def part(minutes, lines=lines):
                path = folder / "part.csv"
                path.write_text("".join(lines[:2 + round(60 * minutes * SCENARIO["sampling"]["rate"])]))
                return path

            def until(path):
                return json.loads(call(asked.program, "check", path, "--until", asked.goal, "--identifier", asked.identifier, "--format", "json"))

            found = until(folder / "log/recording.csv")
            if not found["reached"]:
                continue
            stopped += 1
            # what is known at the stop
            call(asked.program, "identify", part(found["minutes"]), "--identifier", asked.identifier, "-o", folder / "estimate.json")
            estimate = json.loads((folder / "estimate.json").read_text())
            known = {**truth["parameters"], **truth["thermal"]}
            if name == "friction":
                rows = [row for row in estimate["friction_at_speeds"] if not row.get("energy")]
                true = [known["viscous"] * abs(row["speed"]) + known["coulomb"] for row in rows]
                held += [row["interval95"][0] <= value <= row["interval95"][1] for row, value in zip(rows, true, strict=True)]
            else:
                lower, upper = estimate["parameters"][name]["interval95"]
                held.append(lower <= known[name] <= upper)
            # what was foretold at half of the time
            half = until(part(found["minutes"] / 2))
            if half["minutes_more"] is not None:
                ratios.append((half["minutes"] + half["minutes_more"]) / found["minutes"])
    print(f"{asked.goal}: {stopped} of {asked.runs} reached it; {100 * statistics.fmean(held):.0f} % of {len(held)} intervals hold; "
          f"{len(ratios)} were foretold at half time, median {statistics.median(ratios):.3f} of the minutes, "
          f"{100 * statistics.fmean(0.9 <= one <= 1.1 for one in ratios):.0f} % within 10 %")


main()
