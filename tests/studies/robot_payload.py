"""What identify-robot says of a load that the description lacks, on logs of a robot whose description is wrong by a tenth besides.

    robot_payload.py PROGRAM ROBOT.xml LOGS OUT.json [MASS]...

Data: robot_wrong_inertials.py's, ten minutes of sines each, with a point of MASS kg (0, 3 and 5 by default) .1 m off the last link's axis. Asked by
--tool unknown. Prints for each mass how many logs show a load, the mean of its mass, intervals that hold and their mean half width.
"""

import json
import pathlib
import sys
import tempfile

import mujoco
import numpy as np
import robot_wrong_inertials as wrong_inertials

SECONDS = 600


def add_point(model, mass, place):
    """Adds a point of some mass to the last body."""
    last = model.nbody - 1
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, model.body_iquat[last])
    rotation = rotation.reshape(3, 3)
    inertia = rotation @ np.diag(model.body_inertia[last]) @ rotation.T
    own, centre = model.body_mass[last], model.body_ipos[last].copy()
    total = own + mass
    new = (own * centre + mass * place) / total

    def about(m, arm):
        return m * (arm @ arm * np.eye(3) - np.outer(arm, arm))

    values, axes = np.linalg.eigh(inertia + about(own, centre - new) + about(mass, place - new))
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, axes.flatten())
    model.body_mass[last], model.body_ipos[last], model.body_inertia[last], model.body_iquat[last] = total, new, values, quat


def simulate(robot, mass, seed):
    """Positions and torques of the robot with its load, and the description."""
    n = wrong_inertials.passive(robot).nv
    t, q, v, acc = wrong_inertials.motion("fourier", seed, n)
    used = t < SECONDS
    t, q, v, acc = t[used], q[used], v[used], acc[used]
    true = wrong_inertials.passive(robot)
    axis = true.jnt_axis[true.body_jntadr[true.nbody - 1]]
    across = np.cross(axis, [1, 0, 0] if abs(axis[0]) < .9 else [0, 1, 0])
    if mass > 0:
        add_point(true, mass, .1 * across / np.linalg.norm(across))
    torque, wrong, _ = wrong_inertials.measured(robot, seed, v, acc, *wrong_inertials.torques(true, q, v, acc))
    return t, q, torque, wrong


def main():
    program, robot, logs, out, *masses = sys.argv[1:]
    rows = []
    for mass in [float(one) for one in masses] or [0.0, 3.0, 5.0]:
        for seed in range(1, int(logs) + 1):
            t, q, torque, wrong = simulate(robot, mass, seed)
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                mujoco.mj_saveModel(wrong, str(folder / "robot.mjb"))
                answer = wrong_inertials.identify(program, folder / "robot.mjb", t, q, torque, folder, "--tool", "unknown")
            payload, notices = answer["payload"], answer["notices"]
            rows.append({"mass": mass, "seed": seed, "shown": any("shows a load" in one for one in notices), "value": payload["value"], "std": payload["std"],
                         "interval95": payload["interval95"]})
            pathlib.Path(out).write_text(json.dumps(rows) + "\n", encoding="utf-8")
        these = [one for one in rows if one["mass"] == mass]
        ends = np.array([one["interval95"] for one in these])
        held = np.sum((ends[:, 0] <= mass) & (mass <= ends[:, 1]))
        values, stds = np.array([[one["value"], one["std"]] for one in these]).T
        print(f"{mass:g} kg: {sum(one['shown'] for one in these)} of {len(these)} shown, mean {values.mean():.2f} kg, {held} hold, "
              f"half width {(ends[:, 1] - ends[:, 0]).mean() / 2:.2f} kg, rms over deviation {np.sqrt(np.mean(((values - mass) / stds) ** 2)):.2f}", flush=True)


if __name__ == "__main__":
    main()
