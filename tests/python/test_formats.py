"""warmjoint.read on formats that its child process reads; those that need no package but NumPy."""

import json

import numpy as np
import pytest
import warmjoint as wj


@pytest.fixture(scope="module")
def log(recording):
    return wj.read(recording)


def columns(log):
    return {"time": log.time, "position": log.position, "velocity": log.velocity, "torque": log.torque}


def same(one, other):
    for name, values in columns(one).items():
        np.testing.assert_array_equal(getattr(other, name), values)


def test_numpy_and_json(log, tmp_path):
    named = {"t": log.time, "q": np.stack([0 * log.time, log.position], axis=1), "v": log.velocity, "tau": log.torque}
    map_ = {"time": "t", "position": "q[1]", "velocity": "v", "torque": "tau"}
    np.savez(tmp_path / "log.npz", **named)
    same(log, wj.read(tmp_path / "log.npz", map=map_))
    (tmp_path / "log.json").write_text(json.dumps({name: values.tolist() for name, values in named.items()}))
    same(log, wj.read(tmp_path / "log.json", map=map_))
    rows = [json.dumps({name: values[i].tolist() for name, values in named.items()}) for i in range(len(log))]
    (tmp_path / "log.jsonl").write_text("\n".join(rows))
    same(log, wj.read(tmp_path / "log.jsonl", map=map_))
    # several files of one joint, of two formats
    assert len(wj.read([tmp_path / "log.npz", tmp_path / "log.jsonl"], map=map_)) == 2 * len(log)


def test_units_and_episodes(log, tmp_path):
    part = slice(0, 600)
    one = {"time": log.time[part], "position [deg]": np.degrees(log.position[part]), "velocity": log.velocity[part], "torque": log.torque[part]}
    np.savez(tmp_path / "one.npz", **one)
    np.testing.assert_allclose(wj.read(tmp_path / "one.npz").position, log.position[part], atol=1e-12)
    twice = {name: np.tile(values, 2) for name, values in one.items()} | {"episode_index": np.repeat([0, 1], 600)}
    np.savez(tmp_path / "twice.npz", **twice)
    both = wj.read(tmp_path / "twice.npz")
    assert len(both) == 1200 and any("2 episodes" in note for note in both.notes)


def test_what_is_left_out_is_a_warning(log, tmp_path):
    np.savez(tmp_path / "log.npz", **columns(log), phase=1j * log.time)
    with pytest.warns(UserWarning, match="'phase' is complex"):
        same(log, wj.read(tmp_path / "log.npz"))


@pytest.mark.parametrize("name, content, words", [
    ("a.npz", b"\x93NUMPY nothing of the kind", "cannot be read as NumPy's"),
    ("a.jsonl", b'{"time": 1}\n{', "a.jsonl:2: is no record"),
    ("a.json", b"[1, 2]", "neither an object of arrays nor records"),
    ("a.json", b'{"time": [0, 1, 2], "position": [0, 1, 2]}', "no 'torque'|no column 'torque'"),
])
def test_refusals_are_one_sentence(tmp_path, name, content, words):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(wj.BadInput, match=words) as refusal:
        wj.read(tmp_path / name)
    assert "\n" not in str(refusal.value)


def test_a_number_in_text_follows_the_rule_of_tables(tmp_path):
    rows = [json.dumps({"time": 0.1 * i, "position": i, "torque": f"16,{250 + i}"}) for i in range(5)]
    (tmp_path / "log.jsonl").write_text("\n".join(rows))
    with pytest.raises(wj.BadInput, match="16,25"):
        wj.read(tmp_path / "log.jsonl")


@pytest.mark.parametrize("end", ["npz", "mat"])
def test_names_of_columns_are_text(tmp_path, end):
    itself = {}
    itself["torque"] = itself
    path = tmp_path / f"log.{end}"
    path.write_bytes(b"")
    for given in (itself, {"torque": 3}):
        with pytest.raises(wj.BadInput, match="torque"):
            wj.read(path, map=given)
