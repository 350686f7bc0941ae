"""One way of reading for a joint's Log and for a robot's log: whatever holds the numbers, both take it, or both refuse it."""

import json
import pathlib
import sys
import types

import numpy as np
import pytest
import warmjoint as wj
from warmjoint import _core, robot

N = 400
T = np.arange(N) / 50
Q = np.stack([np.sin(T), .8 * np.cos(1.3 * T)], axis=1)
X = np.stack([3 * np.cos(T), 2 * np.sin(1.3 * T)], axis=1)
ARM = """<mujoco><worldbody><body><joint name="lift" axis="0 1 0"/><geom size=".1" mass="1"/>
<body pos=".4 0 0"><joint name="elbow" axis="0 1 0"/><geom size=".1" mass="1"/></body></body></worldbody></mujoco>"""
URDF = """<robot name="arm"><link name="base"/><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="lift" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint></robot>"""


class Engine:
    """Keeps what it is given in place of identifying."""

    def identify_robot(self, model, logs, read, settings):
        self.model, self.logs, self.read = model, logs, read
        self.text = pathlib.Path(model).read_text(errors="replace") if model.endswith((".xml", ".urdf")) else ""
        raise Taken


class Taken(Exception):
    pass


@pytest.fixture
def engine(monkeypatch):
    found = Engine()
    monkeypatch.setattr(robot, "_engine", lambda: found)
    return found


def robot_columns(engine, given, **arguments):
    """{name: (unit, [N], refusal)} of a robot's log, as the engine gets it."""
    with pytest.raises(Taken):
        wj.identify_robot(ARM, given, **arguments)
    return {name: (unit, values, refusal) for name, unit, values, refusal in engine.logs[0][1]}


def frames():
    """{kind: one joint's table, a robot's} in all that holds columns; masked samples 3 and 4 of a torque."""
    hidden = np.zeros_like(X, dtype=bool)
    hidden[3:5, 0] = True
    masked = np.ma.masked_array(np.where(hidden, 99, X), hidden)
    found = {"arrays": ({"time": T, "position": Q[:, 0], "torque": X[:, 0]}, {"time": T, "position": Q, "torque": X}),
             "masks": ({"time": T, "position": Q[:, 0], "torque": masked[:, 0]}, {"time": T, "position": Q, "torque": masked}),
             "objects": ({"time": T, "position": Q[:, 0].astype(object), "torque": X[:, 0].tolist()},
                         {"time": T, "position0": Q[:, 0].astype(object), "position1": Q[:, 1].tolist(), "torque0": X[:, 0].astype(object), "torque1": X[:, 1].tolist()})}
    records = np.rec.fromarrays([T, Q[:, 0], Q[:, 1], X[:, 0], X[:, 1]], names=["time", "position0", "position1", "torque0", "torque1"])
    found["records"] = (np.rec.fromarrays([T, Q[:, 0], X[:, 0]], names=["time", "position", "torque"]), records)
    pandas = pytest.importorskip("pandas")
    wide = pandas.DataFrame({"time": T, **{f"position{j}": Q[:, j] for j in range(2)}, **{f"torque{j}": X[:, j] for j in range(2)}})
    one = pandas.DataFrame({"time": T, "position": Q[:, 0], "torque": X[:, 0]})
    dates = lambda frame: frame.assign(time=pandas.to_datetime(1.75e9 + T, unit="s"))
    found |= {"frame": (one, wide), "dates": (dates(one), dates(wide)), "index": (one.set_index("time"), wide.set_index("time")),
              "integers that may lack": (one, wide.assign(torque0=pandas.array(X[:, 0], dtype="Float64")))}
    try:
        import polars
    except ImportError:
        polars = None
    if polars:
        found["polars"] = (polars.from_pandas(one), polars.from_pandas(wide))
    return found


@pytest.mark.parametrize("kind", list(frames()))
def test_what_a_log_is_read_from_a_robots_log_is_read_from(engine, kind):
    one, wide = frames()[kind]
    log = wj.Log.from_frame(one)
    columns = robot_columns(engine, wide)
    _, torque, refusal = columns["torque0"]
    assert not refusal
    kept = ~np.isnan(torque)
    np.testing.assert_array_equal(columns["position0"][1][kept], log.position)
    np.testing.assert_array_equal(torque[kept], log.torque)
    np.testing.assert_allclose(columns["time"][1][kept] - columns["time"][1][0], log.time - log.time[0], atol=1e-6)
    assert kind != "masks" or not kept[3:5].any()


def test_two_rows_of_columns(engine):
    pandas = pytest.importorskip("pandas")
    parts = {f"joint_{j}": pandas.DataFrame({"position": Q[:, j], "torque": X[:, j]}, index=pandas.Index(T, name="time")) for j in range(2)}
    columns = robot_columns(engine, pandas.concat(parts, axis=1))
    np.testing.assert_array_equal(columns["joint_1/torque"][1], X[:, 1])
    np.testing.assert_array_equal(columns["time"][1], T)


def test_a_matrix_with_samples_in_its_columns_is_refused(engine):
    for given in ({"time": T, "position": Q.T, "torque": X.T}, {"position": Q.T, "torque": X.T}):
        with pytest.raises(wj.BadInput, match=r"position: has the shape .2, 400.*transpose"):
            wj.identify_robot(ARM, given)


def test_a_column_that_is_no_numbers_is_told_with_its_reason(engine):
    columns = robot_columns(engine, {"time": T, "position": Q, "torque0": X[:, 0], "torque1": ["OVF"] * N})
    assert columns["torque0"][2] == "" and "'OVF'" in columns["torque1"][2]


def test_files_of_every_kind_are_read_by_one_function(engine, tmp_path):
    wide = {"time": T, **{f"q{j}": Q[:, j] for j in range(2)}, **{f"tau{j}": X[:, j] for j in range(2)}}
    with (tmp_path / "LOG.NPZ").open("wb") as file:  # a name alone gets another ending
        np.savez(file, **wide)
    columns = robot_columns(engine, tmp_path / "LOG.NPZ")
    np.testing.assert_array_equal(columns["tau1"][1], X[:, 1])
    log = wj.read(tmp_path / "LOG.NPZ", map={"time": "time", "position": "q1", "torque": "tau1"})
    np.testing.assert_array_equal(log.torque, X[:, 1])
    rows = [json.dumps({name: values[i] for name, values in wide.items()}) for i in range(N)]
    (tmp_path / "log.jsonl").write_text("\n".join(rows))
    with pytest.raises(Taken):
        wj.identify_robot(ARM, [tmp_path / "log.jsonl", "log.csv"])
    assert engine.logs[0][2].startswith('"time"') and engine.logs[1] == ("log.csv", None, None)
    for name, words in (("log.pkl", "not opened here"), ("log.xls", "save it as .xlsx")):
        (tmp_path / name).write_bytes(b"\x80\x04}")
        with pytest.raises(wj.BadInput, match=words):
            wj.read(tmp_path / name)


def test_what_is_no_log_is_refused_by_both():
    for given in (3, None, object(), [3], types.SimpleNamespace()):
        for call in (wj.identify, lambda one: wj.identify_robot(ARM, one)):
            with pytest.raises(wj.BadInput, match="log"):
                call(given)


def test_the_endings_are_those_of_the_program():
    known = _core.log_formats()
    assert {one["by"] for one in known} == {"program", "converter", "nobody"}
    for one in known:
        assert _core.is_other_format("LOG" + one["ending"].upper()) == (one["by"] == "converter")


def test_a_model_may_be_text(engine):
    for text, end in ((ARM, ".xml"), ("\n " + URDF, ".urdf")):
        with pytest.raises(Taken):
            wj.identify_robot(text, {"time": T, "position": Q, "torque": X})
        assert engine.model.endswith(end) and engine.text == text


def test_a_robots_answer_is_loaded_by_its_own_function(tmp_path):
    path = tmp_path / "robot.json"
    path.write_text(json.dumps({"joints": {"elbow": {"status": "ok", "message": ""}}, "notices": []}))
    with pytest.raises(wj.BadInput, match="load_robot"):
        wj.load(path)
    joint = wj.load_robot(path)["elbow"]
    for ask in (lambda: joint.plot(), lambda: joint.residuals, lambda: joint.figures()):
        with pytest.raises(wj.BadInput, match=r"elbow.*identify_robot"):
            ask()


@pytest.mark.skipif(sys.platform != "linux", reason="wheels are for Linux")
def test_unknown_kinds_of_binary_files_are_named(tmp_path):
    (tmp_path / "log.dat").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    with pytest.raises(wj.BadInput, match=r"end in \.h5"):
        wj.read(tmp_path / "log.dat")
