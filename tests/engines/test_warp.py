"""warmjoint.warp against the plugin. Opt-in: needs build/deps/engine-warp (tools/python/requirements_warp.txt)."""

import mujoco
import numpy as np
import pytest

mjw = pytest.importorskip("mujoco_warp")

import friction_worlds as worlds  # noqa: E402
import warmjoint as wj  # noqa: E402
import warp as wp  # noqa: E402
from conftest import HINGE, WARM, jumps, rests_of_plugin, settled_by_steps, without_friction  # noqa: E402
from warmjoint import warp_kernel  # noqa: E402

wp.config.quiet = True


def engine(bare, friction, nworld):
    m = mjw.put_model(bare)
    d = mjw.put_data(bare, mujoco.MjData(bare), nworld=nworld)
    return m, d, wj.warp.put_friction(friction, m, nworld)


def started(motion):
    """An engine with all starts as worlds beside each other."""
    starts = len(motion.start["qpos"])
    m = mjw.put_model(motion.bare)
    d = mjw.put_data(motion.bare, mujoco.MjData(motion.bare), nworld=starts)
    d.qpos.assign(motion.start["qpos"].astype(np.float32))
    d.qvel.assign(motion.start["qvel"].astype(np.float32))
    return m, d


def engine_alone(motion, forces):
    """By how much the engine without friction leaves MuJoCo, where both have the torques less these forces [steps x S x J]: rad and rad/s."""
    m, d = started(motion)
    worst = np.zeros(2)
    for torque, angles, speeds in zip(*without_friction(motion, forces)):
        d.qfrc_applied.assign(torque)
        mjw.step(m, d)
        pairs = ((d.qpos.numpy()[:, motion.friction.positions], angles), (d.qvel.numpy(), speeds))
        worst = np.maximum(worst, [np.abs(mine - theirs).max() for mine, theirs in pairs])
    return worst


@pytest.mark.parametrize("robot", worlds.ROBOTS)
@pytest.mark.parametrize("law", [*worlds.LAWS, "everything"])
def test_moves_as_the_plugin(motion_of, robot, law):
    """From the plugin's state each .1 s, over 3 s."""
    motion = motion_of(robot, law)
    m, d = started(motion)
    f = wj.warp.put_friction(motion.friction, m, len(motion.start["qpos"]))
    f.put_state(motion.start["bristle load"], np.array([motion.start["energy"], motion.start["second energy"]]), motion.start["slip"])
    f.ambient_rise.fill_(motion.rise)
    worst, differ, forces, positions = np.zeros(3), 0, [], motion.friction.positions
    for step, torque in enumerate(motion.torque):
        d.qfrc_applied.assign(torque.astype(np.float32))
        mjw.step(m, d)
        # of the joints: a base that has fallen for 3 s is 40 m away, where single precision has steps of 4e-6 m
        pairs = ((d.qpos.numpy()[:, positions], motion.qpos[step][:, positions]), (d.qvel.numpy(), motion.qvel[step]),
                 (f.energy.numpy(), motion.energy[step]))
        worst = np.maximum(worst, [np.abs(mine - theirs).max() for mine, theirs in pairs])
        differ += (f.held.numpy() != (motion.held[step] != 0)).sum()
        forces.append(f.force.numpy().copy())
        assert f.turns.numpy().max() <= 8
    alone = engine_alone(motion, forces)
    print(f"\n{robot} {law}: dq {worst[0]:.1e} rad, dv {worst[1]:.1e} rad/s, E {worst[2]:.1e}, held differs in {differ}; "
          f"the engine alone {alone[0]:.1e} rad, {alone[1]:.1e} rad/s")
    # what the engine itself loses in single precision is none of the friction's
    assert worst[0] <= max(1e-5, alone[0])
    assert worst[1] <= max(1e-4, alone[1])


def test_held_joints_rest_also_under_torques_of_20_ms():
    spec = worlds.bare_spec("panda")
    names = worlds.levels(spec)
    attached = wj.attach(spec, worlds.frictions(spec, "coulomb"))
    bare, friction = wj.split(attached)
    model = attached.spec.compile()
    bare.opt.gravity[:] = model.opt.gravity[:] = 0
    level = np.array([names[joint] for joint in friction.joints])
    m, d, f = engine(bare, friction, 4)
    torques = (jumps(4, 7) * level).astype(np.float32)
    speeds, places = [], []
    for torque in torques:
        d.qfrc_applied.assign(torque)
        for _ in range(10):
            mjw.step(m, d)
        # numpy() shows the engine's own memory
        speeds.append(d.qvel.numpy().copy())
        places.append(d.qpos.numpy()[0].copy())
    for _ in range(10):
        mjw.step(m, d)
    later = np.abs(d.qvel.numpy()).max()
    assert f.held.numpy().all()
    drift = np.abs(np.array(places[5:], dtype=np.float64) - places[5]).max()
    speeds, plugin = np.array(speeds)[5:], rests_of_plugin(model, torques)[5:]
    differ = np.abs(speeds - plugin).max()
    print(f"\nheld: constant torque {np.abs(speeds[:, 0]).max():.1e}, moved by {drift:.1e} rad, 20 ms after a jump {np.abs(speeds[:, 1:]).max():.1e}, "
          f"the plugin {np.abs(plugin[:, 1:]).max():.1e}, apart {differ:.1e}; after 20 ms more {later:.1e} rad/s")
    # what one rounding of the torque in single precision does in a step; coupled joints feel up to 3.3 times as light
    rounding = 3.3 * (np.spacing(level.astype(np.float32)) * bare.opt.timestep / friction.inertia).max()
    assert np.abs(speeds[:, 0]).max() <= rounding
    # such speeds do not add up: none goes on for more than a step
    assert drift <= 2 * rounding * bare.opt.timestep
    # the plugin's bristles are not yet at rest after ten steps; single precision adds less than a tenth to that
    assert differ <= 0.1 * np.abs(plugin).max()
    assert later <= rounding


def test_heat_over_900000_steps():
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    m, d, f = engine(bare, friction, 1)
    mjw.forward(m, d)
    h, count = bare.opt.timestep, 900_000
    speeds = (1.0 + 0.5 * np.sin(np.arange(count) * 1e-3)).astype(np.float32)
    table, time, force = wp.array(speeds, dtype=float), wp.zeros(1, dtype=float), wp.zeros((1, 1), dtype=float)

    @wp.kernel
    def move(speeds: wp.array(dtype=float), count: wp.array(dtype=int), qvel: wp.array2d(dtype=float), time: wp.array(dtype=float)):
        qvel[0, 0] = speeds[count[0]]
        # whole numbers tell one step from the next
        time[0] = float(count[0])
        count[0] = count[0] + 1

    at = wp.zeros(1, dtype=int)
    commands = [
        wp.launch(move, dim=1, inputs=[table, at, d.qvel, time], record_cmd=True),
        wp.launch(warp_kernel.step_friction, dim=(1, 1),
                  inputs=[time, d.qpos, d.qvel, d.M, d.qfrc_bias, m.M_rownnz, m.M_rowadr, m.M_colind, m.tree_dofadr, m.tree_dofnum, m.dof_damping,
                          h, 8, f._joints, f._states, f._scratch], outputs=[force], record_cmd=True),
    ]
    for _ in range(count):
        for command in commands:
            command.launch()
    wanted = settled_by_steps(speeds.astype(np.float64), h)
    found = float(f._states.next_energy.numpy()[0, 0, 0])
    print(f"\nE {found:.9f}, in double precision {wanted:.9f}: {abs(found - wanted):.1e} N.m")
    assert abs(found - wanted) <= 1e-6


def drive(m, d, level, steps=150):
    random = np.random.default_rng(3)
    for step in range(steps):
        if step % 10 == 0:
            torque = np.zeros(d.qvel.shape, np.float32)
            torque[:] = (level * random.uniform(-3, 3, len(level))).astype(np.float32)
        d.qfrc_applied.assign(torque)
        mjw.step(m, d)
    return d.qpos.numpy(), d.qvel.numpy()


def test_worlds_alike_are_equal_and_worlds_of_their_own_as_single_runs():
    spec = worlds.bare_spec("panda")
    names = worlds.levels(spec)
    bare, friction = wj.split(wj.attach(spec, worlds.frictions(spec, "stribeck")))
    level = np.array([names[joint] for joint in friction.joints])
    m, d, f = engine(bare, friction, 3)
    q, v = drive(m, d, level)
    assert (q == q[0]).all()
    assert (v == v[0]).all()
    factor = np.array([0.7, 1.0, 1.2])[:, None]
    own = friction.changed(coulomb=factor * friction.numbers["coulomb"], static=factor * friction.numbers["static"])
    m, d, f = engine(bare, own, 3)
    f.reset(warm=np.array([[0.0], [0.5], [1.0]]))
    q, v = drive(m, d, level)
    for world in range(3):
        single = friction.changed(coulomb=factor[world] * friction.numbers["coulomb"], static=factor[world] * friction.numbers["static"])
        m, d, f = engine(bare, single, 1)
        f.reset(warm=[0.0, 0.5, 1.0][world])
        alone = drive(m, d, level)
        assert (alone[0][0] == q[world]).all()
        assert (alone[1][0] == v[world]).all()


def test_resets_of_some_worlds():
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    m, d, f = engine(bare, friction, 3)
    f.reset(warm=1.0, speed=0.5)
    settled = wj.Friction.from_dict(WARM).settled_heat(0.5)
    mjw.step(m, d)
    np.testing.assert_allclose(f.energy.numpy()[:, 0], settled, rtol=1e-5)
    f.reset(mask=[True, False, False], warm=0.0)
    np.testing.assert_allclose(f.energy.numpy()[:, 0], [0, settled, settled], atol=1e-3)
    # to a time before that of the last computation: what they were reset to
    mjw.step(m, d)
    mjw.reset_data(m, d, reset=wp.array([True, True, False], dtype=bool))
    mjw.step(m, d)
    np.testing.assert_allclose(f.energy.numpy()[:, 0], [0, settled, settled], atol=1e-3)


def pushed_humanoid(nworld):
    """Its joints under stiction, and what pushes them at random."""
    spec = worlds.bare_spec("humanoid")
    bare, friction = wj.split(wj.attach(spec, worlds.frictions(spec, "stiction")))
    m, d, f = engine(bare, friction, nworld)
    random = np.random.default_rng(4)
    push = lambda: d.qfrc_applied.assign(np.concatenate([np.zeros((nworld, 6)), random.normal(0, 8, (nworld, m.nv - 6))], axis=1).astype(np.float32))
    return m, d, f, push


def test_a_step_launches_one_kernel_more_than_without_friction(monkeypatch):
    m, d, _, _ = pushed_humanoid(2)
    launched = []
    for name in ("launch", "launch_tiled"):
        real = getattr(wp, name)
        monkeypatch.setattr(wp, name, lambda *given, real=real, **named: (launched.append(given[:1] or named["kernel"]), real(*given, **named)))
    mjw.step(m, d)
    with_friction = len(launched)
    m.callback.passive = None
    mjw.step(m, d)
    assert 2 * with_friction == len(launched) + 1


def test_a_state_that_is_put_back_repeats_the_run_to_the_bit():
    m, d, f, push = pushed_humanoid(3)
    f.reset(warm=np.array([[0.0], [0.5], [1.0]]))
    kept = ("qpos", "qvel", "qacc_warmstart", "time", "qfrc_applied")
    for _ in range(40):
        push()
        mjw.step(m, d)
    saved, before = f.get_state(), {name: getattr(d, name).numpy().copy() for name in kept}
    for _ in range(40):
        mjw.step(m, d)
    end = [one.numpy().copy() for one in (d.qpos, f.energy, f.force)]
    # of all worlds
    for name, values in before.items():
        getattr(d, name).assign(values)
    f.set_state(saved)
    again = f.get_state()
    for name in ("load", "energy", "slip", "turns", "stretch", "status"):
        assert (getattr(again, name).numpy() == getattr(saved, name).numpy()).all(), name
    for _ in range(40):
        mjw.step(m, d)
    for one, other in zip(end, (d.qpos, f.energy, f.force)):
        assert (one == other.numpy()).all()
    # one world alone, by a mask on the device
    moved = f.get_state().energy.numpy()
    f.set_state(saved, wp.array([False, True, False], dtype=bool))
    now = f.get_state().energy.numpy()
    assert (now[1] == saved.energy.numpy()[1]).all() and (now[1] != moved[1]).any()
    assert (now[[0, 2]] == moved[[0, 2]]).all()
    assert np.abs(saved.load.numpy()).max() > 0.01
    with pytest.raises(wj.BadInput, match="worlds"):
        pushed_humanoid(2)[2].set_state(saved)


def test_a_reset_by_time_gives_what_the_last_reset_drew():
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    m, d, f = engine(bare, friction, 3)
    f.reset(warm=np.array([[0.2], [0.5], [1.0]]))
    drawn = f.energy.numpy().copy()
    for _ in range(3):
        mjw.step(m, d)
    mjw.reset_data(m, d)
    mjw.step(m, d)
    assert (f.energy.numpy() == drawn).all() and len(np.unique(drawn)) == 3


@pytest.mark.parametrize("at", [0.0, 5 * 3600.0, 80000.0, 1e6])
def test_heat_goes_on_however_late_it_is(at):
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    m, d, f = engine(bare, friction, 1)
    d.time.fill_(at)
    d.qfrc_applied.fill_(10.0)
    for _ in range(200):
        mjw.step(m, d)
    early, d0, f0 = engine(bare, friction, 1)
    d0.qfrc_applied.fill_(10.0)
    for _ in range(200):
        mjw.step(early, d0)
    assert f.energy.numpy()[0, 0] == f0.energy.numpy()[0, 0] < -0.001


def test_other_worlds_and_another_timestep_are_refused_once_it_steps():
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    m, d, _ = engine(bare, friction, 2)
    with pytest.raises(wj.BadInput, match="4 worlds"):
        mjw.step(m, mjw.put_data(bare, mujoco.MjData(bare), nworld=4))
    m.opt.timestep.fill_(0.004)
    with pytest.raises(wj.BadInput, match="timestep"):
        mjw.step(m, d)


@pytest.mark.parametrize("broken", [np.nan, np.inf, -np.inf])
def test_what_is_no_finite_number_is_gone_once_the_engine_has_right_ones_again(broken):
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    m, d, f = engine(bare, friction, 3)
    f.reset(warm=0.5)
    # a speed of the first world, the load and the heat of the second
    d.qvel.assign(np.array([[broken], [0], [0]], np.float32))
    mjw.step(m, d)
    before = f.energy.numpy()[2, 0]
    assert f.energy.numpy()[0, 0] == before and f.force.numpy()[0, 0] == 0
    f.put_state(np.array([[0.0], [broken], [0.0]]), np.array([[[before], [broken], [before]], [[0.0], [0.0], [0.0]]]))
    d.qpos.zero_()
    d.qvel.zero_()
    d.qacc_warmstart.zero_()
    d.qfrc_applied.assign(np.full((3, 1), 10.0, np.float32))
    for _ in range(50):
        mjw.step(m, d)
    energy, speed = f.energy.numpy()[:, 0], d.qvel.numpy()[:, 0]
    assert energy[0] == energy[2] and speed[0] == speed[2] > 0.1
    m, d, cold = engine(bare, friction, 1)
    d.qfrc_applied.assign(np.full((1, 1), 10.0, np.float32))
    for _ in range(50):
        mjw.step(m, d)
    assert energy[1] == cold.energy.numpy()[0, 0] and speed[1] == d.qvel.numpy()[0, 0]


@pytest.mark.parametrize("form", ["port", "native"])
def test_of_a_thousand_numbers_that_are_none_nothing_is_left_after_two_steps(form):
    """One in each world: of the engine's states and of friction's own."""
    count, random = 1000, np.random.default_rng(5)
    if form == "port":
        bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
        m, d, f = engine(bare, friction, count)
        step = lambda: mjw.step(m, d)
        own = [f._states.stretch, f._states.next_stretch, f._states.energy, f._states.next_energy, f._states.slip, f._states.next_slip]
    else:
        heavy = HINGE.replace("<mujoco>", '<mujoco><option integrator="implicitfast"/>', 1)
        native = wj.native(heavy, {"hinge": wj.Friction("viscous_coulomb", viscous=0.5, coulomb=2, thermal_gain=-0.1, thermal_time_constant=20)}, timestep=0.001)
        m, d = mjw.put_model(native.model), mjw.put_data(native.model, mujoco.MjData(native.model), nworld=count)
        f = native.update(m, d)
        step = lambda: (mjw.step(m, d), native.update(m, d))
        own = [f.energy, d.plastic]
    step()
    arrays = [d.qpos, d.qvel, d.qfrc_applied, *own]
    which, bad = random.integers(len(arrays), size=count), random.choice([np.nan, np.inf, -np.inf], count)
    for k, array in enumerate(arrays):
        values = array.numpy().copy().reshape(count, -1)
        values[which == k, random.integers(values.shape[1], size=(which == k).sum())] = bad[which == k]
        array.assign(values.reshape(array.shape))
    step()
    for array, value in ((d.qpos, 0), (d.qvel, 0), (d.qacc_warmstart, 0), (d.qfrc_applied, 10)):
        array.fill_(value)
    step()
    step()
    assert np.isfinite(f.energy.numpy()).all() and np.isfinite(d.qvel.numpy()).all()
    for _ in range(20):
        step()
    assert (d.qvel.numpy() > 0.01).all()


def test_springs_of_native_have_the_heat_of_mujoco_s_own_by_world():
    spec = worlds.bare_spec("panda")
    spec.option.timestep, spec.option.integrator = 0.001, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    for joint in spec.joints:
        joint.armature = 0.1
    level = worlds.levels(spec)
    frictions = {joint: wj.Friction("viscous_coulomb", viscous=0.4 * one, coulomb=one, thermal_gain=-0.3, thermal_time_constant=5) for joint, one in level.items()}
    native = wj.native(spec, frictions)
    data = mujoco.MjData(native.model)
    native.start(data)
    mujoco.mj_forward(native.model, data)
    m, d = mjw.put_model(native.model), mjw.put_data(native.model, data, nworld=3)
    heat = native.update(m, d)
    heat.start(d, warm=np.array([[0.0], [0.0], [0.5]]))
    size, h = np.array([level[joint] for joint in native.joints]), 0.001
    assert native.model.jnt_springyield[native.ids] * native.stiffness == pytest.approx(size)
    before = m.jnt_springyield.numpy().copy()
    assert (before[0] == before[1]).all() and (before[2] < before[0])[native.ids].all()
    apart = 0.0
    for step in range(2000):
        torque = 2.5 * size * np.sin(2 * np.pi * 0.7 * step * h + np.arange(7))
        torque[3] = 0.7 * size[3]
        mujoco.mj_forward(native.model, data)
        torque = torque + data.qfrc_bias
        data.qfrc_applied[:] = torque
        d.qfrc_applied.assign(np.tile(torque, (3, 1)).astype(np.float32))
        native.step(data)
        mjw.step(m, d)
        assert native.update(m, d) is heat
        apart = max(apart, np.abs(d.qpos.numpy()[0] - data.qpos).max())
    found, wanted = heat.energy.numpy().sum(axis=2), native.heat
    print(f"\nE apart by {np.abs(found[0] / wanted - 1).max():.1e}, positions by {apart:.1e} rad, held {np.abs(d.qvel.numpy()[0, 3]):.1e} rad/s")
    assert (found[0] == found[1]).all() and (found[2] < found[0]).all()
    moves = np.arange(7) != 3
    # the stretch is a difference of angles of about 1 rad, worth 6e-8 in single precision, of yields of 4e-5 rad: .2 % of the level, on a travel of 2 rad
    assert np.abs(found[0] / wanted - 1)[moves].max() <= 5e-3
    assert apart <= 5e-3


def test_a_pose_set_anew_and_a_number_that_is_none_leave_springs_of_native_relaxed():
    native = wj.native(HINGE, {"hinge": {**WARM, "parameters": {"viscous": 0.5, "coulomb": 2.0}}}, integrator="implicitfast")
    data = mujoco.MjData(native.model)
    m, d = mjw.put_model(native.model), mjw.put_data(native.model, data, nworld=2)
    heat = native.update(m, d)
    d.qpos.assign(np.array([[0.0], [1.0]], np.float32))
    native.update(m, d)
    for _ in range(5):
        mjw.step(m, d)
        native.update(m, d)
    assert np.abs(d.qvel.numpy()).max() <= 1e-6
    d.qvel.assign(np.array([[np.nan], [0.0]], np.float32))
    mjw.step(m, d)
    native.update(m, d)
    for array in (d.qpos, d.qvel, d.qacc_warmstart):
        array.zero_()
    for _ in range(2):
        native.update(m, d)
        mjw.step(m, d)
    assert np.isfinite(heat.energy.numpy()).all() and np.isfinite(d.qvel.numpy()).all() and np.abs(d.qvel.numpy()).max() <= 1e-6


@pytest.mark.parametrize("change, words", [("RK4", "RK4"), ("step", "timestep"), ("damper", "damper"), ("worlds", "worlds")])
def test_what_the_port_does_not_step_is_refused(change, words):
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": WARM}))
    if change == "RK4":
        bare.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    elif change == "step":
        bare.opt.timestep = 0.001
    elif change == "damper":
        bare.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_DAMPER)
    else:
        friction = friction.changed(coulomb=np.ones((2, 1)))
    with pytest.raises(wj.BadInput, match=words):
        wj.warp.put_friction(friction, mjw.put_model(bare), 3)
