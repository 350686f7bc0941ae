"""FIGAROH (pip install figaroh) on a robot's log: parameters with standard deviations, and the prediction of the log's end, as JSON on standard output.

    robot_figaroh.py FOLDER RATE

FOLDER holds robot.urdf, config.yaml, and train and test with q.csv, dq.csv, ddq.csv, tau.csv (N x joints, rad, N.m or A) each, low-passed at 10 Hz. RATE: Hz.
"""

import contextlib
import json
import pathlib
import sys

import numpy as np
from figaroh.integration.api import _SimpleIdentification
from figaroh.tools.load_robot import load_robot

folder, rate = pathlib.Path(sys.argv[1]), float(sys.argv[2])


def begun(part):
    """FIGAROH's identification with the data of one part and their regressor."""
    robot = load_robot(str(folder / "robot.urdf"), package_dirs=str(folder), loader="figaroh")
    simple = _SimpleIdentification(robot, str(folder / "config.yaml"), data_dir=str(folder / part))
    known = simple._identification
    given = simple.load_trajectory_data()
    names = ("timestamps", "positions", "velocities", "accelerations", "torques")
    known.load_trajectory_data = lambda: {**dict(zip(names, given, strict=True)), "timestamps": np.arange(len(given[1])) / rate}
    model, asked = robot.model, [name for name in robot.model.names if name != "universe"]
    known.identif_config.update({
        "active_joints": asked, "act_Jid": [model.getJointId(name) for name in asked], "act_J": [model.joints[model.getJointId(name)] for name in asked],
        "act_idxq": [model.joints[model.getJointId(name)].idx_q for name in asked], "act_idxv": [model.joints[model.getJointId(name)].idx_v for name in asked]})
    known.filter_config = {"differentiation_method": "gradient", "filter_params": {"nbutter": 4, "f_butter": 10, "med_fil": 1, "f_sample": rate}}
    known.initialize()
    return known


with contextlib.redirect_stdout(sys.stderr):
    known = begun("train")
    known.solve(decimate=False, plotting=False, wls=True)
    # what the first part taught, on the regressor of the second
    regressor = np.delete(begun("test").dynamic_regressor, known._idx_eliminated, axis=1)[:, known._base_indices]
    predicted = regressor @ known.phi_base
    percent = np.asarray(known.result["wls_std_deviations"], float)

print(json.dumps({"names": [str(name) for name in known.params_base], "values": np.asarray(known.phi_base, float).tolist(), "percent": percent.tolist(),
                  "torque": predicted.reshape(6, -1).T.tolist()}))
