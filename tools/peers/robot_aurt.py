"""AURT (pip install aurt) on a robot's log: parameters and the prediction of the log's end, as JSON on standard output.

    robot_aurt.py FOLDER SHARE MODEL

MODEL: a folder for the model of these kinematics, which takes AURT minutes and is made where it is not there. FOLDER holds log.csv (blanks between columns: timestamp, actual_q_1 .., actual_current_1 ..) and mdh.csv (d, a, alpha), and is worked in. SHARE of the log
trains. AURT gives no intervals.
"""

import json
import pathlib
import subprocess
import sys
import time

import numpy as np
import pandas as pd

folder, share, model = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
aurt = pathlib.Path(sys.executable).with_name("aurt")


def call(*arguments):
    done = subprocess.run([aurt, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"aurt {arguments[0]} ended with {done.returncode}: {done.stderr.strip()[-600:]}")


began = time.perf_counter()
if not list(model.glob("rd*")):
    model.mkdir(parents=True, exist_ok=True)
    call("compile-rbd", "--mdh", "mdh.csv", "--out", model / "rbd")
    call("compile-rd", "--model-rbd", model / "rbd", "--friction-torque-model", "none", "--friction-viscous-powers", "1", "--out", model / "rd")
    (model / "seconds").write_text(str(time.perf_counter() - began))
call("calibrate-validate", "--model", model / "rd", "--data", "log.csv", "--gravity", "0", "0", "-9.81", "--calibration-data-rel", share,
     "--out-params", "parameters.csv", "--out-calibrated-model", "calibrated", "--out-prediction", "predicted.csv")

parameters = pd.read_csv(folder / "parameters.csv")
predicted = pd.read_csv(folder / "predicted.csv")
currents = [name for name in predicted.columns if name.startswith("predicted")]
print(json.dumps({"columns": list(parameters.columns), "parameters": parameters.astype(str).values.tolist(), "compiled": float((model / "seconds").read_text()), "time": predicted["timestamp"].tolist(),
                  "torque": np.column_stack([predicted[name] for name in currents]).tolist()}))
