"""The forms in which friction runs in MuJoCo, beside each other on five arms and a humanoid: creep of what is held, cost of a step, and the springs
of `native` beside the plugin over minutes of motion with heat.

    forms.py ROBOTS [held|cost|warm|humanoid] [SECONDS]     ROBOTS: the folder shared/robots; SECONDS of `warm`, 600 by default

Prints a table in Markdown. `held` and `cost` measure the forms whose engines this Python has: mujoco_warp with MuJoCo 4.0, MJX with 3.17; both on a CPU.
`humanoid`: what friction adds to a step of mujoco_warp on 29 joints in one tree, with 64 and 1024 worlds, and how many kernels a step launches; on a GPU,
as a captured graph, where Warp finds one.
Arms have an armature of .1 kg.m^2 (YuMi's .05) and steps of 1 ms in implicitfast, no stops, no contacts.
"""

import functools
import pathlib
import sys
import time

import mujoco
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))

import friction_worlds
import warmjoint as wj

ARMS = {"UR5e": ("universal_robots_ur5e/ur5e_nomesh.xml", 0.1), "Panda": ("franka_emika_panda/panda_nohand_nomesh.xml", 0.1),
        "iiwa 14": ("kuka_iiwa_14/iiwa14_nomesh.xml", 0.1), "YuMi": ("abb_yumi/yumi_nomesh.urdf", 0.05),
        "IRB 140": ("abb_irb140_drake/irb140_inertial_com_shifted.urdf", 0.1)}
STEP = 1e-3


def bare_spec(folder, name):
    """A robot without drives, friction, stops and contacts; the humanoid floats without gravity."""
    if name.startswith("humanoid"):
        spec = mujoco.MjSpec.from_string(friction_worlds.humanoid(friction_worlds.MORE_LIMBS if name == "humanoid of 29" else friction_worlds.LIMBS))
        spec.option.gravity = [0, 0, 0]
    else:
        path, armature = ARMS[name]
        spec = mujoco.MjSpec.from_file(str(folder / path))
        for joint in spec.joints:
            joint.armature = armature
    for kind in ("actuators", "keys"):
        for one in list(getattr(spec, kind)):
            spec.delete(one)
    for geom in spec.geoms:
        geom.contype = geom.conaffinity = 0
    spec.option.timestep, spec.option.integrator = STEP, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    for joint in spec.joints:
        joint.frictionloss, joint.limited = 0, mujoco.mjtLimited.mjLIMITED_FALSE
        joint.damping = [0] * len(np.atleast_1d(joint.damping)) if np.ndim(joint.damping) else 0
    return spec


class Robot:
    """A robot with a level of 1.5 times its load and 2 N.m for each joint, and of that a third of a second as viscous (1.1 s/m of a slide)."""

    def __init__(self, folder, name, gain=0.0, tau=200.0):
        self.name, self.spec = name, bare_spec(folder, name)
        self.model = self.spec.copy().compile()
        data = mujoco.MjData(self.model)
        kinds = mujoco.mjtJoint
        hinges = [joint for joint in range(self.model.njnt) if int(self.model.jnt_type[joint]) in (int(kinds.mjJNT_HINGE), int(kinds.mjJNT_SLIDE))]
        # slides are fingers of some centimetres
        self.reach = np.where(self.model.jnt_type[hinges] == kinds.mjJNT_SLIDE, 0.02, 0.8)
        self.joints = [self.model.joint(one).name for one in hinges]
        self.dofs, self.places = self.model.jnt_dofadr[hinges], self.model.jnt_qposadr[hinges]
        self.pose = data.qpos.copy()
        self.pose[self.places] = 0.5 * self.reach * (-1) ** np.arange(len(hinges))
        data.qpos[:] = self.pose
        mujoco.mj_forward(self.model, data)
        self.level = 2 + 1.5 * np.abs(data.qfrc_bias[self.dofs])
        self.viscous = self.level * np.where(self.reach < 0.1, 1.1, 1 / 3)
        # of a third of the level where nothing else pulls
        self.torque = np.zeros(self.model.nv)
        self.torque[self.dofs] = 0.3 * self.level * (-1) ** np.arange(len(hinges))
        self.frictions = {joint: wj.Friction("viscous_coulomb", viscous=viscous, coulomb=level, thermal_gain=gain, thermal_time_constant=tau)
                          for joint, level, viscous in zip(self.joints, self.level, self.viscous)}


class Stepped:
    """A form of one robot: MuJoCo steps a compiled model."""

    def __init__(self, robot, model, start=None):
        self.model, self.data, self.start = model, mujoco.MjData(model), start
        self.robot = robot
        self.reset()

    def reset(self):
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:] = self.robot.pose
        if self.start:
            self.start(self.data)

    def steps(self, torque, count):
        self.data.qfrc_applied[:] = torque
        mujoco.mj_step(self.model, self.data, count)

    @property
    def places(self):
        return self.data.qpos[self.robot.places].copy()


def plugin(robot, form):
    return Stepped(robot, wj.attach(robot.spec.copy(), robot.frictions, form, sensors=False, randomisable=False).spec.compile())


def frictionloss(robot, noslip=0):
    spec = robot.spec.copy()
    spec.option.noslip_iterations = noslip
    for joint, level, viscous in zip(robot.joints, robot.level, robot.viscous):
        one = spec.joint(joint)
        one.frictionloss, one.damping = level, [viscous, 0, 0] if np.ndim(one.damping) else viscous
    return Stepped(robot, spec.compile())


def springs(robot):
    native = wj.native(robot.spec.copy(), robot.frictions)
    return Stepped(robot, native.model, native.start)


class Driven(Stepped):
    """Springs, with the driver after each step."""

    def __init__(self, robot):
        self.native = wj.native(robot.spec.copy(), robot.frictions)
        super().__init__(robot, self.native.model, self.native.start)

    def steps(self, torque, count):
        self.data.qfrc_applied[:] = torque
        self.native.step(self.data, count)


class InWarp:
    """Worlds of mujoco_warp. form: bare, plugin's port, or springs."""

    def __init__(self, robot, form, nworld):
        import mujoco_warp as mjw
        import warp as wp

        wp.config.quiet = True
        self.engine, self.robot, self.form, self.driver = mjw, robot, form, None
        model, native = robot.spec.copy().compile(), None
        if form == "port":
            model, friction = wj.split(wj.attach(robot.spec.copy(), robot.frictions, sensors=False))
        elif form == "native":
            native = wj.native(robot.spec.copy(), robot.frictions)
            model = native.model
        data = mujoco.MjData(model)
        data.qpos[:] = robot.pose
        if native:
            native.start(data)
        mujoco.mj_forward(model, data)
        self.m, self.d = mjw.put_model(model), mjw.put_data(model, data, nworld=nworld)
        if form == "port":
            wj.warp.put_friction(friction, self.m, nworld)
        self.driver = native

    def steps(self, torque, count):
        self.d.qfrc_applied.assign(np.tile(torque, (self.d.qvel.shape[0], 1)).astype(np.float32))
        for _ in range(count):
            self.engine.step(self.m, self.d)
            if self.driver:
                self.driver.update(self.m, self.d)

    @property
    def places(self):
        return self.d.qpos.numpy()[0, self.robot.places].astype(float)


class InMjx:
    """Worlds of MJX, one step compiled at a time."""

    def __init__(self, robot, form, nworld):
        import jax
        import jax.numpy as jp
        from mujoco import mjx

        self.jax, self.jp, self.robot = jax, jp, robot
        bare, friction = wj.split(wj.attach(robot.spec.copy(), robot.frictions, sensors=False))
        m = mjx.put_model(bare if form == "port" else robot.spec.copy().compile(), impl="jax")
        f = wj.mjx.put_friction(friction, mjx.put_model(bare, impl="jax"))
        data = mjx.make_data(bare).replace(qpos=jp.asarray(robot.pose))
        self.d = jax.vmap(lambda _: data)(jp.arange(nworld))
        self.state = f.start(nworld=nworld)

        def step(d, state):
            return wj.mjx.step(m, d, f, state) if form == "port" else (mjx.step(m, d), state)

        def run(d, state, count):
            return jax.lax.fori_loop(0, count, lambda _, both: jax.vmap(step)(*both), (d, state))

        self.run = jax.jit(run)

    def steps(self, torque, count):
        self.d = self.d.replace(qfrc_applied=self.jp.tile(self.jp.asarray(torque), (self.d.qvel.shape[0], 1)))
        self.d, self.state = self.jax.block_until_ready(self.run(self.d, self.state, count))

    @property
    def places(self):
        return np.asarray(self.d.qpos)[0, self.robot.places].astype(float)


class Humanoids(InWarp):
    """Worlds of 29 joints, of which random torques hold some and move some; a graph on a GPU."""

    def __init__(self, robot, form, nworld):
        super().__init__(robot, form, nworld)
        self.random, self.graph, self.at = np.random.default_rng(0), None, 0.0

    def launches(self):
        """Of kernels in a step."""
        import warp as wp

        count, real = 0, (wp.launch, wp.launch_tiled)

        def counting(launch):
            def one(*arguments, **named):
                nonlocal count
                count += 1
                return launch(*arguments, **named)

            return one

        wp.launch, wp.launch_tiled = map(counting, real)
        try:
            super().steps(self.robot.torque, 1)
        finally:
            wp.launch, wp.launch_tiled = real
        return count

    def capture(self):
        import warp as wp

        if self.d.qvel.device.is_cuda:
            with wp.ScopedCapture() as found:
                self.engine.step(self.m, self.d)
            self.graph = found.graph

    def torques(self, drive):
        """[worlds x nv] Of up to twice the level: drawn anew each 20 ms, or sines of 0.3 to 1 Hz."""
        found, shape = np.zeros(self.d.qvel.shape, np.float32), (len(self.d.qvel), len(self.robot.dofs))
        if drive == "jumps":
            share = self.random.uniform(-2, 2, shape)
        else:
            waves = np.random.default_rng(1)
            self.at += 0.02
            share = 2 * np.sin(2 * np.pi * waves.uniform(0.3, 1, shape) * self.at + waves.uniform(0, 6, shape))
        found[:, self.robot.dofs] = self.robot.level * share
        return found

    def timed(self, drive, count):
        """Seconds a step: of the processor, or of the clock for a GPU."""
        import warp as wp

        self.d.qfrc_applied.assign(self.torques(drive))
        wp.synchronize()
        clock = time.perf_counter if self.graph else time.process_time
        begin = clock()
        for _ in range(count):
            if self.graph:
                wp.capture_launch(self.graph)
            else:
                self.engine.step(self.m, self.d)
        wp.synchronize()
        return (clock() - begin) / count


def humanoids(folder, rounds=30):
    """Friction in mujoco_warp beside the same robot without, 20 ms of each in turns."""
    print("| worlds | device | torques | step over that without friction | without, us a world | launches | without | held | turns |")
    print("|---|---|---|---|---|---|---|---|---|")
    robot = Robot(folder, "humanoid of 29")
    for nworld in (64, 1024):
        port, bare = made = [Humanoids(robot, form, nworld) for form in ("port", "bare")]
        launches = [one.launches() for one in made]
        for one in made:
            one.capture()
        for drive in ("swing", "jumps"):
            count = round(0.02 / STEP)
            pairs = np.array([[one.timed(drive, count) for one in made] for _ in range(rounds)])
            friction = port.m.callback.passive
            print(f"| {nworld} | {bare.d.qvel.device} | {drive} | {np.median(pairs[:, 0] / pairs[:, 1]):.2f} | {1e6 * np.median(pairs[:, 1]) / nworld:.0f} "
                  f"| {launches[0]} | {launches[1]} | {friction.held.numpy().mean():.2f} | {friction.turns.numpy().mean():.2f} |", flush=True)


def has(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True


def forms(robot):
    """What this Python runs: {name: how it is made}."""
    found = {"actuator": functools.partial(plugin, robot, "actuator"), "passive": functools.partial(plugin, robot, "passive"),
             "frictionloss (export --to mjcf)": functools.partial(frictionloss, robot),
             "frictionloss, noslip 20": functools.partial(frictionloss, robot, 20)}
    if int(mujoco.__version__.split(".")[0]) >= 4:
        found["native"] = functools.partial(springs, robot)
    return found


def batches(robot, nworld):
    found = {}
    if has("mujoco_warp"):
        found["Warp: port"] = (functools.partial(InWarp, robot, "port", nworld), functools.partial(InWarp, robot, "bare", nworld))
        found["Warp: native"] = (functools.partial(InWarp, robot, "native", nworld), functools.partial(InWarp, robot, "bare", nworld))
    if has("jax"):
        found["MJX: port"] = (functools.partial(InMjx, robot, "port", nworld), functools.partial(InMjx, robot, "bare", nworld))
    return found


def creep(made, robot, seconds=4):
    """rad/min of the worst joint over the second half of some seconds under a load below its level."""
    count = round(seconds / STEP)
    made.steps(robot.torque, count // 2)
    before = made.places
    made.steps(robot.torque, count // 2)
    return np.abs(made.places - before).max() * 60 / (seconds / 2)


def per_step(made, robot, count, rounds):
    """Seconds of the processor a step in each of some rounds, in which the joints are pushed to and fro."""
    taken = []
    for _ in range(rounds):
        begin = time.process_time()
        for k in range(4):
            made.steps((3 if k % 2 else -3) * robot.torque, count)
        taken.append((time.process_time() - begin) / (4 * count))
    return np.array(taken)


def ratio(form, bare, robot, count=250, rounds=15):
    """The median of the cost of a step over that without friction, measured in turns."""
    both = np.array([[per_step(one, robot, count, 1)[0] for one in (form, bare)] for _ in range(rounds)])
    return float(np.median(both[:, 0]) / np.median(both[:, 1]))


def warm(folder, name, seconds):
    """Native beside the plugin under the same servos: arcs of sines for 14 s of each 20, then rest. Prints heat, positions and the held joints."""
    robot = Robot(folder, name, gain=-0.3)
    attached = wj.attach(robot.spec.copy(), robot.frictions)
    model = attached.spec.compile()
    data, native = mujoco.MjData(model), wj.native(robot.spec.copy(), robot.frictions)
    bound, other = attached.bind(model, data), mujoco.MjData(native.model)
    places, dofs, number = robot.places, robot.dofs, np.arange(len(robot.dofs))
    frequency, stiff = 0.1 + 0.2 * number / len(number), 18 * robot.level
    data.qpos[:] = other.qpos[:] = robot.pose
    native.start(other)
    apart, held, at_rest = 0.0, [], None
    for step in range(round(seconds / STEP)):
        at = step * STEP
        moved, phase = divmod(at, 20)
        # the last second of the motion slows down to rest
        travelled = 14 * moved + (phase if phase < 13 else 13 + min(phase - 13, 2) * (1 - min(phase - 13, 2) / 4))
        wanted = robot.pose[places] + robot.reach * (np.sin(2 * np.pi * frequency * travelled + number) - np.sin(number))
        for one in (data, other):
            servo = stiff * (wanted - one.qpos[places]) - stiff / 30 * one.qvel[dofs]
            one.qfrc_applied[dofs] = one.qfrc_bias[dofs] + servo
        mujoco.mj_step(model, data)
        native.step(other)
        if step % 50 == 0:
            apart = max(apart, np.abs(data.qpos[places] - other.qpos[places]).max())
        if abs(phase - 17) < STEP / 2:
            at_rest = [one.qpos[places].copy() for one in (data, other)]
        if at_rest is not None and phase > 20 - 1.5 * STEP:
            held.append([np.abs(one.qpos[places] - before).max() * 20 for one, before in zip((data, other), at_rest)])
            at_rest = None
    heat, ours = bound.heat, native.heat
    share = np.abs(heat / robot.level).max()
    # of joints that warm: fingers of some centimetres lose 1e-5 of their level
    warms = np.abs(heat) > 0.01 * robot.level
    creeps = np.max(held, axis=0) if held else np.full(2, np.nan)
    print(f"| {name} | {share:.2f} | {100 * np.abs(ours / heat - 1)[warms].max():.3f} % | {apart:.1e} | {creeps[0]:.0e} | {creeps[1]:.0e} |", flush=True)


def main(folder, what="held", seconds="600"):
    names = [*ARMS, "humanoid"]
    if what == "warm":
        print("| robot | heat over level | E apart | positions apart rad | held rad/min: plugin | native |\n|---|---|---|---|---|---|")
        for name in names[:-1]:
            warm(pathlib.Path(folder), name, float(seconds))
        return
    if what == "humanoid":
        humanoids(pathlib.Path(folder))
        return
    rows = {}
    for name in names:
        robot = Robot(pathlib.Path(folder), name)
        made = {form: make() for form, make in forms(robot).items()}
        if what == "held":
            for form, one in made.items():
                rows.setdefault(form, []).append(f"{creep(one, robot):.0e}")
            for form, (make, _) in batches(robot, 1).items():
                rows.setdefault(form, []).append(f"{creep(make(), robot):.0e}")
            continue
        bare = Stepped(robot, robot.model)
        if "native" in made:
            made["native, driven"] = Driven(robot)
        for form, one in made.items():
            rows.setdefault(form, []).append(f"{ratio(one, bare, robot):.2f}")
        for form, (make, without) in batches(robot, 64).items():
            rows.setdefault(form, []).append(f"{ratio(make(), without(), robot, 10, 7):.2f}")
    print(f"| {'creep rad/min' if what == 'held' else 'step over that without friction'} | {' | '.join(names)} |\n|{'---|' * (len(names) + 1)}")
    for form, values in rows.items():
        print(f"| {form} | {' | '.join(values)} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
