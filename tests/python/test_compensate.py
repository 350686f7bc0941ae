"""Compensation: an estimate's own, along a log, over a day with the truth beside it, as code, and from the program."""

import copy
import csv
import json
import math
import pathlib
import pickle
import shutil
import subprocess
import sys

import numpy as np
import pytest
import warmjoint as wj
from warmjoint.export import export_frictions

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/studies"))

import compensation_day as study  # noqa: E402

MAP = {"axes": [{"quantity": "motor_position", "centres": [0, 2, 4], "width": 0.8, "period": 2 * math.pi},
                {"quantity": "velocity", "centres": [-0.5, 0.5], "width": 0.5, "sides": "apart"}],
       "kernels": "plain", "weights": [0.1, -0.3, 0.5, 0.2, -0.6, 0.4], "factor": "one"}
RICH = {"law": "asymmetric_stribeck",
        "parameters": {"viscous": 5, "coulomb_positive": 15, "coulomb_negative": 12, "static_rise": 3, "stribeck_velocity": 0.2,
                       "stribeck_exponent": 1.4},
        "thermal": {"thermal_gain": -0.75, "thermal_time_constant": 600, "second": {"thermal_gain": -0.2, "thermal_time_constant": 90}},
        "gear": 11, "load_gain": 0.1, "maps": [MAP]}


@pytest.fixture(scope="module")
def estimate(recording):
    return wj.identify(recording, "energy-ml")


def test_an_estimate_compensates_its_friction(estimate):
    compensator = estimate.compensator(share=1, dead_band=0)
    for speed in (0.2, -0.7):
        assert compensator.step(speed, dt=0) == pytest.approx(float(estimate.friction(speed)), rel=1e-12)
    # as estimates know it: by their covariance and their residual
    assert 0 < compensator.std < 0.1
    assert estimate.compensator().step(0.2, dt=0) == pytest.approx(0.9 * float(estimate.friction(0.2)), rel=1e-12)
    # no torque far below the slowest speed that the log knows
    slowest = min(abs(one.speed) for one in estimate.friction_at_speeds)
    assert estimate.compensator().step(slowest / 20, dt=0) == 0


def test_it_warms_along_a_log_as_the_estimate_predicts(estimate, recording):
    log = wj.read(recording)
    found = estimate.compensator(correct=False).run(log)
    predicted = estimate.predict(log)
    moves = found.velocity != 0
    # both have the same losses but for the samples between holds
    assert np.abs(found.energy - predicted.heat).max() < 0.05 * np.abs(predicted.heat).max()
    # the noise of the scenario is .5 N.m
    assert np.sqrt(np.nanmean(found.residual[moves] ** 2)) == pytest.approx(0.5, rel=0.1)
    assert np.isnan(found.residual[~moves]).all()


def test_copies_and_pickles_go_on_as_it_does():
    first = wj.Compensator(RICH, noise=0.5)
    for i in range(500):
        first.step(math.sin(0.1 * i), 18 * math.sin(0.1 * i), 0.01, position=0.1 * i)
    others = [copy.deepcopy(first), pickle.loads(pickle.dumps(first))]
    for i in range(500, 600):
        sample = (math.sin(0.1 * i), 18 * math.sin(0.1 * i), 0.01)
        torque = first.step(*sample)
        assert [one.step(*sample) for one in others] == [torque, torque]
    assert all(one.state == first.state for one in others)


def test_its_state_cools_while_the_power_is_off():
    first, next_day = wj.Compensator(RICH), wj.Compensator(RICH)
    for _ in range(1000):
        first.step(0.5, dt=0.5)
    next_day.restore(first.state, seconds_off=600)
    assert next_day.state["energy"] == pytest.approx(first.state["energy"] * math.exp(-1), rel=1e-9)
    unknown = wj.Compensator(RICH)
    unknown.restore(first.state)
    assert unknown.state["energy"] == first.state["energy"] / 2
    assert unknown.state["variance"] > first.state["variance"]
    with pytest.raises(wj.BadInput, match="energy"):
        unknown.restore({"correction": 0.0})


@pytest.fixture
def morning(monkeypatch):
    """The first two hours of the study's day."""
    monkeypatch.setattr(study, "HOURS", 2)
    monkeypatch.setattr(study, "N", int(2 * 3600 / study.DT))


def test_over_a_morning_the_residual_stays_near_zero(morning):
    """The study's joint, within what the study finds over five days."""
    day = study.make_day(0)
    rms, _, worst, starts, push = study.measures(day, study.compensator(True).run(day.log()).friction)
    truth = study.measures(day, day.friction)
    assert rms <= 0.3
    assert worst <= 2
    assert starts <= 0.5
    assert push <= 1.05 * truth[4]
    assert study.rise_where_exact(0) <= 2


def test_a_push_in_the_warm_up_is_no_friction(morning):
    bias = study.contact(0)
    assert abs(bias["heat, corrected"]) <= 0.5
    assert abs(bias["heat, open loop"]) <= 0.25
    # what a level that is never still makes of it
    assert bias["level without heat, never still"] < -1.5


def compiled(text, language, folder):
    """The friction at velocities of code that was exported: position 1, load 3, E as it is after 60 s."""
    compiler = shutil.which("gcc" if language == "c" else "g++")
    if not compiler:
        pytest.skip("no compiler")
    friction = "elbow_friction" if language == "c" else "elbow_friction()"
    program = text + f"""
#include <stdio.h>
int main(void) {{
  wj_friction friction = {friction};
  wj_joint joint;
  wj_begin(&joint, &friction);
  joint.settings.share = 1;
  joint.at.position = 1;
  joint.at.load = 3;
  for (int i = 0; i < 6; ++i) printf("%.17g ", wj_step(&joint, 0.3 * i - 0.8, NAN, 0.5));
  return 0;
}}
"""
    (folder / f"elbow.{language}").write_text(program)
    standard = "c99" if language == "c" else "c++11"
    command = [compiler, f"-std={standard}", "-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-I{ROOT}/models/include", f"elbow.{language}", "-lm"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [float(one) for one in subprocess.check_output([folder / "a.out"], text=True).split()]


@pytest.mark.parametrize("language", ["c", "cpp", "python"])
def test_exported_code_is_the_friction(tmp_path, language):
    text = export_frictions(RICH, language, warm=0, speed=None, joint="elbow").text
    compensator = wj.Compensator(RICH, share=1, dead_band=0)
    expected = [compensator.step(0.3 * i - 0.8, dt=0.5, position=1, load=3) for i in range(6)]
    if language == "python":
        names = {}
        exec(text, names)
        told = names["elbow_friction"]
        assert [told.step(0.3 * i - 0.8, dt=0.5, position=1, load=3) for i in range(6)] == [0.9 * one for one in expected]
    else:
        np.testing.assert_allclose(compiled(text, language, tmp_path), expected, rtol=1e-14)


def test_code_has_intervals_and_no_warmth(estimate):
    text = estimate.export("c", joint="elbow 1/2\n").text
    lower, upper = estimate["coulomb"].ci95
    assert f"{lower:.6g} .. {upper:.6g} N.m" in text
    assert "elbow_1_2__friction" in text
    with pytest.raises(wj.BadInput, match="warm"):
        estimate.export("c", warm=1)


def test_the_program_exports_the_same_code(estimate, program):
    estimate.save(program.folder / "estimate.json")
    assert program("export", "estimate.json", "--to", "cpp", "--joint", "elbow") == estimate.export("cpp", joint="elbow").text
    program("export", "estimate.json", "--to", "cpp", "--speed", 0.5, status=2)


def rows_of(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name.partition(" [")[0]: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def test_the_program_does_so_with_a_state(estimate, recording, program):
    estimate.save(program.folder / "estimate.json")
    log = ("compensate", recording, "--friction", "estimate.json")
    told = json.loads(program(*log, "--correct", "--state", "state.json", "-o", "out.csv", "--format", "json"))
    found, columns = estimate.compensator().run(wj.read(recording)), rows_of(program.folder / "out.csv")
    np.testing.assert_allclose(columns["friction"], found.friction, rtol=1e-12)
    np.testing.assert_allclose(columns["compensation"], found.compensation, rtol=1e-12)
    np.testing.assert_allclose(columns["energy"], found.energy, rtol=1e-12, atol=1e-12)
    assert told["residual_rms"] < told["friction_rms"] / 10
    kept = json.loads((program.folder / "state.json").read_text())
    assert kept == told["state_end"]

    # the next log begins with what is left after the pause; stamps of both begin at 0 and tell none
    program(*log, "--state", "state.json", status=2)
    assert json.loads((program.folder / "state.json").read_text()) == kept
    program(*log, "--state", "state.json", "--pause", 600, "-o", "next.csv")
    assert rows_of(program.folder / "next.csv")["energy"][0] == pytest.approx(kept["energy"] * math.exp(-600 / estimate["thermal_time_constant"].value))

    # as HDF5, too
    program(*log, "-o", "out.h5")
    h5py = pytest.importorskip("h5py")
    with h5py.File(program.folder / "out.h5") as file:
        assert {"friction", "residual", "energy", "contact"} <= set(file)
        assert file["friction"].attrs["unit"] in ("N.m", b"N.m")


@pytest.mark.parametrize("how, words", [({"share": 1.2}, "share"), ({"heat": "oven"}, "model"), ({"noise": -1}, "noise"), ({"dead_band": "x"}, "dead_band")])
def test_bad_settings_are_refused(how, words):
    with pytest.raises(wj.BadInput, match=words):
        wj.Compensator(RICH, **how)


def test_a_suite_compares_compensators(program):
    suite = {
        "name": "little", "question": "Which compensation stays true?", "realizations": 1, "seed": 3,
        "scenario": {
            "friction": {"law": "viscous_coulomb", "parameters": {"viscous": 5, "coulomb": 15},
                         "thermal": {"thermal_gain": -0.75, "thermal_time_constant": 600}},
            "motion": {"speeds": {"uniform": [0.1, 1]}, "hold": 5}, "noise": {"torque": 0.5}, "sampling": {"rate": 20}, "duration": 1200,
            "disturbances": {"load_change": {"load": 10, "gain": 0.1, "period": 240}}},
        "compensators": [{"name": "none"}, {"name": "fixed"}, {"name": "heat"}, {"name": "truth"}]}
    pytest.importorskip("mujoco")
    done = wj.run(suite, program.folder / "contest")
    rows = {row["identifier"]: row for row in wj.compare(done)}
    assert list(rows) == ["heat", "fixed", "none", "truth"]
    # a friction file knows how friction grows with the load, of 1 N.m in some 15
    assert rows["heat"]["measures_residual_median"] < 1
    text = program("compare", "contest")
    assert "heat is best: its median residual is" in text and "10 min after starts" in text
    pytest.importorskip("matplotlib")
    program("plot", "contest", "--figure", "residual_by_minute", "-o", "pictures", "--data")
    assert (program.folder / "pictures/residual_by_minute.png").exists()
    program("report", "contest", "-o", "page.html")
