#!/usr/bin/env python3
"""Log of one joint from the Staubli TX40 files shipped with FIGAROH, as a CSV for warmjoint.

    tx40_to_csv.py pos_read_data.csv curr_data.csv JOINT > joint.csv

The files hold six joints, one row each 0.2 ms: motor-encoder positions in degrees of the joint, motor currents in A.
Writes time (s), position (deg) and current (A) of joint 1 to 6. Read it with
--map torque=current --unit position=deg,torque=A; the velocity is derived from the position.
"""
import csv
import sys

STEP = 0.0002  # s


def column(path, joint):
    with open(path, newline="") as file:
        return [row[f"Joint_{joint}"] for row in csv.DictReader(file)]


def main():
    if len(sys.argv) != 4 or sys.argv[3] not in "123456":
        sys.exit(__doc__)
    positions = column(sys.argv[1], sys.argv[3])
    currents = column(sys.argv[2], sys.argv[3])
    if len(positions) != len(currents):
        sys.exit(f"{len(positions)} positions but {len(currents)} currents; the files do not belong together")
    print("time,position,current")
    for i, (position, current) in enumerate(zip(positions, currents)):
        print(f"{i * STEP:.4f},{position},{current}")


main()
