"""What logs, estimates and frictions do in Python besides what the program does: copies, containers, words, heat."""

import concurrent.futures
import copy
import json
import multiprocessing
import os
import pathlib
import pickle
import re
import subprocess
import sys
import warnings

import numpy as np
import pytest
import warmjoint as wj

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def log(columns):
    return wj.Log(**columns)


@pytest.fixture(scope="module")
def estimate(log):
    return wj.identify(log, "energy-ml")


def identify(log):
    return wj.identify(log, "energy-ml")


def same(one, other):
    assert one.data == other.data


def test_copies_are_the_same_to_the_last_bit(log, estimate, recording, columns):
    without = {name: values for name, values in columns.items() if name != "position"}
    for each in (log, wj.read(recording), wj.read([recording, recording]), wj.Log(**without), wj.Log(**columns, trim=0.5), log[100:2000]):
        for other in (pickle.loads(pickle.dumps(each)), copy.deepcopy(each), copy.copy(each)):
            np.testing.assert_array_equal(other.torque, each.torque)
            assert other.notes == each.notes and other.source == each.source
            same(wj.identify(other, "nominal-ls"), wj.identify(each, "nominal-ls"))
    other = pickle.loads(pickle.dumps(estimate))
    same(other, estimate)
    same(copy.deepcopy(estimate), estimate)
    assert other.residuals.torque.tolist() == estimate.residuals.torque.tolist()
    friction = estimate.fitted
    assert pickle.loads(pickle.dumps(friction)) == copy.deepcopy(friction) == friction
    with pytest.raises(wj.BadInput) as refusal:
        wj.read("absent.csv")
    assert str(pickle.loads(pickle.dumps(refusal.value))) == str(refusal.value)


def test_threads_and_processes_answer_alike(log, estimate, recording, program):
    program("simulate", "scenario.yaml", "-o", "of_hdf5", "--set", "duration=300")
    wj.read(program.folder / "of_hdf5/recording.csv").save(program.folder / "log.h5")
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        for answer in pool.map(identify, [log] * 16):
            same(answer, estimate)
        lengths = set(pool.map(lambda _: len(wj.read(program.folder / "log.h5")), range(16)))
        assert len(lengths) == 1
    with concurrent.futures.ProcessPoolExecutor(8, mp_context=multiprocessing.get_context("spawn")) as pool:
        for answer in pool.map(identify, [log] * 8):
            same(answer, estimate)


def test_joblib_and_dask_map_over_logs(log, estimate):
    joblib = pytest.importorskip("joblib")
    for answer in joblib.Parallel(2)(joblib.delayed(identify)(one) for one in [log, log]):
        same(answer, estimate)
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, distributed.Client(cluster) as pool:
        for answer in pool.gather(pool.map(identify, [log, log], pure=False)):
            same(answer, estimate)


def test_an_estimate_is_a_container(estimate):
    assert "coulomb" in estimate and "stiction" not in estimate and 0 not in estimate
    assert list(estimate) == list(estimate.parameters) == list(estimate.data["parameters"])
    names, matrix = estimate.covariance
    np.testing.assert_allclose(matrix, matrix.T)
    assert matrix.shape == (len(names),) * 2 and "coulomb" in names
    residuals = estimate.residuals
    np.testing.assert_allclose(np.sqrt(np.mean(residuals.torque**2)), estimate.metrics["rmse"], rtol=1e-6)
    assert len(residuals) == len(residuals.time) == estimate.metrics["n"]
    pandas = pytest.importorskip("pandas")
    table = estimate.to_pandas()
    assert isinstance(table, pandas.DataFrame) and table.loc["coulomb", "value"] == estimate["coulomb"].value
    assert table.loc["coulomb", "lower"] == estimate["coulomb"].ci95[0]


def test_a_value_at_its_bound_is_shown_as_a_range(estimate):
    data = copy.deepcopy(estimate.data)
    data["parameters"]["viscous"].update(value=1.2e-18, interval95=[0, 0.41])
    held = wj.Estimate(data)
    assert repr(held["viscous"]) == "viscous = 0 to 0.41 N.m.s/rad" and "  viscous = 0 to 0.41 N.m.s/rad\n" in repr(held)
    assert "<td>0 to 0.41</td>" in held._repr_html_()
    assert held["viscous"].value == 1.2e-18  # the number is as it was
    assert " (" in repr(estimate["viscous"]) and max(map(len, repr(estimate).splitlines())) <= 100


def test_a_log_is_cut_drawn_and_shown(log, columns):
    part = log[200:2200]
    np.testing.assert_array_equal(part.torque, columns["torque"][200:2200])
    np.testing.assert_array_equal(log.between(200, 2200).time, columns["time"][(columns["time"] >= 200) & (columns["time"] < 2200)])
    for wrong in (0, "a", slice(0, 100, 2)):
        with pytest.raises(TypeError, match="log"):
            log[wrong]
    for wrong in (slice(0, 2), slice(500, 100)):
        with pytest.raises(wj.BadInput, match="at least 3"):
            log[wrong]
    assert "<table>" in log._repr_html_() and log.source in log._repr_html_()
    pytest.importorskip("matplotlib")
    assert len(log.plot().axes) >= 3
    pytest.importorskip("pandas")
    assert list(log.to_pandas()) == ["time", "position", "velocity", "torque"]


def test_numbers_of_a_refused_answer_are_nan(columns, tmp_path):
    turned = wj.identify(wj.Log(**columns, scale={"torque": -1}), "nominal-ls")
    assert turned.status == "bad_data"
    with pytest.warns(wj.Void, match="bad_data"):
        assert np.isnan(turned["viscous"].value) and turned["viscous"].ci95 is None
    with pytest.warns(wj.Void):
        assert all(np.isnan(one.value) for one in turned.parameters.values())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "nan" in repr(turned) and "nan" in turned._repr_html_()
        forced = wj.identify(wj.Log(**columns, scale={"torque": -1}), "nominal-ls", force=True)
        assert np.isfinite(forced["viscous"].value)
        turned.save(tmp_path / "estimate.json")
        assert np.isfinite(wj.load(tmp_path / "estimate.json", force=True)["viscous"].value)
        assert np.isfinite(wj.identify(wj.Log(**columns), "nominal-ls", force=True)["viscous"].value)
    # what a model leaves out voids its numbers as well
    inadequate = wj.identify(wj.Log(**columns), "nominal-ls")
    assert inadequate.status == "inadequate_model"
    with pytest.warns(wj.Void, match="inadequate_model"):
        assert np.isnan(inadequate["viscous"].value) and inadequate["viscous"].ci95 is None
    with pytest.warns(wj.Void):
        assert np.isnan(wj.load(tmp_path / "estimate.json")["viscous"].value)


def test_a_pickled_estimate_of_files_is_small_and_reads_them_again(recording, log, estimate, tmp_path):
    (tmp_path / "log.csv").write_bytes(recording.read_bytes())
    of_file = wj.identify(wj.read(tmp_path / "log.csv"), "energy-ml")
    columns = 4 * 8 * len(log)  # bytes of the log
    assert len(pickle.dumps(of_file)) < len(pickle.dumps(estimate)) - columns
    other = pickle.loads(pickle.dumps(of_file))
    same(other, of_file)
    assert other.residuals.torque.tolist() == of_file.residuals.torque.tolist()
    alone = pickle.loads(pickle.dumps(estimate.without_log()))
    same(alone, estimate)
    assert len(pickle.dumps(alone)) < len(pickle.dumps(estimate)) - columns
    with pytest.raises(wj.BadInput, match="log="):
        alone.residuals  # noqa: B018
    # where the file is gone the log stays
    os.remove(tmp_path / "log.csv")
    assert pickle.loads(pickle.dumps(of_file)).residuals.torque.tolist() == of_file.residuals.torque.tolist()


def test_two_estimates_are_compared(log, estimate):
    again = wj.identify(log, "energy-ml")
    rows = {row["name"]: row for row in wj.compare(estimate, again)}
    assert rows["coulomb"]["first"] == rows["coulomb"]["second"] == estimate["coulomb"].value
    assert rows["coulomb"]["apart"] == rows["coulomb"]["difference"] == 0
    cold = {row.speed: row for row in estimate.friction_at_speeds if not row.heat}
    shown = [row for name, row in rows.items() if name.startswith("friction at")]
    assert len(shown) == len(cold)
    for row, known in zip(sorted(shown, key=lambda row: row["first"]), sorted(cold.values(), key=lambda known: known.value), strict=True):
        assert row["first"] == pytest.approx(known.value) and row["first_lower"] == pytest.approx(known.ci95[0])
    # halves of one log agree within their intervals, and each row says by how much
    first, second = (wj.identify(one, "energy-ml", holdout=0) for one in (log[: len(log) // 2], log))
    board = wj.compare(first, second)
    row = next(row for row in board if row["name"] == "viscous")
    halves = [(one["viscous"].ci95[1] - one["viscous"].ci95[0]) / 2 for one in (first, second)]
    assert row["apart"] == pytest.approx(abs(first["viscous"].value - second["viscous"].value) / np.hypot(*halves))
    assert "viscous" in board._repr_html_()
    # a number that one of the two does not have, or that is void
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        void = {row["name"]: row for row in wj.compare(estimate, wj.identify(log, "nominal-ls"))}
    assert np.isnan(void["viscous"]["second"]) and void["viscous"]["apart"] is None and void["thermal_gain"]["second"] is None
    for wrong in ((estimate, "x"), (estimate,), ("x", estimate)):
        with pytest.raises(wj.BadInput, match="two estimates"):
            wj.compare(*wrong)


def test_remedies_are_arguments(columns, log):
    turned = wj.identify(wj.Log(**columns, scale={"torque": -1}), "nominal-ls")
    assert {"scale": {"torque": -1}} in turned.remedies and 'scale={"torque": -1}' in turned.message
    cold = wj.identify(log, "nominal-ls")
    assert "--" not in cold.message and "method=" in cold.message
    better = wj.identify(log, **cold.remedies[0])
    assert better.ok
    assert "--identifier" in cold.data["message"]  # as in the program's file


def test_refusals_name_arguments(tmp_path):
    (tmp_path / "log.csv").write_text("t,q,i\n" + "".join(f"{i},{i % 7},{i % 5}\n" for i in range(50)))
    for call, words in (
        (lambda: wj.read(tmp_path / "log.csv"), r'map=\{"time": "t", "position": "q", "torque": "i"\}'),
        (lambda: wj.read(tmp_path / "log.csv", rate=-1), "^rate: is -1"),
        (lambda: wj.read(tmp_path / "log.csv", map={"time": "t", "position": "q", "torque": "i"}, unit={"torque": "A"}, torque_constant=float("nan")),
         "torque_constant"),
        (lambda: wj.identify({"time": [0, 1, 2], "position": [0, 1, 2], "torque": [0, 1, 0]}, "nominal-ls", gravity="sincos", relevance=3), "relevance"),
    ):
        with pytest.raises(wj.BadInput, match=words) as refusal:
            call()
        assert not re.search(r"--[a-z]", str(refusal.value))


# options that no function of the package has, and those of `warmjoint design`, which messages give as a whole command
COMMAND_LINE = {"minutes", "for", "follows", "pause", "explain", "plot", "format", "quiet", "output", "mjcf", "segments", "help",
                "package", "joint-name", "figure"}


def test_every_option_in_a_message_has_an_argument():
    """Options in the texts of the rooms that Python calls, in string literals."""
    found = set()
    for room in ("models", "identification", "tools/identify"):
        for file in (ROOT / room).rglob("*.cc"):
            for literal in re.findall(r'"((?:[^"\\\n]|\\.)*)"', re.sub(r"^\s*//.*$", "", file.read_text(), flags=re.M)):
                found |= set(re.findall(r"(?<![\w-])--([a-z][a-z-]*)", literal))
    assert {"map", "unit", "identifier", "set"} <= found
    left = {name for name in found - COMMAND_LINE if f"--{name}" in wj._core.in_python(f"give --{name}, or not")}
    assert not left


@pytest.mark.parametrize(("given", "spoken", "calls"), [
    ("Name them: --map time=t,position=NAME, or give --rate HZ", 'Name them: map={"time": "t", "position": NAME}, or give rate=HZ', []),
    ("--map 'torque=tau (mNm),time=t [s]'; where", 'map={"torque": "tau (mNm)", "time": "t [s]"}; where',
     [{"map": {"torque": "tau (mNm)", "time": "t [s]"}}]),
    ("try --identifier stribeck --set law=asymmetric_stribeck, or log", 'try method="stribeck", law="asymmetric_stribeck", or log',
     [{"method": "stribeck", "law": "asymmetric_stribeck"}]),
    ("raise --trim, so; --trim 0.5.", "raise trim, so; trim=0.5.", [{"trim": 0.5}]),
    ("(--scale torque=-1 turns it)", '(scale={"torque": -1} turns it)', [{"scale": {"torque": -1}}]),
    ("--unit velocity=..., position=...", 'unit={"velocity": "...", "position": "..."}', []),
    ("give --gear or a column", "give gear or a column", []),
    ("--set iterations=500 --gravity sincos", 'iterations=500, gravity="sincos"', [{"iterations": 500, "gravity": "sincos"}]),
    ("leave out, --map velocity=, and", 'leave out, map={"velocity": ""}, and', [{"map": {"velocity": ""}}]),
    ("a -- b --unknown x-y--set", "a -- b --unknown x-y--set", []),
    ("identify with --force to see", "identify with force=True to see", [{"force": True}]),
])
def test_words_of_the_command_line_become_those_of_python(given, spoken, calls):
    assert wj._core.in_python(given) == spoken
    assert wj._core.calls_in(given) == calls


def test_a_loaded_estimate_draws_what_its_recording_allows(recording, log, estimate, tmp_path):
    pytest.importorskip("matplotlib")
    (tmp_path / "log.csv").write_bytes(recording.read_bytes())
    of_file = wj.identify(wj.read(tmp_path / "log.csv"), "energy-ml")
    of_file.save(tmp_path / "estimate.json")
    loaded = wj.load(tmp_path / "estimate.json")
    assert set(loaded.figures()) == set(of_file.figures())
    assert loaded.residuals.torque.tolist() == of_file.residuals.torque.tolist()
    loaded.plot("fit")
    os.remove(tmp_path / "log.csv")
    alone = wj.load(tmp_path / "estimate.json")
    assert "fit" not in alone.figures()
    with pytest.raises(wj.BadInput, match=r"log\.csv is not there; give it: load\(path, log="):
        alone.plot("fit")
    assert set(wj.load(tmp_path / "estimate.json", log=log).figures()) == set(of_file.figures())
    with pytest.raises(wj.BadInput, match="gives no 'fitt'"):
        wj.load(tmp_path / "estimate.json", log=log).plot("fitt")


def test_heat_steps_by_the_formula():
    one = wj.Friction(viscous=5, coulomb=15, thermal_gain=-3, thermal_time_constant=600)
    loss = 0.5 * (15 + 2.5 - 2)
    expected = -2 * np.exp(-1 / 600) - 3 * (1 - np.exp(-1 / 600)) * loss
    np.testing.assert_allclose(one.step(-2, 0.5, 1), expected, rtol=1e-12)
    np.testing.assert_allclose(one.step([-2, 0], [0.5, 0], 1), [expected, 0], rtol=1e-12)
    two = wj.Friction(viscous=5, coulomb=15, thermal_gain=-0.03, thermal_time_constant=600,
                      second={"thermal_gain": -0.01, "thermal_time_constant": 60})
    heat = np.zeros(2)
    for _ in range(6000):
        heat = two.step(heat, 0.5, 1)
    np.testing.assert_allclose(heat.sum(), two.settled_heat(0.5), rtol=1e-4)
    settled = one.settled_heat([[0.1, 0.5]])
    assert settled.shape == (1, 2) and settled[0, 1] == one.settled_heat(0.5)
    growing = wj.Friction(viscous=0, coulomb=1, thermal_gain=0.5, thermal_time_constant=10)
    assert growing.settled_heat(3) is None and np.isnan(growing.settled_heat([3.0])[0])
    for wrong in ({"dt": 0}, {"dt": -1}, {"speed": "x"}, {"heat": [0, 0], "speed": [1, 2, 3]}):
        with pytest.raises(wj.BadInput):
            one.step(**{"heat": 0, "speed": 1, "dt": 1, **wrong})


def test_progress_is_told(log):
    told = []
    wj.identify(log, "auto", progress=told.append)
    assert told and all(isinstance(words, str) for words in told)

    class StopIt(Exception):
        pass

    def stop(words):
        raise StopIt

    with pytest.raises(StopIt):
        wj.identify(log, "auto", progress=stop)
    with pytest.raises(wj.BadInput, match="progress"):
        wj.identify(log, progress=5)


def test_values_that_hold_themselves_or_never_end_are_refused():
    held = {"law": "coulomb", "parameters": {"coulomb": 1}}
    held["maps"] = [held]
    deep = []
    for _ in range(100_000):
        deep = [deep]
    twice = [1.0]
    for _ in range(64):
        twice = [twice, twice]
    for value, words in ((held, "holds itself"), ({"law": "coulomb", "parameters": {"coulomb": 1}, "maps": deep}, "64 levels"), ({"law": twice}, "levels|more than")):
        with pytest.raises(wj.BadInput, match=words):
            wj.Friction.from_dict(value)
    for call in (lambda: wj.Friction("coulomb", coulomb=10**30), lambda: wj.read("\udcff.csv"), lambda: wj.read("a\0b"),
                 lambda: wj.Friction("coulomb\udcff", coulomb=1), lambda: wj.Friction(coulomb=1, **{"\udcff": 1})):
        with pytest.raises(wj.BadInput):
            call()


def test_memory_of_many_identifications_does_not_grow(tmp_path):
    """What 200 identifications leave after the first 100; the long attack makes 10,000."""
    code = f"""
import numpy as np, resource, sys, warmjoint as wj
sys.path.insert(0, {os.fspath(ROOT / 'tests/attack')!r})
from package import samples, resident
log = wj.Log(**samples())
for i in range(300):
    wj.identify(wj.Log(**samples()), "nominal-ls")
    if i == 100:
        before = resident()
print(resident() - before)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 1_000_000


def test_the_board_is_a_list_that_pandas_takes(program):
    pytest.importorskip("mujoco")
    suite = {"name": "small", "question": "Which?", "realizations": 2, "identifiers": [{"name": "nominal-ls"}],
             "scenario": {"friction": {"law": "coulomb", "parameters": {"coulomb": 2}}, "motion": {"speeds": [0.5, 1], "hold": 5},
                          "noise": {"torque": 0.1}, "duration": 60}}
    board = wj.compare(wj.run(suite, program.folder / "of_a_dict"))
    assert isinstance(board, list) and board[0]["identifier"] == "nominal-ls" and "<table>" in board._repr_html_()
    assert json.loads(json.dumps(board[0]))["runs"] == 2
    pandas = pytest.importorskip("pandas")
    assert isinstance(board.to_pandas(), pandas.DataFrame)
    with pytest.raises(wj.BadInput, match="suite"):
        wj.run({"name": float("nan")}, program.folder / "wrong")


def test_the_package_lists_what_it_has():
    assert {"attach", "bind", "identify", "Log"} <= set(dir(wj))
