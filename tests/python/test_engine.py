"""Simulation, suites and scores from Python are those of the program."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest
import warmjoint as wj
from conftest import SCENARIO

mujoco = pytest.importorskip("mujoco")
ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.mark.skipif("WARMJOINT_SCRIPT" not in os.environ, reason="WARMJOINT_SCRIPT names no script of an installed package")
def test_the_script_of_the_package_is_the_program(program, tmp_path):
    # MuJoCo's library lies elsewhere than in the folder of packages, where the script looks
    environment = os.environ | {"LD_LIBRARY_PATH": os.fspath(pathlib.Path(mujoco.__file__).parent)}
    for command in (["list", "robots"], ["list", "suites"], ["new", "scenario", "one"], ["simulate", "one.yaml", "--set", "duration=60", "-o", "one"]):
        done = subprocess.run([os.environ["WARMJOINT_SCRIPT"], *command], cwd=tmp_path, env=environment, capture_output=True, text=True,
                              check=True)
        assert done.stdout == program(*command)
    assert (tmp_path / "one/recording.csv").read_bytes() == (program.folder / "one/recording.csv").read_bytes()


def test_a_simulation_is_that_of_the_program(program, recording, columns):
    made = wj.simulate(SCENARIO)
    np.testing.assert_array_equal(made.log.torque, columns["torque"])
    truth = json.loads((recording.parent / "truth.json").read_text())
    np.testing.assert_array_equal(made.truth["energy"], truth["energy"])
    assert made.truth["friction"] == truth["friction"]
    # changes and seeds count
    assert np.ptp(wj.simulate(SCENARIO, seed=1).log.torque - made.log.torque) > 0
    quiet = wj.simulate(SCENARIO, noise={"torque": 0})
    np.testing.assert_allclose(quiet.log.torque, quiet.truth["force"])
    with pytest.raises(wj.BadInput, match="duration"):
        wj.simulate(SCENARIO, durration=5)
    made.save(program.folder / "saved")
    assert (program.folder / "saved/recording.csv").read_text() == recording.read_text()


def test_an_estimate_is_scored(program):
    made = wj.simulate(SCENARIO)
    score = wj.score(wj.identify(made.log, "energy-ml"), made)
    coulomb = score["continuous"]["coulomb"]
    assert coulomb["truth"] == 15 and abs(coulomb["estimate"] - 15) < 5 * coulomb["bound"] and coulomb["covered"] in (True, False)
    lower, upper = coulomb["interval95"]
    assert coulomb["covered"] == (lower <= coulomb["truth"] <= upper)
    parts = [(one["estimate"] - one["truth"]) / one["truth"] for one in score["continuous"].values()]
    np.testing.assert_allclose(score["npe_continuous"], np.hypot.reduce(parts))


def test_a_robot_begins_with_the_heat_that_an_estimates_log_left(columns):
    estimate = wj.identify(wj.Log(**columns), "energy-ml")
    robot = wj.attach(ROOT / "models/robots/rotary/rotary.xml", {"hinge": estimate})
    model = robot.spec.compile()
    friction = robot.bind(model, mujoco.MjData(model))
    friction.reset(warm="end")
    assert friction.heat[0] == estimate.state_end < -1


def own_identifier(log):
    """Friction of one level, by the mean of what acts against the motion."""
    level = float(np.mean(log.torque * np.sign(log.velocity)))
    return {"status": "ok", "parameters": {"coulomb": {"value": level, "unit": log.torque_unit}}}


def test_a_run_is_that_of_the_program_and_takes_functions(program):
    seen = []
    done = wj.run("table1", program.folder / "run", identifiers={"mine": own_identifier, "energy-ml": None}, realizations=3,
                  progress=lambda finished, total: seen.append((finished, total)))
    assert done.results == 6 and done.unanswered == 0 and seen[-1] == (3, 3)
    program("run", "table1", "-o", "theirs", "--identifier", "energy-ml", "--realizations", 3)
    theirs = json.loads(program("compare", "theirs", "--format", "json"))["rows"][0]
    rows = wj.compare(done)
    rows = rows.to_dict("records") if hasattr(rows, "to_dict") else rows
    ours = {row["identifier"]: row for row in rows}
    assert ours["energy-ml"]["rmse_median"] == theirs["rmse"]["median"]
    assert ours["mine"]["npe_continuous_median"] > ours["energy-ml"]["npe_continuous_median"]


def test_a_function_that_fails_is_an_answer_that_lacks(program):
    def broken(log):
        raise ZeroDivisionError("of mine")

    done = wj.run("table1", program.folder / "broken", identifiers={"mine": broken}, realizations=2)
    assert done.unanswered == 2 and "of mine" in done.silent[0][1]
    with pytest.raises(wj.BadInput, match="tabel1"):
        wj.run("tabel1", program.folder / "none", realizations=1)
