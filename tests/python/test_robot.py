"""The friction of a whole robot, from a description that is wrong by a tenth and a log made of a known truth."""

import csv
import json
import pathlib
import sys

import numpy as np
import pytest
import warmjoint as wj

mujoco = pytest.importorskip("mujoco")
if not mujoco.__version__.startswith("4.0."):
    pytest.skip("needs MuJoCo 4.0", allow_module_level=True)

ARM = """<mujoco><compiler angle="radian"/><worldbody>
  <body name="a"><joint name="shoulder" axis="0 1 0" range="-3 3"/><inertial pos="0 0 .2" mass="8" diaginertia=".1 .1 .02"/>
    <body name="b" pos="0 0 .4"><joint name="elbow" axis="0 1 0" range="-3 3"/><inertial pos="0 0 .15" mass="3" diaginertia=".03 .03 .01"/>
      <body name="c" pos="0 0 .3"><joint name="wrist" axis="0 0 1" range="-3 3"/><inertial pos=".02 0 .05" mass="1" diaginertia=".003 .003 .002"/>
</body></body></body></worldbody></mujoco>"""
VISCOUS, UP, DOWN = np.array([4, 2, 1.0]), np.array([6, 4, 2.0]), np.array([5, 4.5, 2.2])


def rigid_of(model, q, v, acc):
    """Torque of rigid bodies along a motion, N.m. [N x n]"""
    data, torque = mujoco.MjData(model), np.empty_like(q)
    for i in range(len(q)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q[i], v[i], acc[i]
        mujoco.mj_inverse(model, data)
        torque[i] = data.qfrc_inverse
    return torque


def log_of(model, payload=0.0, seconds=240, rate=100, seed=1):
    """Sums of sines on all joints, and the torques of the true robot with its friction and .1 N.m of noise."""
    random = np.random.default_rng(seed)
    t = np.arange(0, seconds, 1 / rate)
    w, a, p = random.uniform(.3, 1.5, (3, 3)), random.uniform(.2, .6, (3, 3)), random.uniform(0, 6, (3, 3))
    q, v, acc = (sum(a[k] * w[k] ** m * np.sin(np.outer(t, w[k]) + p[k] + m * np.pi / 2) for k in range(3)) for m in range(3))
    model.body_mass[-1] += payload
    rigid = rigid_of(model, q, v, acc)
    friction = VISCOUS * v + UP * (v > 0) - DOWN * (v < 0)
    return {"time": t, "position": q, "torque": rigid + friction + .1 * random.standard_normal(q.shape)}


@pytest.fixture(scope="module")
def wrong():
    """The arm with masses and inertias that are off."""
    model = mujoco.MjModel.from_xml_string(ARM)
    model.body_mass[1:] *= [1.1, .92, 1.05]
    model.body_inertia[1:] *= .9
    return model


@pytest.fixture(scope="module")
def log():
    model = mujoco.MjModel.from_xml_string(ARM)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    return log_of(model)


def test_all_joints_are_told_within_their_intervals(wrong, log):
    robot = wj.identify_robot(wrong, log)
    assert list(robot) == ["shoulder", "elbow", "wrist"]
    off = []
    for j, (name, estimate) in enumerate(robot.items()):
        assert estimate.ok, f"{name}: {estimate.message}"
        for key, truth in (("viscous", VISCOUS[j]), ("coulomb_positive", UP[j]), ("coulomb_negative", DOWN[j])):
            one = estimate[key]
            off.append((one.value - truth) / one.std)
        assert robot.summary[name]["rms_held_out"] < .1  # the noise of .1 N.m at 100 Hz through 10 Hz
    assert np.max(np.abs(off)) < 4  # standard errors: by chance once in a thousand logs
    assert set(robot.frictions) == set(robot)


def test_fields_hold_a_ripple_over_the_angle(wrong, log):
    # friction of the shoulder that ripples by a tenth; its mean over the angles is part of both levels
    q, v = log["position"][:, 0], np.gradient(log["position"][:, 0], log["time"])
    ripple, moves = .5 * np.sin(11 * q), np.abs(v) > .02 * np.abs(v).max()
    rough = log | {"torque": log["torque"] + np.column_stack([ripple * np.sign(v), 0 * q, 0 * q])}
    held = wj.identify_robot(wrong, rough)["shoulder"]
    plain = wj.identify_robot(wrong, rough, fields="none")["shoulder"]
    assert "fields hold" in held.message and "fields" not in plain.message
    truth = (UP[0] + DOWN[0]) / 2 + ripple[moves].mean()
    assert abs(held["coulomb"].value - truth) < 4 * held["coulomb"].std
    assert held.data["metrics"]["rmse"] < .6 * plain.data["metrics"]["rmse"]
    assert held.data["friction"]["maps"]


def test_a_file_gives_the_same_as_arrays_and_its_friction_is_attached(wrong, log, program):
    mujoco.mj_saveModel(wrong, str(program.folder / "arm.mjb"))
    table = np.column_stack([log["time"], log["position"], log["torque"]])
    header = "time," + ",".join(f"{name}_{part}" for part in ("position", "torque") for name in ("shoulder", "elbow", "wrist"))
    np.savetxt(program.folder / "arm.csv", table, delimiter=",", header=header, comments="", fmt="%.17g")
    program("identify-robot", "arm.mjb", "arm.csv", "-o", "robot.json")
    told = json.loads((program.folder / "robot.json").read_text())
    robot = wj.identify_robot(wrong, log)
    for name, estimate in robot.items():
        assert told["joints"][name]["parameters"]["viscous"]["value"] == pytest.approx(estimate["viscous"].value, rel=1e-6)
    (program.folder / "arm.xml").write_text(ARM)
    said = program("attach", "arm.xml", "--friction", "robot.json", "-o", "warm.xml")
    assert "3 of its joints" in said
    assert wj.attach(ARM, robot.frictions).spec is not None


def test_the_robot_that_is_written_simulates_to_what_was_identified(wrong, log, program):
    sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "studies"))
    import robot_round_trip as trip
    from warmjoint import mujoco_plugin

    mujoco.mj_loadPluginLibrary(str(mujoco_plugin.library_path(mujoco.__version__)))
    spec = mujoco.MjSpec.from_string(ARM)
    spec.compile()
    for i in range(1, wrong.nbody):
        body = spec.body(wrong.body(i).name)
        body.mass, body.inertia = wrong.body_mass[i], wrong.body_inertia[i]
    spec.compile()
    (program.folder / "wrong.xml").write_text(spec.to_xml())
    first = trip.identify(program.path, program.folder / "wrong.xml", log["time"], log["position"], log["torque"], program.folder, "--mjcf", program.folder / "warm.xml")
    moved, force = trip.follow(trip.servoed(program.folder / "warm.xml"), log["time"], log["position"])
    force = force + .1 * np.random.default_rng(5).standard_normal(force.shape)
    second = trip.identify(program.path, program.folder / "wrong.xml", log["time"][: len(moved)], moved, force, program.folder)
    rows = trip.compared(first, second, 1)
    assert len(rows) >= 3 * 6  # viscous, both Coulomb, their mean, rotor, gain of each joint
    off = {(one["joint"], one["parameter"]): one["deviations"] for one in rows if abs(one["deviations"]) > 4}
    assert not off  # standard errors
    assert np.mean([one["holds"] for one in rows]) >= .8  # of some 20 at 95 %, by chance below in fewer than one of 300 logs


def test_swapped_columns_and_a_turned_position_are_named(wrong, log):
    swapped = log | {"position": log["position"][:, [1, 0, 2]], "torque": log["torque"][:, [1, 0, 2]]}
    robot = wj.identify_robot(wrong, swapped)
    assert "shoulder and elbow are swapped" in robot["shoulder"].message
    turned = log | {"position": log["position"] * [1, -1, 1]}
    assert "position of elbow is turned" in wj.identify_robot(wrong, turned)["elbow"].message


def plain(model, log, **settings):
    """Without fields, which take most of the time."""
    return wj.identify_robot(model, log, fields="none", **settings)


def torque_of(gravity, log):
    """The log's torques with another gravity in them."""
    model = mujoco.MjModel.from_xml_string(ARM)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    q, still = log["position"], np.zeros_like(log["position"])
    upright = rigid_of(model, q, still, still)
    model.opt.gravity = gravity
    return log["torque"] + rigid_of(model, q, still, still) - upright


def assert_true(robot):
    for j, (name, estimate) in enumerate(robot.items()):
        assert estimate.ok, f"{name}: {estimate.message}"
        one = estimate["coulomb"]
        assert abs(one.value - (UP[j] + DOWN[j]) / 2) < 4 * one.std, name


@pytest.mark.parametrize("gravity", [(9.81, 0, 0), (0, 0, 9.81), (2.54, 0, -9.48)])
def test_a_base_that_is_tilted_is_found_and_said(wrong, log, gravity):
    robot = plain(wrong, log | {"torque": torque_of(gravity, log)})
    assert_true(robot)
    found = robot.data["gravity"]
    # in the plane in which both joints swing
    off = [(found["value"][k] - gravity[k]) / found["std"][k] for k in (0, 2) if found["std"][k] > 1e-3]
    assert np.max(np.abs(off)) < 4
    said = plain(wrong, log | {"torque": torque_of(gravity, log)}, gravity=gravity)
    assert_true(said)
    assert said.data["gravity"] is None


def test_a_friction_that_falls_with_speed_is_told(wrong, log):
    v = np.gradient(log["position"], log["time"], axis=0)
    robot = wj.identify_robot(wrong, log | {"torque": log["torque"] - (VISCOUS + .1 * UP) * v})
    for j, (name, estimate) in enumerate(robot.items()):
        assert estimate.ok, f"{name}: {estimate.message}"
        assert estimate["viscous"].value == 0
        for one in estimate.data["friction_at_speeds"]:
            truth = (UP if one["speed"] > 0 else DOWN)[j] - .1 * UP[j] * abs(one["speed"])
            assert abs(one["value"] - truth) < 4 * one["std"], name


def test_gravity_that_was_taken_off_is_said_and_no_load_is_named(wrong, log):
    robot = plain(wrong, log | {"torque": torque_of((0, 0, 0), log)})
    assert robot.data["gravity_taken_off"]
    assert robot.data["payload"] is None
    assert_true(robot)


def test_torques_that_come_late_are_fitted_with_their_delay(wrong, log):
    late = 3  # samples of 10 ms
    robot = plain(wrong, log | {"torque": np.roll(log["torque"], late, axis=0)})
    delay = robot.data["delay"]
    assert abs(delay["value"] - .01 * late) < 4 * delay["std"]
    assert_true(robot)
    assert plain(wrong, log).data["delay"] is None


def test_torques_of_the_motors_side_are_refused_by_their_gain(wrong, log):
    robot = plain(wrong, log | {"torque": log["torque"] / 100})
    assert not any(estimate.ok for estimate in robot.values())
    one = plain(wrong, log | {"torque": log["torque"] / [100, 1, 1]})
    assert not one["shoulder"].ok
    assert "scale shoulder.torque=" in one["shoulder"].message
    assert one["elbow"].ok
    # nor is it taken in as what a load does
    assert not plain(wrong, log | {"torque": log["torque"] / [100, 1, 1]}, tool="unknown")["shoulder"].ok
    # the description may be as wrong as that
    assert plain(wrong, log | {"torque": log["torque"] / 100}, inertials=1)["elbow"].ok


def test_all_torques_turned_are_one_sentence(wrong, log):
    robot = plain(wrong, log | {"torque": -log["torque"]})
    assert len([one for one in robot.notices if "turned" in one]) == 1
    assert_true(robot)


def test_a_zero_that_is_off_is_named_and_undone(wrong, log):
    off = log | {"position": log["position"] + [0, np.pi / 2, 0]}
    refused = plain(wrong, off)
    assert not any(estimate.ok for estimate in refused.values())
    assert 'zero={"elbow": 1.5' in refused["elbow"].message
    assert_true(plain(wrong, off, zero={"elbow": np.pi / 2}))


def test_a_joint_that_the_log_lacks_stands_where_it_is_said():
    # the wrist's frame is held 1 rad off by a joint that was not logged
    bent = ARM.replace('<body name="b" pos="0 0 .4">', '<body name="m" pos="0 0 .1"><joint name="held" axis="0 1 0"/><inertial pos="0 0 .1" mass="2" '
                       'diaginertia=".02 .02 .01"/><body name="b" pos="0 0 .3">').replace("</body></body></body></worldbody>", "</body></body></body></body></worldbody>")
    model = mujoco.MjModel.from_xml_string(bent)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    arm = mujoco.MjModel.from_xml_string(ARM)
    source = log_of(arm)
    v = np.gradient(source["position"], source["time"], axis=0)
    a = np.gradient(v, source["time"], axis=0)
    torque = rigid_of(model, *(np.insert(one, 1, held, axis=1) for one, held in ((source["position"], 1), (v, 0), (a, 0))))[:, [0, 2, 3]]
    friction = VISCOUS * v + UP * (v > 0) - DOWN * (v < 0)
    table = source | {"torque": torque + friction + .1 * np.random.default_rng(5).standard_normal(v.shape)}
    robot = plain(model, table, joints=["shoulder", "elbow", "wrist"], at={"held": 1})
    assert_true(robot)


def test_a_turned_torque_is_named_and_fitted(wrong, log):
    robot = wj.identify_robot(wrong, log | {"torque": log["torque"] * [1, -1, 1]})
    assert len([one for one in robot.notices if "sign is taken to be turned" in one]) == 1
    assert robot["elbow"]["viscous"].value == pytest.approx(2, rel=.1)


def test_no_load_is_claimed_where_there_is_none_and_an_unknown_one_is_taken_in(wrong, log):
    unloaded = wj.identify_robot(wrong, log)
    assert unloaded.payload is None and not [one for one in unloaded.notices if "a load" in one]
    lower, upper = wj.identify_robot(wrong, log, tool="unknown").payload.ci95
    assert lower < 0 < upper
    model = mujoco.MjModel.from_xml_string(ARM)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    loaded = wj.identify_robot(wrong, log_of(model, payload=3), tool="unknown")
    lower, upper = loaded.payload.ci95
    assert 0 < lower < 3 < upper
    for j, (name, estimate) in enumerate(loaded.items()):
        assert estimate.ok, f"{name}: {estimate.message}"
        assert abs(estimate["viscous"].value - VISCOUS[j]) < 4 * estimate["viscous"].std


def test_masked_samples_are_left_out_and_a_dead_torque_leaves_its_joint_out(wrong, log):
    whole = wj.identify_robot(wrong, log)
    hidden = np.random.default_rng(5).random(log["torque"].shape) < .1
    spoilt = np.ma.masked_array(np.where(hidden, .4 * log["torque"], log["torque"]), hidden)
    masked = wj.identify_robot(wrong, log | {"torque": spoilt})
    for name, one in masked.items():
        assert one.ok, one.message
        assert one["viscous"].value == pytest.approx(whole[name]["viscous"].value, rel=.03)
    for nothing in (0, np.nan):
        dead = log["torque"].copy()
        dead[:, 1] = nothing
        robot = wj.identify_robot(wrong, log | {"torque": dead})
        assert [one.status for one in robot.values()] == ["ok", "bad_data", "ok"]
        assert "torque of elbow" in robot["elbow"].message
        assert [one for one in robot.notices if one.startswith("elbow is left out")]
        for name in ("shoulder", "wrist"):
            assert robot[name]["viscous"].value == pytest.approx(whole[name]["viscous"].value, rel=.02)


def test_the_reason_of_a_refusal_is_its_own(wrong, log):
    for spoilt, words in (({"time": log["time"][::-1]}, "runs backwards"), ({"torque": log["torque"][:-1]}, "one length"),
                          ({"position": log["position"].T, "torque": log["torque"].T}, "transpose"),
                          ({"position": log["position"] * [1, np.nan, 1]}, "position of elbow")):
        with pytest.raises(wj.BadInput, match=words) as refusal:
            wj.identify_robot(wrong, log | spoilt)
        assert "map" not in str(refusal.value) or words == "position of elbow"


def test_a_joint_of_a_robot_is_drawn_and_has_residuals(wrong, log):
    robot = wj.identify_robot(wrong, log)
    elbow = robot["elbow"]
    assert type(elbow.plot()) is type(robot.plot("elbow"))
    left = elbow.residuals
    assert len(left.time) == len(left.torque) > 100
    assert np.sqrt(np.mean(left.torque ** 2)) < .2
    with pytest.raises(wj.BadInput, match="elbow"):
        elbow.plot("friction_curve")


def test_two_answers_are_compared_joint_by_joint(wrong, log):
    worn = plain(wrong, log | {"torque": log["torque"] + [1, 0, 0] * np.sign(np.gradient(log["position"], axis=0))})
    rows = plain(wrong, log).compare(worn)
    assert {row["joint"] for row in rows} == {"shoulder", "elbow", "wrist"}
    apart = {row["joint"]: abs(row["apart"]) for row in rows if row["name"] == "coulomb"}
    assert apart["shoulder"] > 1 and max(apart["elbow"], apart["wrist"]) < 1
    with pytest.raises(wj.BadInput, match="give a RobotEstimate"):
        worn.compare(worn["elbow"])


def test_all_joints_are_drawn_on_one_sheet(wrong, log):
    series = wj.identify_robot(wrong, log, fields="none").plot().series()
    for j, joint in enumerate(("shoulder", "elbow", "wrist")):
        drawn = series[f"{joint}: forwards"]
        assert np.abs(drawn["y"] - UP[j] - VISCOUS[j] * drawn["x"]).max() < .1 * UP[j]
    # without a log what robot.json holds
    stored = wj.load_robot("library:panda")
    of_answer = stored.plot().series()["joint5: forwards"]
    speeds = {abs(one.speed): one.value for one in stored["joint5"].friction_at_speeds if one.speed > 0}
    assert dict(zip(of_answer["x"], of_answer["y"])) == pytest.approx(speeds)


def test_a_robot_has_a_page(wrong, log, tmp_path):
    robot = wj.identify_robot(wrong, log, fields="none")
    robot.report(tmp_path / "robot.html")
    page = (tmp_path / "robot.html").read_text()
    assert "3 of 3 joints" in page and page.count("MuJoCo, compensation") == 3


def test_what_cannot_be_used_is_refused(wrong, log):
    with pytest.raises(wj.BadInput, match="position"):
        wj.identify_robot(wrong, {"time": log["time"], "torque": log["torque"]})
    with pytest.raises(wj.BadInput, match="elbw"):
        wj.identify_robot(wrong, log, joints=["shoulder", "elbw", "wrist"])
    with pytest.raises(KeyError, match="elbow"):
        wj.identify_robot(wrong, log)["elbw"]


@pytest.mark.parametrize("given, words", [
    ({"gear": "x"}, "^gear: "), ({"gear": {"elbow": 10**5000}}, "^gear: "), ({"gear": {5: 1}}, "^gear: has the key 5"), ({"cutoff": None}, "^cutoff: "),
    ({"inertials": "some"}, "^inertials: "), ({"torque_constant": [1, 2]}, "^torque_constant: "), ({"holdout": "x"}, "^holdout: "), ({"rate": 1j}, "^rate: "),
    ({"joints": [5]}, "^joints: is 5"), ({"coupling": 7}, "^coupling: is 7"), ({"columns": {1}}, "^columns: "), ({"scale": {"elbow.torqe": 1}}, "^scale: 'elbow.torqe'"),
    ({"scale": {"elbow.torque": "x"}}, "^scale: "), ({"map": 5}, "^map: "), ({"unit": [1]}, "^unit: "), ({"tool": {"com": (0, 0, 0)}}, "^tool: "),
    ({"tool": {"mass": 1, "com": (0, 0)}}, "^tool: com has the shape"), ({"tool": {"mass": 1, "centre": 0}}, "^tool: "), ({"tool": 5}, "^tool: is 5"),
    ({"fields": "x"}, "fields is .x.; it must be auto"), ({"fields": 5}, "^fields: "),
])
def test_a_wrong_option_is_refused_by_its_name(wrong, log, given, words):
    with pytest.raises(wj.BadInput, match=words):
        wj.identify_robot(wrong, log, **given)


@pytest.mark.parametrize("nothing", [[], ()])
def test_no_recording_is_refused(wrong, nothing):
    with pytest.raises(wj.BadInput, match="give at least one"):
        wj.identify_robot(wrong, nothing)


def test_a_description_of_another_kind_is_refused(log):
    for given in (None, 5, object()):
        with pytest.raises(wj.BadInput, match=r"^model: is "):
            wj.identify_robot(given, log)


def test_files_that_are_no_robot_are_refused(tmp_path):
    for text, words in (("{", "is not JSON"), ("5", "is no JSON file"), ("[5]", "holds no map of joints"), ('{"identifier": "auto"}', "of one estimate Estimate or load")):
        (tmp_path / "robot.json").write_text(text)
        with pytest.raises(wj.BadInput, match=words):
            wj.load_robot(tmp_path / "robot.json")


def test_a_push_is_found_with_its_force(wrong, log):
    """A force on the last link from the 100th to the 130th second, and the band without it."""
    model = mujoco.MjModel.from_xml_string(ARM)
    data, place, force = mujoco.MjData(model), np.array([0.1, 0, 0.1]), np.array([6.0, 4.0, -8.0])
    pushed = (log["time"] >= 100) & (log["time"] < 130)
    torque, jacobian = log["torque"].copy(), np.empty((3, 3))
    for i in np.flatnonzero(pushed):
        data.qpos[:] = log["position"][i]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_jac(model, data, jacobian, None, data.xpos[-1] + data.xmat[-1].reshape(3, 3) @ place, model.nbody - 1)
        # the motors hold against it
        torque[i] -= jacobian.T @ force
    robot = wj.identify_robot(wrong, log)
    found = robot.external_torque({**log, "torque": torque}, wrong, tool={"mass": 0.0, "com": place})
    assert set(found.joints) == {"shoulder", "elbow", "wrist"}
    during = (found.time > 101) & (found.time < 129)
    free = (found.time < 99) | (found.time > 131)
    for one in found.joints.values():
        assert np.mean(np.abs(one.external[free]) <= one.half_width[free]) > 0.9
    told = np.isfinite(found.force[during]).all(axis=1)
    assert told.mean() > 0.5
    off = np.abs(found.force[during][told] - force) / found.force_half_width[during][told]
    assert np.mean(off <= 1) > 0.9
    assert np.abs(np.median(found.force[during][told], axis=0) - force).max() < 2


def test_the_program_finds_it_as_well(wrong, log, program):
    mujoco.mj_saveModel(wrong, str(program.folder / "arm.mjb"))
    robot = wj.identify_robot(wrong, log)
    robot.save(program.folder / "arm.json")
    table = np.column_stack([log["time"], log["position"], log["torque"]])
    header = "time," + ",".join(f"{name}_{part}" for part in ("position", "torque") for name in robot)
    np.savetxt(program.folder / "arm.csv", table, delimiter=",", header=header, comments="", fmt="%.17g")
    program("compensate", "arm.csv", "--friction", "arm.json", "--robot", "arm.mjb", "-o", "external.csv")
    with open(program.folder / "external.csv") as file:
        elbow = [float(row["elbow.external [N.m]"]) for row in csv.DictReader(file)]
    found = robot.external_torque(log, wrong)
    np.testing.assert_allclose(elbow, found.joints["elbow"].external, rtol=1e-9, atol=1e-9)
    program("compensate", "arm.csv", "--friction", "arm.json", status=2)
