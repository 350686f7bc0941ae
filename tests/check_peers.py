"""Checks a run of the peers: each agrees with the identifier of ours that solves the same problem.

    check_peers.py BOARD.json RESULTS.csv
"""

import csv
import json
import sys

# peer, ours, parameters, largest relative difference and where it comes from
PAIRS = [
    # the same least squares problem, up to the tolerance of curve_fit
    ("scipy_closed_loop", "energy-ml", ["viscous", "coulomb", "thermal_gain", "thermal_time_constant"], 1e-3),
    # the same rows [v, sign v]; the servo lags by torque / 1e4 N.m.s/rad, up to 2 % of the lowest speed
    ("mujoco_sysid", "nominal-ls", ["viscous", "coulomb"], 0.02),
    # the kernels over the position take part of the level
    ("sklearn_ridge", "nominal-ls", ["viscous", "coulomb"], 0.15),
]


def main(board, results):
    with open(board, encoding="utf-8") as file:
        rows = {row["identifier"]: row for row in json.load(file)["rows"]}
    with open(results, encoding="utf-8") as file:
        answers = {(row["identifier"], row["realization"]): row for row in csv.DictReader(file)}

    problems = []
    for peer, ours, names, tolerance in PAIRS:
        if peer not in rows or rows[peer]["failures"]:
            problems.append(f"{peer} failed: {rows.get(peer, {}).get('failures')}")
            continue
        for (identifier, realization), answer in answers.items():
            if identifier != peer:
                continue
            for name in names:
                theirs, mine = float(answer[name]), float(answers[ours, realization][name])
                if abs(theirs - mine) > tolerance * abs(mine):
                    problems.append(f"{peer}, realization {realization}: {name} {theirs:g}, {ours} has {mine:g}")
    print("\n".join(problems) or "every peer agrees with the identifier that solves the same problem")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
