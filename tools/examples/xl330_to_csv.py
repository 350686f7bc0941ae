#!/usr/bin/env python3
"""Log of a Dynamixel XL330 (JSON with an `entries` list) as a CSV for warmjoint.

    xl330_to_csv.py LOG.json > log.csv

Writes time (s), position (rad), velocity (rad/s), load (raw) and temperature (degC). The load is stored unsigned with 16
bits: values above 32767 are negative. Read it with --map torque=load --unit torque=raw.
"""
import json
import sys

if len(sys.argv) != 2:
    sys.exit(__doc__)
with open(sys.argv[1]) as file:
    entries = json.load(file)["entries"]
print("time,position,velocity,load,temperature")
for entry in entries:
    load = entry["load"] - 65536 if entry["load"] > 32767 else entry["load"]
    print(entry["timestamp"], entry["position"], entry["speed"], load, entry["temp"], sep=",")
