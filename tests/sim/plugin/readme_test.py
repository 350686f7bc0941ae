"""Runs the Python snippets of sim/plugin/README.md one after the other and checks what they leave.

readme_test.py README PLUGIN: exits 77, with the reason, where MuJoCo's Python cannot be imported."""

import json
import os
import pathlib
import re
import sys
import tempfile

try:
    import mujoco
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ROBOT = """
<mujoco>
  <extension>
    <plugin plugin="warmjoint.friction">
      <instance name="friction">
        <config key="instance" value="friction"/>
        <config key="joints" value='{"shoulder": {"law": "coulomb", "parameters": {"coulomb": 6},
            "thermal": {"thermal_gain": -0.3, "thermal_time_constant": 20}},
          "elbow": {"law": "coulomb", "parameters": {"coulomb": 2},
            "thermal": {"thermal_gain": -0.1, "thermal_time_constant": 20}}}'/>
      </instance>
    </plugin>
  </extension>
  <option timestep="0.001" integrator="implicitfast"/>
  <custom>
    <numeric name="friction/coulomb" size="2" data="6 2"/>
    <numeric name="friction/thermal_gain" size="2" data="-0.3 -0.1"/>
  </custom>
  <worldbody>
    <body name="arm">
      <plugin plugin="warmjoint.friction" instance="friction"/>
      <joint name="shoulder" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.04" mass="3" contype="0" conaffinity="0"/>
      <body pos="0.5 0 0">
        <joint name="elbow" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1" contype="0" conaffinity="0"/>
      </body>
    </body>
  </worldbody>
  <sensor><plugin plugin="warmjoint.friction" instance="friction"/></sensor>
</mujoco>
"""

ESTIMATE = {
    "parameters": {"coulomb": {"value": 4.0}, "thermal_gain": {"value": -0.2}},
    "covariance": {
        "parameters": ["coulomb", "thermal_gain"],
        "matrix": [[0.04, 0.001], [0.001, 0.0004]],
    },
}


def check_single_runs(left):
    """Each of the 64 worlds against a run of its own with the world's numbers."""
    final = np.array(left["worlds"].qpos)
    for world in range(64):
        model = mujoco.MjModel.from_xml_path("robot.xml")
        model.numeric_data[:] = left["numbers"][world]
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data, 100)
        assert np.array_equal(data.qpos, final[world]), (world, data.qpos, final[world])
    assert len(np.unique(final[:, 0])) == 64


def check_maps(readme):
    """The README's maps act on a joint that slides through them."""
    text = re.search(r"```json\n(.*?)```", readme, re.S).group(1)
    plain = ROBOT.replace('"parameters": {"coulomb": 2}', '"parameters": {"coulomb": 2}, "maps": ' + text)
    assert plain != ROBOT
    forces = []
    for xml in (ROBOT, plain):
        model = mujoco.MjModel.from_xml_string(xml)
        data = mujoco.MjData(model)
        data.qpos[1], data.qvel[1] = 0.5, 1
        mujoco.mj_forward(model, data)
        forces.append(data.sensordata[5])
    # 0.2 of the ripple at 0.5 rad, 0.3 of the stiff place, kernels at their centres and beside them
    assert 0.3 < forces[0] - forces[1] < 0.6, forces


def main():
    readme, plugin = (pathlib.Path(given).resolve() for given in sys.argv[1:3])
    snippets = re.findall(r"```python\n(.*?)```", readme.read_text(), re.S)
    assert len(snippets) >= 5, len(snippets)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.mkdir("build")
        os.symlink(plugin, "build/libwarmjoint_friction.so")
        pathlib.Path("robot.xml").write_text(ROBOT)
        pathlib.Path("estimate.json").write_text(json.dumps(ESTIMATE))
        left = {}
        for snippet in snippets:
            exec(snippet, left)
            if "estimate.json" in snippet:
                check_single_runs(left)
            if "sensordata" in snippet:
                assert left["held"] in (0, 1) and left["loss"] >= 0 and left["energy"] == 0
            if "bristle, energy" in snippet:
                assert left["energy"] < 0 and left["bristle"] != 0
        assert left["data"].plugin_state[left["first"] + 1] == -0.5
        check_maps(readme.read_text())
    print(f"ran {len(snippets)} snippets")


main()
