"""Identification from Python is that of the program."""

import json
import os
import signal
import threading
import time

import numpy as np
import pytest
import warmjoint as wj


@pytest.mark.parametrize(("method", "options"), [("energy-ml", {}), ("nominal-ls", {}), ("energy-ml", {"law": "asymmetric"}),
                                                 ("auto", {}), ("energy-als", {"iterations": 50})])
def test_the_estimate_is_that_of_the_program_to_the_last_bit(program, recording, method, options):
    words = [word for name, value in options.items() for word in ("--set", f"{name}={value}")]
    ok = wj.identify(wj.read(recording), method, **options)
    program("identify", recording, "--identifier", method, *words, "-o", "estimate.json", status=0 if ok.ok else 3)
    theirs = json.loads((program.folder / "estimate.json").read_text())
    del theirs["recording"]
    ours = {key: value for key, value in ok.data.items() if key != "recording"}
    assert ours == theirs
    # saved, it is the same file but for the names of its recording
    ok.save(program.folder / "saved.json")
    saved = json.loads((program.folder / "saved.json").read_text())
    del saved["recording"]
    assert saved == theirs
    assert wj.load(program.folder / "saved.json").data["parameters"] == theirs["parameters"]


def test_arrays_give_what_their_file_gives(recording, columns):
    ours = wj.identify(wj.Log(**columns), "energy-ml")
    assert ours.data["parameters"] == wj.identify(wj.read(recording), "energy-ml").data["parameters"]
    assert ours.ok and abs(ours["coulomb"].value - 15) < 4 * ours["coulomb"].std
    assert ours["coulomb"].ci95[0] < ours["coulomb"].value < ours["coulomb"].ci95[1]
    assert ours["coulomb"].unit == "N.m"
    with pytest.raises(KeyError, match="viscous"):
        ours["stiction"]


def test_units_are_converted(columns):
    given = {**columns, "position": np.degrees(columns["position"]), "velocity": np.degrees(columns["velocity"])}
    log = wj.Log(**given, unit={"position": "deg", "velocity": "deg/s"}, scale={"torque": -1})
    np.testing.assert_allclose(log.position, columns["position"], rtol=1e-12)
    np.testing.assert_array_equal(log.torque, -columns["torque"])


def test_a_data_frame_is_a_log(columns):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"stamp": pandas.Timestamp("2024-03-01") + pandas.to_timedelta(columns["time"], unit="s"),
                              "q": columns["position"], "torque": columns["torque"]})
    log = wj.Log.from_pandas(frame, time="stamp", position="q")
    np.testing.assert_allclose(log.time, columns["time"], atol=1e-6)
    np.testing.assert_array_equal(log.torque, columns["torque"])
    with pytest.raises(wj.BadInput, match="q_m"):
        wj.Log.from_pandas(frame, time="stamp", position="q_m")


def test_several_logs_begin_cold_each(columns):
    one = wj.Log(**columns)
    both = wj.identify([one, one], "energy-ml")
    assert both.metrics["n"] == 2 * wj.identify(one, "energy-ml").metrics["n"]


def test_a_velocity_does_without_positions(columns):
    given = {name: column for name, column in columns.items() if name != "position"}
    log, whole = wj.Log(**given), wj.Log(**columns)
    np.testing.assert_allclose(log.position, whole.position - whole.position[0], atol=0.1 * np.ptp(whole.position))
    estimate = wj.identify(log, "nominal-ls")
    assert estimate.status == wj.identify(whole, "nominal-ls").status
    assert any("no positions" in warning for warning in estimate.data["warnings"])
    assert wj.identify(log, "position-ridge").status != "ok"


@pytest.mark.parametrize(("call", "words"), [
    (lambda log: wj.Log(time=[0, 1, 2], torque=[1, 2, 1]), "position"),
    (lambda log: wj.identify(log, "energyml"), "did you mean 'energy-ml'"),
    (lambda log: wj.identify(log, "energy-ml", lw="asymmetric"), "did you mean 'law'"),
    (lambda log: wj.identify(log, gravity="sinus"), "sincos"),
    (lambda log: wj.identify(log, relevance=2), "relevance"),
    (lambda log: wj.identify(log, holdout=1), "holdout"),
    (lambda log: wj.Log(time=[0, 1], position=[0, 1], torque=[1]), "torque"),
    (lambda log: wj.Log(time=[[0, 1], [1, 2]], position=[0, 1], torque=[1, 1]), "shape"),
    (lambda log: wj.Log(time=["a", "b"], position=[0, 1], torque=[1, 1]), "time"),
    (lambda log: wj.read("absent.csv"), "absent.csv"),
    (lambda log: wj.read(log.source, map={"positon": "q"}), "position"),
    (lambda log: wj.Friction(law="coulom", coulomb=1), "coulomb"),
    (lambda log: wj.Friction(coulomb=1, viscous=-1), "viscous"),
    (lambda log: wj.Friction(coulomb=1, viscous=1, thermal_gain="hot"), "thermal_gain"),
])
def test_what_cannot_be_used_is_refused_with_the_programs_sentence(recording, call, words):
    with pytest.raises(wj.BadInput, match=words):
        call(wj.read(recording))


def test_what_fails_is_a_status(columns):
    few = {name: column[:40] for name, column in columns.items()}
    estimate = wj.identify(wj.Log(**few), "energy-ml")
    assert not estimate.ok and estimate.status == "not_identifiable" and estimate.message
    with pytest.raises(wj.Rejected, match="not_identifiable"):
        estimate.raise_if_rejected()
    with pytest.raises(wj.Rejected):
        estimate.friction(1)


def test_the_check_is_that_of_the_program(program, recording):
    ours = wj.check(wj.read(recording))
    assert ours.data == json.loads(program("check", recording, "--format", "json"))
    assert ours.text == wj._core.in_python(program("check", recording))
    assert ours.can_identify["law viscous_coulomb"]


def test_prediction_is_that_of_the_program(program, recording):
    log = wj.read(recording)
    estimate = wj.identify(log, "energy-ml")
    estimate.save(program.folder / "estimate.json")
    for initial, words in (("cold", "cold"), ("end", "end"), (0.5, "settled:0.5")):
        ours = estimate.predict(log, initial)
        theirs = json.loads(program("predict", "estimate.json", recording, "--initial", words, "--format", "json"))
        assert ours.metrics["rmse"] == theirs["metrics"]["rmse"]
        assert ours.heat[-1] == theirs["state_end"]["energy"]
        assert len(ours.torque) == len(log)


def test_friction_is_the_formula(columns):
    estimate = wj.identify(wj.Log(**columns), "energy-ml")
    viscous, coulomb = estimate["viscous"].value, estimate["coulomb"].value
    speed = np.array([[-1.0, 0.2], [0.5, 1]])
    np.testing.assert_allclose(estimate.friction(speed, heat=-2), viscous * speed + np.sign(speed) * (coulomb - 2), rtol=1e-12)
    # the band of a linear law is that of its two parameters
    value, lower, upper = estimate.friction(0.5, band=True)
    matrix = np.array(estimate.data["covariance"]["matrix"])
    rows = [estimate.data["covariance"]["parameters"].index(name) for name in ("viscous", "coulomb")]
    std = np.array([np.ptp(estimate[name].ci95) / (2 * 1.96) for name in ("viscous", "coulomb")])
    part = matrix[np.ix_(rows, rows)]
    part *= np.outer(std, std) / np.sqrt(np.outer(np.diag(part), np.diag(part)))
    direction = np.array([0.5, 1])
    np.testing.assert_allclose(upper - value, 1.96 * np.sqrt(direction @ part @ direction), rtol=1e-6)
    np.testing.assert_allclose(value - lower, upper - value)
    # E = k W
    np.testing.assert_allclose(estimate.temperature_rise(heat=-3, watts_per_kelvin=2), -3 / estimate["thermal_gain"].value / 2)


def test_a_friction_file_reads_back(tmp_path):
    friction = wj.Friction(law="stribeck", coulomb=3, viscous=1, static=4, stribeck_velocity=0.1, thermal_gain=-0.1,
                           thermal_time_constant=100)
    friction.save(tmp_path / "friction.json")
    assert wj.Friction.load(tmp_path / "friction.json") == friction
    heat = friction.settled_heat(1)
    np.testing.assert_allclose(heat, -0.1 * friction(1, heat=heat))
    assert friction.changed("coulomb", 0.5).parameters["coulomb"] == 3.5


def test_figures_are_drawn_and_the_page_is_written(columns, tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    estimate = wj.identify(wj.Log(**columns), "energy-ml")
    drawn = estimate.plot()
    assert len(drawn.axes) > 2
    drawn.savefig(tmp_path / "fit.png")
    _, ax = pyplot.subplots()
    assert estimate.plot(ax=ax) is ax.figure and ax.get_xlabel().startswith("velocity")
    with pytest.raises(wj.BadInput, match="friction_curve"):
        estimate.plot("fitt")
    # without its log an estimate has fewer
    estimate.save(tmp_path / "estimate.json")
    assert "log" in estimate.figures() and "log" not in wj.load(tmp_path / "estimate.json").figures()
    pytest.importorskip("jinja2")
    estimate.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert "coulomb" in page and "data:image/png;base64" in page and "http://" not in page.split("<style")[0]


def test_lists_are_those_of_the_program(program):
    assert list(wj.identifiers()) == program("list", "identifiers", "--format", "names").split()
    laws = [name for name in program("list", "laws", "--format", "names").split() if name in wj.laws()]
    assert laws == list(wj.laws())


def test_other_threads_run_meanwhile_and_ctrl_c_ends_it(columns):
    n = 400_000
    many = {name: np.interp(np.linspace(0, 1, n), np.linspace(0, 1, len(column)), column) for name, column in columns.items()}
    log = wj.Log(**many)
    ticks = []
    begin = time.monotonic()

    def interrupt():
        for _ in range(10):
            time.sleep(0.01)
            ticks.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        wj.identify(log, "auto")
    thread.join()
    assert len(ticks) == 10 and time.monotonic() - begin < 5
