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


ARM = """<mujoco><compiler angle="radian"/><worldbody><geom type="plane" size="2 2 .1"/><body name="base" pos="0 0 .3">
<geom type="cylinder" size=".08 .3" mass="5"/><body name="upper" pos="0 0 .38"><joint name="shoulder" axis="0 1 0" range="-2.5 2.5"/>
<geom type="capsule" fromto="0 0 0 0 0 .4" size=".04" mass="2"/><body name="fore" pos="0 0 .4">
<joint name="elbow" axis="0 1 0" range="-2.8 2.8" actuatorfrcrange="-9 9"/><geom type="capsule" fromto="0 0 .02 0 0 .4" size=".04" mass="1"/>
<body name="hand" pos="0 0 .4"><joint name="wrist" axis="0 1 0" range="-2.8 2.8"/><geom type="capsule" fromto="0 0 .02 0 0 .15" size=".03" mass=".3"/>
</body></body></body></body></worldbody><actuator><motor joint="shoulder" gear="10" ctrllimited="true" ctrlrange="-3 3"/></actuator></mujoco>"""


def test_a_robot_s_motion_keeps_links_apart_and_torques_within_efforts(program):
    mujoco = pytest.importorskip("mujoco")
    (program.folder / "arm.xml").write_text(ARM)
    prior = wj.Friction(viscous=1, coulomb=2, thermal_gain=-0.3, thermal_time_constant=300)
    made = wj.design_robot(program.folder / "arm.xml", [".*"], 6, prior=prior, method="energy-ml", noise=0.05, clearance=0.02)
    assert list(made.joints) == ["shoulder", "elbow", "wrist"]
    assert any("exchanged" in notice for notice in made.data["notices"])
    # the shoulder feels the elbow, and all of them the others
    assert {"joint": "shoulder", "by": "elbow"} in [{name: one[name] for name in ("joint", "by")} for one in made.data["coupling"]]

    # the same files as the program's
    prior.save(program.folder / "prior.json")
    program("design", "arm.xml", "--joint", ".*", "--minutes", 6, "--prior", "prior.json", "--identifier", "energy-ml", "--noise", 0.05,
            "--clearance", 0.02, "-o", "arm")
    assert (program.folder / "arm/motion.csv").read_text() == made.files["motion.csv"]
    assert (program.folder / "arm/trajectory.yaml").read_text().startswith('joint_names: ["shoulder", "elbow", "wrist"]')

    # a picture of each joint
    program("plot", "arm", "-o", "arms", "--data")
    assert {path.stem for path in (program.folder / "arms").glob("*.csv")} == {"shoulder", "elbow", "wrist"}

    # walked through by MuJoCo's own Python, between the program's looks as well
    model = mujoco.MjModel.from_xml_string(ARM)
    data, torque, nearest, most = mujoco.MjData(model), np.zeros(3), 1.0, np.zeros(3)
    model.geom_margin[:] = 0.1
    for time in np.arange(0, 360, 0.0073):
        for j, one in enumerate(made.joints.values()):
            k = min(int(np.searchsorted(one.time, time, side="right")), len(one.time) - 1)
            slope = (one.velocity[k] - one.velocity[k - 1]) / (one.time[k] - one.time[k - 1])
            after = time - one.time[k - 1]
            data.qpos[j] = one.position[k - 1] + after * (one.velocity[k - 1] + slope * after / 2)
            data.qvel[j], data.qacc[j] = one.velocity[k - 1] + slope * after, slope
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        for contact in data.contact[: data.ncon]:
            bodies = model.geom_bodyid[contact.geom]
            if set(bodies) != {1, 2}:
                nearest = min(nearest, contact.dist)
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 1, torque)
        most = np.maximum(most, np.abs(torque + np.sign(data.qvel) * (2 + np.abs(data.qvel)) * (np.abs(data.qvel) > 1e-9)))
    print(f"\nnearest {nearest:.4f} m, torques {most} N.m")
    assert 0.02 <= nearest < 0.1
    assert most[0] <= 30 and most[1] <= 9


def test_limits_of_a_urdf_count_and_what_cannot_begin_is_refused(tmp_path):
    arm = """<robot name="arm"><link name="base"/><link name="l"><inertial><mass value="2"/><origin xyz="0 0 .2"/>
    <inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="lift" type="revolute">
    <parent link="base"/><child link="l"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="{effort}" velocity=".3"/></joint></robot>"""
    (tmp_path / "arm.urdf").write_text(arm.format(effort=20))
    made = wj.design_robot(tmp_path / "arm.urdf", ["lift"], 4, method="energy-ml", limits={"position": (-0.5, 2)})
    lift = made.joints["lift"]
    limits = lift.data["settings"]["limits"]
    assert limits["position"] == [-0.5, 1] and limits["velocity"][1] == 0.3 and limits["torque"] == 20
    assert np.abs(lift.velocity).max() <= 0.3 and lift.position.max() <= 1 + 1e-9
    # of one joint the files of one
    assert made.files["motion.csv"].startswith("time,position,velocity\n") and "motion.script" in made.files
    (tmp_path / "weak.urdf").write_text(arm.format(effort=1))
    with pytest.raises(wj.BadInput, match=r"lift.*effort of 1 N.m, of which gravity"):
        wj.design_robot(tmp_path / "weak.urdf", ["lift"], 4, method="energy-ml", at={"lift": 1.0})
    for wrong, words in (({"joints": ["lever"]}, "lever"), ({"at": {"lever": 0}}, "lever"), ({"priors": {"lever": PRIOR}}, "lever"), ({"clearance": -1}, "clearance")):
        with pytest.raises(wj.BadInput, match=words):
            wj.design_robot(tmp_path / "arm.urdf", **({"joints": ["lift"]} | wrong), minutes=4, method="energy-ml")
