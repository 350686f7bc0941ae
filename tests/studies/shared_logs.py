"""The real logs of shared/data, each with what reads it: one table for real_logs.py and guard."""

import dataclasses
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "tools/examples"


@dataclasses.dataclass(frozen=True)
class SharedLog:
    """A log of one joint; columns: of time, position, velocity (None: the slope of the positions) and torque, radians: of one unit of its positions (1 for m)."""

    file: str
    arguments: str
    columns: tuple
    radians: float
    joint: int = 0  # of files that hold several by number

    def path(self, shared, folder):
        """The table that the program reads; written into folder where the files are of another form."""
        given = pathlib.Path(shared, "data", self.file)
        if given.suffix == ".json":
            return converted(pathlib.Path(folder, given.stem + ".csv"), "xl330_to_csv.py", given)
        if "tx40" in self.file:
            return converted(pathlib.Path(folder, f"tx40_{self.joint}.csv"), "tx40_to_csv.py", given, given.with_name("curr_data.csv"), self.joint)
        return given

    def there(self, shared):
        return pathlib.Path(shared, "data", self.file).exists()


def converted(out, script, *arguments):
    if not out.exists():
        out.write_bytes(subprocess.run([sys.executable, EXAMPLES / script, *map(str, arguments)], check=True, capture_output=True).stdout)
    return out


def of_ur10e(j):
    return SharedLog(f"ur10e_joints/joint{j}.csv", "--map time=t_s,position=q,velocity=qd,torque=i_A --unit torque=A", ("t_s", "q", "qd", "i_A"), 1)


def of_nist(j):
    columns = ("timestamp", f"actual_q_{j}", f"actual_qd_{j}", f"actual_current_{j}")
    return SharedLog("nist_ur5/robot.csv", "--map time={},position={},velocity={},torque={} --unit position=deg --unit torque=A".format(*columns), columns, np.pi / 180)


def of_tx40(j):
    return SharedLog("tx40/pos_read_data.csv", "--map torque=current --unit position=deg,torque=A", ("time", "position", None, "current"), np.pi / 180, j)


def of_xl330(stem):
    return SharedLog(f"xl330/{stem}.json", "--map torque=load --unit torque=raw", ("time", "position", "velocity", "load"), 1)


def logs(shared):
    """{name: SharedLog} of those that are there."""
    emps = SharedLog("emps/DATA_EMPS.csv", "--map time=t_s,position=q_m,torque=force_N --joint linear", ("t_s", "q_m", None, "force_N"), 1)
    arm = SharedLog("xarm6_thermal/j3_48deg_s.csv", "--map time=t,position=q_deg,velocity=v_deg,torque=i,temperature=temp "
                    "--unit position=deg,velocity=deg/s,torque=A,temperature=degC", ("t", "q_deg", None, "i"), np.pi / 180)
    found = {**{f"UR10e {j}": of_ur10e(j) for j in range(1, 6)}, "EMPS": emps, **{f"NIST {j + 1}": of_nist(j) for j in range(6)}, "xArm6": arm,
             **{f"TX40 {j}": of_tx40(j) for j in range(1, 7)},
             **{f"XL330 {file.stem[-8:]}": of_xl330(file.stem) for file in sorted(pathlib.Path(shared, "data/xl330").glob("*.json"))}}
    return {name: log for name, log in found.items() if log.there(shared)}
