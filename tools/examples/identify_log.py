"""From a log to its friction: what the log shows, parameters with intervals, a picture, a file.

    identify_log.py LOG.csv FOLDER

FOLDER gets fit.png and estimate.json, which attach, scenarios and the plugin read.
"""

import pathlib
import sys

import warmjoint as wj


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])

    # other names and units: wj.read(path, map={"position": "q"}, unit={"position": "deg"});
    # a data frame: wj.Log.from_frame(frame, time="t_s", position="q_rad", torque="tau_Nm")
    log = wj.read(sys.argv[1])
    print(wj.check(log))

    # anything but ok has no numbers to use; the error says why and what would help
    estimate = wj.identify(log).raise_if_rejected()
    print(estimate)

    # friction to plan with, N.m or N: cold, and as warm as at the end of the log
    for heat in (0, estimate.state_end):
        value, lower, upper = estimate.friction(speed=0.5, heat=heat, band=True)
        print(f"at 0.5 rad/s or m/s and heat {heat:.3g}: {value:.4g} ({lower:.4g} .. {upper:.4g})")

    estimate.plot().savefig(folder / "fit.png")
    estimate.save(folder / "estimate.json")


main()
