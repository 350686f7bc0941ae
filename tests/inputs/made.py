"""Inputs of the table that are made here, each by the few lines that a report of it would have."""

import numpy as np


def write_csv(path, **columns):
    """A recording, one column a name."""
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", comments="", fmt="%.9g",
               header=",".join(columns))


def holds(speeds=(0.1, 0.3, 0.6, 1), seconds=2, repeats=4):
    """time, position, velocity at 50 Hz: each speed forwards and backwards, again and again."""
    one = np.repeat([s * side for s in speeds for side in (1, -1)], 50 * seconds)
    velocity = np.tile(one, repeats)
    return 0.02 * np.arange(len(velocity)), 0.02 * np.cumsum(velocity), velocity


def make_degenerate(folder):
    """Logs that tell nothing, or too much, of friction: each identifier owes a status and a sentence."""
    t, q, v = holds()
    exact = 0.8 * v + 4.5 * np.sign(v)
    noisy = exact + 0.1 * np.random.default_rng(1).standard_normal(len(t))
    for name, (position, velocity, torque) in {
            "constant": (q, v, 3 + 0 * v), "one_value_each_way": (q, v, 4.5 * np.sign(v)), "zeros": (q, v, 0 * v),
            "at_rest": (0 * q, 0 * v, noisy), "exact": (q, v, exact), "unsigned": (q, abs(v), noisy),
            "both_unsigned": (q, abs(v), abs(noisy)), "huge": (q, v, 1e150 * noisy), "tiny": (q, v, 1e-200 * noisy),
            "slow": (1e-150 * q, 1e-150 * v, noisy), "one_way": (0.02 * np.cumsum(abs(v)), abs(v), abs(exact)),
            "steps": (q, v, np.round(exact))}.items():
        write_csv(folder / f"degenerate_{name}.csv", time=t, position=position, velocity=velocity, torque=torque)
    write_csv(folder / "degenerate_two_samples.csv", time=t[:2], position=q[:2], velocity=v[:2], torque=noisy[:2])


def make_coarse(folder):
    """A torque without noise in coarse steps."""
    t, q, v = holds((0.1, 0.5, 0.9, 1.4, 2))
    for step in 0.25, 0.4:
        torque = step * np.round((0.8 * v + 4.5 * np.sign(v)) / step)
        write_csv(folder / f"coarse_{step}.csv", time=t, position=q, velocity=v, torque=torque)


def make_cool_down(folder):
    """Ends with as long a rest as it moved."""
    t, q, v = holds()
    rest = 0 * t
    torque = 0.8 * v + 4.5 * np.sign(v) + 0.1 * np.random.default_rng(2).standard_normal(len(t))
    write_csv(folder / "cool_down.csv", time=0.02 * np.arange(2 * len(t)), position=np.r_[q, q[-1] + rest],
              velocity=np.r_[v, rest], torque=np.r_[torque, rest])


def make_ripple(folder):
    """Friction 0.06 v + 0.55 forwards, 0.48 backwards, and a ripple that evens out over a turn; motor ripple with a gear of 7."""
    speeds = np.tile(np.repeat([0.3, -0.3, 1.2, -1.2], [1047, 1047, 262, 262]), 8)
    t, q = 0.02 * np.arange(len(speeds)), 0.02 * np.cumsum(speeds)
    level = np.where(speeds > 0, 0.55, 0.48) + 0.08 * np.sin(q)
    noise = 0.05 * np.random.default_rng(3).standard_normal(len(t))
    torque = 0.06 * speeds + np.sign(speeds) * level + noise
    write_csv(folder / "ripple.csv", time=t, position=q, velocity=speeds, torque=torque)
    write_csv(folder / "motor_ripple.csv", time=t, position=q, velocity=speeds,
              torque=torque + np.sign(speeds) * 0.2 * np.sin(7 * q))


def write(folder):
    """All of them, into a folder."""
    for name, make in list(globals().items()):
        if name.startswith("make_"):
            make(folder)
