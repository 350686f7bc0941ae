"""Friction attached from Python, in the MuJoCo that runs the tests and, by the wheels that tools/setup/fetch put into
build/deps, in the other versions that the plugin is for."""

import importlib
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco")

ROOT = pathlib.Path(__file__).resolve().parents[2]

from warmjoint import BadInput, Friction, attach, identify_robot, mujoco_attach, mujoco_plugin, split  # noqa: E402

ROBOT = """
<mujoco model="arm">
  <option timestep="0.001" integrator="implicitfast"/>
  <worldbody>
    <body name="upper">
      <joint name="joint1" axis="0 1 0" damping="1"/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.04" mass="3" contype="0" conaffinity="0"/>
      <body name="lower" pos="0.5 0 0">
        <joint name="joint2" axis="0 1 0" frictionloss="1"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1" contype="0" conaffinity="0"/>
        <body name="hand" pos="0.3 0 0">
          <joint name="slide" type="slide" axis="1 0 0"/>
          <geom size="0.03" mass="0.5" contype="0" conaffinity="0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="joint1"/><motor joint="joint2"/><motor joint="slide"/></actuator>
</mujoco>
"""

BIG = {
    "law": "viscous_coulomb",
    "parameters": {"viscous": 0.5, "coulomb": 4},
    "thermal": {"thermal_gain": -0.3, "thermal_time_constant": 20, "second": {"thermal_gain": -0.1, "thermal_time_constant": 90}},
}
SMALL = {
    "law": "stribeck",
    "parameters": {"viscous": 0.1, "coulomb": 1, "static": 1.5, "stribeck_velocity": 0.1},
    "thermal": {"thermal_gain": -0.2, "thermal_time_constant": 10},
}
ESTIMATE = {
    "status": "ok",
    "friction": BIG,
    "state_end": {"energy": {"value": -0.7}, "second_energy": -0.2, "time": 3.0},
}
FRICTIONS = {"joint1": BIG, "joint2|slide": SMALL}
FORMS = ("passive", "actuator")


def bound(form="passive", frictions=FRICTIONS, **options):
    attached = attach(ROBOT, frictions, form=form, **options)
    model = attached.spec.compile()
    return attached.bind(model, mujoco.MjData(model))


def batch_of_mujoco():
    if mujoco.__version__.startswith("3.11."):
        pytest.skip("MuJoCo 3.11 has no batch")
    return importlib.import_module("mujoco.batch")


def drive(friction, steps):
    model, data = friction.model, friction.data
    for _ in range(steps):
        data.ctrl[:3] = np.array([20, 6, 12]) * np.sin(np.array([2, 3.5, 5]) * data.time)
        mujoco.mj_step(model, data)


def test_forms_agree_and_report_the_same():
    passive, actuator = (bound(form) for form in FORMS)
    for _ in range(20):
        drive(passive, 50)
        drive(actuator, 50)
        np.testing.assert_allclose(passive.data.qpos, actuator.data.qpos, atol=1e-9)
        for which in ("torque", "heat", "loss", "held"):
            np.testing.assert_allclose(getattr(passive, which), getattr(actuator, which), atol=1e-7)
    assert passive.joints == actuator.joints == ["joint1", "joint2", "slide"]
    assert (passive.heat < 0).all()
    assert passive["joint2"].heat == passive.heat[1]
    assert passive.model.nsensordata == 15
    assert passive.data.sensor("joint2_friction").data[0] == passive.torque[1]
    assert passive["slide"].held in (True, False)


def test_the_numbers_are_those_of_the_engine():
    friction = bound("actuator")
    drive(friction, 300)
    mujoco.mj_forward(friction.model, friction.data)
    data = friction.data
    # the joint's damping is the viscous part, which MuJoCo adds
    np.testing.assert_array_equal(friction.model.dof_damping, [0.5, 0.1, 0.1])
    np.testing.assert_allclose(friction.torque, data.actuator_force[3:] + data.qfrc_damper, rtol=1e-12)
    slides = ~friction.held
    np.testing.assert_allclose(friction.loss[slides], np.abs(friction.torque * data.qvel)[slides], rtol=1e-12)


@pytest.mark.parametrize("form", FORMS)
def test_reset_sets_the_heat(form):
    friction = bound(form)
    drive(friction, 200)
    friction.reset()
    assert (friction.heat == 0).all()

    # settled: k |v| F0 / (1 - k |v|) at 1 rad/s and 0.1 m/s, k the sum of both stages
    friction.reset(warm=1)
    settled = friction.heat
    np.testing.assert_allclose(settled[0], -0.4 * 4.5 / 1.4, rtol=1e-9)
    assert settled[2] > settled[1]
    friction.reset(warm=[0, 0.5, 1])
    np.testing.assert_allclose(friction.heat, settled * [0, 0.5, 1])
    friction.reset(warm=1, speed=[2, 1, 0.1])
    np.testing.assert_allclose(friction.heat[0], -0.8 * 5 / 1.8, rtol=1e-9)

    # the next steps go on from there
    friction.reset(warm=1)
    mujoco.mj_step(friction.model, friction.data)
    np.testing.assert_allclose(friction.heat, settled, atol=2e-3)
    friction.reset(warm=0)
    mujoco.mj_step(friction.model, friction.data)
    np.testing.assert_allclose(friction.heat, 0, atol=2e-3)


def test_reset_to_the_end_of_the_log(tmp_path):
    (tmp_path / "estimate.json").write_text(json.dumps(ESTIMATE))

    class Estimate:
        def to_json(self):
            return json.dumps(ESTIMATE)

    for given in (tmp_path / "estimate.json", ESTIMATE, Estimate()):
        friction = bound(frictions={"joint.*|slide": given})
        friction.reset(warm="end")
        np.testing.assert_allclose(friction.heat, -0.9)
    with pytest.raises(ValueError, match="'joint1' is no estimate"):
        bound().reset(warm="end")
    doubtful = attach(ROBOT, {"joint1": ESTIMATE | {"status": "inadequate_model"}})
    assert "inadequate_model" in doubtful.notices[0]
    with pytest.raises(ValueError, match="holds no friction"):
        attach(ROBOT, {"joint1": {"status": "bad_data", "friction": None}})


@pytest.mark.parametrize("form", FORMS)
def test_worlds_equal_single_runs(form):
    batch = batch_of_mujoco()
    friction = bound(form)
    worlds = batch.Batch(friction.model, 64)
    drawn = friction.randomise(worlds, coulomb=(0.7, 1.0), thermal_gain=(0.5, 1.5), warm=(0, 1), rng=1)
    assert drawn["coulomb"].shape == drawn["warm"].shape == (64, 3)
    assert 0.7 <= drawn["coulomb"].min() < drawn["coulomb"].max() <= 1.0
    controls = np.array([15, 5, 10])
    worlds.bind("ctrl")[:, :3] = controls
    begin = worlds.state.copy()
    worlds.step(nstep=100)
    single = bound(form)
    for world in range(64):
        single.model.numeric_data[:] = worlds.expand("numeric_data")[world]
        mujoco.mj_setState(single.model, single.data, begin[world], mujoco.mjtState.mjSTATE_INTEGRATION)
        np.testing.assert_allclose(single.heat, single.settled() * drawn["warm"][world])
        mujoco.mj_step(single.model, single.data, 100)
        np.testing.assert_array_equal(single.data.qpos, worlds.bind("qpos")[world])
        np.testing.assert_allclose(single.model.numeric("friction/coulomb").data, drawn["coulomb"][world] * [4, 1, 1])
    assert len(np.unique(worlds.bind("qpos")[:, 0])) == 64

    # a reset begins with the world's heat; what is drawn is repeatable and starts from the model's numbers
    worlds.reset()
    again = friction.randomise(worlds, coulomb=(0.7, 1.0), thermal_gain=(0.5, 1.5), warm=(0, 1), rng=1)
    np.testing.assert_array_equal(again["warm"], drawn["warm"])


def test_some_worlds_draw_and_all_are_read():
    batch = batch_of_mujoco()
    friction = bound()
    worlds = batch.Batch(friction.model, 8)
    first = friction.randomise(worlds, coulomb=(0.7, 1.0), viscous=(0.5, 2), warm=(0, 1), rng=1)
    before = {field: worlds.expand(field).copy() for field in ("numeric_data", "dof_damping")}
    np.testing.assert_allclose(before["dof_damping"], first["viscous"] * friction.model.dof_damping)
    ended = np.array([1, 5])
    again = friction.randomise(worlds, ids=ended, coulomb=(0.7, 1.0), viscous=(0.5, 2), warm=(0, 1), rng=2)
    assert again["coulomb"].shape == (2, 3)
    others = np.setdiff1d(np.arange(8), ended)
    for field, values in before.items():
        np.testing.assert_array_equal(worlds.expand(field)[others], values[others])
        assert (worlds.expand(field)[ended] != values[ended]).any()
    mask = np.arange(8) == 3
    assert friction.randomise(worlds, ids=mask, coulomb=(1, 1))["coulomb"].shape == (1, 3)
    with pytest.raises(ValueError, match="worlds from 0 to 7"):
        friction.randomise(worlds, ids=[8], coulomb=(1, 1))

    # torque and heat of all worlds are those of each
    worlds.bind("qvel")[:] = 0.5
    worlds.step(nstep=20)
    seen = friction.of(worlds)
    single = bound()
    for world in range(8):
        single.model.numeric_data[:] = worlds.expand("numeric_data")[world]
        single.model.dof_damping[:] = worlds.expand("dof_damping")[world]
        mujoco.mj_setState(single.model, single.data, worlds.state[world], mujoco.mjtState.mjSTATE_INTEGRATION)
        np.testing.assert_array_equal(seen.heat[world], single.heat)
    worlds.forward()
    mujoco.mj_forward(single.model, single.data)
    for which in ("torque", "loss", "held", "rise"):
        assert getattr(seen, which).shape == (8, 3)
        np.testing.assert_array_equal(getattr(seen, which)[7], getattr(single, which))


def test_worlds_beyond_bounds_are_refused_by_name():
    batch = batch_of_mujoco()
    friction = bound()
    worlds = batch.Batch(friction.model, 8)
    before = worlds.expand("numeric_data").copy()
    for factors, words in (
        ({"viscous": (-2, -1)}, "viscous of 'joint1' would be -.* in world 0; it must be a number of at least 0"),
        ({"thermal_time_constant": (0, 0)}, "thermal_time_constant of 'joint1' would be 0"),
        ({"coulomb": (2, 2)}, "static of 'joint2' would be 1.5 in world 0; it must be at least coulomb, 2"),
        ({"coulumb": (1, 2)}, "'coulumb'; did you mean 'coulomb'"),
        ({"coulomb": (1.3, 0.7)}, "coulomb: the least, 1.3, is above the largest, 0.7"),
        ({"warm": (0, 2)}, "warm: is from 0 to 2"),
        ({"warm": (-1, 1)}, "warm: is from -1 to 1"),
    ):
        with pytest.raises(ValueError, match=words):
            friction.randomise(worlds, **factors)
        np.testing.assert_array_equal(worlds.expand("numeric_data"), before)
    with pytest.raises(ValueError, match="attach with randomisable"):
        fixed = bound(randomisable=False)
        fixed.randomise(batch.Batch(fixed.model, 2), coulomb=(0.5, 1))


def test_wrong_calls_are_refused_by_name_and_change_nothing():
    spec = mujoco.MjSpec.from_string(ROBOT)
    spec.compile()
    before = spec.to_xml()
    heavy = BIG | {"parameters": {"viscous": 1e5, "coulomb": 1e6}}
    for frictions, options, words in (
        ({"joint3": BIG}, {}, "no joint 'joint3'; did you mean 'joint"),
        ({"*": BIG}, {}, r"write '\.\*'"),
        ({"joint1": BIG, "joint.*": BIG}, {}, "'joint1' is given friction twice"),
        ({"joint1": {"law": "coulmb", "parameters": {}}}, {}, "did you mean 'coulomb'"),
        ({"joint1": BIG | {"parameters": {"viscous": 1}}}, {}, "coulomb"),
        ({"joint1": heavy}, {}, 'armatures={"joint1"'),
        ({"joint1": BIG}, {"form": "active"}, "'active'"),
        ({"joint1": BIG}, {"armatures": {"joint9": 1}}, "joint9"),
        ({"joint1": BIG}, {"timestep": -1}, "timestep"),
        ({"joint1": BIG}, {"integrator": "euler"}, "'euler'; it must be one of auto, Euler"),
        ({"joint1": BIG}, {"stiffest_drive": 5}, "stiffest_drive"),
        ({"slide": ESTIMATE | {"parameters": {"coulomb": {"value": 4, "unit": "N.m"}}}}, {}, "slide.* of hinges"),
    ):
        with pytest.raises(ValueError, match=words):
            attach(spec, frictions, **options)
    spec.compile()
    assert spec.to_xml() == before
    attach(spec, {"joint1": BIG})
    with pytest.raises(ValueError, match="has friction already"):
        attach(spec, {"joint1": BIG})
    with pytest.raises(KeyError, match="did you mean 'joint1'"):
        bound()["jiont1"]
    with pytest.raises(ValueError, match="attach with sensors"):
        _ = bound(sensors=False).torque
    with pytest.raises(ValueError, match="give one number, or 3"):
        bound().reset(warm=[1, 2])
    with pytest.raises(ValueError, match="smaller speed"):
        growing = BIG | {"thermal": {"thermal_gain": 0.5, "thermal_time_constant": 10}}
        bound(frictions={"joint1": growing}).reset(warm=1, speed=3)


def test_what_mujoco_refuses_is_said_in_one_line():
    massless = "<mujoco><worldbody><body><joint name='joint1'/></body></worldbody></mujoco>"
    for call in (lambda: attach("no \x1b[31m such\n file.xml", {"joint1": BIG}), lambda: attach("<mujoco><worldbdy/></mujoco>", {"joint1": BIG}),
                 lambda: split(mujoco.MjSpec.from_string(massless)), lambda: identify_robot(mujoco.MjSpec.from_string(massless), {"time": [1]})):
        with pytest.raises(BadInput, match=r"^model: MuJoCo cannot") as refused:
            call()
        assert str(refused.value).isprintable() and "\\x0A" not in str(refused.value)
    bare, arrays = split(attach(ROBOT, {"joint1": BIG}))
    for arguments, words in ((("model",), "^model: "), ((bare, 5), "^prefix: is 5"), ((bare, "\udcff"), "^prefix: .*no UTF-8")):
        with pytest.raises(BadInput, match=words):
            arrays.in_model(*arguments)


def test_models_from_specs_files_and_memory(tmp_path):
    mesh = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    xml = """<mujoco><asset><mesh name="t" file="t.obj"/></asset>
      <worldbody><body><joint name="j"/><geom type="mesh" mesh="t"/></body></worldbody></mujoco>"""
    spec = mujoco.MjSpec.from_string(xml, assets={"t.obj": mesh})
    assert attach(spec, {"j": BIG}).spec is spec
    assert spec.compile().nplugin == 1

    # a file's meshes are found from anywhere
    (tmp_path / "t.obj").write_bytes(mesh)
    (tmp_path / "robot.xml").write_text(xml)
    attached = attach(tmp_path / "robot.xml", {"j": BIG})
    assert mujoco.MjModel.from_xml_string(attached.xml).nmesh == 1


@pytest.mark.parametrize("form", FORMS)
def test_a_robot_in_a_scene(form):
    attached = attach(ROBOT, FRICTIONS, form=form)
    scene = mujoco.MjSpec()
    scene.option.timestep, scene.option.integrator = attached.spec.option.timestep, attached.spec.option.integrator
    for side in ("left/", "right/"):
        scene.attach(attached.spec.copy(), prefix=side, frame=scene.worldbody.add_frame())
    model = scene.compile()
    data = mujoco.MjData(model)
    left, right = (attached.bind(model, data, prefix=side) for side in ("left/", "right/"))
    right.reset(warm=1)
    mujoco.mj_step(model, data)
    assert left.joints[0] == "left/joint1"
    assert (left.heat > right.heat).all()
    assert len(mujoco_attach.bind(model, data).joints) == 6


def test_a_number_out_of_its_bounds_warns_once(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    friction, other = bound(), bound()
    friction.model.numeric("friction/coulomb").data[1] = -3
    drive(friction, 100)
    drive(other, 100)
    np.testing.assert_array_equal(friction.data.qpos, other.data.qpos)
    log = (tmp_path / "MUJOCO_LOG.TXT").read_text()
    assert log.count("numeric 'friction/coulomb' of joint 'joint2' is -3; it must be a number of at least 0; 1 acts") == 1


@pytest.mark.skipif(not mujoco.__version__.startswith("4."), reason="springs yield from MuJoCo 4.0 on")
def test_a_spring_that_yields_gives_way_to_the_friction():
    text = """<mujoco><compiler angle="radian"/><option timestep="1e-3" integrator="implicitfast"/><worldbody><body>
    <joint name="axle" stiffness="20000" springyield="2.5e-4" damping=".6"/><inertial pos="0 0 0" mass="1.5" diaginertia=".8 .8 .8"/>
    </body></worldbody></mujoco>"""
    attached = attach(text, {"axle": {"law": "viscous_coulomb", "parameters": {"viscous": 0.6, "coulomb": 12}}})
    assert any("axle: the stiffness of the model's spring with a yield was removed" in notice for notice in attached.notices)
    model = attached.spec.compile()
    for torque, slides in ((11.5, False), (12.5, True)):
        data = mujoco.MjData(model)
        data.qfrc_applied[0] = torque
        mujoco.mj_step(model, data, 1000)
        assert (abs(data.qvel[0]) > 0.01) == slides


@pytest.mark.parametrize("form", ["passive", "actuator"])
def test_inverse_dynamics_along_a_motion_have_the_friction_of_sliding(form):
    robot = attach(ROBOT, FRICTIONS, form)
    model = robot.spec.compile()
    data = mujoco.MjData(model)
    friction, bare = robot.bind(model, data), split(robot)[0]
    inside, times = mujoco.MjData(bare), np.linspace(0.01, 9, 60)[:, None]
    phase = 0.3 * times + np.arange(model.nv)
    q, v, a = 0.5 * np.sin(phase), 0.15 * np.cos(phase), -0.045 * np.sin(phase)
    heat = -0.1 * np.arange(len(friction.joints))
    before = data.qpos.copy(), data.plugin_state.copy()
    found = friction.inverse(q, v, a, heat)
    assert (data.qpos == before[0]).all() and (data.plugin_state == before[1]).all()
    worst = 0.0
    for i in range(len(q)):
        inside.qpos[:], inside.qvel[:], inside.qacc[:] = q[i], v[i], a[i]
        mujoco.mj_inverse(bare, inside)
        wanted = inside.qfrc_inverse.copy()
        for k, joint in enumerate(mujoco_plugin.joints_of(model)):
            dof = model.joint(joint["name"]).dofadr[0]
            of = Friction.from_dict(joint["friction"])
            wanted[dof] += of(v[i, dof], q[i, model.joint(joint["name"]).qposadr[0]], heat[k], inside.qfrc_bias[dof]) - bare.dof_damping[dof] * v[i, dof]
        worst = max(worst, np.abs(found[i] - wanted).max())
    assert worst <= 1e-9
    np.testing.assert_array_equal(friction.inverse(q[3], v[3], a[3], heat), found[3])
    for wrong, words in (((q[:, :1], v, a), "q"), ((q, v[:5], a), "shapes"), ((q, v, np.nan * a), "finite"), ((q, v, a, [1.0] * 99), "heat")):
        with pytest.raises(BadInput, match=words):
            friction.inverse(*wrong)


def test_bind_refuses_what_is_no_model_and_data_of_another():
    model = attach(ROBOT, FRICTIONS).spec.compile()
    other = mujoco.MjModel.from_xml_string(ROBOT)
    for given, words in (((5, mujoco.MjData(model)), "^model: is a value of the type int"), ((model, None), "^data: is None"),
                         ((model, mujoco.MjData(other)), "^data: is of another model")):
        with pytest.raises(ValueError, match=words):
            mujoco_attach.bind(*given)


def test_a_second_attach_joins_the_first():
    once = attach(ROBOT, FRICTIONS).spec
    twice = attach(ROBOT, {"joint1": BIG})
    attach(twice.spec, {"joint2|slide": SMALL})
    assert twice.spec.to_xml() == once.to_xml()
    assert "passive form (form='actuator'" in repr(twice)
    model = twice.spec.compile()
    assert twice.bind(model, mujoco.MjData(model)).joints == ["joint1"]
    integrator = attach(ROBOT, {"joint1": BIG}, integrator="RK4").spec.option.integrator
    assert integrator == mujoco.mjtIntegrator.mjINT_RK4


@pytest.mark.parametrize(
    "order", ["loads, uses", "uses, loads", "runs, uses", "uses, runs", "loads, runs, uses", "runs, loads, uses"]
)
def test_the_library_may_be_loaded_by_hand_and_with_the_engine(order, tmp_path):
    """attach, simulate and a library of one's own in one process, in any order."""
    library = tmp_path / "libwarmjoint_friction.so"
    library.write_bytes(mujoco_plugin.library_path(mujoco.__version__).read_bytes())
    (tmp_path / "robot.xml").write_text(ROBOT)
    steps = {
        "loads": f"mujoco.mj_loadPluginLibrary({str(library)!r})",
        "runs": "wj.simulate({'friction': {'law': 'viscous_coulomb', 'parameters': {'viscous': 5, 'coulomb': 15}}, "
        "'plant': 'mujoco', 'robot': 'rotary', 'joint': 'hinge', 'motion': {'speeds': {'uniform': [0.1, 1]}, 'hold': 2}, 'duration': 20})",
        "uses": f"m = wj.attach({str(tmp_path / 'robot.xml')!r}, {{'joint1': wj.Friction('coulomb', coulomb=4)}}).spec.compile(); "
        "mujoco.mj_step(m, mujoco.MjData(m), 10); assert m.nplugin == 1",
    }
    if "runs" in order and mujoco.__version__ != "4.0.0":
        pytest.skip("simulate runs MuJoCo 4.0")
    code = "\n".join(["import mujoco", *("import warmjoint as wj\n" + steps[step] for step in order.split(", "))])
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert run.returncode == 0, run.stderr


def test_refuses_another_mujoco():
    with pytest.raises(ImportError, match=r"4\.0, and this Python has 3\.5\.0: pip install 'mujoco==4\.0\.\*'"):
        mujoco_plugin.library_path("3.5.0")


def test_a_patch_version_takes_the_build_of_its_minor_version(tmp_path, monkeypatch):
    for version in ("3.9.0", "3.10.0"):
        (tmp_path / version).mkdir()
        (tmp_path / version / "libwarmjoint_friction.so").touch()
    monkeypatch.setenv("WARMJOINT_PLUGINS", str(tmp_path))
    assert mujoco_plugin.library_path("3.10.4").parent.name == "3.10.0"
    with pytest.raises(ImportError, match=r"3\.9, 3\.10, and this Python has 4\.1\.0: pip install 'mujoco==3\.10\.\*'"):
        mujoco_plugin.library_path("4.1.0")


def test_a_refused_mjdata_leaks_nothing():
    """The plugin frees the data that it refuses as this engine would."""
    import resource

    model = bound().model
    model.opt.timestep = 1

    def refuse(count):
        for _ in range(count):
            with pytest.raises(Exception, match="joint1"):
                mujoco.MjData(model)
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = refuse(100)
    assert refuse(1000) - before < 20000  # kB; each data is some 100 kB


OTHERS = [version for version in ("3.11.0", "3.17.0", "4.0.0") if version != mujoco.__version__]
INNER = "WARMJOINT_INNER_TEST"


def python_of(version):
    """The environment of a MuJoCo that tools/setup/fetch unpacked, or the reason why there is none."""
    wheel = ROOT / "build/deps" / ("mujoco" if version == "4.0.0" else f"mujoco-{version}")
    if not wheel.exists():
        pytest.skip(f"MuJoCo {version} is absent: tools/setup/fetch build/deps {version}")
    try:
        mujoco_plugin.library_path(version)
    except ImportError as missing:
        pytest.skip(str(missing))
    return os.environ | {INNER: "1", "PYTHONPATH": f"{wheel}:{os.environ.get('PYTHONPATH', '')}"}


@pytest.mark.skipif(INNER in os.environ, reason="is run in another version")
@pytest.mark.parametrize("version", OTHERS)
def test_the_same_in_another_version(version):
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", __file__], env=python_of(version), capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout[-4000:]


def motion(form):
    """5,000 steps; positions, velocities and heat, [3 x joints]."""
    friction = bound(form)
    drive(friction, 5000)
    return np.array([friction.data.qpos, friction.data.qvel, friction.heat])


@pytest.mark.skipif(INNER in os.environ, reason="is run in another version")
@pytest.mark.parametrize("version", OTHERS)
@pytest.mark.parametrize("form", FORMS)
def test_moves_as_in_another_version(version, form):
    code = f"import test_attach, json; print(json.dumps(test_attach.motion({form!r}).tolist()))"
    run = subprocess.run(
        [sys.executable, "-c", code], env=python_of(version), cwd=ROOT / "tests/python", capture_output=True, text=True, check=True
    )
    np.testing.assert_array_equal(json.loads(run.stdout), motion(form))
