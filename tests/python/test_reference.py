"""The plugin against the friction of a step in numpy."""

import gc
import subprocess
import sys

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


@pytest.mark.parametrize("form", ["passive", "actuator"])
def test_what_split_leaves_names_no_plugin_and_loads_where_there_is_none(form, tmp_path):
    robot_with = attached(form=form)
    bare, friction = wj.split(robot_with)
    # the same of a spec, of its text and of a file
    (tmp_path / "warm.xml").write_text(robot_with.xml)
    for given in (robot_with.spec, robot_with.xml, tmp_path / "warm.xml"):
        again, of = wj.split(given)
        assert of.joints == friction.joints and (again.dof_damping == bare.dof_damping).all() and again.npluginstate == 0
    spec, of = wj.split(robot_with, spec=True)
    assert of.joints == friction.joints and not [body for body in spec.bodies if body.plugin.active or body.plugin.name]
    (tmp_path / "bare.xml").write_text(spec.to_xml())
    model = spec.compile()
    assert (model.dof_damping == bare.dof_damping).all() and (model.nplugin, model.nu, model.nsensor) == (0, 0, 0)
    code = f"import mujoco; print(mujoco.MjModel.from_xml_path({str(tmp_path / 'bare.xml')!r}).nv)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert int(done.stdout) == bare.nv


def test_a_copied_spec_from_which_friction_was_taken_can_be_read_and_takes_friction_again():
    spec = attached().spec.copy()
    mujoco_plugin.remove_from_spec(spec)
    gc.collect()
    assert [body.plugin.name for body in spec.bodies] == len(spec.bodies) * [""]
    again = wj.attach(spec, worlds.frictions(spec, "stribeck"))
    assert len(mujoco_plugin.joints_of(again.spec.compile())) == len(again.joints)


def test_of_a_scene_with_meshes_in_several_folders_split_gives_the_model_and_no_spec(tmp_path):
    specs = []
    for name, size in (("a", 0.1), ("b", 0.2)):
        (tmp_path / name).mkdir()
        corners = size * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        (tmp_path / name / "mesh.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {i + 1} {j + 1} {k + 1}\n" for i, j, k in faces))
        (tmp_path / name / "robot.xml").write_text(
            f'<mujoco model="{name}"><compiler meshdir="."/><asset><mesh name="m" file="mesh.obj"/></asset><worldbody><body>'
            f'<joint name="{name}" armature=".1"/><geom type="mesh" mesh="m" mass="1"/></body></worldbody></mujoco>')
        specs.append(mujoco.MjSpec.from_file(str(tmp_path / name / "robot.xml")))
    # of one folder it is found from anywhere
    law = worlds.friction("coulomb", 0.1)
    assert wj.split(wj.attach(specs[0].copy(), {"a": law}), spec=True)[0].compile().nmesh == 1
    specs[0].attach(specs[1], prefix="b_", frame=specs[0].worldbody.add_frame())
    scene = wj.attach(specs[0], {"a": law})
    assert wj.split(scene)[0].nmesh == 2
    with pytest.raises(wj.BadInput, match="several folders"):
        wj.split(scene, spec=True)


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
