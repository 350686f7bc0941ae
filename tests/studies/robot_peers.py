"""identify-robot beside AURT and FIGAROH on the same logs: NIST's UR5, and simulated UR5e whose friction is known. Prints the board robot-peers.

    tests/studies/robot_peers.py SHARED [--seeds N] [--peers PYTHON] [--program PROGRAM] [-o BOARD.md]

SHARED: folder with data/nist_ur5 and robots/universal_robots_ur5e. PYTHON: of an environment with aurt and figaroh (tools/peers/README.md). The first 60 % of
each log trains, the rest tests. All get the same samples, low-passed at 10 Hz without delay; held-out error is the rms of what is predicted wrongly at samples
that move. Simulated: sums of sines at 100 Hz, 100 s, noise of .3 to .1 N.m; masses, their places and inertias of the description are wrong by 8 %, the kinematics are
right. AURT gets the kinematics alone, FIGAROH and identify-robot the wrong description. An error of friction is that at the joint's median speed.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import mujoco
import numpy as np
from scipy.signal import butter, sosfiltfilt

ROOT = pathlib.Path(__file__).resolve().parents[2]
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
MDH = {"ur5": [(0.089159, 0, "pi/2"), (0, -0.425, "0"), (0, -0.39225, "0"), (0.10915, 0, "pi/2"), (0.09465, 0, "-pi/2"), (0.0823, 0, "0")],
       "ur5e": [(0.1625, 0, "pi/2"), (0, -0.425, "0"), (0, -0.3922, "0"), (0.1333, 0, "pi/2"), (0.0997, 0, "-pi/2"), (0.0996, 0, "0")]}
VISCOUS = np.array([6.4, 9.7, 5.1, 1.3, 0.9, 0.7])  # N.m.s/rad
COULOMB = np.array([7.2, 9.1, 6.3, 1.9, 1.4, 1.1])  # N.m
ROTOR = np.array([0.8, 0.9, 0.6, 0.17, 0.15, 0.12])  # kg.m^2
NOISE = np.array([0.3, 0.3, 0.3, 0.1, 0.1, 0.1])  # N.m
TRAINS, CUTOFF = 0.6, 10.0
CONFIG = """robot:
  name: arm
  properties:
    joints:
      active_joints: [{joints}]
    mechanics:
      reduction_ratios: [1, 1, 1, 1, 1, 1]
      friction_coefficients: {{viscous: [0, 0, 0, 0, 0, 0], static: [0, 0, 0, 0, 0, 0]}}
      actuator_inertias: [0, 0, 0, 0, 0, 0]
      joint_offsets: [0, 0, 0, 0, 0, 0]
tasks:
  identification:
    enabled: true
    problem:
      use_joint_torques: true
      model_components: {{friction: true, joint_offset: true, actuator_inertia: true, static_regressor: true, inertia_regressor: true}}
      qr_relative_tolerance: 1.0e-4
    signal_processing: {{sampling_frequency: {rate}, cutoff_frequency: 10.0}}
"""


def low_pass(x, rate):
    return sosfiltfilt(butter(4, CUTOFF, fs=rate, output="sos"), x, axis=0)


class Log:
    """Time [N], positions and torques [N, 6] as logged, with those that all get: low-passed, differentiated."""

    def __init__(self, t, q, tau, urdf, mdh, truth=None, gear=None, unit="N.m"):
        self.rate = (len(t) - 1) / (t[-1] - t[0])
        even = np.linspace(t[0], t[-1], len(t))
        self.t = even - even[0]
        self.raw_q, self.raw_tau = (np.column_stack([np.interp(even, t, one) for one in x.T]) for x in (q, tau))
        self.q, self.tau = low_pass(self.raw_q, self.rate), low_pass(self.raw_tau, self.rate)
        self.v = np.gradient(self.q, self.t, axis=0)
        self.a = np.gradient(self.v, self.t, axis=0)
        self.urdf, self.mdh, self.truth, self.gear, self.unit = urdf, mdh, truth, gear, unit
        self.cut = int(TRAINS * len(self.t))

    def moving(self):
        """[rows of the test, 6]: away from reversals, where friction is told."""
        return np.abs(self.v[self.cut:]) > 0.05 * np.abs(self.v).max(axis=0)

    def median_speed(self):
        return np.array([np.median(one[one > 0.05 * one.max()]) for one in np.abs(self.v).T])

    def held_out(self, predicted):
        wrong = np.where(self.moving(), self.tau[self.cut:] - predicted, np.nan)
        return np.sqrt(np.nanmean(wrong**2, axis=0))


def nist(shared):
    table = np.genfromtxt(shared / "data/nist_ur5/robot.csv", delimiter=",", names=True)
    q = np.radians(np.column_stack([table[f"actual_q_{j}"] for j in range(6)]))
    return Log(table["timestamp"], q, np.column_stack([table[f"actual_current_{j}"] for j in range(6)]), (shared / "data/nist_ur5/ur5.urdf").read_text(), "ur5", gear=101, unit="A")


def simulated(shared, seed):
    """A UR5e with known friction, and a description that is wrong by 8 %."""
    file = shared / "robots/universal_robots_ur5e/ur5e_nomesh.xml"
    random = np.random.default_rng(seed)
    t = np.arange(0, 100, 0.01)
    waves = [(random.uniform(0.15, 0.5), 2 * np.pi * random.uniform(0.03, 0.25), random.uniform(0, 6.28)) for _ in range(18)]
    middle = np.array([0.3, -1.3, 1.2, -1.1, -1.4, 0.2])
    q = np.stack([sum(a * np.sin(w * t + p) for a, w, p in waves[3 * j:3 * j + 3]) for j in range(6)], axis=1) + middle
    v = np.gradient(q, t, axis=0)
    a = np.gradient(v, t, axis=0)
    model = mujoco.MjModel.from_xml_path(str(file))
    model.dof_armature[:] = model.dof_damping[:] = model.dof_frictionloss[:] = 0
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT | mujoco.mjtDisableBit.mjDSBL_ACTUATION)
    data, rigid = mujoco.MjData(model), np.empty_like(q)
    for k in range(len(t)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q[k], v[k], a[k]
        mujoco.mj_inverse(model, data)
        rigid[k] = data.qfrc_inverse
    tau = rigid + ROTOR * a + VISCOUS * v + COULOMB * np.sign(v) + NOISE * random.standard_normal(q.shape)
    return Log(t, q, tau, urdf_of(model, random), "ur5e", truth=(VISCOUS, COULOMB))


def urdf_of(model, random):
    """A URDF of an arm in MuJoCo, one hinge a body, with inertials that are wrong by 8 %."""
    text, parent, offset, turn = "<robot name='arm'><link name='link0'/>", "link0", np.zeros(3), np.array([1.0, 0, 0, 0])
    for body in range(1, model.nbody):
        # bodies without a joint go with the next one that has one
        place = offset + rotate(turn, model.body_pos[body])
        angle = multiply(turn, model.body_quat[body])
        joints = [j for j in range(model.njnt) if model.jnt_bodyid[j] == body]
        if not joints:
            offset, turn = place, angle
            continue
        name, axis, mass = model.joint(joints[0]).name, model.jnt_axis[joints[0]], model.body_mass[body] * (1 + 0.08 * random.standard_normal())
        centre = model.body_ipos[body] * (1 + 0.08 * random.standard_normal(3))
        inertia = model.body_inertia[body] * (1 + 0.08 * random.standard_normal())
        words = lambda x: " ".join(f"{one:.9g}" for one in x)
        text += (f"<link name='{name}_link'><inertial><origin xyz='{words(centre)}' rpy='{words(roll_pitch_yaw(model.body_iquat[body]))}'/><mass value='{mass:.9g}'/>"
                 f"<inertia ixx='{inertia[0]:.9g}' iyy='{inertia[1]:.9g}' izz='{inertia[2]:.9g}' ixy='0' ixz='0' iyz='0'/></inertial></link>"
                 f"<joint name='{name}' type='revolute'><parent link='{parent}'/><child link='{name}_link'/><origin xyz='{words(place)}' rpy='{words(roll_pitch_yaw(angle))}'/>"
                 f"<axis xyz='{words(axis)}'/><limit lower='-6.3' upper='6.3' effort='150' velocity='3.2'/></joint>")
        parent, offset, turn = f"{name}_link", np.zeros(3), np.array([1.0, 0, 0, 0])
    return text + "</robot>"


def multiply(one, other):
    result = np.zeros(4)
    mujoco.mju_mulQuat(result, one, other)
    return result


def rotate(turn, vector):
    result = np.zeros(3)
    mujoco.mju_rotVecQuat(result, vector, turn)
    return result


def roll_pitch_yaw(quaternion):
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    m = matrix.reshape(3, 3)
    return np.arctan2(m[2, 1], m[2, 2]), np.arctan2(-m[2, 0], np.hypot(m[2, 1], m[2, 2])), np.arctan2(m[1, 0], m[0, 0])


# Each peer: {"viscous", "coulomb" [6], "low", "high" of friction at the median speed (NaN where it gives none), "predicted" [rows of the test, 6], "seconds"}


def ours(log, folder, program):
    names = [f"{kind}{j}" for kind in ("q", "i" if log.unit == "A" else "torque") for j in range(6)]
    np.savetxt(folder / "log.csv", np.column_stack([log.t, log.raw_q, log.raw_tau]), delimiter=",", header=",".join(["time", *names]), comments="", fmt="%.9g")
    np.savetxt(folder / "train.csv", np.column_stack([log.t, log.raw_q, log.raw_tau])[:log.cut], delimiter=",", header=",".join(["time", *names]), comments="", fmt="%.9g")
    (folder / "robot.urdf").write_text(log.urdf)
    unit = ["--unit", "torque=A"] if log.unit == "A" else []
    gear = ["--gear", str(log.gear)] if log.gear else []

    def identified(file, *options):
        call = [program, "identify-robot", "robot.urdf", file, "--map", f"time=time,position=q{{j}},torque={names[6][:-1]}{{j}}", *unit, *gear, *options]
        subprocess.run([*call, "-o", "robot.json", "-q"], cwd=folder, capture_output=True, check=False)
        return json.loads((folder / "robot.json").read_text())

    # friction of the first part alone, as of the others; the summary of the whole log has what such a fit leaves on the rest
    began = time.perf_counter()
    robot = identified("train.csv")
    seconds = time.perf_counter() - began
    summary = identified("log.csv", "--holdout", str(1 - TRAINS))["summary"]
    found = {key: np.full(6, np.nan) for key in ("viscous", "coulomb", "low", "high", "held_out")}
    found["refused"] = []
    for j, (name, joint) in enumerate(robot["joints"].items()):
        if joint["status"] != "ok":
            found["refused"].append(name)
            continue
        parameters = joint["parameters"]
        found["viscous"][j], found["coulomb"][j] = parameters["viscous"]["value"], parameters["coulomb"]["value"]
        low, high = at_speed(joint, log.median_speed()[j])
        found["low"][j], found["high"][j] = low, high
        found["held_out"][j] = summary[name]["rms_held_out"] or np.nan
    return {**found, "seconds": seconds}


def at_speed(joint, speed):
    """95 % interval of the mean of both directions at a speed, by the covariance of viscous and Coulomb friction."""
    matrix, names = np.array(joint["covariance"]["matrix"], float), joint["covariance"]["parameters"]
    row = np.array([{"viscous": speed, "coulomb": 1.0, "coulomb_positive": 0.5, "coulomb_negative": 0.5}.get(name, 0.0) for name in names])
    if "coulomb" in names and "coulomb_positive" in names:
        row[[names.index("coulomb_positive"), names.index("coulomb_negative")]] = 0
    middle = joint["parameters"]["coulomb"]["value"] + speed * joint["parameters"]["viscous"]["value"]
    half = 1.96 * np.sqrt(max(0.0, row @ matrix @ row))
    return middle - half, middle + half


def aurt(log, folder, python, models):
    names = ["timestamp"] + [f"actual_q_{j}" for j in range(1, 7)] + [f"actual_current_{j}" for j in range(1, 7)]
    step = round(1 / log.rate, 6)
    even = np.arange(len(log.t)) * step
    np.savetxt(folder / "log.csv", np.column_stack([even, log.raw_q, log.raw_tau]), delimiter=" ", header=" ".join(names), comments="", fmt="%.9g")
    (folder / "mdh.csv").write_text("d,a,alpha\n" + "".join(f"{d},{a},{alpha}\n" for d, a, alpha in MDH[log.mdh]))
    there = (models / log.mdh / "seconds").exists()
    answer, seconds = run([python, ROOT / "tools/peers/robot_aurt.py", folder, str(TRAINS), models / log.mdh])
    parameters = {row[0]: float(row[1]) for row in answer["parameters"]}
    find = lambda key, j: next((value for name, value in parameters.items() if name.replace("_", "").replace("{", "").replace("}", "").lower() in (f"{key}{j}", f"{key}1,{j}", f"{key}{j},1")), np.nan)
    predicted = np.array(answer["torque"])
    when = np.array(answer["time"])
    when = when - when[0] + log.t[log.cut]
    shown = np.column_stack([np.interp(log.t[log.cut:], when, one) for one in predicted.T])
    none = np.full(6, np.nan)
    return {"viscous": np.array([find("fv", j) for j in range(1, 7)]), "coulomb": np.array([find("fc", j) for j in range(1, 7)]), "low": none, "high": none,
            "held_out": log.held_out(shown), "seconds": seconds - (0 if there else answer["compiled"]), "names": [*parameters, f"model: {answer['compiled']:.0f} s"], "refused": []}


def figaroh(log, folder, python):
    for part, rows in (("train", slice(0, log.cut)), ("test", slice(log.cut, None))):
        (folder / part).mkdir()
        for name, values in (("q", log.q), ("dq", log.v), ("ddq", log.a), ("tau", log.tau)):
            np.savetxt(folder / part / f"{name}.csv", values[rows], delimiter=",", fmt="%.9g")
    (folder / "robot.urdf").write_text(log.urdf)
    joints = [one.split("'")[0] for one in log.urdf.replace('"', "'").split("<joint name='")[1:]]
    active = [name for name in joints if any(word in name for word in JOINTS)][:6]
    (folder / "config.yaml").write_text(CONFIG.format(joints=", ".join(active), rate=log.rate))
    answer, seconds = run([python, ROOT / "tools/peers/robot_figaroh.py", folder, str(log.rate)])
    known = dict(zip(answer["names"], zip(answer["values"], answer["percent"], strict=True), strict=True))
    viscous, coulomb, spread = np.full(6, np.nan), np.full(6, np.nan), np.full((2, 6), np.nan)
    for j, name in enumerate(active):
        for kind, values in ((0, viscous), (1, coulomb)):
            key = next((one for one in known if one in (f"{('fv', 'fs')[kind]}_{name}", f"{('fv', 'fs')[kind]}{j + 1}")), None)
            if key:
                values[j] = known[key][0]
                spread[kind, j] = abs(known[key][0]) * known[key][1] / 100
    middle = coulomb + viscous * log.median_speed()
    half = 1.96 * np.hypot(spread[1], spread[0] * log.median_speed())
    return {"viscous": viscous, "coulomb": coulomb, "low": middle - half, "high": middle + half, "held_out": log.held_out(np.array(answer["torque"])),
            "seconds": seconds, "names": answer["names"], "refused": []}


def run(command):
    began = time.perf_counter()
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{command[1]}: {done.stderr[-1500:]}")
    return json.loads(done.stdout.splitlines()[-1]), time.perf_counter() - began


def page(rows, program, took):
    """The board: question, table, how it is read and made again."""
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    return f"""# robot-peers

How near to the friction of a robot do programs come that fit all joints at once, and do their intervals hold?

{chr(10).join(rows)}

The first 60 % of each log trains, the rest tests; all get the same samples. NIST's UR5: currents, 63 s, gear 101 given
to `identify-robot`, which neither of the others takes. UR5e: simulated, 100 s, sums of three sines a joint, friction
viscous and Coulomb, noise .3 and .1 N.m, a description whose masses, centres and inertias are wrong by 8 %.

- held-out rms: of what is predicted wrongly on the last 40 %, away from reversals. Of `identify-robot` it is the
  summary's own figure.
- error of friction: at the joint's median speed, J1 to J6. Intervals: those that hold that friction; of FIGAROH by the
  standard deviations of its weighted least squares, which take the noise as white.
- s: on two busy cores, with writing and reading of files.

Setting up: `identify-robot` took the description and the log. FIGAROH needed
a configuration of 20 lines, its joints named once more in Python, and velocities and accelerations made before; AURT
needs a table of kinematics, and derives a model of them by symbols.
{took}
Made by {version} with FIGAROH 1.0.2 and AURT 0.0.4:

<!-- not run: it needs the packages and the shared logs -->
```sh
python3 tests/studies/robot_peers.py SHARED -o scenarios/suites/boards/robot-peers.md
```

[All suites](../README.md), [how the others are called](../../../tools/peers/README.md).
"""


def words(values, digits=3):
    return " ".join("–" if not np.isfinite(one) else f"{one:.{digits}g}" for one in values)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shared", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--peers", default=str(ROOT / "build/robot_peers/bin/python"))
    parser.add_argument("--program", default=str(ROOT / "build/warmjoint"))
    parser.add_argument("--only", nargs="*", help="of warmjoint, AURT, FIGAROH those that are run")
    parser.add_argument("--models", type=pathlib.Path, default=ROOT / "build/robot_peers/models", help="where AURT's models of kinematics are kept")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    asked = parser.parse_args()
    who = {"warmjoint identify-robot": lambda log, folder: ours(log, folder, asked.program), "AURT": lambda log, folder: aurt(log, folder, asked.peers, asked.models.resolve()),
           "FIGAROH": lambda log, folder: figaroh(log, folder, asked.peers)}
    who = {name: peer for name, peer in who.items() if not asked.only or name.split()[0] in asked.only}
    logs = {"NIST UR5": nist(asked.shared), **{f"UR5e, seed {seed}": simulated(asked.shared, seed) for seed in range(asked.seeds)}}
    rows = ["| log | who | held-out rms, J1 to J6 | error of friction, % | intervals that hold | s |", "|---|---|---|---|---|---|"]
    for title, log in logs.items():
        for name, peer in who.items():
            with tempfile.TemporaryDirectory() as folder:
                found = peer(log, pathlib.Path(folder))
            error = hold = ""
            if log.truth:
                truth = log.truth[1] + log.truth[0] * log.median_speed()
                error = words(100 * (found["coulomb"] + found["viscous"] * log.median_speed() - truth) / truth, 2)
                known = np.isfinite(found["low"])
                hold = f"{np.sum((found['low'] <= truth) & (truth <= found['high']))} of {known.sum()}" if known.any() else "gives none"
            rows.append(f"| {title} | {name} | {words(found['held_out'])} {log.unit} | {error} | {hold} | {found['seconds']:.1f} |")
            print(rows[-1], flush=True)
            print("   ", found.get("names", ""), found["refused"], file=sys.stderr)
    if asked.output:
        left_out = " ".join(f"{one} was left out of this run." for one in ("AURT", "FIGAROH") if one not in who)
        asked.output.write_text(page(rows, asked.program, left_out))


if __name__ == "__main__":
    main()
