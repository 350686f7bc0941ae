"""An identifier of one's own beside two of warmjoint, on simulated logs whose truth is known.

    compare_identifiers.py FOLDER    (FOLDER gets the run; the same command goes on where it stopped)
"""

import sys

import numpy as np
import warmjoint as wj


def mine(log):
    """viscous v + coulomb sign(v) by least squares, without the first ten minutes, in which the joint warms up most."""
    late = (log.time > log.time[0] + 600) & (log.velocity != 0)
    rows = np.column_stack((log.velocity, np.sign(log.velocity)))[late]
    viscous, coulomb = np.linalg.lstsq(rows, log.torque[late], rcond=None)[0]
    parameters = {"viscous": {"value": viscous, "unit": "N.m.s/rad"}, "coulomb": {"value": coulomb, "unit": "N.m"}}
    return {"status": "ok", "parameters": parameters,
            "friction": {"law": "viscous_coulomb", "parameters": {"viscous": viscous, "coulomb": coulomb}}}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    identifiers = {"mine": mine, "nominal-ls": None, "energy-ml": None}
    run = wj.run("table1", sys.argv[1], identifiers=identifiers, realizations=10)
    print(f"{run.results} estimates, {run.rejected} rejected by their own tests")

    # a data frame where pandas is installed, else a list of dicts
    board = wj.compare(run)
    for row in board.to_dict("records") if hasattr(board, "to_dict") else board:
        print(f"{row['identifier']:12} error over all parameters {100 * row['npe_continuous_median']:7.2f} %")


main()
