"""Joint springs with a yield beside the plugin. They came with MuJoCo 4.0."""

import copy
import json
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco")

import friction_worlds as worlds  # noqa: E402
import warmjoint as wj  # noqa: E402

pytestmark = pytest.mark.skipif(int(mujoco.__version__.split(".")[0]) < 4, reason="MuJoCo 4.0 brought springs with a yield")

HINGE = """<mujoco><compiler angle="{angle}"/><option timestep="{h}" integrator="{integrator}" gravity="0 0 0"/><worldbody><body>
<joint name="hinge" axis="0 1 0" ref="20" {more}/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
<actuator><motor joint="hinge"/></actuator><keyframe><key qpos=".3"/></keyframe></mujoco>"""
WARM = wj.Friction("viscous_coulomb", viscous=5, coulomb=15, thermal_gain=-0.25, thermal_time_constant=60)


def hinge(angle="radian", h=1e-3, integrator="implicitfast", more=""):
    return HINGE.format(angle=angle, h=h, integrator=integrator, more=more)


def beside_the_plugin(friction, torque, seconds, **options):
    """Heat and position of both under a torque of the time, and the level that each held."""
    attached, native = wj.attach(hinge(), {"hinge": friction}), wj.native(hinge(), {"hinge": friction}, **options)
    model = attached.spec.compile()
    data, other = mujoco.MjData(model), mujoco.MjData(native.model)
    bound = attached.bind(model, data)
    bound.reset(warm=0.3)
    native.start(other, warm=0.3)
    apart = 0.0
    for step in range(round(seconds * 1000)):
        data.qfrc_applied[0] = other.qfrc_applied[0] = torque(step * 1e-3)
        mujoco.mj_step(model, data)
        native.step(other)
        apart = max(apart, abs(data.qpos[0] - other.qpos[0]))
    return bound.heat[0], native.heat[0], apart


@pytest.mark.parametrize("friction", [
    WARM,
    wj.Friction("viscous_coulomb", viscous=5, coulomb=15, thermal_gain=-0.2, thermal_time_constant=20, second={"thermal_gain": -0.1, "thermal_time_constant": 200}),
    wj.Friction("stribeck", viscous=5, coulomb=12, static=15, stribeck_velocity=0.2, thermal_gain=-0.25, thermal_time_constant=60),
], ids=["one heat", "two heats", "stribeck"])
def test_heat_and_motion_are_those_of_the_plugin(friction):
    heat, ours, apart = beside_the_plugin(friction, lambda t: 25 * np.sin(2 * np.pi * 0.5 * t), 12)
    print(f"\nE {heat:.5f} N.m, of the springs {ours:.5f}; positions apart by {apart:.1e} rad")
    assert abs(ours / heat - 1) <= 1e-3 and heat < -0.5
    assert apart <= 2e-3


@pytest.mark.parametrize("law", ["viscous_coulomb", "stribeck"])
def test_the_driver_s_heat_is_that_of_the_golden_recordings(law):
    """Those by which the other spellings of a step are tested (tests/golden)."""
    golden = json.loads((pathlib.Path(__file__).resolve().parents[1] / f"golden/{law}.json").read_text())
    heavy = hinge(h=golden["step"]).replace('diaginertia="1 1 1"', 'diaginertia="1e6 1e6 1e6"')
    native = wj.native(heavy, {"hinge": golden["friction"]})
    data = mujoco.MjData(native.model)
    native.start(data)
    worst = 0.0
    for v, energy in zip(golden["velocity"], golden["energy"]):
        worst = max(worst, abs(native.heat[0] - energy))
        data.qvel[0] = v
        # as a step that slid at this speed leaves the spring: at the yield of the speed
        native.warm(data, 0)
        data.plastic[0] = data.qpos[0] - np.sign(v) * native.model.jnt_springyield[0]
        native.warm(data)
    print(f"\n{law}: E apart by {worst:.1e} N.m")
    assert worst <= 1e-9 and native.heat[0] < -1


def test_what_is_held_rests():
    native = wj.native(hinge(), {"hinge": WARM})
    data = mujoco.MjData(native.model)
    native.start(data)
    data.qfrc_applied[0] = 14.0
    native.step(data, 4000)
    before = data.qpos[0]
    native.step(data, 2000)
    assert abs(data.qpos[0] - before) * 30 <= 1e-3 and native.heat[0] == pytest.approx(0, abs=1e-3)
    data.qfrc_applied[0] = 16.0
    native.step(data, 1000)
    assert data.qvel[0] > 0.05


def test_steps_together_are_the_same_steps_and_the_heat_can_be_put_back():
    both, native = [], wj.native(hinge(), {"hinge": WARM})
    for together in (1, 20):
        data = mujoco.MjData(native.model)
        native.start(data)
        for step in range(0, 2000, 20):
            data.qfrc_applied[0] = 25 * np.sin(np.pi * step * 1e-3)
            for _ in range(20 // together):
                native.step(data, together)
        both.append((native.heat[0], data.qpos[0]))
    assert both[0] == both[1] and both[0][0] < -0.1
    # a snapshot, put back into a copy of the driver
    driver, copied = copy.copy(native.bind(native.model)), copy.copy(data)
    driver.energy = native.energy.copy()
    for one, its in ((native, data), (driver, copied)):
        one.step(its, 100)
    assert driver.heat[0] == native.heat[0] != both[1][0] and copied.qpos[0] == data.qpos[0]
    with pytest.raises(wj.BadInput, match=r"^energy: has shape .*2 x 1"):
        native.energy = [1.0, 2.0, 3.0]


def test_errors_of_the_engine_and_of_its_callbacks_are_raised(capfd):
    crowd = "".join(f'<body pos="0 0 {0.01 * k}"><freejoint/><geom size=".1"/></body>' for k in range(8))
    native = wj.native(hinge().replace("<worldbody>", f'<size memory="5K"/><worldbody>{crowd}'), {"hinge": WARM})
    with pytest.raises(mujoco.FatalError, match="stack overflow"):
        native.step(mujoco.MjData(native.model), 3)
    assert "arena memory is full" in capfd.readouterr().err  # warnings go where they always do
    times = []

    def control(model, data):
        times.append(data.time)
        if len(times) == 3:
            raise ValueError("of mine")

    native = wj.native(hinge(), {"hinge": WARM})
    data = mujoco.MjData(native.model)
    mujoco.set_mjcb_control(control)
    try:
        with pytest.raises(ValueError, match="of mine"):
            native.step(data, 5)
    finally:
        mujoco.set_mjcb_control(None)
    native.step(data, 5)
    assert len(times) == 3 and data.time == pytest.approx(7e-3)


@pytest.mark.parametrize("angle", ["degree", "radian"])
def test_yield_and_start_are_in_the_model_s_own_units_and_the_text_loads_anywhere(angle):
    native = wj.native(hinge(angle), {"hinge": WARM})
    for model in (native.model, mujoco.MjModel.from_xml_string(native.xml)):
        np.testing.assert_allclose(model.jnt_springyield * model.jnt_stiffness[:, 0] if model.jnt_stiffness.ndim > 1 else model.jnt_springyield * model.jnt_stiffness,
                                   15, rtol=1e-12)
        assert model.nplugin == 0 and model.dof_damping[0] == 5
        # relaxed at the reference pose and in the keyframe
        data = mujoco.MjData(model)
        assert data.plastic[0] == data.qpos[0]
        mujoco.mj_resetDataKeyframe(model, data, 0)
        assert data.plastic[0] == data.qpos[0] == 0.3


def test_springs_are_as_stiff_as_the_step_carries_in_every_pose():
    spec = worlds.bare_spec("panda")
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    native = wj.native(spec, worlds.frictions(spec, "viscous_coulomb"))
    model, data = native.model, mujoco.MjData(native.model)
    inertia, random, modes = np.zeros((model.nv, model.nv)), np.random.default_rng(3), []
    for _ in range(200):
        data.qpos[:] = random.uniform(-np.pi, np.pi, model.nq)
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, inertia)
        modes.append(np.linalg.eigvals(np.linalg.solve(inertia, np.diag(native.stiffness))).real.max() * model.opt.timestep**2)
    # 1 in the poses that were looked at, and of the 4 that the step carries no more than half in others
    assert 0.5 < max(modes) < 2


@pytest.mark.parametrize("friction, words", [
    (wj.Friction("stiction", viscous=5, coulomb=12, static=15), "stiction .*12 .*15"),
    (wj.Friction("asymmetric", viscous=5, coulomb_positive=15, coulomb_negative=11), "asymmetry .*off by 2"),
    (wj.Friction("lugre", viscous=5, coulomb=12, static=15, stribeck_velocity=0.1, bristle_stiffness=1e4, bristle_damping=100), "bristle"),
    (wj.Friction("viscous_coulomb", viscous=5, coulomb=15, maps=[worlds.POSITION_MAP]), "map .*0.14"),
    (wj.Friction("viscous_coulomb", viscous=5, coulomb=15, load_gain=0.1), "load_gain"),
    (wj.Friction("coulomb", coulomb=15), "viscous of 0 .*1.5"),
    (wj.Friction("viscous_coulomb", viscous=0.2, coulomb=15), "viscous of 0.2 .*1.5"),
], ids=lambda one: one.law if isinstance(one, wj.Friction) else "")
def test_what_a_spring_cannot_hold_is_refused_or_replaced_with_its_size(friction, words):
    spec = mujoco.MjSpec.from_string(hinge())
    before = spec.to_xml()
    with pytest.raises(wj.BadInput, match=words):
        wj.native(spec, {"hinge": friction})
    assert spec.to_xml() == before
    native = wj.native(spec, {"hinge": friction}, approximate=True)
    assert len(native.notices) == 1 and native.friction.laws[0] in ("viscous_coulomb", "stribeck")
    data = mujoco.MjData(native.model)
    native.step(data, 10)
    assert data.qpos[0] == pytest.approx(20, abs=1e-9)


@pytest.mark.parametrize("options, words", [
    ({"h": 0.1}, "too long.*timestep=0.0.*armatures"), ({"integrator": "RK4"}, "RK4|explicitly"), ({"integrator": "discrete"}, "discrete"),
    ({"more": 'stiffness="3"'}, "spring of its own")])
def test_steps_and_joints_that_springs_do_not_suit_are_refused(options, words):
    with pytest.raises(wj.BadInput, match=words):
        wj.native(hinge(**options), {"hinge": WARM})
    with pytest.raises(wj.BadInput, match="already"):
        wj.native(wj.native(hinge(), {"hinge": WARM}).spec, {"hinge": WARM})


@pytest.mark.parametrize(("call", "words"), [
    (lambda native, data: native.start(None), "^data: is None; give a mujoco.MjData"),
    (lambda native, data: native.start(data, warm="hot"), "^warm: "),
    (lambda native, data: native.start(data, warm=1, speed=[1, 2]), "^speed: "),
    (lambda native, data: native.warm(data, 0.5), "^steps: "),
    (lambda native, data: native.step(mujoco.MjData(mujoco.MjModel.from_xml_string("<mujoco/>"))), "^data: is of another model"),
    (lambda native, data: native.bind(native.model, prefix=1), "^prefix: "),
])
def test_wrong_calls_of_the_driver_are_refused_by_the_name_of_the_argument(call, words):
    native = wj.native(hinge(), {"hinge": WARM})
    with pytest.raises(wj.BadInput, match=words):
        call(native, mujoco.MjData(native.model))


def test_a_pose_that_was_set_anew_and_a_reset_begin_relaxed_with_the_heat_of_the_last_start():
    native = wj.native(hinge(), {"hinge": WARM})
    data = mujoco.MjData(native.model)
    native.start(data, warm=0.5)
    begun = native.heat[0]
    assert begun == pytest.approx(0.5 * WARM.settled_heat(1.0))
    native.step(data, 100)
    data.qpos[0] += 1
    native.step(data)
    assert abs(data.qvel[0]) <= 1e-9
    mujoco.mj_resetData(native.model, data)
    native.step(data)
    assert native.heat[0] == pytest.approx(begun, rel=1e-3)
    # a number that is none leaves the heat as it was
    data.qvel[0] = np.nan
    native.step(data, 2)
    assert np.isfinite(native.heat).all() and np.isfinite(data.qvel).all()


@pytest.mark.parametrize("form", ["passive", "actuator", "native"])
def test_of_a_thousand_numbers_that_are_none_nothing_is_left_after_two_steps(form):
    """In the engine's states and in friction's own; the engine's are put right by those who own them."""
    native = wj.native(hinge(), {"hinge": WARM}) if form == "native" else None
    attached = None if native else wj.attach(hinge(), {"hinge": WARM}, form)
    model = native.model if native else attached.spec.compile()
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    data, random = mujoco.MjData(model), np.random.default_rng(2)
    step = native.step if native else lambda data, count=1: mujoco.mj_step(model, data, count)
    bound = native or attached.bind(model, data)
    own = {"passive": lambda: data.plugin_state, "actuator": lambda: data.act, "native": lambda: (data.plastic, native.energy[0])[random.integers(2)]}[form]
    for _ in range(1000):
        mujoco.mj_resetData(model, data)
        if native:
            native.start(data)
        step(data, 2)
        broken = (data.qpos, data.qvel, data.qfrc_applied, own(), own())[random.integers(5)]
        broken[random.integers(len(broken))] = random.choice([np.nan, np.inf, -np.inf])
        step(data)
        data.qpos[:], data.qvel[:], data.qacc_warmstart[:], data.qfrc_applied[:] = 20, 0, 0, 25
        step(data, 2)
        assert np.isfinite(bound.heat).all() and np.isfinite(data.qvel).all()
        if native:
            assert np.isfinite(model.jnt_springyield).all() and np.isfinite(data.plastic).all()
        step(data, 20)
        assert 0.05 < data.qvel[0] < 0.3


def test_a_scene_that_holds_the_robot():
    native = wj.native(hinge(), {"hinge": WARM})
    scene = mujoco.MjSpec()
    scene.option.timestep, scene.option.integrator = 1e-3, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    scene.attach(native.spec.copy(), prefix="left_", frame=scene.worldbody.add_frame())
    model = scene.compile()
    driver = native.bind(model, "left_")
    data = mujoco.MjData(model)
    driver.start(data)
    data.qfrc_applied[0] = 25
    driver.step(data, 1000)
    assert driver.joints == ["left_hinge"] and driver.heat[0] < -0.1 and data.qvel[0] > 0.5


@pytest.mark.parametrize("friction", [
    WARM,
    wj.Friction("stribeck", viscous=5, coulomb=12, static=15, stribeck_velocity=0.2, thermal_gain=-0.2, thermal_time_constant=20,
                second={"thermal_gain": -0.1, "thermal_time_constant": 200}),
], ids=["one heat", "stribeck, two heats"])
def test_the_driver_in_c_has_the_heat_of_the_one_in_python(tmp_path, friction):
    """tools/examples/native_friction.c on the header of compensation, where there is a compiler and a libmujoco beside the package."""
    from warmjoint import mujoco_library

    compiler, library = shutil.which("cc"), mujoco_library.library()
    if not compiler or not library:
        pytest.skip("no C compiler")
    root = pathlib.Path(__file__).resolve().parents[2]
    subprocess.run([compiler, "-std=c11", "-Wall", "-Werror", root / "tools/examples/native_friction.c", f"-I{library.parent}/include",
                    f"-I{root}/models/include", library, f"-Wl,-rpath,{library.parent}", "-lm", "-o", tmp_path / "drive"], check=True)
    native = wj.native(hinge().replace('<motor joint="hinge"/>', '<motor joint="hinge" gear="25"/>'), {"hinge": friction})
    (tmp_path / "warm.xml").write_text(native.xml)
    done = subprocess.run([tmp_path / "drive", tmp_path / "warm.xml", "5"], capture_output=True, text=True, check=True)
    data = mujoco.MjData(native.model)
    data.ctrl[0] = 1
    native.step(data, 5000)
    time, position, heat = (float(value) for value in done.stdout.split("\n")[-2].split())
    print(f"\n{time} {position} {heat}; in Python {data.time} {data.qpos[0]} {native.heat[0]}")
    assert time == pytest.approx(data.time, abs=1e-9)
    # the controller's heat counts the stretching of the spring as sliding, level^2 / k of some 50 J
    stretching = 15**2 / native.stiffness[0] / 50
    assert stretching < 1e-4
    assert heat == pytest.approx(native.heat[0], rel=stretching) and position == pytest.approx(data.qpos[0], rel=stretching)
