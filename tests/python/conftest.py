"""Logs that the tests share. The program is WARMJOINT_PROGRAM; the package is found by PYTHONPATH, its script is WARMJOINT_SCRIPT."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

SCENARIO = {"friction": {"law": "viscous_coulomb", "parameters": {"viscous": 5, "coulomb": 15},
                         "thermal": {"thermal_gain": -3, "thermal_time_constant": 600}},
            "motion": {"speeds": {"uniform": [0.1, 1]}, "hold": 20}, "noise": {"torque": 0.5}, "sampling": {"rate": 1},
            "duration": 3600}


class Program:
    """The command line program in a folder of its own."""

    def __init__(self, folder: pathlib.Path):
        self.folder = folder
        self.path = os.environ["WARMJOINT_PROGRAM"]

    def __call__(self, *arguments, status=0):
        done = subprocess.run([self.path, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False)
        assert done.returncode == status, done.stderr
        return done.stdout


@pytest.fixture(scope="session")
def program(tmp_path_factory):
    return Program(tmp_path_factory.mktemp("program"))


@pytest.fixture(scope="session")
def recording(program):
    """The path of a simulated recording of an hour, viscous 5, coulomb 15, k -3, tau 600 s."""
    (program.folder / "scenario.yaml").write_text(json.dumps(SCENARIO))
    program("simulate", "scenario.yaml", "-o", "log")
    return program.folder / "log/recording.csv"


@pytest.fixture(scope="session")
def columns(recording):
    """The same as arrays by name."""
    table = np.genfromtxt(recording, delimiter=",", names=True)
    return {name: table[name] for name in ("time", "position", "velocity", "torque")}
