"""Inputs of the table that are made here, each by the few lines that a report of it would have."""

import numpy as np


def write_csv(path, **columns):
    """A recording, one column a name."""
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", comments="", fmt="%.9g",
               header=",".join(columns))


def write(folder):
    """All of them, into a folder."""
    for name, make in list(globals().items()):
        if name.startswith("make_"):
            make(folder)


def make_rests(folder):
    """Two seconds of motion, and then a rest of .2, 1.4 or 3 s whose velocity a drive logs as zeros: viscous 1.5, Coulomb .5, inertia .2."""
    rng, dt = np.random.default_rng(1), .008
    t = np.arange(0, 60, dt)
    for rest in (.2, 1.4, 3):
        phase, turn = np.mod(t, 2 + rest), (t // (2 + rest)).astype(int)
        moves, x = phase < 2, np.clip(phase / 2, 0, 1)
        speed = (.2 + .3 * (turn * 7 % 5) / 4) * np.sin(np.pi * x)**2 * (1 + .5 * np.sin(6 * np.pi * x))
        v = np.where(moves, np.where(turn % 2, -1, 1) * speed, 0)
        noise = .03 * rng.standard_normal(len(t))
        write_csv(folder / f"rests_{rest}.csv", time=t, position=np.cumsum(v) * dt,
                  velocity=np.where(moves, v + 1e-3 * rng.standard_normal(len(t)), 0),
                  torque=1.5 * v + .5 * np.sign(v) + .2 * np.gradient(v, dt) + noise)


def make_rounded(folder):
    """Positions alone, in degrees, rounded as people export them: 75 holds of 4 s. viscous .35, Coulomb 1.4"""
    rng = np.random.default_rng(2)
    turn = np.arange(15000) // 200
    v = np.where(turn % 2, -1, 1) * np.array([.1, .3, .6, 1, 1.5])[turn * 7 // 2 % 5]
    v = np.convolve(v, np.ones(10) / 10, "same")
    torque = .35 * v + 1.4 * np.sign(v) + .02 * rng.standard_normal(len(v))
    for step in (.001, .01):
        q = np.round(np.rad2deg(np.cumsum(v) * .02) / step) * step
        write_csv(folder / f"rounded_{step}.csv", time=np.arange(len(v)) * .02, position=q, torque=torque)


def make_ringing(folder):
    """20 holds of 10 s at 20 Hz, each of which starts with samples that ring by some per cent, and more in the torque. viscous 5, Coulomb 15"""
    rng = np.random.default_rng(3)
    speeds = np.where(np.arange(20) % 2, -1, 1) * rng.uniform(.1, 1, 20)
    v = np.repeat(speeds, 200)
    torque = 5 * v + 15 * np.sign(v) + .1 * rng.standard_normal(len(v))
    for begin in range(200, len(v), 200):
        v[begin - 2:begin + 1] = np.linspace(v[begin - 3], v[begin], 5)[1:-1]
        v[begin + 1:begin + 5] *= (.969, .991, .983, 1.005)
        torque[begin - 2:begin + 4] += np.sign(v[begin + 4]) * np.array([-10, 5, 12, 5.8, -1.4, .8])
    write_csv(folder / "ringing.csv", time=np.arange(len(v)) * .05, position=np.cumsum(v) * .05, velocity=v, torque=torque)
