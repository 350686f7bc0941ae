"""EMPS by its benchmark's own rules: fitted to one experiment, judged on the other, errors as its authors compute them.

    python3 tests/studies/emps_benchmark.py FOLDER     # DATA_EMPS.mat and DATA_EMPS_PULSES.mat in FOLDER; the package on PYTHONPATH; SciPy

After Janot, Gautier, Brunot 2019, "Data set and reference models of EMPS": a Butterworth filter of fourth order at 100 Hz, forwards and backwards; central
differences; the first 49 samples left out; relative error 100 |y - yhat| / |y|. Force: the inverse model's, with every tenth sample after a Chebyshev filter.
Simulation: the axis in its position loop of 1 ms, which follows the reference and the force pulses, all other forces from the model.
"""

import pathlib
import sys

import numpy as np
import scipy.io
import scipy.signal
import warmjoint as wj

FILES = {"estimation": "DATA_EMPS.mat", "test": "DATA_EMPS_PULSES.mat"}
STEP, SUBSTEPS, BORDER, DECIMATION = 1e-3, 10, 49, 10
SATURATION = 10.0  # V
PUBLISHED = {"mass": 95.1089, "viscous": 203.5034, "coulomb": 20.3935, "offset": -3.1648}


def read(path):
    return {name: value.ravel().astype(float) for name, value in scipy.io.loadmat(path).items() if not name.startswith("__")}


def motion(log):
    """Position, velocity and acceleration of the log, filtered as the benchmark does."""
    position = scipy.signal.filtfilt(*scipy.signal.butter(4, 100 / 500), log["qm"])
    velocity = np.gradient(position, STEP)
    return position, velocity, np.gradient(velocity, STEP)


def decimated(signal):
    """Every tenth sample after a Chebyshev filter of order 8, without phase."""
    return scipy.signal.filtfilt(*scipy.signal.cheby1(8, 0.05, 0.8 / DECIMATION), signal)[1::DECIMATION]


def relative(measured, modelled):
    return 100 * np.linalg.norm(measured - modelled) / np.linalg.norm(measured)


def force_error(mass, friction, log):
    """Of the inverse model, %."""
    position, velocity, acceleration = motion(log)
    measured = (log["gtau"] * log["vir"])[BORDER:]
    modelled = (mass * acceleration + friction(velocity, position))[BORDER:]
    return relative(decimated(measured), decimated(modelled))


class Tabled:
    """Friction between the points of a table over position and speed for each direction, since a simulation asks for one value at a time."""

    def __init__(self, friction, positions, speeds=200, places=600, fastest=0.3):
        self.low, self.place = positions.min() - 0.01, (np.ptp(positions) + 0.02) / (places - 1)
        self.speed = fastest / (speeds - 1)
        at, v = np.meshgrid(self.low + self.place * np.arange(places), np.maximum(self.speed * np.arange(speeds), 1e-9), indexing="ij")
        self.forwards, self.backwards = friction(v, at).tolist(), friction(-v, at).tolist()

    def __call__(self, velocity, position):
        if velocity == 0:
            return 0.0
        table = self.forwards if velocity > 0 else self.backwards
        x, y = (position - self.low) / self.place, abs(velocity) / self.speed
        i, j = min(max(int(x), 0), len(table) - 2), min(int(y), len(table[0]) - 2)
        a, b = x - i, y - j
        return (1 - a) * ((1 - b) * table[i][j] + b * table[i][j + 1]) + a * ((1 - b) * table[i + 1][j] + b * table[i + 1][j + 1])


def simulated(mass, friction, log):
    """Position, velocity and control of the axis in its loop. Its control: kv (kp (reference - q) - dq), one sample late, dq of the mean of two samples."""
    gain, kp, kv = (float(log[name][0]) for name in ("gtau", "kp", "kv"))
    friction = Tabled(friction, log["qm"])
    reference, pulses = log["qg"].tolist(), log.get("pulses_N", np.zeros(len(log["t"]))).tolist()
    q = v = before = mean = late = 0.0
    rows, h = [], STEP / SUBSTEPS
    for asked, pulse in zip(reference, pulses):
        # the loop, once a sample
        control = min(max(late, -SATURATION), SATURATION) + pulse
        rows.append((q, v, control))
        slope, mean, before = ((q + before) / 2 - mean) / STEP, (q + before) / 2, q
        late = kv * (kp * (asked - q) - slope)

        # the axis, by the midpoint rule
        for _ in range(SUBSTEPS):
            half = v + h / 2 * (gain * control - friction(v, q)) / mass
            q, v = q + h * half, v + h * (gain * control - friction(half, q + h / 2 * v)) / mass
    return np.array(rows).T


def simulation_errors(mass, friction, log):
    """Of position, velocity, force and position as it was measured, %."""
    position, velocity, _ = motion(log)
    q, v, control = simulated(mass, friction, log)
    return [relative(a[BORDER:], b[BORDER:]) for a, b in ((position, q), (velocity, v), (log["vir"], control))]


def published(velocity, position):
    given = PUBLISHED
    return given["viscous"] * velocity + given["coulomb"] * np.sign(velocity) + given["offset"] + 0 * position


def identified(folder, **asked):
    """Mass and friction of an identifier, from the estimation experiment alone."""
    columns = {"time": "t", "position": "qm", "torque": "vir"}
    gain = float(read(folder / FILES["estimation"])["gtau"][0])
    log = wj.read(folder / FILES["estimation"], map=columns, scale={"torque": gain}, joint="linear")
    found = wj.identify(log, motion="any", holdout=0, **asked)
    return found.parameters["inertia"].value, found.friction


def main(folder):
    logs = {name: read(folder / file) for name, file in FILES.items()}
    models = {
        "published parameters": (PUBLISHED["mass"], published),
        "nominal-ls law=asymmetric": identified(folder, method="nominal-ls", law="asymmetric"),
        "auto": identified(folder),
    }
    print("| model | experiment | mass kg | force % | simulated: position % | velocity % | force % |\n|---|---|---|---|---|---|---|")
    for name, (mass, friction) in models.items():
        for experiment, log in logs.items():
            cells = [f"{force_error(mass, friction, log):.2f}", *(f"{one:.3g}" for one in simulation_errors(mass, friction, log))]
            print(f"| {name} | {experiment} | {mass:.2f} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
