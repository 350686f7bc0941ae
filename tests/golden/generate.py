#!/usr/bin/env python3
"""Recordings of friction that warms, made by the equations alone.

This program shares nothing with the project, not even a table: it is what plants, the plugin's
kernel and identifiers are held to, so that one mistake in the project's forward model cannot hide
on both sides of a test. It needs Python's own library only and gives the same bytes every time:

    python3 tests/golden/generate.py        # writes LAW.json and everything.json beside itself

Laws that slide steadily (coulomb, viscous_coulomb, asymmetric, stiction, stribeck,
asymmetric_stribeck) hold one speed after the other, the sign alternating, and follow the sampled equations exactly,
    F = Fn(v) + sign(v) E,  W = |F v|,  E[i+1] = te E[i] + k (1 - te) W[i],  te = exp(-h/tau).
Laws with a bristle (dahl, lugre, asymmetric_lugre) follow the differential equations
    ds/dt = sigma0 (v - |v| s/(g(v) + E)),  F = s + sigma1 (v - |v| s/(g(v) + E)) + kv v,
    tau dE/dt = k W - E,  W = F v - s/sigma0 ds/dt
along a smooth velocity, by Runge-Kutta in steps of 0.1 ms; halving the step changes what is
written by 2e-7 N.m at most. `everything` has two stages of heat, surroundings, load, a slope that
follows E and a map of normalised Gaussian kernels over position.
"""
import json
import math
import pathlib

SPEEDS = [0.3, 1.0, 0.12, 0.7, 0.2, 0.05, 0.45]  # rad/s, used in turn
HOLD = 20  # s
STEP = 2  # s between samples
COUNT = 600
GAIN, TIME_CONSTANT = -1.5, 300.0  # k, N.m/W; tau, s


def sign(v):
    return (v > 0) - (v < 0)


def held_velocity(i):
    """rad/s at sample i."""
    segment = i * STEP // HOLD
    return SPEEDS[segment % len(SPEEDS)] * (1 if segment % 2 == 0 else -1)


def stribeck_level(speed, kc, ks, vs):
    return kc + (ks - kc) * math.exp(-((speed / vs) ** 2))


def two_levels(v, forwards, backwards, rise, vs):
    return (backwards if v < 0 else forwards) + rise * math.exp(-((v / vs) ** 2))


def steady_laws():
    """name -> (parameters, Fn(v))"""
    return {
        "coulomb": ({"coulomb": 15.0}, lambda v: 15 * sign(v)),
        "viscous_coulomb": ({"viscous": 5.0, "coulomb": 15.0}, lambda v: 5 * v + 15 * sign(v)),
        "asymmetric": (
            {"viscous": 5.0, "coulomb_positive": 15.0, "coulomb_negative": 12.0},
            lambda v: 5 * v + (15 if v > 0 else -12 if v < 0 else 0),
        ),
        "stiction": (
            {"viscous": 5.0, "coulomb": 15.0, "static": 20.0},
            lambda v: 5 * v + 15 * sign(v),
        ),
        "stribeck": (
            {
                "viscous": 5.0,
                "coulomb": 15.0,
                "static": 20.0,
                "stribeck_velocity": 0.15,
                "stribeck_exponent": 2.0,
            },
            lambda v: 5 * v + stribeck_level(abs(v), 15, 20, 0.15) * sign(v),
        ),
        "asymmetric_stribeck": (
            {
                "viscous": 5.0,
                "coulomb_positive": 15.0,
                "coulomb_negative": 12.0,
                "static_rise": 5.0,
                "stribeck_velocity": 0.15,
                "stribeck_exponent": 2.0,
            },
            lambda v: 5 * v + two_levels(v, 15, 12, 5, 0.15) * sign(v),
        ),
    }


def warm(nominal):
    pole = math.exp(-STEP / TIME_CONSTANT)
    gain = GAIN * -math.expm1(-STEP / TIME_CONSTANT)
    energy, forces, energies = 0.0, [], []
    for i in range(COUNT):
        v = held_velocity(i)
        force = nominal(v) + sign(v) * energy
        forces.append(force)
        energies.append(energy)
        energy = pole * energy + gain * abs(force * v)
    return forces, energies


def bristle_laws():
    """name -> (parameters, g(v), sigma0, sigma1, kv)"""
    return {
        "dahl": ({"coulomb": 15.0, "bristle_stiffness": 500.0}, lambda v: 15.0, 500.0, 0.0, 0.0),
        "lugre": (
            {
                "viscous": 5.0,
                "coulomb": 15.0,
                "static": 20.0,
                "stribeck_velocity": 0.1,
                "bristle_stiffness": 500.0,
                "bristle_damping": 5.0,
            },
            lambda v: stribeck_level(abs(v), 15, 20, 0.1),
            500.0,
            5.0,
            5.0,
        ),
        "asymmetric_lugre": (
            {
                "viscous": 5.0,
                "coulomb_positive": 15.0,
                "coulomb_negative": 12.0,
                "static_rise": 5.0,
                "stribeck_velocity": 0.1,
                "bristle_stiffness": 500.0,
                "bristle_damping": 5.0,
            },
            lambda v: two_levels(v, 15, 12, 5, 0.1),
            500.0,
            5.0,
            5.0,
        ),
    }


def smooth_velocity(t):
    """rad/s; at 0 its derivative is large, so that the joint begins with a turn"""
    return 0.25 * math.sin(0.7 * t) + 0.15 * math.sin(1.9 * t)


BRISTLE_RATE, BRISTLE_COUNT, FINE = 100, 2001, 100  # Hz, samples, Runge-Kutta steps a sample
BRISTLE_GAIN, BRISTLE_TIME_CONSTANT = -2.0, 8.0


def bend(level, sigma0, sigma1, kv):
    """(F, s, E) at each sample, from rest with a bristle that is not bent"""

    def force_and_rates(t, s, energy):
        v = smooth_velocity(t)
        rate = v - abs(v) * s / (level(v) + energy)
        force = s + sigma1 * rate + kv * v
        loss = force * v - s * rate
        return force, sigma0 * rate, (BRISTLE_GAIN * loss - energy) / BRISTLE_TIME_CONSTANT

    h = 1 / (BRISTLE_RATE * FINE)
    s = energy = 0.0
    samples = []
    for k in range((BRISTLE_COUNT - 1) * FINE + 1):
        t = k * h
        force, ds1, de1 = force_and_rates(t, s, energy)
        if k % FINE == 0:
            samples.append((force, s, energy))
        _, ds2, de2 = force_and_rates(t + h / 2, s + h / 2 * ds1, energy + h / 2 * de1)
        _, ds3, de3 = force_and_rates(t + h / 2, s + h / 2 * ds2, energy + h / 2 * de2)
        _, ds4, de4 = force_and_rates(t + h, s + h * ds3, energy + h * de3)
        s += h / 6 * (ds1 + 2 * ds2 + 2 * ds3 + ds4)
        energy += h / 6 * (de1 + 2 * de2 + 2 * de3 + de4)
    return samples


def everything():
    viscous, coulomb, per_energy, load_gain, per_temperature = 5.0, 15.0, 0.2, 0.1, -0.05
    first, second = (-1.0, 300.0), (-0.4, 40.0)
    centres, width, weights = [-1.0, -0.5, 0.0, 0.5, 1.0], 0.5, [0.4, -0.3, 0.6, -0.2, 0.1]
    columns = {name: [] for name in ("velocity", "position", "load", "ambient_rise")}
    forces, energies = [], []
    e1, e2 = -0.5, 0.0
    for i in range(300):
        t = i * STEP
        v = 0.0 if i % 50 >= 40 else held_velocity(i)
        position = round(math.sin(0.05 * t), 6)
        load = round(3 * math.cos(0.03 * t), 6)
        rise = round(8 * math.sin(0.004 * t), 6)
        kernels = [math.exp(-((position - c) ** 2) / (2 * width**2)) for c in centres]
        ripple = sum(w * k for w, k in zip(weights, kernels)) / sum(kernels)
        energy = e1 + e2
        level = coulomb + energy + load_gain * abs(load)
        force = 0.0 if v == 0 else (viscous + per_energy * energy) * v + sign(v) * level + ripple
        for name, value in zip(columns, (v, position, load, rise)):
            columns[name].append(value)
        forces.append(force)
        energies.append(energy)
        loss = abs(force * v)
        # the first stage relaxes towards the level of its surroundings, kT (Ts - T0)
        p1, p2 = math.exp(-STEP / first[1]), math.exp(-STEP / second[1])
        e1 = p1 * e1 + (1 - p1) * (first[0] * loss + per_temperature * rise)
        e2 = p2 * e2 + (1 - p2) * second[0] * loss
    thermal = {
        "thermal_gain": first[0],
        "thermal_time_constant": first[1],
        "second": {"thermal_gain": second[0], "thermal_time_constant": second[1]},
    }
    axis = {"quantity": "position", "centres": centres, "width": width, "sides": "together"}
    friction = {
        "law": "viscous_coulomb",
        "parameters": {"viscous": viscous, "coulomb": coulomb},
        "thermal": thermal,
        "level_per_temperature": per_temperature,
        "viscous_per_energy": per_energy,
        "load_gain": load_gain,
        "maps": [{"axes": [axis], "kernels": "normalised", "weights": weights}],
    }
    return {
        "friction": friction,
        "step": STEP,
        "initial_energy": -0.5,
        **columns,
        "force": forces,
        "energy": energies,
    }


def friction_of(law, parameters, gain, time_constant):
    thermal = {"thermal_gain": gain, "thermal_time_constant": time_constant}
    return {"law": law, "parameters": parameters, "thermal": thermal}


def write(name, content):
    text = json.dumps(content, separators=(",", ":")).replace("],", "],\n")
    (pathlib.Path(__file__).parent / f"{name}.json").write_text(text + "\n")


def main():
    for law, (parameters, nominal) in steady_laws().items():
        forces, energies = warm(nominal)
        write(
            law,
            {
                "friction": friction_of(law, parameters, GAIN, TIME_CONSTANT),
                "step": STEP,
                "speeds": SPEEDS,
                "hold": HOLD,
                "velocity": [held_velocity(i) for i in range(COUNT)],
                "force": forces,
                "energy": energies,
            },
        )
    for law, (parameters, level, sigma0, sigma1, kv) in bristle_laws().items():
        samples = bend(level, sigma0, sigma1, kv)
        write(
            law,
            {
                "friction": friction_of(law, parameters, BRISTLE_GAIN, BRISTLE_TIME_CONSTANT),
                "step": 1 / BRISTLE_RATE,
                "velocity": [
                    round(smooth_velocity(i / BRISTLE_RATE), 9) for i in range(BRISTLE_COUNT)
                ],
                "force": [round(force, 7) for force, _, _ in samples],
                "bristle": [round(s, 7) for _, s, _ in samples],
                "energy": [round(energy, 7) for _, _, energy in samples],
            },
        )
    write("everything", everything())


main()
