"""The board of robot_wrong_inertials.py, a table a motion: each method on each joint, and each kind of parameter over all joints.

    robot_board.py OUT.json... > board.md
"""

import json
import pathlib
import sys

import numpy as np

KINDS = {"viscous": "viscous", "coulomb": "mean Coulomb", "coulomb_positive": "kc+", "coulomb_negative": "kc-", "rotor_inertia": "rotor", "load_gain": "load",
         "gain": "gain", "thermal_gain": "heat gain", "thermal_time_constant": "log tau"}


def relative(rows, parameter):
    """Rms error over the truth's rms, in per cent."""
    these = [one for one in rows if one["parameter"] == parameter]
    error = np.array([one["value"] - one["truth"] for one in these])
    return 100 * np.sqrt(np.mean(error**2) / np.mean([one["truth"] ** 2 for one in these]))


def table(header, rows):
    print("| " + " | ".join(header) + " |\n|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def main():
    for path in sys.argv[1:]:
        kept = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        rows, methods = kept["rows"], list(dict.fromkeys(one["method"] for one in kept["rows"]))
        joints = list(dict.fromkeys(one["joint"] for one in rows))
        print(f"## {kept['robot']}, {kept['motion']}, {kept['realizations']} realizations\n\nRms error in per cent of the truth of mean Coulomb friction, of "
              "viscous friction, and share of the 95 % intervals of all parameters that hold.\n")
        lines = []
        for joint in joints:
            for method in methods:
                own = [one for one in rows if one["joint"] == joint and one["method"] == method]
                held = np.mean([one["holds"] for one in own])
                lines.append([joint, method, f"{relative(own, 'coulomb'):.2g}", f"{relative(own, 'viscous'):.2g}", f"{held:.2f}"])
        table(["joint", "method", "mean Coulomb (%)", "viscous (%)", "intervals that hold"], lines)
        print("By kind: share of intervals that hold, and rms error over the reported deviation.\n")
        lines = []
        for method in methods:
            found = kept["report"][method]
            lines.append([method, *(f"{found[key]['coverage']:.2f} {found[key]['rms over deviation']:.3g}" if key in found else "" for key in KINDS)])
        table(["method", *KINDS.values()], lines)
        for method in methods:
            one = kept["report"][method]
            if "warm" in one:
                print(f"{method[0].upper()}{method[1:]}: warming found on {one['warming found']} of {one['warm']} joints that warm, claimed on "
                      f"{one['warming claimed falsely']} of {one['joints'] - one['warm']} that do not; {one['not ok']} of {one['joints']} joints refused.\n")


main()
