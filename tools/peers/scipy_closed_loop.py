"""Warm friction by scipy.optimize.curve_fit on the closed loop, from one start.

F = kv v + kc sign(v) + sign(v) E, W = |F v|, E[i+1] = te E[i] + k (1 - te) W[i], te = exp(-h/tau).
"""

import sys

import numpy as np
import recording
from scipy.optimize import curve_fit


def force(motion, viscous, coulomb, gain, time_constant):
    """Friction over the samples, N.m. motion: [2, N], time in s and velocity in rad/s."""
    time, velocity = motion
    pole = np.exp(-np.median(np.diff(time)) / time_constant)
    speed = np.abs(velocity)
    level = viscous * speed + coulomb * (speed > 0)  # size of the nominal friction

    # heat follows from sample to sample: this loop is what the fit spends its time in
    energy = np.empty_like(speed)
    e = 0.0
    for i, (f, v) in enumerate(zip(level.tolist(), speed.tolist())):
        energy[i] = e
        e = pole * e + gain * (1 - pole) * abs((f + e) * v)
    return np.sign(velocity) * (level + energy)


def main(source, target):
    log = recording.read(source)
    motion = np.vstack([log["time"], log["velocity"]])
    start = [1.0, np.median(np.abs(log["torque"])), -0.5, 300.0]
    names = ["viscous", "coulomb", "thermal_gain", "thermal_time_constant"]
    try:
        best, covariance = curve_fit(
            force, motion, log["torque"], start, x_scale=np.abs(start), method="trf",
            bounds=([0, 0, -50, 1], [np.inf, np.inf, 0, 1e5]))
    except RuntimeError as error:
        recording.write(target, {}, status="not_converged", message=str(error))
        return
    deviations = np.sqrt(np.diag(covariance))
    recording.write(target, dict(zip(names, best)), dict(zip(names, deviations)), names[2:])


if __name__ == "__main__":
    main(*sys.argv[1:])
