"""The friction of each joint of a wide file, without a description of the robot.

    robot_joints.py LOG.csv [POSITION TORQUE [TIME]]

POSITION and TORQUE name the columns of joint j, as q{j} and tau{j}, counted from 1. Each joint is identified by itself: gravity and inertia of a
joint alone. With a description, warmjoint.identify_robot is closer.
"""

import sys

import numpy as np
import warmjoint as wj


def main():
    if len(sys.argv) not in (2, 4, 5):
        sys.exit(__doc__)
    position, torque = sys.argv[2:4] if len(sys.argv) > 2 else ("q{j}", "tau{j}")
    time = sys.argv[4] if len(sys.argv) > 4 else "t"
    frame = np.genfromtxt(sys.argv[1], delimiter=",", names=True)

    j = 1
    while position.format(j=j) in frame.dtype.names:
        try:
            log = wj.Log(time=frame[time], position=frame[position.format(j=j)], torque=frame[torque.format(j=j)])
            estimate = wj.identify(log, gravity="sincos")
            print(f"joint {j}: {estimate.status}", *(f"{one!r}" for one in estimate.parameters.values()), sep="\n  ")
            if not estimate.ok:
                print(f"  {estimate.message}")
        except wj.BadInput as refusal:  # a column that cannot be used leaves the other joints alone
            print(f"joint {j}: {refusal}")
        j += 1


main()
