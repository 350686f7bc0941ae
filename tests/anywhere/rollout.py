"""Rolls the model out with the plugin, from Python: rollout.py PLUGIN MODEL OUT, as rollout.cc does."""
import sys

import mujoco

mujoco.mj_loadPluginLibrary(sys.argv[1])
model = mujoco.MjModel.from_xml_path(sys.argv[2])
data = mujoco.MjData(model)
with open(sys.argv[3], "wb") as out:
    for step in range(20000):
        data.ctrl[0] = 9 if step // 2500 % 2 == 0 else -9  # N.m, reversed every 2.5 s
        mujoco.mj_step(model, data)
        out.write(data.qpos.tobytes() + data.qvel.tobytes() + data.act.tobytes())
