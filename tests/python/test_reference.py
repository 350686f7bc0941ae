"""The plugin against the friction of a step in numpy."""

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco")

import friction_worlds as worlds  # noqa: E402
import warmjoint as wj  # noqa: E402
from warmjoint import mujoco_plugin, reference  # noqa: E402


def state_of(plugin, model, data):
    """What the plugin's states say of each joint."""
    joints = mujoco_plugin.joints_of(model)
    state = {name: np.zeros(len(joints)) for name in ("bristle load", "energy", "second energy", "slip")}
    for i, joint in enumerate(joints):
        for k, name in enumerate(joint["states"]):
            state[name][i] = data.plugin_state[joint["state"] + k]
    return reference.State(state["bristle load"], np.array([state["energy"], state["second energy"]]), state["slip"])


@pytest.mark.parametrize("robot", worlds.ROBOTS)
@pytest.mark.parametrize("law", [*worlds.LAWS, "everything"])
def test_the_plugin_moves_as_the_reference(robot, law):
    """Restarted from the plugin's state each .1 s, over .4 s of sticking and slipping. What a step leaves in the speed of a joint is h/m of what
    is wrong with its force."""
    spec = worlds.bare_spec(robot)
    level = worlds.levels(spec)
    robot_with = wj.attach(spec, worlds.frictions(spec, law))
    bare, friction = wj.split(robot_with)
    model = robot_with.spec.compile()
    data, ours = mujoco.MjData(model), mujoco.MjData(bare)
    torques = worlds.Torques(model, friction.joints, level)
    rise = 7.0 if law == "everything" else 0.0
    data.plugin_state[model.plugin_stateadr[0] + 2] = rise

    sensed = robot_with.bind(model, data)
    worst, held = 0.0, 0
    for step in range(200):
        if step % 50 == 0:
            ours.qpos[:], ours.qvel[:], ours.time = data.qpos, data.qvel, data.time
            ours.qacc_warmstart[:] = data.qacc_warmstart
            state = state_of(sensed, model, data)
        data.qfrc_applied[:] = ours.qfrc_applied[:] = torques.at(data.time)
        mujoco.mj_step(model, data)
        stepped, state = reference.advance(bare, ours, friction, state, rise)
        per_force = friction.timestep / friction.inertia
        pairs = ((data.qpos, ours.qpos), (data.qvel, ours.qvel), (-per_force * sensed.torque, per_force * stepped.force),
                 (sensed.loss, stepped.loss), (sensed.heat, state.energy.sum(axis=0)))
        worst = max(worst, *(np.abs(one - other).max() for one, other in pairs))
        assert (stepped.held == sensed.held).all()
        held += stepped.held.sum()
    assert 0 < held < 200 * len(friction.joints)
    assert worst <= 1e-12


def attached(law="stribeck", **options):
    spec = mujoco.MjSpec.from_string(worlds.humanoid())
    return wj.attach(spec, worlds.frictions(spec, law), **options)


@pytest.mark.parametrize("form", ["passive", "actuator"])
def test_a_model_without_its_plugin(form):
    robot = attached(form=form)
    text = robot.xml
    bare, friction = wj.split(robot)
    model = robot.spec.compile()
    assert robot.xml == text
    assert (bare.nplugin, bare.nsensor, bare.nu, bare.nnumeric) == (0, 0, 0, 0)
    assert (bare.dof_damping == model.dof_damping).all()
    assert list(friction.joints) == robot.joints
    np.testing.assert_allclose(friction.numbers["static"], 1.25 * friction.numbers["coulomb"])


def test_what_arrays_cannot_hold_is_refused_by_name():
    spec = mujoco.MjSpec.from_string(worlds.humanoid())
    dahl = wj.Friction("dahl", coulomb=0.5, bristle_stiffness=50)
    with pytest.raises(wj.BadInput, match="'leg_l0': the law dahl"):
        wj.split(wj.attach(spec, {"leg_l0": dahl}))
    with pytest.raises(wj.BadInput, match="compiled model"):
        wj.split(attached().spec.compile())
    with pytest.raises(wj.BadInput, match="no joint"):
        wj.split(worlds.humanoid())


def test_numbers_that_change_keep_their_bounds():
    _, friction = wj.split(attached())
    joints = len(friction.joints)
    changed = friction.changed(coulomb=np.linspace(0.5, 1, 3)[:, None] * friction.numbers["coulomb"], thermal_gain=0.0)
    assert changed.worlds == 3
    assert changed.numbers["coulomb"].shape == (3, joints)
    for numbers, words in (({"coulomb": -1.0}, "coulomb"), ({"static": 0.0}, "static"), ({"viscous": 1.0}, "dof_damping"), ({"culomb": 1.0}, "culomb"),
                           ({"coulomb": np.zeros(2)}, "shape"), ({"static": 1e6}, "give way"),
                           ({"coulomb": np.ones((2, joints)) * 1e-3, "static": np.ones((3, joints))}, "2 and 3 worlds")):
        with pytest.raises(wj.BadInput, match=words):
            friction.changed(**numbers)
