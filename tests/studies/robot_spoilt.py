"""What identify-robot makes of robots' logs that are spoilt in one way. Printed, not tested.

    tests/studies/robot_spoilt.py WARMJOINT ROBOT.xml [SEEDS [KIND,...]] [-- OPTION of identify-robot...]      default: 2 seeds, all kinds

Each log is 150 s at 50 Hz of moves between random places; the description is wrong by 8 % in masses, their places and inertias. Kinds: positions, torques
or both of two joints swapped; the torque of one joint or of all turned; a zero 90 degrees off; the torque of one joint or of all on the motor's side of a gear;
late by 1, 2 or 3 samples; filtered (30 ms); an offset of one torque by .5 to 1.5 of its Coulomb friction; the command for the measurement; the base tilted by 15, 90, 180 degrees; a payload; a half that stands still; and clean logs.
Friction is scaled to the robot: Coulomb friction 15 to 40 % of the rms of the rigid torque, at least .3 N.m.
For each kind: joints that are ok and right (true viscous and Coulomb friction inside the interval, or within 5 %), ok and wrong (silently, where nothing
is said; said: a notice or a remark names the kind), refused with the cause named, and refused without. Needs NumPy and MuJoCo.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np
import robot_wrong_inertials as robots

RATE, LENGTH, GEAR = 100, 150, 80
WRONG = 0.08  # of the description
NEAR = 0.05  # of the truth: an error that nobody minds
# words of a notice or a message that name each kind
NAMED = {
    "swap positions": "swapped", "swap torques": "swapped", "swap both": "swapped", "turned one": "turned", "turned all": "turned",
    "zero": "zero of", "motor one": "motor's side", "motor all": "motors' side", "late 1": "after the positions", "late 2": "after the positions",
    "late 3": "after the positions", "filtered": "after the positions", "commanded": "commanded", "tilted 15": "base does not stand", "tilted 90": "base does not stand",
    "tilted 180": "base does not stand", "offset": "has an offset", "payload": "load at the last link", "idle": "", "clean": "",
}


def spec_of(path, gravity=None, payload=None):
    spec = mujoco.MjSpec.from_file(str(path))
    for joint in spec.joints:
        joint.damping, joint.frictionloss, joint.armature = np.zeros_like(joint.damping), 0, 0
    for actuator in list(spec.actuators):
        spec.delete(actuator)
    for key in list(spec.keys):
        spec.delete(key)
    if gravity is not None:
        spec.option.gravity = gravity
    if payload:
        mass, place = payload
        load = spec.bodies[-1].add_body(name="load", pos=place)
        load.explicitinertial, load.mass, load.inertia = True, mass, [mass * 0.02**2] * 3
    return spec


def described(path, random):
    spec = spec_of(path)
    for body in spec.bodies[1:]:
        body.mass *= 1 + WRONG * random.standard_normal()
        body.ipos = body.ipos * (1 + WRONG * random.standard_normal(3))
        body.inertia = body.inertia * (1 + WRONG * random.standard_normal())
    return spec.to_xml() if spec.compile() else ""


def motion(random, centre):
    """Angles at RATE, each joint between random places at times of its own, by fifth-order polynomials. [N x n]"""
    count = LENGTH * RATE
    q = np.empty((count, len(centre)))
    for j in range(len(centre)):
        k, here = 0, 0.0
        while k < count:
            to = random.uniform(-1, 1)
            m = max(30, int(abs(to - here) * random.uniform(1.4, 3.2) * RATE))
            s = np.arange(m) / m
            q[k : k + m, j] = (here + (to - here) * s**3 * (10 - 15 * s + 6 * s * s))[: count - k]
            k, here = k + m, to
            m = int(random.uniform(0.05, 0.6) * RATE)
            q[k : k + m, j] = here
            k += m
    return q + centre


def rigid(spec, q, v, a):
    model = spec.compile()
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    return robots.torques(model, q, v, a)[0]


class Log:
    """A log of a truth, spoilt in one way."""

    def __init__(self, path, kind, seed):
        random = np.random.default_rng([seed, 77])
        model = spec_of(path).compile()
        n = model.nq
        limited = model.jnt_limited.astype(bool)
        centre = np.where(limited & (np.ptp(model.jnt_range, axis=1) < 6), model.jnt_range.mean(axis=1), 0) + random.uniform(-0.5, 0.5, n)
        self.time = np.arange(LENGTH * RATE) / RATE
        q = motion(random, centre)
        if kind == "idle":
            q[len(q) // 2 :] = q[len(q) // 2]
        v = np.gradient(q, self.time, axis=0)
        a = np.gradient(v, self.time, axis=0)
        force = rigid(spec_of(path, self.gravity(kind, random), self.payload(kind, random)), q, v, a)
        size = np.maximum(np.sqrt(np.mean(rigid(spec_of(path), q, v, a) ** 2, axis=0)), 1)
        self.coulomb, self.viscous = size * random.uniform(0.15, 0.4, n), size * random.uniform(0.1, 0.4, n)
        friction = np.sign(v) * (np.abs(v) > 1e-4) * self.coulomb + self.viscous * v
        rotor = 0.05 * size * a
        torque = force + rotor + friction + 0.02 * size * random.standard_normal(q.shape)
        if kind == "commanded":
            torque = force + rotor + 0.5 * self.viscous * v + 1.3 * self.coulomb * np.tanh(v / 0.05)
        self.q, self.torque = self.spoil(kind, random, q, torque)
        self.target = kind == "commanded"

    @staticmethod
    def gravity(kind, random):
        if not kind.startswith("tilted"):
            return None
        angle, about = np.radians(float(kind.split()[1])), random.uniform(0, 2 * np.pi)
        return 9.81 * np.array([np.sin(angle) * np.cos(about), np.sin(angle) * np.sin(about), -np.cos(angle)])

    @staticmethod
    def payload(kind, random):
        return (random.uniform(1, 2), random.uniform(-0.1, 0.1, 3)) if kind == "payload" else None

    def spoil(self, kind, random, q, torque):
        q, torque, n = q.copy(), torque.copy(), q.shape[1]
        one, other = random.choice(n, 2, replace=False)
        if kind in ("swap positions", "swap both"):
            q[:, [one, other]] = q[:, [other, one]]
        if kind in ("swap torques", "swap both"):
            torque[:, [one, other]] = torque[:, [other, one]]
        if kind == "turned one":
            torque[:, one] *= -1
        if kind == "turned all":
            torque *= -1
        if kind == "zero":
            q[:, max(one, 1)] += np.pi / 2
        if kind == "motor one":
            torque[:, one] /= GEAR
        if kind == "motor all":
            torque /= GEAR
        if kind.startswith("late"):
            torque = np.roll(torque, 2 * int(kind.split()[1]), axis=0)
        if kind == "offset":
            torque[:, one] += random.choice([-1, 1]) * random.uniform(0.5, 1.5) * self.coulomb[one]
        if kind == "filtered":
            pole = np.exp(-1 / RATE / 0.03)
            for i in range(1, len(torque)):
                torque[i] = pole * torque[i - 1] + (1 - pole) * torque[i]
        return q, torque

    def write(self, file):
        n = self.q.shape[1]
        name = "target_torque" if self.target else "torque"
        head = ["time"] + [f"q{j}" for j in range(n)] + [f"{name}{j}" for j in range(n)]
        rows = np.column_stack([self.time, self.q, self.torque])[::2]
        np.savetxt(file, rows, delimiter=",", header=",".join(head), comments="", fmt="%.7g")


def is_right(parameters, truth):
    for name, value in truth.items():
        one = parameters.get(name)
        if not one:
            return False
        lower, upper = one["interval95"] or (one["value"],) * 2
        if not lower <= value <= upper and abs(one["value"] - value) > NEAR * value:
            return False
    return True


def judge(program, options, folder, path, kind, seed):
    """Joints by verdict: ok and right, ok and wrong in silence, wrong and said, refused and named, refused without."""
    log = Log(path, kind, seed)
    log.write(folder / "log.csv")
    (folder / "robot.xml").write_text(described(path, np.random.default_rng([seed, 78])))
    more = ["--map", "position=q{j},torque=target_torque{j},time=time"] if log.target else []
    run = subprocess.run([program, "identify-robot", folder / "robot.xml", folder / "log.csv", "-o", folder / "robot.json", *more, *options],
                         capture_output=True, text=True)
    if not (folder / "robot.json").exists():
        return {"failed": 1}, run.stderr[-200:]
    answer = json.loads((folder / "robot.json").read_text())
    (folder / "robot.json").unlink()
    said = " ".join(answer["notices"])
    count = dict.fromkeys(("right", "silently wrong", "wrong, said", "refused, named", "refused"), 0)
    for j, estimate in enumerate(answer["joints"].values()):
        named = bool(NAMED[kind]) and NAMED[kind] in said + estimate["message"]
        if estimate["status"] != "ok":
            count["refused, named" if named else "refused"] += 1
        elif is_right(estimate["parameters"], {"viscous": log.viscous[j], "coulomb": log.coulomb[j]}):
            count["right"] += 1
        else:
            count["wrong, said" if named else "silently wrong"] += 1
    return count, said


def main():
    words, _, options = " ".join(sys.argv[1:]).partition(" -- ")
    program, path, *rest = words.split()
    seeds, kinds = rest[0] if rest else "2", " ".join(rest[1:])
    for kind in kinds.split(",") if kinds else NAMED:
        total, notes = {}, []
        for seed in range(int(seeds)):
            with tempfile.TemporaryDirectory() as folder:
                count, said = judge(program, options.split(), pathlib.Path(folder), path, kind, seed)
            for name, number in count.items():
                total[name] = total.get(name, 0) + number
            notes.append(said[:160])
        print(f"{kind:15s}", "  ".join(f"{name} {number}" for name, number in total.items() if number), flush=True)
        if total.get("silently wrong") or total.get("refused") or kind == "clean":
            print("     ", " | ".join(one for one in notes if one), flush=True)


main()
