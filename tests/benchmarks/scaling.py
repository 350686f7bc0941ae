"""Time of `identify` over the samples of a log, from 6e4 to 1e6: reading, preparation, fit and verdict, on one core.

usage: scaling.py WARMJOINT [KIND...]         kinds: those of KINDS; default all

Prints processor seconds for each number of samples, and the power of the number that they grow with between the first and the
last: 1 is linear.
"""

import pathlib
import resource
import subprocess
import sys
import tempfile

import numpy as np

SAMPLES = (60_000, 240_000, 1_000_000)
RATE = 100  # Hz
SPEEDS = np.array([.1, -.1, .3, -.3, .6, -.6, 1, -1])  # rad/s, held one after the other
# kind: s that a speed is held (0: a sum of sines), gravity of 3 N.m, arguments of the program
KINDS = {
    "holds of 0.5 s": (.5, False, "--identifier energy-ml"),
    "holds of 20 s": (20, False, "--identifier energy-ml"),
    "holds of 4 s, auto": (4, False, "--identifier auto"),
    "Fourier": (0, False, "--identifier nominal-ls --motion any"),
    "Fourier, auto": (0, False, "--identifier auto"),
    "gravity sincos": (4, True, "--identifier energy-ml --gravity sincos"),
    "gravity paired": (4, True, "--identifier energy-ml --gravity paired"),
    "map": (4, False, "--identifier position-ridge"),
    "map that warms": (4, False, "--identifier energy-ml --set position=map"),
    "motor map": (4, False, "--identifier motor-ridge --gear 100"),
}


def recording(samples, hold, gravity):
    """[samples x 4] s, rad, rad/s, N.m: viscous 0.8, Coulomb 4.5, -0.3 N.m/W after 600 s, noise 0.1."""
    step, random = 1 / RATE, np.random.default_rng(1)
    time = np.arange(samples) * step
    if hold:
        goal = SPEEDS[(time / hold).astype(int) % len(SPEEDS)]
        velocity = np.convolve(goal, np.full(20, 1 / 20))[:samples]  # ramps of 0.2 s
    else:
        velocity = sum(.4 * np.cos(2 * np.pi * f * time + f) for f in (.1, .23, .37))
    position = np.cumsum(velocity) * step
    torque, energy, keeps = np.empty(samples), 0.0, np.exp(-step / 600)
    for i, v in enumerate(velocity):
        friction = .8 * v + (4.5 + energy) * np.sign(v)
        torque[i] = friction
        energy = keeps * energy - .3 * (1 - keeps) * abs(friction * v)
    torque += random.normal(0, .1, samples) + (3 * np.sin(position) if gravity else 0)
    return np.column_stack([time, position, velocity, torque])


def seconds(program, path, arguments, folder):
    """Of processor time of one call."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "identify", path, *arguments.split(), "-o", pathlib.Path(folder, "e.json"), "--force"],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main():
    program, kinds = sys.argv[1], sys.argv[2:] or KINDS
    print(f"{'':20}" + "".join(f"{n:>12,}" for n in SAMPLES) + "   grows as")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "log.csv")
        for kind in kinds:
            hold, gravity, arguments = KINDS[kind]
            times = []
            for samples in SAMPLES:
                np.savetxt(path, recording(samples, hold, gravity), delimiter=",", comments="", fmt="%.7g",
                           header="time,position,velocity,torque")
                times.append(seconds(program, path, arguments, folder))
            power = np.log(times[-1] / times[0]) / np.log(SAMPLES[-1] / SAMPLES[0])
            print(f"{kind:20}" + "".join(f"{t:10.2f} s" for t in times) + f"   n^{power:.2f}", flush=True)


if __name__ == "__main__":
    main()
