"""Small random logs through the whole program: check, identify, and what reads an estimate again. Nothing may end by a signal.
   program.py WARMJOINT [LOGS [SEED]]        200 logs by default; the same number and seed give the same logs"""
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

HOW = [  # an identifier, and the options that it takes
    ("auto", ["--gravity", "--start"]),
    ("nominal-ls", ["--gravity", "load", "--motion"]),
    ("energy-ml", ["--gravity", "load", "--start", "--motion"]),
    ("energy-als", ["--start"]),
    ("position-ridge", ["--gravity"]),
    ("motor-ridge", ["--gravity"]),
    ("stribeck", ["--gravity"]),
    ("energy-map", []), ("load-map", []), ("lpv-energy", []), ("rls", []), ("kalman", []), ("lugre", []),
]
VALUES = {"--gravity": ["none", "sincos", "paired"], "--start": ["cold", "unknown", "estimated"], "--motion": ["constant", "any"]}


def speed_of(kind, draw, fastest, hold):
    """The speed of a motion over time, rad/s."""
    levels = [draw.uniform(0.05, 1) * fastest for _ in range(64)]

    def at(t):
        i = int(t / hold)
        level = levels[i % 64] * (-1) ** i
        if kind == "one direction":
            return abs(level)
        if kind == "one speed":
            return math.copysign(fastest, level)
        if kind == "rests":
            return 0 if i % 2 else levels[i % 64] * (-1) ** (i // 2)
        if kind == "hand":
            return fastest * (0.6 * math.sin(3.1 * t / hold) + 0.5 * math.sin(7.7 * t / hold))
        if kind == "rest":
            return 0
        return level

    return at


def log_of(draw):
    """Columns and rows of one log: friction that may warm and grow with the load, gravity, inertia, noise and steps."""
    kind = draw.choice(["holds", "one direction", "one speed", "rests", "hand", "hand", "rest"])
    n, h = draw.choice([3, 30, 200, 600]), draw.choice([0.01, 0.05, 1])
    coulomb, viscous = draw.uniform(0.05, 20), draw.uniform(0, 5)
    gain, tau = draw.choice([0, 0, -0.5]), draw.uniform(10, 600)
    load_gain, weight = draw.choice([0, 0, 0.1]), draw.choice([0, 1, 8])
    inertia, noise, step = draw.choice([0, 0.01]), draw.choice([0, 0.01, 0.3]), draw.choice([0, 0, 0.1])
    at, q, heat, before, rows = speed_of(kind, draw, draw.uniform(0.05, 3), draw.uniform(0.3, 10)), 0.0, 0.0, 0.0, []
    for k in range(n):
        v = at(k * h)
        gravity = weight * (math.sin(q) - 0.3 * math.cos(q))
        sign = (v > 0) - (v < 0)
        friction = viscous * v + sign * (coulomb + load_gain * abs(gravity) + heat)
        torque = friction + gravity + inertia * (v - before) / h + draw.gauss(0, noise)
        heat += h * (gain * friction * v - heat) / tau
        rows.append([k * h, q, v, round(torque / step) * step if step else torque, gravity])
        q, before = q + h * v, v
    names = ["time", "position", "velocity", "torque"]
    if draw.random() < 0.3:
        names.append("load")
    if draw.random() < 0.15:
        names.remove("velocity")
    whole = ["time", "position", "velocity", "torque", "load"]
    return ",".join(names) + "\n" + "".join(",".join(f"{row[whole.index(name)]:.9g}" for name in names) + "\n" for row in rows)


def words_of(draw, name, takes):
    """The options of one command."""
    words = ["--identifier", name]
    for option in takes:
        if option == "load":
            words += ["--set", "load=" + draw.choice(["none", "estimated"])]
        elif draw.random() < 0.6:
            words += [option, draw.choice(VALUES[option])]
    if draw.random() < 0.3:
        words += ["--holdout", "0.3"]
    return words


def run(what, allowed):
    """Runs a command; a status that is not allowed, or a refusal without a word, is an error."""
    done = subprocess.run(what, capture_output=True, text=True, timeout=300)
    assert done.returncode in allowed, f"status {done.returncode}: {' '.join(what)}\n{done.stderr}"
    assert done.returncode == 0 or done.stderr or done.stdout, f"no word: {' '.join(what)}"
    return done.returncode


def main():
    program = sys.argv[1]
    logs, seed = (int(word) for word in (sys.argv[2:] + ["200", "11"][len(sys.argv) - 2:]))
    count = {}
    with tempfile.TemporaryDirectory() as folder:
        log, estimate = Path(folder) / "log.csv", Path(folder) / "estimate.json"
        for which in range(logs):
            draw = random.Random(1000 * seed + which)
            log.write_text(log_of(draw))
            estimate.unlink(missing_ok=True)
            name, takes = HOW[which % len(HOW)] if draw.random() < 0.7 else HOW[draw.randrange(3)]
            run([program, "check", str(log)], {0, 2, 3})
            status = run([program, "identify", str(log), *words_of(draw, name, takes), "-o", str(estimate)], {0, 2, 3})
            count[status] = count.get(status, 0) + 1
            assert estimate.exists() == (status != 2), f"log {which}: status {status} and a file do not agree"
            if status != 2:
                assert (json.loads(estimate.read_text())["status"] == "ok") == (status == 0)
                run([program, "predict", str(estimate), str(log)], {0, 2, 3})
                run([program, "plot", str(estimate), "--data", "-o", str(Path(folder) / "plots")], {0, 2, 3})
    assert count.get(0, 0) > logs / 20, f"hardly any answer: {count}"
    print(f"{logs} logs: " + ", ".join(f"{n} of status {status}" for status, n in sorted(count.items())))


if __name__ == "__main__":
    main()
