#!/usr/bin/env python3
"""Joints that do not warm: how often does `identify` claim that they do? Printed, not tested.

    tests/studies/false_warming.py WARMJOINT [LOGS [FIRST]]        default: 42 logs of each kind, the first of seed 1

Each log is a joint drawn anew: its Coulomb friction from .1 to 20 N.m, its viscous friction a tenth to all of that at 1 rad/s, white noise of
1 to 4 % of it. The kinds differ in motion, rate, sensors, law and in noise that remembers: AR(1) of 2 % of the Coulomb friction. A claim is an
answer with the status ok whose thermal gain has its interval wholly below 0. Prints for each kind the claims, the answers with a thermal gain
at all, and the answers by status. Exit status 1 where more than a hundredth of all logs have a claim.
"""

import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
from collections import Counter

HOLDS = {"speeds": {"uniform": [0.1, 1]}, "hold": 20, "order": "alternating"}
SHORT = {**HOLDS, "hold": 5}
RAMPS = {"motion": SHORT, "controller": {"acceleration": 3}, "sampling": {"rate": 20}, "duration": 1800}
KINDS = {
    "1 Hz": {},
    "1 Hz, noise on the velocity": {"noise": {"velocity": 0.05}},
    "20 Hz with ramps": RAMPS,
    "5 Hz with ramps, no velocity": {**RAMPS, "sampling": {"rate": 5}, "disturbances": {"encoder": {"resolution": 1.5e-3}, "without_velocity": {}}},
    "rests of 5 minutes": {"motion": {**HOLDS, "rests": {"run": 600, "rest": 300}}},
    "moves with pauses, 20 Hz": {**RAMPS, "motion": {"moves": {"between": [-1.5, 1.5], "speed": 1, "acceleration": 3, "pause": 0.5}}},
    "harmonics, 20 Hz, 10 minutes": {"motion": {"fourier": {"period": 20, "harmonics": 5, "speed": 1.5}}, "sampling": {"rate": 20}, "duration": 600},
    "Stribeck": {"law": "stribeck"},
    "asymmetric": {"law": "asymmetric"},
    "noise that remembers 10 s": {"disturbances": {"coloured_noise": {"correlation_time": 10}}},
    "noise that remembers 100 s": {"disturbances": {"coloured_noise": {"correlation_time": 100}}},
    "noise that remembers 600 s": {"disturbances": {"coloured_noise": {"correlation_time": 600}}},
}


def scenario(kind, draw):
    """What a scenario file holds, of a drawn joint."""
    given = dict(KINDS[kind])
    law = given.pop("law", "viscous_coulomb")
    coulomb = math.exp(draw.uniform(math.log(0.1), math.log(20)))
    numbers = {"viscous": coulomb * math.exp(draw.uniform(math.log(0.1), 0)), "coulomb": coulomb}
    if law == "asymmetric":
        side = draw.uniform(0.02, 0.2) * coulomb
        numbers = {"viscous": numbers["viscous"], "coulomb_positive": coulomb + side, "coulomb_negative": coulomb - side}
    elif law == "stribeck":
        numbers |= {"static": coulomb * draw.uniform(1.1, 1.5), "stribeck_velocity": draw.uniform(0.1, 0.3)}
    made = {"plant": "ideal", "motion": HOLDS, "sampling": {"rate": 1}, "duration": 3600, **given, "friction": {"law": law, "parameters": numbers}}
    made["noise"] = {"torque": coulomb * draw.uniform(0.01, 0.04), **given.get("noise", {})}
    if "coloured_noise" in made.get("disturbances", {}):
        made["disturbances"] = {"coloured_noise": {**made["disturbances"]["coloured_noise"], "deviation": 0.02 * coulomb}}
    return made


def answer(program, folder, kind, seed):
    """What estimate.json holds of one log."""
    made = folder / "scenario.yaml"
    made.write_text(json.dumps(scenario(kind, random.Random(f"{kind} {seed}"))))  # JSON is YAML
    subprocess.run([program, "simulate", "-q", made, "--seed", str(seed), "-o", folder / "log"], check=True, stdout=subprocess.DEVNULL)
    done = subprocess.run([program, "identify", "-q", folder / "log/recording.csv", "-o", folder / "estimate.json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 2, 3):
        raise SystemExit(f"{kind}, seed {seed}: exit status {done.returncode}\n{done.stderr}")
    return json.loads((folder / "estimate.json").read_text())


def main():
    program, logs, first = sys.argv[1], *(int(word) for word in [*sys.argv[2:], *["42", "1"][len(sys.argv) - 2:]])
    claims = 0
    print(f"{'kind':<32}{'claims':>8}{'of':>5}{'thermal gain':>14}  answers")
    for kind in KINDS:
        claimed, named, status = [], 0, Counter()
        for seed in range(first, first + logs):
            with tempfile.TemporaryDirectory() as folder:
                found = answer(program, pathlib.Path(folder), kind, seed)
            status[found["status"]] += 1
            gain = found["parameters"].get("thermal_gain") if found["status"] == "ok" else None
            named += gain is not None
            interval = gain.get("interval95") if gain else None
            if interval and interval[1] < 0:
                claimed.append(seed)
        claims += len(claimed)
        print(f"{kind:<32}{len(claimed):>8}{logs:>5}{named:>14}  {', '.join(f'{n} {name}' for name, n in status.most_common())}"
              + (f"; seeds {claimed}" if claimed else ""), flush=True)
    print(f"{claims} of {logs * len(KINDS)} logs claim a warming that is not there: {100 * claims / (logs * len(KINDS)):.1f} %")
    sys.exit(1 if claims > 0.01 * logs * len(KINDS) else 0)


if __name__ == "__main__":
    main()
