"""Whether what identify-robot writes for MuJoCo simulates to what it says: identified, simulated with `--mjcf`'s model, identified again.

    robot_round_trip.py PROGRAM PLUGIN ROBOT.xml fourier|moves REALIZATIONS OUT.json

Aim: a second answer, of a log that the first answer's model made, holds the first answer's parameters in 95 % of its intervals and none beyond 4 standard
errors. Data: logs of robot_wrong_inertials; then the model that `--mjcf` wrote, under servos of its own that follow the same motion at steps of 1 ms (Euler),
from cold, with the same noise. The force of a step goes with the state at its start, and damping that Euler takes at the step's end adds half a step of it
to the rotor, which the truth says.
"""

import json
import pathlib
import sys
import tempfile

import mujoco
import numpy as np
import robot_wrong_inertials
from mujoco import rollout
from robot_wrong_inertials import STEP, row, simulate

INNER = .001  # s
STIFFNESS, DAMPING = 20_000.0, 150.0  # of the servos, over the joint's inertia at rest: N.m/rad and N.m.s/rad for each kg.m2
CHUNK = 50_000  # steps


def described(robot, wrong):
    """The robot's MJCF with the inertials of a wrong model."""
    spec = mujoco.MjSpec.from_file(robot)
    model = spec.compile()
    for i in range(1, model.nbody):
        body = spec.body(model.body(i).name)
        body.mass, body.ipos, body.inertia = wrong.body_mass[i], wrong.body_ipos[i], wrong.body_inertia[i]
    spec.compile()
    return spec.to_xml()


def servoed(path):
    """The warm model with servos of its own in place of the robot's, joints that nothing stops, and a sensor of each servo's force."""
    spec = mujoco.MjSpec.from_file(str(path))
    for one in list(spec.actuators):
        if one.name.endswith("_friction"):
            continue
        spec.delete(one)
    for key in list(spec.keys):
        spec.delete(key)
    model = spec.compile()
    full = np.empty((model.nv, model.nv))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mujoco.mj_fullM(model, data, full)
    for joint, inertia in zip(list(spec.joints), np.diag(full), strict=True):
        actuator = spec.add_actuator(name=f"servo_{joint.name}", target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.set_to_position(kp=STIFFNESS * inertia, kv=DAMPING * inertia)
        spec.add_sensor(name=f"force_{joint.name}", type=mujoco.mjtSensor.mjSENS_ACTUATORFRC, objtype=mujoco.mjtObj.mjOBJ_ACTUATOR, objname=actuator.name)
    spec.option.timestep, spec.option.integrator = INNER, mujoco.mjtIntegrator.mjINT_EULER
    model = spec.compile()
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    return model


def between(t, q, at):
    """q of t at other times, by cubics that pass its slopes on: a straight line between samples would shake the servos at the log's own rate."""
    slope = np.gradient(q, STEP, axis=0) * STEP
    i = np.minimum((at / STEP + 1e-9).astype(int), len(t) - 2)
    x = (at / STEP - i)[:, None]
    return ((1 + 2 * x) * (1 - x) ** 2) * q[i] + x * (1 - x) ** 2 * slope[i] + x**2 * (3 - 2 * x) * q[i + 1] + x**2 * (x - 1) * slope[i + 1]


def follow(model, t, q):
    """Positions and servo forces at the steps of t while the servos follow q."""
    data, n = mujoco.MjData(model), q.shape[1]
    data.qpos[:], data.qvel[:] = q[0], (q[1] - q[0]) / STEP
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    every = round(STEP / INNER)
    inner = np.arange(len(t) * every) * INNER
    servos = [i for i in range(model.nu) if model.actuator(i).name.startswith("servo_")]
    positions, forces = [], []
    for i in range(0, len(inner), CHUNK):
        part = inner[i : i + CHUNK]
        control = np.zeros((len(part), model.nu))
        control[:, servos] = between(t, q, part)
        states, sensed = rollout.rollout(model, data, state[None], control[None])
        state = states[0, -1].copy()
        positions.append(states[0, every - 1 :: every, 1 : 1 + n])
        forces.append(sensed[0, ::every])
    # the sensor of a step is that of its start, the state that of its end
    return np.concatenate(positions)[:-1], np.concatenate(forces)[1:]


def identify(program, robot, t, q, torque, folder, *options):
    """The joints of the answer."""
    return robot_wrong_inertials.identify(program, robot, t, q, torque, folder, *options)["joints"]


def compared(first, second, seed):
    """The second answer against the first, a row a parameter."""
    rows = []
    for joint, before in first.items():
        said, after = before["parameters"], second[joint]["parameters"]
        for key, one in after.items():
            truth = 1 if key == "gain" else said[key]["value"] if key in said else None
            if truth is None or not one["interval95"]:
                continue
            if key == "rotor_inertia":
                truth += INNER / 2 * said["viscous"]["value"]
            rows.append(row(seed, joint, "round trip", key, truth, one["value"], one["std"], one["interval95"]))
    return rows


def main():
    program, plugin, robot, kind, count, out = sys.argv[1:]
    mujoco.mj_loadPluginLibrary(plugin)
    motions, rows = {}, []
    for seed in range(1, int(count) + 1):
        t, q, torque, wrong, _ = simulate(robot, kind, seed, motions)
        random = np.random.default_rng(9000 + seed)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "robot.xml").write_text(described(robot, wrong), encoding="utf-8")
            first = identify(program, folder / "robot.xml", t, q, torque, folder, "--mjcf", folder / "warm.xml")
            moved, force = follow(servoed(folder / "warm.xml"), t, q)
            noise = np.where(np.arange(q.shape[1]) < q.shape[1] // 2, .5, .15)
            force = force + noise * random.standard_normal(force.shape)
            second = identify(program, folder / "robot.xml", t[: len(moved)], moved, force, folder)
        rows += compared(first, second, seed)
        held, off = [one["holds"] for one in rows], [abs(one["deviations"]) for one in rows]
        worst = max(rows, key=lambda one: abs(one["deviations"]))
        summary = {"parameters": len(rows), "within their intervals": float(np.mean(held)), "beyond 4 standard errors": sum(one > 4 for one in off), "worst": worst}
        pathlib.Path(out).write_text(json.dumps({"robot": pathlib.Path(robot).stem, "motion": kind, "realizations": seed, **summary, "rows": rows}) + "\n",
                                     encoding="utf-8")
        print(f"{seed} of {count}: {np.mean(held):.3f} of {len(rows)} within, largest {max(off):.2f} ({worst['joint']}, {worst['parameter']})", flush=True)


if __name__ == "__main__":
    main()
