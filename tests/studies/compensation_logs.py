"""Compensation of real logs: friction from the first 60 % of each, residual over the last 40 %, by arm.

    python3 tests/studies/compensation_logs.py     # needs WARMJOINT_SHARED, and the package on PYTHONPATH

Fixed: the law that is identified, its heat left out: cold as it was, and warm with the level of the first part's last tenth. Least squares: slope and level that forget
over 60 s, by log_forgetting. The estimate may be refused; it is used all the same, and its status is printed. rms in % of the torque less weight and inertia.
The xArm6 moves at one speed, and is asked for a law of one number with heat; EMPS for inertia, and for a level of each side: its force has an offset.
"""

import argparse
import os
import tempfile

import numpy as np
import shared_logs
import warmjoint as wj

ASKED = {"xArm6": {"method": "energy-ml", "law": "coulomb", "gravity": "sincos"}, "EMPS": {"method": "nominal-ls", "law": "asymmetric", "motion": "any"},
         **{f"NIST {j}": {} for j in range(1, 7)}}
FIRST = 0.6


def pairs(texts):
    return dict(pair.split("=", 1) for text in texts for pair in text.split(","))


def read(log, folder):
    options = argparse.ArgumentParser()
    options.add_argument("--map", action="append", default=[])
    options.add_argument("--unit", action="append", default=[])
    options.add_argument("--joint", default="rotary")
    asked = options.parse_args(log.arguments.split())
    return wj.read(log.path(os.environ["WARMJOINT_SHARED"], folder), map=pairs(asked.map), unit=pairs(asked.unit), joint=asked.joint)


def log_forgetting(found, seconds=60.0):
    """[N] prediction of slope and level along a Compensated, fitted by recursive least squares up to the sample before."""
    force = found.residual + found.friction  # torque less weight and inertia
    slope = level = 0.0
    a, b, c = 1e3, 0.0, 1e3
    predicted = np.full(len(force), np.nan)
    steps = np.diff(found.time, prepend=found.time[0])
    for i, (v, y, dt) in enumerate(zip(found.velocity.tolist(), force.tolist(), steps.tolist())):
        if not np.isfinite(y):
            continue
        x, side = abs(v), 1 if v > 0 else -1
        predicted[i] = side * (slope * x + level)
        keep, error = np.exp(-max(dt, 0) / seconds), side * (y - predicted[i])
        u, w = a * x + b, b * x + c
        d = keep + x * u + w
        slope, level = slope + u / d * error, level + w / d * error
        a, b, c = (a - u * u / d) / keep, (b - u * w / d) / keep, (c - w * w / d) / keep
    return predicted


def arms(estimate, log, seen):
    """{arm: [N] torque less weight, inertia and friction}, and that torque itself. seen: [N] samples that the arms may know beforehand."""
    cold = {key: value for key, value in estimate.data["friction"].items() if key not in ("thermal", "viscous_per_energy", "level_per_temperature")}
    cold["maps"] = [one for one in cold.get("maps", []) if all(axis["quantity"] != "energy" for axis in one["axes"])]

    def run(friction, correct):
        return wj.Compensator(wj.Estimate({**estimate.data, "friction": friction}, force=True), correct=correct).run(log)

    warm = estimate.data["friction"]
    open_loop, fixed = run(warm, False), run(cold, False)
    force, side = open_loop.residual + open_loop.friction, np.sign(open_loop.velocity)
    last = np.flatnonzero(seen & np.isfinite(force))
    last = last[-len(last) // 10:]
    level = np.mean(fixed.residual[last] * side[last])
    return force, {"fixed, cold": fixed.residual, "fixed, warm": fixed.residual - level * side, "least squares, 60 s": force - log_forgetting(open_loop),
                   "level without heat, corrected": run(cold, True).residual, "heat, open loop": open_loop.residual, "heat, corrected": run(warm, True).residual}


def main():
    with tempfile.TemporaryDirectory() as folder:
        logs = shared_logs.logs(os.environ["WARMJOINT_SHARED"])
        for name, asked in ASKED.items():
            if name not in logs:
                continue
            log = read(logs[name], folder)
            first = int(FIRST * len(log.time))
            estimate = wj.identify(log[:first], force=True, **asked)
            if not estimate.data["friction"]:
                print(f"{name}: {estimate.status}, no friction")
                continue
            seen = np.arange(len(log.time)) < first
            force, left = arms(estimate, log, seen)
            unseen = ~seen & np.isfinite(force) & np.all([np.isfinite(one) for one in left.values()], axis=0)
            rms = np.sqrt(np.mean(force[unseen] ** 2))
            print(f"{name} ({estimate.status}, {estimate.fitted.law}{', warms' if 'thermal' in estimate.data['friction'] else ''}), {unseen.sum()} samples")
            for arm, residual in left.items():
                print(f"  {arm:32}{100 * np.sqrt(np.mean(residual[unseen] ** 2)) / rms:7.1f} %")


if __name__ == "__main__":
    main()
