#!/usr/bin/env python3
"""A joint with friction of warmjoint in MuJoCo's Python: moves it to and fro and prints its friction as it warms up.

    warm_up.py MODEL JOINT [MINUTES [SPEED]]

MODEL: what `warmjoint attach ... -o MODEL` wrote, actuator form. SPEED: rad/s or m/s. Takes MuJoCo 4.0.0 and NumPy from
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

    # the plugin is loaded once, before the model
    mujoco.mj_loadPluginLibrary(str(ROOT / "build/libwarmjoint_friction.so"))
    model = mujoco.MjModel.from_xml_path(sys.argv[1])
    data = mujoco.MjData(model)
    dof = model.joint(sys.argv[2]).dofadr[0]
    friction = data.actuator(sys.argv[2] + "_friction")
    inertia = 1 / model.dof_invweight0[dof]  # kg.m^2 or kg

    def slide(seconds):
        """Moves the joint to and fro; the mean friction while it slides forwards, N.m or N."""
        forces = []
        for _ in range(round(seconds / model.opt.timestep)):
            # a stiff controller of the speed: friction is what it has to overcome
            wanted = speed if data.time % (2 * HOLD) < HOLD else -speed
            error = wanted - data.qvel[dof]
            data.qfrc_applied[dof] = 200 * inertia * error - friction.force[0]
            mujoco.mj_step(model, data)
            if wanted > 0 and abs(error) < 0.01 * speed:
                forces.append(-friction.force[0])
        return sum(forces) / len(forces)

    print("minutes of motion   friction forwards, N.m or N")
    print(f"{0:17d}   {slide(2 * HOLD):.2f}")
    for minute in range(1, minutes + 1):
        slide(60 - 4 * HOLD if minute == 1 else 60 - 2 * HOLD)
        print(f"{minute:17d}   {slide(2 * HOLD):.2f}")


main()
