"""warmjoint.mjx against the plugin. Opt-in: needs build/deps/engine-mjx (tools/python/requirements_mjx.txt)."""

import copy
import pickle
import subprocess
import sys

import mujoco
import numpy as np
import pytest

jax = pytest.importorskip("jax")

import friction_worlds as worlds  # noqa: E402
import jax.numpy as jp  # noqa: E402
import warmjoint as wj  # noqa: E402
from conftest import HINGE, SEGMENT, WARM, jumps, rests_of_plugin, settled_by_steps, without_friction  # noqa: E402
from mujoco import mjx  # noqa: E402


def start_of(motion, f, nworld):
    """The plugin's states as those of the port."""
    friction = motion.friction
    per_load = friction.timestep**2 / (friction.stiffness * friction.inertia)
    single = lambda values: jp.asarray(values, dtype=jp.zeros(()).dtype)
    stages = np.stack([motion.start["energy"], motion.start["second energy"]], axis=1)
    return f.start(nworld=nworld)._replace(stretch=single(motion.start["bristle load"] * per_load), stages=single(stages),
                                           slip=single(motion.start["slip"]))


def runs_of(m, f):
    """All starts beside each other: what d and the state are after each step. Compiled once for each robot."""

    def run(numbers, damping, d, state, torque):
        own, damped = f.with_numbers(**numbers._asdict()), m.replace(dof_damping=damping)

        def one(carried, applied):
            d, state = carried
            before = state.energy
            d, state = wj.mjx.step(damped, d.replace(qfrc_applied=applied), own, state)
            return (d, state), (d.qpos, d.qvel, before, state.held, state.force)

        return jax.lax.scan(one, (d, state), torque)[1]

    return jax.jit(jax.vmap(run, in_axes=(None, None, 0, 0, 1)))


def engine_alone(motion, m, d, forces):
    """By how much the engine without friction leaves MuJoCo, where both have the torques less these forces [steps x S x J]: rad and rad/s."""
    applied, angles, speeds = without_friction(motion, forces)

    def run(d, torques):
        def one(d, torque):
            d = mjx.step(m, d.replace(qfrc_applied=torque))
            return d, (d.qpos[motion.friction.positions], d.qvel)

        return jax.lax.scan(one, d, torques)[1]

    found = jax.jit(jax.vmap(run, in_axes=(0, 1), out_axes=1))(d, jp.asarray(applied))
    return np.array([np.abs(np.asarray(mine) - theirs).max() for mine, theirs in zip(found, (angles, speeds))])


@pytest.fixture(scope="module")
def compiled():
    """runs_of by robot and whether there are maps."""
    found = {}

    def of(robot, law, m, f):
        key = robot, law == "everything"
        if key not in found:
            found[key] = runs_of(m, f)
        return found[key]

    return of


@pytest.mark.parametrize("robot, law", [*((robot, law) for robot in worlds.ROBOTS for law in worlds.LAWS), ("panda", "everything")])
def test_moves_as_the_plugin(motion_of, compiled, robot, law):
    """From the plugin's state each .1 s, over 3 s; all starts are worlds beside each other."""
    motion = motion_of(robot, law)
    starts = len(motion.start["qpos"])
    m = mjx.put_model(motion.bare)
    f = wj.mjx.put_friction(motion.friction, m)
    d = jax.vmap(lambda q, v: mjx.make_data(motion.bare).replace(qpos=q, qvel=v))(jp.asarray(motion.start["qpos"], jp.float32),
                                                                               jp.asarray(motion.start["qvel"], jp.float32))
    numbers = f.with_numbers(ambient_rise=jp.float32(motion.rise)).numbers
    run = compiled(robot, law, m, f)
    qpos, qvel, energy, held, forces = (np.asarray(one).swapaxes(0, 1) for one in run(numbers, m.dof_damping, d, start_of(motion, f, starts), jp.asarray(motion.torque, jp.float32)))
    # of the joints: a base that has fallen for 3 s is 40 m away, where single precision has steps of 4e-6 m
    positions = motion.friction.positions
    pairs = ((qpos[..., positions], motion.qpos[..., positions]), (qvel, motion.qvel), (energy, motion.energy))
    worst = [np.abs(mine - theirs).max() for mine, theirs in pairs]
    differ = int((held != (motion.held != 0)).sum())
    print(f"\n{robot} {law}: dq {worst[0]:.1e} rad, dv {worst[1]:.1e} rad/s, E {worst[2]:.1e}, held differs in {differ}")
    assert len(qpos) == SEGMENT
    limits = np.array([1e-5, 1e-4])
    if (worst[:2] > limits).any():
        # what the engine itself loses in single precision is none of the friction's
        alone = engine_alone(motion, m, d, forces)
        print(f"the engine alone: {alone[0]:.1e} rad, {alone[1]:.1e} rad/s")
        limits = np.maximum(limits, alone)
    assert (worst[:2] <= limits).all()


@pytest.mark.parametrize("law", ["stiction", "everything"])
def test_a_step_is_the_reference_s(law):
    """At random states of seven coupled joints, of which some hold, some slide and some are about to."""
    spec = worlds.bare_spec("panda")
    level = worlds.levels(spec)
    bare, friction = wj.split(wj.attach(spec, worlds.frictions(spec, law)))
    m = mjx.put_model(bare)
    f = wj.mjx.put_friction(friction, m)
    data, inertia, random = mujoco.MjData(bare), np.zeros((7, 7)), np.random.default_rng(5)
    size = np.array([level[joint] for joint in friction.joints])
    step, worst, held = jax.jit(wj.mjx.step_friction), np.zeros(4), []
    per_load = friction.timestep**2 / (friction.stiffness * friction.inertia)
    for _ in range(60):
        data.qpos[:], speed = random.uniform(-1, 1, 7), random.normal(0, 1, 7) * random.choice([1e-3, 1e-1, 1], 7)
        mujoco.mj_forward(bare, data)
        mujoco.mj_fullM(bare, data, inertia)
        load = random.normal(0, 1, 7)
        state = wj.reference.State(size * random.uniform(-0.7, 0.7, 7), -0.1 * size * random.uniform(0, 1, (2, 7)), random.choice([-1.0, 0.0, 1.0], 7))
        stepped, after = wj.reference.step(friction, state, inertia, speed, bare.dof_damping, data.qpos, load)
        mine = f.start()._replace(stretch=jp.asarray(state.load * per_load, jp.float32), stages=jp.asarray(state.energy, jp.float32),
                                  slip=jp.asarray(state.slip, jp.float32))
        found = step(f, mine, jp.asarray(inertia, jp.float32), jp.asarray(speed, jp.float32), m.dof_damping, jp.asarray(data.qpos, jp.float32),
                     jp.asarray(load, jp.float32))
        pairs = ((found.force, stepped.force), (found.stretch / per_load, after.load), (found.energy, after.energy.sum(axis=0)), (found.loss, stepped.loss))
        worst = np.maximum(worst, [(np.abs(np.asarray(one) - other) / (size + np.abs(other))).max() for one, other in pairs])
        assert (np.asarray(found.held) == stepped.held).all()
        held.append(stepped.held)
    print(f"\n{law}: force {worst[0]:.1e}, load {worst[1]:.1e}, E {worst[2]:.1e}, loss {worst[3]:.1e} of the level, held {np.mean(held):.2f}")
    assert 0.1 < np.mean(held) < 0.9
    assert worst.max() <= 2e-4


def hinge(**numbers):
    bare, friction = wj.split(wj.attach(HINGE, {"hinge": {**WARM, **numbers}}))
    m = mjx.put_model(bare)
    return bare, m, wj.mjx.put_friction(friction, m), friction


def test_heat_over_900000_steps():
    bare, m, f, _ = hinge()
    speeds = (1.0 + 0.5 * np.sin(np.arange(900_000) * 1e-3)).astype(np.float32)
    inertia = jp.asarray([[1 / bare.dof_invweight0[0]]], jp.float32)

    def one(state, v):
        return wj.mjx.step_friction(f, state, inertia, v[None], m.dof_damping, jp.zeros(1), jp.zeros(1)), None

    state = jax.jit(lambda state: jax.lax.scan(one, state, jp.asarray(speeds))[0])(f.start())
    found = float(np.float64(state.stages[0, 0]) + np.float64(state.lost_digits[0, 0]))
    wanted = settled_by_steps(speeds.astype(np.float64), bare.opt.timestep)
    print(f"\nE {found:.9f}, in double precision {wanted:.9f}: {abs(found - wanted):.1e} N.m")
    assert abs(found - wanted) <= 1e-6


def torques(steps):
    random = np.random.default_rng(3)
    return np.repeat(random.uniform(-8, 8, steps // 10), 10)[:, None].astype(np.float32)


def test_worlds_alike_are_equal_and_worlds_of_their_own_as_single_runs():
    bare, m, f, friction = hinge()
    factor = np.array([0.7, 1.0, 1.0, 1.2])[:, None]
    own = wj.mjx.put_friction(friction.changed(coulomb=factor * friction.numbers["coulomb"]), m)
    warm = np.array([[0.0], [0.5], [0.5], [1.0]])

    def run(f, state):
        one = lambda carried, torque: (wj.mjx.step(m, carried[0].replace(qfrc_applied=torque), f, carried[1]), None)
        (d, state), _ = jax.lax.scan(one, (mjx.make_data(bare), state), jp.asarray(torques(300)))
        return d.qpos, state.energy

    q, e = jax.jit(jax.vmap(run, in_axes=(own.in_axes(), 0)))(own, own.start(warm=warm))
    assert q[1] == q[2]
    assert e[1] == e[2]
    single = jax.jit(run)
    for world in range(4):
        alone = wj.mjx.put_friction(friction.changed(coulomb=factor[world] * friction.numbers["coulomb"]), m)
        found = single(f.with_numbers(**alone.numbers._asdict()), alone.start(warm=warm[world]))
        np.testing.assert_allclose(found[0], q[world], rtol=0, atol=1e-6)
        np.testing.assert_allclose(found[1], e[world], rtol=0, atol=1e-6)


@pytest.mark.parametrize("broken", [np.nan, np.inf, -np.inf])
def test_what_is_no_finite_number_is_gone_once_the_engine_has_right_ones_again(broken):
    bare, m, f, _ = hinge()
    step = jax.jit(wj.mjx.step)
    clean = mjx.make_data(bare)
    pushed = clean.replace(qfrc_applied=jp.asarray([10.0]))

    def run(state):
        d = pushed
        for _ in range(50):
            d, state = step(m, d, f, state)
        return float(d.qvel[0]), float(state.energy[0])

    # a speed for one step, and a state
    start = f.start(warm=0.5)
    after = step(m, clean.replace(qvel=jp.asarray([broken])), f, start)[1]
    assert after.energy == start.energy and after.force == 0
    assert run(after) == run(start)
    assert run(start._replace(stretch=jp.asarray([broken]), stages=jp.full_like(start.stages, broken))) == run(f.start(warm=0.0))


def test_of_a_thousand_numbers_that_are_none_nothing_is_left_after_two_steps():
    """One in each world: of the engine's states and of friction's own."""
    bare, m, f, _ = hinge()
    count, random = 1000, np.random.default_rng(5)
    step = jax.jit(jax.vmap(lambda d, state: wj.mjx.step(m, d, f, state)))
    clean = jax.vmap(lambda _: mjx.make_data(bare).replace(qfrc_applied=jp.asarray([10.0])))(jp.arange(count))
    d, state = step(clean, f.start(nworld=count))
    names = ["qpos", "qvel", "qfrc_applied"]
    own = ["stretch", "stages", "lost_digits", "slip"]
    which, bad = random.integers(len(names) + len(own), size=count), random.choice([np.nan, np.inf, -np.inf], count)

    def broken(values, k):
        flat = np.array(values, dtype=np.float32).reshape(count, -1)
        flat[which == k, random.integers(flat.shape[1], size=(which == k).sum())] = bad[which == k]
        return jp.asarray(flat.reshape(values.shape))

    d = d.replace(**{name: broken(getattr(d, name), k) for k, name in enumerate(names)})
    state = state._replace(**{name: broken(getattr(state, name), len(names) + k) for k, name in enumerate(own)})
    _, state = step(d, state)
    d = clean
    for _ in range(2):
        d, state = step(d, state)
    assert all(np.isfinite(np.asarray(one)).all() for one in (state.energy, state.force, d.qvel))
    for _ in range(20):
        d, state = step(d, state)
    assert (np.asarray(d.qvel) > 0.01).all()


def test_starts_are_drawn_under_jit_and_vmap():
    _, _, f, friction = hinge()
    settled = wj.Friction.from_dict(WARM).settled_heat(1.0)
    found = jax.jit(lambda warm: f.start(warm=warm).energy)(jp.asarray([0.5]))
    np.testing.assert_allclose(found, [0.5 * settled], rtol=1e-6)
    found = jax.vmap(lambda warm: f.start(warm=warm).energy)(jp.asarray([0.0, 0.25, 1.0]))
    np.testing.assert_allclose(found[:, 0], [0, 0.25 * settled, settled], rtol=1e-6)
    np.testing.assert_allclose(f.start(warm=1, speed=0.5).energy, [wj.Friction.from_dict(WARM).settled_heat(0.5)], rtol=1e-6)
    # worlds with numbers of their own, each with the heat at which it settles
    own = friction.changed(thermal_gain=np.array([[-0.3], [-0.6]]))
    _, m, _, _ = hinge()
    g = wj.mjx.put_friction(own, m, speed=0.5)
    wanted = [0.5 * wj.Friction.from_dict({**WARM, "thermal": {**WARM["thermal"], "thermal_gain": gain}}).settled_heat(0.5) for gain in (-0.3, -0.6)]
    found = jax.jit(jax.vmap(lambda g: g.start(warm=0.5).energy, in_axes=(g.in_axes(),)))(g)
    np.testing.assert_allclose(found[:, 0], wanted, rtol=1e-6)
    for wrong in (-0.1, np.nan, [0.1, 0.2]):
        with pytest.raises(wj.BadInput, match="warm"):
            f.start(warm=wrong)


def test_an_equal_friction_compiles_nothing_anew_and_another_does():
    bare, m, f, _ = hinge()
    traced = []

    @jax.jit
    def step(d, f, state):
        traced.append(f.joints)
        return wj.mjx.step(m, d, f, state)

    d = mjx.make_data(bare)
    for one in (f, pickle.loads(pickle.dumps(f)), copy.deepcopy(f), hinge()[2], f.with_numbers(positive=1.1 * f.numbers.positive)):
        step(d, one, one.start())
    assert len(traced) == 1
    other = hinge(gear=3.0)[2]
    step(d, other, other.start())
    assert len(traced) == 2 and f._shape != other._shape


def test_a_state_that_is_kept_repeats_the_run_to_the_bit():
    bare, m, f, _ = hinge()
    step = jax.jit(wj.mjx.step)
    d, state = mjx.make_data(bare), f.start(warm=0.5)

    def run(d, state):
        for torque in torques(100)[::10]:
            d, state = step(m, d.replace(qfrc_applied=jp.asarray(torque)), f, state)
        return d, state

    d, state = run(d, state)
    saved = pickle.loads(pickle.dumps((np.asarray(d.qpos), np.asarray(d.qvel), state)))
    first = run(d, state)
    again = run(d.replace(qpos=jp.asarray(saved[0]), qvel=jp.asarray(saved[1])), saved[2])
    assert (first[0].qpos == again[0].qpos).all()
    assert all((np.asarray(one) == np.asarray(other)).all() for one, other in zip(first[1], again[1]))


def test_a_model_with_the_sensors_of_the_friction_is_taken():
    robot = wj.attach(HINGE, {"hinge": WARM})
    m, f = wj.mjx.put_model(robot)
    d, state = wj.mjx.step(m, mjx.make_data(m).replace(qfrc_applied=jp.asarray([9.0])), f, f.start())
    assert state.force == 0 and d.qvel[0] > 0


def test_another_timestep_is_refused_and_under_jit_seen():
    bare, m, f, _ = hinge()
    other, d = m.replace(opt=m.opt.replace(timestep=jp.asarray(0.004))), mjx.make_data(bare)
    with pytest.raises(wj.BadInput, match="timestep"):
        wj.mjx.step(other, d, f, f.start())
    assert jp.isnan(jax.jit(wj.mjx.step)(other, d, f, f.start())[0].qvel).all()


GRADIENT = """
import jax
jax.config.update("jax_enable_x64", True)
import sys
sys.path[:0] = {path!r}
import jax.numpy as jp, numpy as np, warmjoint as wj
from mujoco import mjx
from conftest import HINGE, WARM
bare, friction = wj.split(wj.attach(HINGE, {{"hinge": WARM}}))
m = mjx.put_model(bare)
f = wj.mjx.put_friction(friction, m).unrolled()
torque = jp.asarray(9 * np.sin(np.arange(200) * 0.02)[:, None])
def end(coulomb):
    own = f.with_numbers(positive=coulomb, negative=coulomb)
    one = lambda carried, torque: (wj.mjx.step(m, carried[0].replace(qfrc_applied=torque), own, carried[1]), None)
    (d, state), _ = jax.lax.scan(one, (mjx.make_data(bare), f.start()), torque)
    return d.qpos[0] + state.energy[0]
at = f.numbers.positive
gradient = jax.jit(jax.grad(end))(at)
by = 1e-6
run = jax.jit(end)
differences = (run(at + by) - run(at - by)) / (2 * by)
print("gradient", gradient[0], "by differences", differences)
assert abs(gradient[0] - differences) <= 1e-6 * abs(differences) and differences != 0
"""


def test_the_gradient_is_that_of_differences():
    """In double precision, which JAX takes as it starts."""
    done = subprocess.run([sys.executable, "-c", GRADIENT.format(path=[path for path in sys.path if "tests" in path])], capture_output=True, text=True,
                          check=False)
    print(done.stdout)
    assert done.returncode == 0, done.stderr[-2000:]


def test_held_joints_rest_also_under_torques_of_20_ms():
    bare, m, f, _ = hinge()
    torques = (4.0 * jumps(4, 1)).astype(np.float32)

    def run(torques):
        def one(carried, torque):
            after = wj.mjx.step(m, carried[0].replace(qfrc_applied=torque), f, carried[1])
            return after, (after[0].qvel, after[1].held)

        return jax.lax.scan(one, (mjx.make_data(bare), f.start()), jp.repeat(torques, 10, axis=0))[1]

    speed, held = jax.jit(jax.vmap(run, in_axes=1, out_axes=1))(jp.asarray(torques))
    speeds, plugin = np.asarray(speed)[59::10], rests_of_plugin(wj.attach(HINGE, {"hinge": WARM}).spec.compile(), torques)[5:]
    differ = np.abs(speeds - plugin).max()
    print(f"\nheld: constant torque {np.abs(speeds[:, 0]).max():.1e}, 20 ms after a jump {np.abs(speeds[:, 1:]).max():.1e}, "
          f"the plugin {np.abs(plugin[:, 1:]).max():.1e}, apart {differ:.1e} rad/s")
    assert held.all()
    assert np.abs(speeds[:, 0]).max() <= 1e-8
    assert differ <= 1e-8


def test_what_the_port_does_not_step_is_refused():
    attached = wj.attach(HINGE, {"hinge": WARM}, sensors=False)
    bare, friction = wj.split(attached)
    with pytest.raises(wj.BadInput, match="holds plugins"):
        wj.mjx.put_friction(friction, mjx.put_model(attached.spec.compile()))
    bare.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    with pytest.raises(wj.BadInput, match="RK4"):
        wj.mjx.put_friction(friction, mjx.put_model(bare))
