"""The example scripts run as their first lines say, and the Python of the pages as it stands there."""

import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROTARY = ["models/robots/rotary/rotary.xml", "hinge", "models/robots/rotary/friction.json"]


@pytest.mark.parametrize("arguments, needed, said", [
    (["identify_log.py", "log.csv", "."], ["matplotlib"], "<Estimate by auto: ok>"),
    (["many_logs.py", "log.csv", "log.csv"], ["numpy"], "log.csv ok viscous="),
    (["warm_robot.py", *ROTARY, "1"], ["mujoco"], "\n     1               15.1"),  # cold 17.5 N.m; (20) to (22) by hand: 15.18
    (["worlds.py", *ROTARY], ["mujoco.batch"], "\n0.01             0.08"),  # m v^2 / 2 = 1.8 J over 15 N.m and more
    (["train.py"], ["mujoco.batch", "gymnasium"], "rad in the mean"),
    (["robot_joints.py", "robot.csv"], [], "joint 2: ok\n  viscous"),
    (["compare_identifiers.py", "run"], ["mujoco"], "\nnominal-ls   error over all parameters  158."),
], ids=lambda given: given[0] if given else "none")
def test_an_example_runs(arguments, needed, said, recording, tmp_path):
    for module in needed:
        pytest.importorskip(module)
    (tmp_path / "models").symlink_to(ROOT / "models")
    (tmp_path / "log.csv").symlink_to(recording)
    with open(recording, encoding="utf-8") as log, open(tmp_path / "robot.csv", "w", encoding="utf-8") as wide:
        header, *rows = (line.rstrip("\n").split(",") for line in log if not line.startswith("#"))
        at = [header.index(name) for name in ("time", "position", "torque")]
        wide.write("t,q1,tau1,q2,tau2\n")
        wide.writelines(",".join(row[i] for i in (*at, *at[1:])) + "\n" for row in rows)
    done = subprocess.run([sys.executable, ROOT / "tools/examples" / arguments[0], *arguments[1:]], cwd=tmp_path,
                          env=os.environ, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert said in done.stdout


@pytest.mark.parametrize("page", ["README.md", "tools/python/README.md", "tools/docs/mujoco.md", "tools/docs/training.md", "tools/docs/compensate.md", "tools/docs/tutorial.md"])
def test_the_python_of_a_page_runs(page, recording, tmp_path):
    for needed in ("mujoco.batch", "matplotlib", "jinja2", "pandas"):
        pytest.importorskip(needed)
    (tmp_path / "models").symlink_to(ROOT / "models")
    (tmp_path / "runs/warm").mkdir(parents=True)
    for place in ("log.csv", "runs/warm/recording.csv"):
        (tmp_path / place).symlink_to(recording)
    frame = np.genfromtxt(recording, delimiter=",", names=True)
    factors = {"time": ("t_ms", 1000), "position": ("q_deg", 180 / np.pi), "velocity": ("qd_deg_s", 180 / np.pi), "torque": ("tau_Nm", 1)}
    table = np.column_stack([frame[name] * factor for name, (_, factor) in factors.items()])
    np.savetxt(tmp_path / "runs/log.csv", table, "%.9g", ",", header=",".join(name for name, _ in factors.values()), comments="")
    blocks = re.findall(r"^(<!-- not run[^\n]*-->\n)?```python\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S)
    code = "\n".join(block for marked, block in blocks if not marked)
    assert code
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
