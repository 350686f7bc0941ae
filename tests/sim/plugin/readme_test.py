"""Runs the Python snippets of sim/plugin/README.md one after the other on what `warmjoint attach` writes, in both forms.

readme_test.py ROOT WARMJOINT BUILD: exits 77, with the reason, where MuJoCo's Python cannot be imported."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import mujoco
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ROOT, PROGRAM, BUILD = (pathlib.Path(given).resolve() for given in sys.argv[1:4])
sys.path.insert(0, str(BUILD / "python"))

import warmjoint  # noqa: E402

ROBOT = """
<mujoco>
  <option timestep="0.001" integrator="implicitfast"/>
  <worldbody>
    <body name="arm">
      <joint name="joint1" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.04" mass="3" contype="0" conaffinity="0"/>
      <body pos="0.5 0 0">
        <joint name="joint2" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1" contype="0" conaffinity="0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
FRICTION = {
    "law": "coulomb",
    "parameters": {"coulomb": 2},
    "thermal": {"thermal_gain": -0.2, "thermal_time_constant": 20},
}
ESTIMATE = {
    "status": "ok",
    "parameters": {"coulomb": {"value": 2.0}, "thermal_gain": {"value": -0.2}},
    "covariance": {"parameters": ["coulomb", "thermal_gain"], "matrix": [[0.04, 0.001], [0.001, 0.0004]]},
    "friction": FRICTION,
}


def attach(form):
    command = [PROGRAM, "attach", "robot.xml", "--joint", "joint.*=estimate.json", "--as", form, "--sensors", "--numbers"]
    subprocess.run([*map(str, command), "-o", "runs/warm.xml"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def check_maps():
    """The maps of attributes.md act on a joint that slides through them."""
    page = (ROOT / "sim/plugin/attributes.md").read_text()
    maps = json.loads(re.search(r"```json\n(.*?)```", page, re.DOTALL).group(1))
    torques = []
    for friction in (FRICTION, FRICTION | {"maps": maps}):
        attached = warmjoint.attach(ROBOT, {"joint2": friction})
        model = attached.spec.compile()
        data = mujoco.MjData(model)
        data.qpos[1], data.qvel[1] = 0.5, 1
        mujoco.mj_forward(model, data)
        torques.append(attached.bind(model, data).torque[0])
    # 0.2 of the ripple at 0.5 rad, 0.3 of the stiff place, kernels at their centres and beside them
    assert 0.3 < torques[0] - torques[1] < 0.6, torques


def main():
    readme = (ROOT / "sim/plugin/README.md").read_text()
    snippets = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    assert len(snippets) >= 5, len(snippets)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.mkdir("runs")
        os.symlink(BUILD, "build")
        pathlib.Path("robot.xml").write_text(ROBOT)
        pathlib.Path("estimate.json").write_text(json.dumps(ESTIMATE))
        for form in ("passive", "actuator"):
            attach(form)
            left = {}
            for snippet in snippets:
                exec(snippet.replace('form="passive"', f'form="{form}"'), left)
                if "multivariate" in snippet:
                    # each of the worlds moves by numbers of its own
                    assert len(np.unique(np.array(left["worlds"].qpos)[:, 0])) == 64
                if "rise" in snippet:
                    assert left["held"] in (0, 1) and left["loss"] >= 0 > left["heat"] and left["torque"] != 0
                if "resetData" in snippet and "friction" not in snippet:
                    assert abs(mujoco_heat(left) + 0.5) < 1e-12
            assert left["loss"] >= 0
        check_maps()
    print(f"ran {len(snippets)} snippets in both forms")


def mujoco_heat(left):
    return left["wj"].bind(left["model"], left["data"]).heat[0]


main()
