"""Designed motions, and logs that are enough."""

import json

import numpy as np
import pytest
import warmjoint as wj

PRIOR = {"law": "viscous_coulomb", "parameters": {"viscous": 5, "coulomb": 15},
         "thermal": {"thermal_gain": -3, "thermal_time_constant": {"log_uniform": [300, 1200]}}}
LIMITS = {"position": (-1.5, 1.5), "velocity": (0.05, 1)}


@pytest.fixture(scope="module")
def motion():
    return wj.design(10, limits=LIMITS, prior=PRIOR, noise=0.5, method="energy-ml", aim="thermal_time_constant=10%")


def test_a_motion_is_that_of_the_program(program, motion, tmp_path):
    (program.folder / "prior.json").write_text(json.dumps(PRIOR))
    program("design", "--minutes", 10, "--limits", "position=-1.5..1.5,velocity=0.05..1", "--prior", "prior.json", "--noise", 0.5,
            "--identifier", "energy-ml", "--for", "thermal_time_constant=10%", "-o", "motion")
    assert (program.folder / "motion/motion.csv").read_text() == motion.files["motion.csv"]
    motion.save(tmp_path / "saved")
    assert (tmp_path / "saved/trajectory.yaml").read_text() == (program.folder / "motion/trajectory.yaml").read_text()


def test_a_motion_keeps_to_its_limits_and_says_what_its_log_gives(motion):
    assert motion.position.min() >= -1.5 - 1e-9 and motion.position.max() <= 1.5 + 1e-9
    assert np.abs(motion.velocity).max() <= 1
    assert motion.time[-1] == pytest.approx(600)
    tau = motion.parameters["thermal_time_constant"]
    assert tau["std"] > 0 and 0 < motion.data["enough"] < 10


def test_priors_are_values_and_files(motion, tmp_path):
    friction = wj.Friction(viscous=5, coulomb=15, thermal_gain=-3, thermal_time_constant=600)
    friction.save(tmp_path / "friction.json")
    short = {"minutes": 4, "limits": LIMITS, "noise": 0.5, "method": "energy-ml"}
    given, read = wj.design(prior=friction, **short), wj.design(prior=tmp_path / "friction.json", **short)
    assert np.array_equal(given.velocity, read.velocity)
    with pytest.raises(wj.BadInput, match="prior"):
        wj.design(prior=5)
    with pytest.raises(wj.BadInput, match="coulomb"):
        wj.design(4, prior={"law": "viscous_coulomb", "parameters": {"viscous": 5}})


def test_a_log_is_enough_once_its_interval_is_there():
    scenario = {"friction": PRIOR | {"thermal": {"thermal_gain": -3, "thermal_time_constant": 600}}, "duration": 900,
                "motion": {"speeds": {"uniform": [0.1, 1]}, "hold": 10}, "noise": {"torque": 0.5}, "sampling": {"rate": 10}}
    log = wj.simulate(scenario).log
    found = wj.enough(log, "thermal_time_constant=5%", "energy-ml")
    assert found and found.minutes == pytest.approx(15, abs=0.1) and found.half_width < 0.05
    part = wj.simulate(scenario, duration=300).log
    found = wj.enough(part, "thermal_time_constant=5%", "energy-ml")
    assert not found and found.half_width > 0.05
    # the minutes that are missing are those of the longer log, in which they are enough
    longer = wj.simulate(scenario, duration=300 + 1.2 * 60 * found.minutes_more).log
    assert wj.enough(longer, "thermal_time_constant=5%", "energy-ml")
    with pytest.raises(wj.BadInput, match="goal"):
        wj.enough(log, "friction=0%")


def test_a_motion_is_drawn_with_what_is_foretold(program):
    program("design", "--minutes", 8, "--identifier", "energy-ml", "--limits", "position=-1..1,velocity=0.05..1", "-o", "drawn")
    program("plot", "drawn", "-o", "pictures", "--data")
    rows = (program.folder / "pictures/design.csv").read_text().splitlines()
    design = json.loads((program.folder / "drawn/design.json").read_text())
    coulomb = [row.split(",") for row in rows if ",coulomb,line," in row]
    assert [float(row[3]) for row in coulomb] == pytest.approx([answer["minutes"] for answer in design["foretold"]])
    last = design["foretold"][-1]["parameters"]["coulomb"]
    half = (last["interval95"][1] - last["interval95"][0]) / 2 / last["value"]
    assert float(coulomb[-1][4]) == pytest.approx(100 * half, rel=1e-3)
