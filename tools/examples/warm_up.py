#!/usr/bin/env python3
"""A joint with friction of warmjoint in MuJoCo's Python: carried to and fro, it warms up, and its friction is printed.

    warm_up.py MODEL JOINT [MINUTES [SPEED]]

MODEL: what `warmjoint attach ... -o MODEL` wrote, in either form. SPEED: rad/s or m/s. Takes MuJoCo and NumPy from
Python where they are installed, else those in build/deps.
"""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
try:
    import mujoco
except ImportError:
    sys.path += [str(ROOT / "build/deps/mujoco"), str(ROOT / "build/deps/python")]
    import mujoco

HOLD = 2  # s in each direction


def main():
    if not 3 <= len(sys.argv) <= 5:
        sys.exit(__doc__)
    minutes = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    speed = float(sys.argv[4]) if len(sys.argv) > 4 else 0.5

    # the plugin of this MuJoCo is loaded once, before the model
    plugins = ROOT / "build/plugins"
    plugin = plugins / mujoco.__version__ / "libwarmjoint_friction.so"
    if not plugin.exists():
        built = " and ".join(sorted(folder.name for folder in plugins.iterdir()))
        sys.exit(f"error: this Python has MuJoCo {mujoco.__version__}; {plugins} holds the plugin for {built}")
    mujoco.mj_loadPluginLibrary(str(plugin))
    model = mujoco.MjModel.from_xml_path(sys.argv[1])
    data = mujoco.MjData(model)
    joint = model.joint(sys.argv[2])
    dof, at = joint.dofadr[0], joint.qposadr[0]
    actuators = {model.actuator(i).name for i in range(model.nactuator)}
    friction = sys.argv[2] + "_friction"
    pose = data.qpos.copy()

    def slide(seconds):
        """Carries the joint to and fro, the others at rest; the mean friction while it goes forwards, N.m or N."""
        forces = []
        for _ in range(round(seconds / model.opt.timestep)):
            since = data.time % (2 * HOLD)
            pose[at] = data.qpos[at]
            data.qpos[:], data.qvel[:] = pose, 0
            data.qvel[dof] = speed if since < HOLD else -speed
            mujoco.mj_step(model, data)
            if HOLD / 2 < since < HOLD:
                # in the passive form among the joint's passive forces
                force = data.actuator(friction).force[0] if friction in actuators else data.qfrc_passive[dof]
                forces.append(-force)
        return sum(forces) / len(forces)

    print("minutes of motion   friction forwards, N.m or N")
    print(f"{0:17d}   {slide(2 * HOLD):.2f}")
    for minute in range(1, minutes + 1):
        slide(60 - 4 * HOLD if minute == 1 else 60 - 2 * HOLD)
        print(f"{minute:17d}   {slide(2 * HOLD):.2f}")


main()
