"""64 worlds, each with friction and warmth of its own: how far a joint coasts from 2 rad/s or m/s.

    worlds.py MODEL JOINT FRICTION    (MJCF or URDF; estimate.json or friction file; MuJoCo 3.17 or later)
"""

import sys

import mujoco
import numpy as np
import warmjoint as wj
from mujoco import batch


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    robot = wj.attach(sys.argv[1], {sys.argv[2]: sys.argv[3]})
    model = robot.spec.compile()
    joint = model.joint(sys.argv[2])
    worlds = batch.Batch(model, nsim=64)

    # a factor on each world's gain, and its warmth: 0 cold, 1 settled at 0.5 rad/s or m/s
    friction = robot.bind(model, mujoco.MjData(model))
    drawn = friction.randomise(worlds, thermal_gain=(0.7, 1.3), warm=(0, 1), speed=0.5, rng=0)

    worlds.bind("qvel")[:, joint.dofadr] = 2
    worlds.step(nstep=round(1 / model.opt.timestep))

    distances = worlds.bind("qpos")[:, joint.qposadr[0]]
    order = np.argsort(drawn["warm"][:, 0])
    print("warm   coasts, rad or m")
    for world in order[::9]:
        print(f"{drawn['warm'][world, 0]:4.2f} {distances[world]:18.4f}")


main()
