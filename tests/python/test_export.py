"""Numbers for other engines, as the program and as Python write them, read again by MuJoCo where it reads them."""

import ast
import json
import re

import numpy as np
import pytest
import warmjoint as wj

ENGINES = ("mjcf", "urdf", "physx", "isaaclab", "mjlab")
SPEEDS = np.array([0.15, 0.4, 0.9])  # rad/s


@pytest.fixture(scope="module")
def estimate(recording):
    return wj.identify(recording, "energy-ml")


def told(text, engine):
    """viscous, level and level at rest that a text tells of the joint 'elbow'."""
    number = r"([-+.0-9e]+)"
    if engine == "mjcf":
        found = re.search(rf'name="elbow" damping="{number}" frictionloss="{number}"', text)
        return float(found[1]), float(found[2]), None
    if engine == "urdf":
        found = re.search(rf'damping="{number}" friction="{number}"', text)
        return float(found[1]), float(found[2]), None
    if engine == "physx":
        found = re.search(rf"PxJointFrictionParams\({number}, {number}, {number}\)", text)
        return float(found[3]), float(found[2]), float(found[1])
    body = "\n".join(line for line in text.splitlines() if not line.startswith("#"))
    if engine == "isaaclab":
        found = eval(f"dict({body})", {"dict": dict})
        return found["viscous_friction"]["elbow"], found["dynamic_friction"]["elbow"], found["friction"]["elbow"]
    found = eval(f"{{{body}}}", {"dict": dict})["elbow"]
    return found["viscous_damping"], found["frictionloss"], None


def half_width(estimate):
    """Of friction at the speed where it is known best, N.m. A text rounds the level to a twentieth of it at most, and viscous at a speed of the
    log as well."""
    return min((one.ci95[1] - one.ci95[0]) / 2 for one in estimate.friction_at_speeds)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("warm", [0.0, 1.0])
def test_every_engine_is_told_the_friction_of_the_estimate(estimate, engine, warm):
    export = estimate.export(engine, warm=warm, speed=0.5, joint="elbow")
    heat = warm * estimate.fitted.settled_heat(0.5)
    viscous, level, rest = told(str(export), engine)
    digits = half_width(estimate) / 10
    np.testing.assert_allclose(viscous * SPEEDS + level, estimate.friction(SPEEDS, heat=heat), rtol=0, atol=digits)
    np.testing.assert_allclose(-viscous * SPEEDS - level, estimate.friction(-SPEEDS, heat=heat), rtol=0, atol=digits)
    assert rest is None or rest == pytest.approx(level, abs=digits)
    one = export.joints["elbow"]
    np.testing.assert_allclose(one.viscous * SPEEDS + one.level, estimate.friction(SPEEDS, heat=heat), rtol=0, atol=1e-6)
    assert one.energy == pytest.approx(heat, abs=1e-9)
    assert {left.what for left in one.left_out} >= {"heat"}


@pytest.mark.parametrize("engine", ENGINES)
def test_the_program_writes_the_same(estimate, program, engine):
    estimate.save(program.folder / "elbow.json")
    options = ("--to", engine, "--warm", 0.5, "--joint", "elbow")
    assert program("export", "elbow.json", *options) == estimate.export(engine, warm=0.5, joint="elbow").text
    as_json = json.loads(program("export", "elbow.json", *options, "--format", "json"))
    assert as_json["joints"]["elbow"]["level"] == estimate.export(engine, warm=0.5, joint="elbow").joints["elbow"].level
    program("export", "elbow.json", *options, "-o", "elbow.txt")
    assert (program.folder / "elbow.txt").read_text() == as_json["text"]


@pytest.mark.parametrize("warm", [0.0, 1.0])
def test_mujoco_reads_both_kinds_of_model(estimate, warm):
    mujoco = pytest.importorskip("mujoco")
    mjcf = estimate.export("mjcf", warm=warm, speed=0.5, joint="elbow")
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody><body>{mjcf}<geom size='.1'/></body></worldbody></mujoco>")
    urdf = str(estimate.export("urdf", warm=warm, speed=0.5, joint="elbow"))
    dynamics = re.search("<dynamics.*/>", urdf)[0]
    inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    robot = mujoco.MjModel.from_xml_string(
        f"<robot name='arm'><link name='base'/><link name='lower'>{inertial}</link><joint name='elbow' type='continuous'>{dynamics}"
        "<parent link='base'/><child link='lower'/></joint></robot>")
    heat = warm * estimate.fitted.settled_heat(0.5)
    for read in (model, robot):
        np.testing.assert_allclose(read.dof_damping[0] * SPEEDS + read.dof_frictionloss[0], estimate.friction(SPEEDS, heat=heat), rtol=0,
                                   atol=half_width(estimate) / 10)


def test_frictionloss_creeps_as_the_export_says(estimate):
    mujoco = pytest.importorskip("mujoco")
    said = next(left.meaning for left in estimate.export("mjcf").joints["joint"].left_out if left.what == "creep")
    seconds = float(re.search(r"at ([-.0-9e]+) s times", said)[1])
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><option gravity='0 0 0'/><worldbody><body><joint axis='0 1 0' frictionloss='6' armature='0.5'/><geom size='.01' mass='1e-6'/></body>"
        "</worldbody></mujoco>")
    data = mujoco.MjData(model)
    data.qfrc_applied[0] = 3.0
    mujoco.mj_step(model, data, 2000)
    assert data.qvel[0] == pytest.approx(seconds * 3.0 / 0.5, rel=0.01)


def test_all_joints_of_a_robot(estimate, program):
    in_amperes = {**estimate.data, "friction": {**estimate.data["friction"], "torque_unit": "A"}}
    robot = wj.RobotEstimate({"joints": {"elbow": estimate.data, "wrist": estimate.data, "hand": in_amperes}, "notices": [], "log": [], "robot": "",
                              "summary": {}})
    export = robot.export("isaaclab", warm=0.5)
    assert list(export.joints) == ["elbow", "wrist"]
    assert "hand" in export.notices[0]
    assert set(ast.literal_eval(re.search("^friction=(.*),$", export.text, re.M)[1])) == {"elbow", "wrist"}
    robot.save(program.folder / "robot.json")
    assert program("export", "robot.json", "--to", "isaaclab", "--warm", 0.5) == export.text


def test_a_name_is_asked_for_where_the_engine_finds_joints_by_it(estimate, program):
    estimate.save(program.folder / "nameless.json")
    for engine in ("physx", "isaaclab", "mjlab"):
        with pytest.raises(wj.BadInput, match=r"^joint: is missing.*give joint=NAME"):
            estimate.export(engine)
        program("export", "nameless.json", "--to", engine, status=2)
    for engine in ("mjcf", "urdf"):
        assert "name=" not in program("export", "nameless.json", "--to", engine)


def test_refusals_name_the_argument(estimate):
    for arguments, words in ((("webots",), "webots"), (("mjcf", -1), "warm"), (("mjcf", 0, 0.0), "speed")):
        with pytest.raises(wj.BadInput, match=words):
            estimate.export(arguments[0], **dict(zip(("warm", "speed"), arguments[1:])))
    with pytest.raises(wj.BadInput, match=r"in A|amperes| A"):
        wj.Estimate({**estimate.data, "friction": {**estimate.data["friction"], "torque_unit": "A"}}).export("mjcf")
