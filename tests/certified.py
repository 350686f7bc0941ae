#!/usr/bin/env python3
"""Least-squares problems of friction whose answers are known to 1e-8, after NIST's reference data for nonlinear regression.

    certified.py --make       writes scenarios/certified: a log for each problem, and problems.json with the answers
    certified.py --check      solves each again from two starts, and compares with problems.json
    certified.py --board PROGRAM [NAME=COMMAND]...     writes the board of digits, scenarios/certified/README.md

This is one of two independent programs: NumPy alone, by the equations of `force` below, with derivatives by complex steps and Gauss-Newton steps by
QR. The other is the program's identifiers, which tests/python/test_certified.py holds to the same answers. They share nothing but the logs.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "scenarios/certified"
STEP, COUNT = 1.0, 600  # s, samples
SPEEDS = [0.25, 1.0, 0.125, 0.75, 0.5, 0.0625, 0.375]  # rad/s: whole sixty-fourths, so that positions are exact
HOLD = 15  # samples
AGREE = 1e-10  # relative, of the answers from both starts: a hundredth of what is certified

VC, ASYM = ["viscous", "coulomb"], ["viscous", "coulomb_positive", "coulomb_negative"]
HEAT, WEIGHT = ["thermal_gain", "thermal_time_constant"], ["gravity_sine", "gravity_cosine"]
STRIBECK = ["viscous", "coulomb", "static", "stribeck_velocity"]
MAP_SETTINGS = {"kernels": 6, "width": 0.7, "strength": 2.0}  # of maps over the position: count, spacings, factor on |w|^2
MAP = [f"map_{k + 1}" for k in range(MAP_SETTINGS["kernels"])]
MAP_TRUTH = [2, -1.5, 1, -2.5, 3, -1]
MAP_ASKED = " ".join(f"--set {key}={value:g}" for key, value in MAP_SETTINGS.items()) + " --set basis=position"
UNITS = {"viscous": "N.m.s/rad", "thermal_gain": "N.m/W", "thermal_time_constant": "s", "stribeck_velocity": "rad/s", "load_gain": ""}

# name: (unknowns, truth, how the program is asked)
PROBLEMS = {
    "coulomb": (["coulomb"], [15], "nominal-ls --set law=coulomb"),
    "viscous_coulomb": (VC, [5, 15], "nominal-ls"),
    "asymmetric": (ASYM, [5, 15, 12], "nominal-ls --set law=asymmetric"),
    "gravity": (VC + WEIGHT, [5, 15, 30, -8], "nominal-ls --gravity sincos"),
    "load": ([*VC, "load_gain"], [5, 15, 0.08], "nominal-ls --set load=estimated"),
    "stribeck": (STRIBECK, [5, 15, 20, 0.2], "stribeck"),
    "heat_coulomb": (["coulomb", *HEAT], [15, -1.5, 200], "energy-ml --set law=coulomb"),
    "heat_viscous": (VC + HEAT, [5, 15, -1.5, 200], "energy-ml"),
    "heat_asymmetric": (ASYM + HEAT, [5, 15, 12, -1.5, 200], "energy-ml --set law=asymmetric"),
    "heat_start": ([*VC, *HEAT, "initial_energy"], [5, 15, -1.5, 200, -6], "energy-ml --start estimated"),
    "heat_gravity": (VC + HEAT + WEIGHT, [5, 15, -1.5, 200, 30, -8], "energy-ml --gravity sincos"),
    "heat_stribeck": (STRIBECK + HEAT, [5, 15, 20, 0.2, -1.5, 200], "stribeck --set warming=estimated"),
    "heat_load": ([*VC, *HEAT, "load_gain"], [5, 15, -1.5, 200, 0.08], "energy-ml --set load=estimated"),
    "map": (VC + MAP, [5, 15, *MAP_TRUTH], f"position-ridge {MAP_ASKED}"),
    "map_asymmetric": (ASYM + MAP, [5, 15, 12, *MAP_TRUTH], f"position-ridge --set law=asymmetric {MAP_ASKED}"),
    "heat_map": (VC + HEAT + MAP, [5, 15, -1.5, 200, *MAP_TRUTH], f"energy-ml --set position=map {MAP_ASKED}"),
}


def motion():
    """Time, position, velocity and load of the logs: constant speeds of 15 s, the direction in turn."""
    i = np.arange(COUNT)
    segment = i // HOLD
    velocity = np.array(SPEEDS)[segment % len(SPEEDS)] * np.where(segment % 2 == 0, 1, -1)
    position = np.concatenate([[0], np.cumsum(velocity[:-1] * STEP)])
    load = 10 + 5 * ((segment * 5) % 7) * np.where(segment % 3 == 0, -1, 1)
    return {"time": STEP * i, "position": position, "velocity": velocity, "load": load.astype(float)}


def force(names, values, log):
    """The torque of the model at each sample, [N], in N.m, of real or complex unknowns:

        F[i] = kv v + s (L + E[i]) + K(q) w,   s = sign(v),   torque = F + gs sin q + gc cos q
        L = kc, or kc+ / kc- by direction, or kc + (ks - kc) exp(-(v / vs)^2);   with load_gain c: + c |load|
        E[i+1] = te E[i] + k (1 - te) |F[i] v[i]|,   te = exp(-h / tau),   E[0] = initial_energy or 0
        K: kernels, w: map_1 to map_6
    """
    given = dict(zip(names, values))
    v, s = log["velocity"], np.sign(log["velocity"])
    level = np.zeros(len(v), complex) + given.get("coulomb", 0)
    if "coulomb_positive" in given:
        level = np.where(v > 0, given["coulomb_positive"], given["coulomb_negative"])
    if "static" in given:
        level = level + (given["static"] - given["coulomb"]) * np.exp(-((v / given["stribeck_velocity"]) ** 2))
    level = level + given.get("load_gain", 0) * np.abs(log["load"])
    cold = given.get("viscous", 0) * v + s * level
    if MAP[0] in given:
        cold = cold + kernels(log["position"]) @ np.array([given[one] for one in MAP])
    energy = np.zeros(len(v), complex)
    if "thermal_gain" in given:
        pole = np.exp(-STEP / given["thermal_time_constant"])
        energy[0] = given.get("initial_energy", 0)
        for i in range(len(v) - 1):
            friction = cold[i] + s[i] * energy[i]
            loss = friction * v[i] * (1 if (friction * v[i]).real >= 0 else -1)
            energy[i + 1] = pole * energy[i] + given["thermal_gain"] * (1 - pole) * loss
    weight = given.get("gravity_sine", 0) * np.sin(log["position"]) + given.get("gravity_cosine", 0) * np.cos(log["position"])
    return cold + s * energy + weight


def kernels(position):
    """Normalised Gaussian kernels, evenly from the least to the largest position: each row sums to 1. [N x kernels]"""
    centres, spacing = np.linspace(position.min(), position.max(), MAP_SETTINGS["kernels"], retstep=True)
    away = (position[:, None] - centres) / (MAP_SETTINGS["width"] * spacing)
    heights = np.exp(-(away**2) / 2)
    return heights / heights.sum(axis=1, keepdims=True)


def solve(names, start, log):
    """The least-squares answer from a start, by damped Gauss-Newton steps, and the sum of squares, with strength |w|^2 of a map's weights."""
    x = np.array(start, float)
    damping = 1e-3
    prior = np.sqrt(MAP_SETTINGS["strength"]) * np.eye(len(x))[[one in MAP for one in names]]

    def modelled(x):
        return np.concatenate([force(names, x, log), prior @ x])

    y = np.concatenate([log["torque"], np.zeros(len(prior))])

    def residual(x):
        return y - modelled(x).real

    left = residual(x)
    for _ in range(500):
        scale = np.maximum(np.abs(x), 1e-3)
        rows = np.stack([modelled(x + 1e-40j * scale * unit).imag / 1e-40 for unit in np.eye(len(x))], axis=1)
        # Levenberg's damping as further rows, so that QR sees no normal equations
        norms = np.linalg.norm(rows, axis=0)
        more = np.vstack([rows, np.diag(np.sqrt(damping) * norms)])
        step = np.linalg.lstsq(more, np.concatenate([left, np.zeros(len(x))]), rcond=None)[0] * scale
        new = residual(x + step)
        if new @ new <= left @ left * (1 + 1e-14):
            x, left, damping = x + step, new, damping / 10
            if np.max(np.abs(step) / scale) < 1e-14:
                break
        else:
            damping = max(damping, 1e-12) * 10
            if damping > 1e12:
                break
    return x, float(left @ left)


def starts(truth):
    """Two: one far off, one near."""
    factor = [np.resize(one, len(truth)) for one in ([0.5, 0.7, 1.3, 1.6, 0.6, 1.4], [0.95, 1.05, 1.05, 0.95, 1.05, 0.95])]
    return [[float(f"{value:.6g}") for value in one] for one in np.array(factor) * truth]


def read(name):
    table = np.genfromtxt(FOLDER / f"{name}.csv", delimiter=",", names=True)
    return {column: table[column] for column in table.dtype.names}


def answer(name):
    """The answer from both starts. Raises AssertionError where they differ."""
    names, truth, _ = PROBLEMS[name]
    log = {"load": motion()["load"], **read(name)}
    (one, squares), (other, _) = (solve(names, start, log) for start in starts(truth))
    assert np.max(np.abs(one / other - 1)) < AGREE, (name, one, other)
    return names, one, squares


def digits(program, asked):
    """{problem: digits of its worst parameter} of identifiers, {problem: options of `identify`}, as `validate` has them."""
    answers = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, options in asked.items():
            out = pathlib.Path(folder) / f"{name}.json"
            words = [program, "identify", FOLDER / f"{name}.csv", "-o", out, "--identifier", *options]
            subprocess.run(words, capture_output=True, check=False)
            estimate = json.loads(out.read_text()) if out.exists() else {}
            found = {key: one["value"] for key, one in estimate.get("parameters", {}).items()}
            for one in (estimate.get("friction") or {}).get("maps", []):
                found |= dict(zip(MAP, one["weights"]))
            answers[name] = {key: found[key] for key in PROBLEMS[name][0] if found.get(key) is not None}
        file = pathlib.Path(folder) / "answers.json"
        file.write_text(json.dumps(answers))
        done = subprocess.run([program, "validate", file, "--format", "json"], capture_output=True, text=True, check=True)
    return {row["problem"]: row["digits"] for row in json.loads(done.stdout) if row["problem"] in asked}


# others of the program, and the problems that they can be asked
OTHERS = {
    "rls": {name: ["rls"] for name in ("viscous_coulomb",)},
    "energy-als": {"heat_viscous": ["energy-als"], "heat_coulomb": ["energy-als", "--set", "law=coulomb"],
                   "heat_asymmetric": ["energy-als", "--set", "law=asymmetric"], "heat_gravity": ["energy-als", "--gravity", "sincos"]},
}


def board(program, commands):
    """The page of the problems with the digits of each identifier."""
    columns = {"ours": digits(program, {name: [*asked.split(" "), "--force"] for name, (_, _, asked) in PROBLEMS.items()})}
    columns |= {name: digits(program, asked) for name, asked in OTHERS.items()}
    for command in commands:
        columns[command.split("=")[0]] = digits(program, {"heat_viscous": [command, "--unconfined"]})
    lines = [f"| problem | unknowns | {' | '.join(columns)} |", "|---" * (2 + len(columns)) + "|"]
    for name, (names, _, _) in PROBLEMS.items():
        cells = [f"{found[name]:.1f}" if name in found else "" for found in columns.values()]
        lines.append(f"| [{name}]({name}.csv) | {', '.join(names)} | {' | '.join(cells)} |")
    (FOLDER / "README.md").write_text(PAGE + "\n".join(lines) + "\n" + AFTER)


PAGE = """# Problems with certified answers

Sixteen least-squares problems of friction, after [NIST's reference data](https://www.itl.nist.gov/div898/strd/) for
nonlinear regression: a log of ten minutes, a model, and the numbers that minimise the sum of squares over all samples,
known to 1e-10. In those with a map, its prior adds `strength` times the squares of its weights. Each is solved from
two starts by [a program in NumPy](../../tests/certified.py), which says the equations, and again by the identifiers of
this project; the two share nothing but the logs.

<!-- not run: the answers are your own -->
```sh
warmjoint validate                    # the problems, their logs and unknowns
warmjoint validate answers.json       # {"heat_viscous": {"viscous": 5.01, "coulomb": 14.9, ...}, ...}
```

`problems.json` has starts, answers with units, the sum of squares, and how `warmjoint identify` is asked. A digit is
-log10 of the relative error of the worst parameter, 10 at most. `ours` is the identifier of `problems.json`.

"""
AFTER = """
energy-als is no least squares over the closed loop: it stops at the fixed point of its iteration. Where an identifier
cannot be asked, its cell is empty.

Not here, and why:

- **Delay.** `nominal-ls` and `energy-ml` end their search for `torque_delay` at a fiftieth of its standard error, and
  differentiate by it over 60 ms of motion. Their answer is no minimum to 1e-8.
- **Field.** The answer is an average over strengths and lengths that the log leaves open; no option sets these, so that
  the command line offers no posterior at given ones.
- **Maps whose prior is chosen.** Cross validation picks one of several strengths. The problems here give it.
"""


def make():
    random, made = np.random.default_rng(20261129), {}
    for name, (names, truth, asked) in PROBLEMS.items():
        log = motion()
        log["torque"] = force(names, truth, log).real + 0.25 * random.standard_normal(COUNT)
        columns = ["time", "position", "velocity", "torque", *(["load"] if "load_gain" in names else [])]
        np.savetxt(FOLDER / f"{name}.csv", np.stack([log[one] for one in columns], axis=1), "%.9g", ",", header=",".join(columns), comments="")
        _, found, squares = answer(name)
        made[name] = {"identify": asked, "starts": starts(truth), "squares": squares,
                      "answer": {one: {"value": float(value), "unit": UNITS.get(one, "N.m")} for one, value in zip(names, found)}}
    (FOLDER / "problems.json").write_text(json.dumps(made, indent=1) + "\n")


def check():
    """Each problem solved again gives what its file says."""
    for name, problem in json.loads((FOLDER / "problems.json").read_text()).items():
        names, found, _ = answer(name)
        worst = max(abs(value / problem["answer"][one]["value"] - 1) for one, value in zip(names, found))
        assert worst < AGREE, (name, worst)
        print(f"{name}: {worst:.1e}")


if __name__ == "__main__":
    if sys.argv[1] == "--board":
        board(sys.argv[2], sys.argv[3:])
    else:
        {"--make": make, "--check": check}[sys.argv[1]]()
