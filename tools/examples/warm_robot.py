"""A joint that warms up in MuJoCo: carried to and fro at 0.5 rad/s or m/s, it prints torque, heat and loss.

    warm_robot.py MODEL JOINT FRICTION MINUTES    (MJCF or URDF; estimate.json or friction file)
"""

import sys

import mujoco
import warmjoint as wj


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    name, minutes = sys.argv[2], float(sys.argv[4])
    robot = wj.attach(sys.argv[1], {name: sys.argv[3]})
    model = robot.spec.compile()
    data = mujoco.MjData(model)
    friction = robot.bind(model, data)
    joint, pose = model.joint(name), data.qpos.copy()

    print("minute   friction, N.m or N   heat, N.m or N   loss, W")
    for step in range(round(60 * minutes / model.opt.timestep) + 2):
        # two seconds in each direction; the other joints stay where they are
        pose[joint.qposadr] = data.qpos[joint.qposadr]
        data.qpos[:], data.qvel[:] = pose, 0
        data.qvel[joint.dofadr] = 0.5 if data.time % 4 < 2 else -0.5
        mujoco.mj_step(model, data)
        if step % round(60 / model.opt.timestep) == 1:
            print(f"{data.time / 60:6.0f} {abs(friction[name].torque):20.3f} {friction[name].heat:16.3f} {friction[name].loss:9.2f}")

    # no need to wait: 0 is cold, 1 settled at this speed, "end" as at the end of the estimate's log
    friction.reset(warm=1, speed=0.5)
    print(f"settled at {friction[name].heat:.3f}")


main()
