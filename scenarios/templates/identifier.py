"""An identifier of your own: reads a recording, writes an estimate. Python's standard library is enough.

Run it on each realization of a suite, beside those of warmjoint:

    warmjoint run table1 -o NAME --realizations 5 \\
        --identifier energy-ml --identifier 'NAME=python3 NAME.py {recording} {estimate}'
    warmjoint compare NAME

This one fits torque = viscous * velocity + coulomb * sign(velocity) by least squares. Put your own method into fit().
"""

import csv
import json
import sys


def fit(velocity, torque):
    """viscous (N.m.s/rad) and coulomb (N.m) by least squares; velocity in rad/s, torque in N.m."""
    sign = [1 if v > 0 else -1 for v in velocity]
    vv = sum(v * v for v in velocity)
    vs = sum(v * s for v, s in zip(velocity, sign))
    ss = len(velocity)
    vt = sum(v * t for v, t in zip(velocity, torque))
    st = sum(s * t for s, t in zip(sign, torque))
    determinant = vv * ss - vs * vs
    if determinant < 1e-9 * vv * ss:
        return None  # one speed alone cannot tell the two apart
    return (ss * vt - vs * st) / determinant, (vv * st - vs * vt) / determinant


def main(recording, estimate):
    # the columns time, position, velocity and torque, in SI
    with open(recording, encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    moving = [row for row in rows if abs(row["velocity"]) > 1e-6]
    answer = fit([row["velocity"] for row in moving], [row["torque"] for row in moving])

    if answer is None:
        # ok, not_converged, not_identifiable, inadequate_model or bad_data; message says why
        result = {"status": "not_identifiable", "message": "the joint moves at one speed alone"}
    else:
        viscous, coulomb = answer
        result = {
            "status": "ok",
            # std and interval95 may stand beside value: then their coverage is judged, too
            "parameters": {
                "viscous": {"value": viscous, "unit": "N.m.s/rad"},
                "coulomb": {"value": coulomb, "unit": "N.m"},
            },
            # with this, the figures of agreement (RMSE, Fit, FPE) are computed
            "friction": {"law": "viscous_coulomb", "parameters": {"viscous": viscous, "coulomb": coulomb}},
        }
    with open(estimate, "w", encoding="utf-8") as file:
        json.dump(result, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
