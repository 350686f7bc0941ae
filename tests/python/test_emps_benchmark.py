"""The study of EMPS finds no error where the log is the model's own, and the right one where the model is another."""

import pathlib
import sys

import numpy as np
import pytest

pytest.importorskip("scipy")
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "studies"))

import emps_benchmark

MASS = 95.0


def friction(velocity, position):
    return 200 * np.asarray(velocity) + 20 * np.sign(velocity) + 0 * np.asarray(position)


@pytest.fixture(scope="module")
def log():
    """What the simulated axis itself records along a sine."""
    t = np.arange(3000) * emps_benchmark.STEP
    made = {"t": t, "qg": 0.02 * (1 - np.cos(3 * t)), "qm": 0.04 * np.sin(t) ** 2, "gtau": np.array([35.0]), "kp": np.array([160.0]), "kv": np.array([240.0])}
    q, _, control = emps_benchmark.simulated(MASS, friction, made)
    return {**made, "qm": q, "vir": control}


def test_its_own_log_has_no_errors(log):
    position, velocity, force = emps_benchmark.simulation_errors(MASS, friction, log)
    assert position < 0.01
    assert velocity < 1
    assert force < 1e-6
    assert emps_benchmark.force_error(MASS, friction, log) < 5


def test_friction_that_is_too_small_shows_as_its_share_of_the_force(log):
    right = emps_benchmark.force_error(MASS, friction, log)
    half = emps_benchmark.force_error(MASS, lambda v, q: friction(v, q) / 2, log)
    share = 100 * np.linalg.norm(friction(np.gradient(log["qm"], emps_benchmark.STEP), 0) / 2) / np.linalg.norm(log["gtau"] * log["vir"])
    assert half > right + 0.5 * share
