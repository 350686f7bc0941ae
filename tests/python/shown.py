"""Made-up logs, estimates and runs as C++ hands them to figures (tools/shown), for tests of pictures and pages."""

import copy

import numpy as np
from warmjoint.figures.run_view import Column, Row, Run, Trace
from warmjoint.figures.view import View

SYMBOLS = [["viscous", "kv"], ["coulomb", "kc"], ["thermal_gain", "k"], ["thermal_time_constant", "tau"], ["thermal_gain_discrete", "ke"],
           ["thermal_pole", "te"]]


def parameter(name, value, unit, std):
    return {"name": name, "value": value, "unit": unit, "std": std, "interval95": [value - 2 * std, value + 2 * std]}


def answer(**changes):
    rows = [parameter("viscous", 5.0, "N.m.s/rad", 0.06), parameter("coulomb", 15.0, "N.m", 0.1), parameter("thermal_gain", -3.0, "N.m/W", 0.05),
            parameter("thermal_time_constant", 600.0, "s", 12.0)]
    known = {"identifier": "energy-ml", "method": "energy-ml", "status": "ok", "message": "joint maximum likelihood", "warnings": [], "remarks": [],
             "without_holdout": "", "metrics": {"n": 1200, "parameters": 4, "rmse": 0.5, "mae": 0.4, "fit": 93.0, "fpe": 0.25}, "holdout": None,
             "parameters": rows, "shown": rows, "symbols": SYMBOLS, "tests": [], "assumptions": [], "trace": [], "has_gravity": False,
             "has_friction": True}
    return {**known, **changes}


def test_of(name, over, **changes):
    """One test for lack of fit that found something."""
    found = {"test": name, "made": True, "reason": "", "rejected": True, "effect": 3.0, "effect_unit": "N.m", "p_adjusted": 1e-9,
             "question": f"does it depend on {name}?", "advice": f"try another law for {name}", "over": over}
    return {**found, **changes}


def warm_facts(**changes):
    """Twenty minutes at 1 Hz: 20 s at each speed, the sign alternating; Table I's friction, 0.5 N.m of noise. The estimate is the truth."""
    rng = np.random.default_rng(7)
    n, hold = 1200, 20
    time = np.arange(n, dtype=float)
    speeds = np.where(np.arange(n // hold) % 2, -1, 1) * rng.uniform(0.1, 1, n // hold)
    velocity = np.repeat(speeds, hold)
    energy = -12 * (1 - np.exp(-time / 300))
    fitted = 5 * velocity + np.sign(velocity) * (15 + energy)
    curves = []
    for heat in (0.0, energy[-1] / 2, energy[-1]):
        for way in (1, -1):
            speed = way * np.linspace(0.1, 1, 60)
            curves.append({"energy": heat, "speed": speed, "force": 5 * speed + way * (15 + heat), "std": np.full(60, 0.1)})
    columns = {"time": time, "position": np.cumsum(velocity), "velocity": velocity, "torque": fitted + 0.5 * rng.standard_normal(n),
               "rigid": np.zeros(n), "keep": np.ones(n), "fitted": fitted, "energy": energy, "energy_std": np.full(n, 0.1)}
    facts = {**answer(), "source": "folder/warm.csv", "torque_unit": "N.m", "position_unit": "rad", "velocity_unit": "rad/s", "any_motion": False,
             "has_fit": True, "warms": True, "has_maps": False, "columns": columns, "curves": curves,
             "segments": np.array([[i * hold, (i + 1) * hold, speed] for i, speed in enumerate(speeds)]),
             "at_speed": {"speed": 0.5, "cold": 17.5, "force": 17.5 + energy, "std": np.full(n, 0.1)}}
    return {**copy.deepcopy(facts), **changes}


def mapped_facts():
    """The same through a gear at three speeds, with a wave of 2 N.m once a turn of the motor in truth and estimate."""
    rng, facts = np.random.default_rng(8), warm_facts()
    columns = facts["columns"]
    n, way = 1200, np.sign(columns["velocity"])
    speed = np.repeat(np.tile([0.2, 0.2, 0.5, 0.5, 0.9, 0.9], 10), 20)
    velocity = way * speed
    angle = 1.3 * np.cumsum(np.where(way > 0, 1.0, 0.6) * velocity)  # slower on the way back, so that every speed meets every angle
    plain = 5 * velocity + way * (15 + columns["energy"])
    wave = 2 * np.sin(angle)
    columns.update(velocity=velocity, motor_angle=angle % (2 * np.pi), fitted=plain + wave, torque=plain + wave + 0.1 * rng.standard_normal(n))
    facts["segments"] = np.array([[20 * i, 20 * i + 20, velocity[20 * i]] for i in range(60)])
    grid_v = 0.9 * (2 * (np.arange(120) + 0.5) / 120 - 1)
    grid_a = 2 * np.pi * (np.arange(180) + 0.5) / 180
    warmest = columns["energy"][-1]
    levels = [5 * np.abs(grid_v)[:, np.newaxis] + 15 + heat + np.sign(grid_v)[:, np.newaxis] * 2 * np.sin(grid_a) for heat in (0, warmest)]
    facts.update(has_maps=True, curves=[], at_speed=None, motor_maps={"with": plain + wave, "without": plain},
                 at_heats=[{"energy": heat, "force": 5 * velocity + way * (15 + heat)} for heat in (0, warmest / 2, warmest)],
                 angle_map={"over_motor": True, "lower": 0.0, "upper": 2 * np.pi, "fastest": 0.9, "energies": [0, warmest], "levels": levels})
    return facts


def guess_facts(**changes):
    time = np.arange(10, 1200, 20.0)
    level = 15 - 12 * (1 - np.exp(-time / 300))
    facts = {"gain": -3.0, "time_constant": 590.0, "gain_unit": "N.m/W", "cold": 15.0, "settled": 3.5, "time_to_63": 300.0, "time": time, "level": level}
    return {**facts, **changes}


def warm_view(**changes):
    return View(warm_facts(**changes))


def trace_of(iterations):
    """Parameters that close in on the truth."""
    rows = answer()["parameters"]
    return [{"iteration": k, "rmse": 0.5 + 0.5**k, "parameters": {row["name"]: row["value"] * (1 + 0.5**k) for row in rows}} for k in range(iterations)]


REALIZATIONS = 40


def column(name, truth, deviation, rng):
    """Estimates about the truth with a relative deviation."""
    full = np.full(REALIZATIONS, float(truth))
    return Column(name, "N·m", full * (1 + deviation * rng.standard_normal(REALIZATIONS)), full, np.full(REALIZATIONS, deviation * truth), 40, 38)


def row(label, method, npe, rng):
    half = np.repeat([0, 1], REALIZATIONS // 2)
    rmse = 0.5 + 0.01 * rng.standard_normal(REALIZATIONS)
    return Row(label, method, REALIZATIONS, {}, half, npe * np.exp(0.3 * rng.standard_normal(REALIZATIONS)), rmse,
               93 + rng.standard_normal(REALIZATIONS), rmse**2, 0.8 * rmse,
               [column("viscous", 5, 0.01, rng), column("coulomb", 15, 0.02, rng), column("thermal_time_constant", 600, 0.03, rng)], Trace())


def example_run(ladder=True):
    """energy-ml, and an energy-als of which 12 runs failed, which iterates 200 times from twice the truth to the truth."""
    rng = np.random.default_rng(11)
    rows = [row("energy-ml", "energy-ml", 0.011, rng), row("energy-als, 50 iterations", "energy-als", 0.2, rng)]
    rows[1].failures = {"not_converged": 12}
    rows[1].npe[:12] = np.nan
    spread = np.linspace(0.5, 1.5, REALIZATIONS)[:, np.newaxis] * np.exp(-0.05 * np.arange(1, 201))
    rows[1].trace = Trace(np.arange(1.0, 201), {"npe_continuous": spread, "rmse": 0.5 + spread, "viscous": 5 * (1 + spread), "thermal_pole": spread})
    groups = [{"variant": "quiet", "bound_npe": {"continuous": {"rms": 0.01}}}, {"variant": "noisy", "bound_npe": {"continuous": {"rms": 0.1}}}]
    facts = {"database": "", "suite": "table1", "realizations": 20 if ladder else 40, "identifiers": [], "torque_unit": "N.m", "noise": 0.5,
             "parameters": {"viscous": ["kv", "N.m.s/rad"], "coulomb": ["kc", "N.m"], "thermal_time_constant": ["tau", "s"]},
             "rungs": {"variable": "noise.torque" if ladder else "", "unit": "N.m", "values": [0.1, 1.0] if ladder else [], "names": []},
             "bound": np.diag([1.0, 1.0, 1.0]), "board": {"realizations": 40, "bound_npe": {"continuous": {"rms": 0.012}}, "groups": groups if ladder else []}}
    return Run(facts, rows)
