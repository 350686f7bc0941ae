#!/usr/bin/env python3
"""Some 15,000 wrong calls of the Python package, in processes that may die of them. package.py; package.py --many COUNT

Each call gives an answer or raises an exception that says what is wrong: BadInput, TypeError that names an argument, KeyError of a name,
Rejected. A RuntimeError, an exception of the inside, a text with options of the command line or with control characters, or the end of the
process is a fault.
"""

import array
import datetime
import decimal
import fractions
import importlib
import os
import re
import subprocess
import sys
import tempfile
import types
import warnings

SECONDS = 900  # of a group; files of other formats are read by a process each
OPTION = re.compile(r"(?<![\w-])--[a-z]")
NAMES = re.compile(r"unexpected keyword argument|positional argument|a log is cut|^[a-z_]+: ")  # of a signature, or with the argument's name
CONTROL = re.compile("[\x00-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")  # line ends as well: a refusal is one line
ROBOT = """<mujoco><compiler angle="radian"/><worldbody>
  <body><joint name="shoulder" axis="0 1 0" range="-3 3"/><inertial pos="0 0 .2" mass="8" diaginertia=".1 .1 .02"/>
    <body pos="0 0 .4"><joint name="elbow" axis="0 1 0" range="-3 3"/><inertial pos="0 0 .15" mass="3" diaginertia=".03 .03 .01"/>
</body></body></worldbody></mujoco>"""


def samples():
    import numpy as np

    t = np.arange(600.0)
    v = np.where(t // 20 % 2, -1.0, 1.0) * (1 + t // 40 % 3)
    q = np.concatenate([[0], np.cumsum(v[:-1])])
    return {"time": t, "position": q, "velocity": v, "torque": 4.5 * np.sign(v) + 0.8 * v + 0.05 * np.sin(9 * t)}


def resident():
    """Bytes of this process in memory."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def many(count):
    """Bytes by which the memory grows from a tenth of `count` identifications on."""
    import warmjoint as wj

    for i in range(count):
        wj.identify(wj.Log(**samples()), "nominal-ls")
        if i == count // 10:
            before = resident()
    print("grown", resident() - before)


def oddities():
    """Values that are no column, no number, no name and no file, by what they are."""
    import numpy as np

    held = []
    held.append(held)
    of_itself = {}
    of_itself["parameters"] = of_itself
    twice = {}
    twice["a"] = twice["b"] = twice
    deep = []
    for _ in range(100_000):
        deep = [deep]
    laughs = [1.0]
    for _ in range(60):
        laughs = [laughs, laughs]
    return {
        "None": None, "True": True, "text": "x", "empty text": "", "escapes": "a\x1b[31mb\n\u202ec", "int": 5, "negative": -1, "bytes": b"\xff", "surrogate": "\udcff", "null": "a\0b", "huge": 10**30,
        "longer": 10**5000, "nan": float("nan"), "inf": float("inf"), "complex": 1j, "object": object(), "type": int, "module": os,
        "function": len, "list": [], "tuple": (), "dict": {}, "set": {1}, "nested": [[1, [2]]], "held": held, "of itself": of_itself,
        "twice": twice, "deep": deep, "laughs": laughs, "generator": (i for i in range(3)), "range": range(3), "memory": memoryview(b"abc"),
        "array": array.array("d", [1, 2]), "date": datetime.date(2024, 1, 1), "decimal": decimal.Decimal("NaN"),
        "fraction": fractions.Fraction(1, 3), "0-d": np.array(1.0), "2-d": np.zeros((3, 4)), "ragged": [[1], [1, 2]],
        "complex array": np.zeros(600, complex), "booleans": np.zeros(600, bool), "words": np.array(["x"] * 600),
        "dates": np.zeros(600, "M8[s]"), "empty": np.array([]), "nans": np.full(600, np.nan), "infs": np.full(600, np.inf),
        "strided": np.arange(1200.0)[::2], "big-endian": np.arange(600.0).astype(">f8"), "half": np.arange(600).astype(np.float16),
        "void": np.zeros(600, "V8"), "records": np.zeros(600, [("a", float)]), "tolist": types.SimpleNamespace(tolist=lambda: held),
        "raises": types.SimpleNamespace(__array__=None, tolist=lambda: 1 / 0),
    }


def said(raised):
    """What an exception says, also where it cannot be printed, as of numbers with thousands of digits."""
    try:
        return str(raised)
    except ValueError as unprinted:
        return f"{type(raised).__name__} that cannot be printed: {unprinted}"


def can_be_key(value):
    """Whether Python lets a value name something in a dict; what it does not is no call of ours."""
    try:
        hash(value)
    except TypeError:
        return False
    return True


def attach_calls(odd, friction):
    """(name, call) of friction in MuJoCo."""
    import mujoco
    import warmjoint as wj

    arm = """<mujoco><worldbody><body><joint name="elbow"/><geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.04"/></body></worldbody></mujoco>"""
    bound = wj.attach(arm, {"elbow": friction})
    model = bound.spec.compile()
    bound = bound.bind(model, mujoco.MjData(model))
    worlds = importlib.import_module("mujoco.batch").Batch(model, 2)
    for name, value in odd.items():
        yield f"attach({name})", lambda v=value: wj.attach(v, {"elbow": friction})
        yield f"attach(frictions={name})", lambda v=value: wj.attach(arm, v)
        yield f"attach(friction={name})", lambda v=value: wj.attach(arm, {"elbow": v})
        if can_be_key(value):
            yield f"attach(joint={name})", lambda v=value: wj.attach(arm, {v: friction})
        for member in ("friction", "status", "state_end", "parameters"):
            tree = {"friction": friction.data, "status": "ok", member: value}
            yield f"attach({member}={name})", lambda t=tree: wj.attach(arm, {"elbow": t})
        for argument in ("form", "sensors", "randomisable", "armatures", "timestep", "integrator", "stiffest_drive"):
            yield f"attach({argument}={name})", lambda a=argument, v=value: wj.attach(arm, {"elbow": friction}, **{a: v})
        yield f"attach(armature={name})", lambda v=value: wj.attach(arm, {"elbow": friction}, armatures={"elbow": v})
        for method in ("reset", "settled", "__getitem__", "of"):
            yield f"bound.{method}({name})", lambda m=method, v=value: getattr(bound, m)(v)
        yield f"bound.reset(speed={name})", lambda v=value: bound.reset(1, v)
        yield f"randomise({name})", lambda v=value: bound.randomise(v, coulomb=(0.5, 1))
        for argument in ("ids", "coulomb", "warm", "speed", "rng", "nonsense"):
            yield f"randomise({argument}={name})", lambda a=argument, v=value: bound.randomise(worlds, **{"warm": (0, 1), a: v})


def robot_log(joints=2):
    """20 s of a robot's joints, short enough to be refused or answered soon."""
    import numpy as np

    t = np.arange(0, 20, 0.02)
    motion = [np.sin((1 + 0.3 * j) * t) for j in range(joints)]
    return {"time": t, "position": np.stack(motion, axis=1), "torque": np.stack([2 * np.sign(np.gradient(one)) for one in motion], axis=1)}


def robot_calls(odd, folder):
    """(name, call) of whole robots."""
    import mujoco
    import numpy as np
    import warmjoint as wj

    model, log = os.path.join(folder, "r.xml"), robot_log()
    with open(model, "w", encoding="utf-8") as file:
        file.write(ROBOT)
    robot = wj.identify_robot(model, log)
    saved = os.path.join(folder, "robot.json")
    robot.save(saved)
    # a log that stops early, so that each call is short
    few = {name: values[:4] for name, values in log.items()}
    for name, value in odd.items():
        yield f"identify_robot(model={name})", lambda v=value: wj.identify_robot(v, few)
        yield f"identify_robot(log={name})", lambda v=value: wj.identify_robot(model, v)
        yield f"identify_robot(log=[{name}])", lambda v=value: wj.identify_robot(model, [v])
        for column in log:
            yield f"identify_robot({column}={name})", lambda c=column, v=value: wj.identify_robot(model, {**few, c: v})
        for argument in ("map", "unit", "scale", "columns", "rate", "joints", "gear", "inertials", "tool", "coupling", "cutoff", "torque_constant",
                         "holdout", "nonsense"):
            yield f"identify_robot({argument}={name})", lambda a=argument, v=value: wj.identify_robot(model, few, **{a: v})
        for argument in ("gear", "torque_constant", "scale", "map", "unit", "tool"):
            for key in ("shoulder", "position", "torque", "elbow.torque", "mass", "com", "a\x1b[2J\nb"):
                given = {"mass": 1, key: value} if argument == "tool" and key == "com" else {key: value}
                yield f"identify_robot({argument}[{key!r}]={name})", lambda a=argument, g=given: wj.identify_robot(model, few, **{a: g})
        for argument in ("columns", "joints", "coupling"):
            yield f"identify_robot({argument}=[{name}])", lambda a=argument, v=value: wj.identify_robot(model, few, **{a: [v]})
        yield f"load_robot({name})", lambda v=value: wj.load_robot(v)
        yield f"RobotEstimate({name})", lambda v=value: len(wj.RobotEstimate(v))
        for method in ("plot", "__getitem__", "__contains__", "save", "export"):
            yield f"robot.{method}({name})", lambda m=method, v=value: getattr(robot, m)(v)
        for argument in ("warm", "speed"):
            yield f"robot.export({argument}={name})", lambda a=argument, v=value: robot.export("mjcf", **{a: v})
    for name, empty in (("list", []), ("tuple", ()), ("dict", {}), ("arrays", {key: values[:0] for key, values in log.items()}), ("time", {"time": log["time"]}),
                        ("one", {key: values[:1] for key, values in log.items()}), ("set", set())):
        yield f"identify_robot(empty {name})", lambda e=empty: wj.identify_robot(model, e)
    for name, spoilt in (("nan", np.nan), ("zero", 0.0), ("back", -1.0), ("huge", 1e300), ("tiny", 1e-300), ("inf", np.inf)):
        for column in log:
            yield f"identify_robot({column} {name})", lambda c=column, f=spoilt: wj.identify_robot(model, {**log, c: log[c] * f})
    yield "identify_robot(model of an engine)", lambda: wj.identify_robot(mujoco.MjModel.from_xml_string("<mujoco/>"), few)
    yield "identify_robot(spec)", lambda: wj.identify_robot(mujoco.MjSpec.from_string("<mujoco><worldbody><body><joint/></body></worldbody></mujoco>"), few)


def tool_calls(odd, log, estimate, friction):
    """(name, call) of what stands beside identification: cuts, frames, comparisons, exports, arrays of friction."""
    import mujoco
    import warmjoint as wj

    arm = """<mujoco><worldbody><body><joint name="elbow" armature="1"/><geom size="0.1"/></body></worldbody></mujoco>"""
    attached = wj.attach(arm, {"elbow": friction})
    model = attached.spec.compile()
    data, other = mujoco.MjData(model), mujoco.MjModel.from_xml_string(arm)
    bare, arrays = wj.split(attached)
    yield "bind(other data)", lambda: wj.bind(model, mujoco.MjData(other))
    yield "bind(other model)", lambda: wj.bind(other, data)
    for name, value in odd.items():
        yield f"bind({name})", lambda v=value: wj.bind(v, data)
        yield f"bind(data={name})", lambda v=value: wj.bind(model, v)
        yield f"attached.bind({name})", lambda v=value: attached.bind(v, data)
        yield f"attached.bind(data={name})", lambda v=value: attached.bind(model, v)
        yield f"attached.bind(prefix={name})", lambda v=value: attached.bind(model, data, v)
        yield f"split({name})", lambda v=value: wj.split(v)
        yield f"split(spec={name})", lambda v=value: wj.split(attached, v)
        for number in ("coulomb", "viscous", "thermal_gain", "static", "nonsense"):
            yield f"arrays.changed({number}={name})", lambda n=number, v=value: arrays.changed(**{n: v})
        yield f"arrays.in_model({name})", lambda v=value: arrays.in_model(v)
        yield f"arrays.in_model(prefix={name})", lambda v=value: arrays.in_model(bare, v)
        yield f"compare({name})", lambda v=value: wj.compare(v)
        yield f"compare(estimate, {name})", lambda v=value: wj.compare(estimate, v)
        yield f"compare({name}, estimate)", lambda v=value: wj.compare(v, estimate)
        yield f"laws({name})", lambda v=value: wj.laws(v)
        for argument in ("to", "warm", "speed", "joint"):
            yield f"export({argument}={name})", lambda a=argument, v=value: estimate.export(**{"to": "isaaclab", "joint": "j", a: v})
        yield f"between({name})", lambda v=value: log.between(v, 5)
        yield f"between(end={name})", lambda v=value: log.between(0, v)
        yield f"log[{name}:]", lambda v=value: log[v:]
        yield f"log.plot(style={name})", lambda v=value: log.plot(style=v)
        for argument in ("ax", "style", "figure"):
            yield f"plot({argument}={name})", lambda a=argument, v=value: estimate.plot(**{a: v})
        yield f"from_frame({name})", lambda v=value: wj.Log.from_frame(v)
        for argument in ("time", "position", "torque", "map", "unit", "scale"):
            yield f"from_frame({argument}={name})", lambda a=argument, v=value: wj.Log.from_frame(samples(), **{a: v})
        for argument in ("log", "force"):
            yield f"load({argument}={name})", lambda a=argument, v=value: wj.load("estimate.json", **{a: v})
        yield f"score(log={name})", lambda v=value: wj.score(estimate, {"friction": friction.data}, v)
        yield f"score(estimate={name})", lambda v=value: wj.score(v, {"friction": friction.data})
        for argument in ("position", "heat", "band", "load"):
            yield f"estimate.friction({argument}={name})", lambda a=argument, v=value: estimate.friction(1.0, **{a: v})
        yield f"reference.start({name})", lambda v=value: wj.reference.start(v)


def compensator_calls(odd, log, estimate, friction):
    """(name, call) of compensation."""
    import warmjoint as wj

    held = wj.Compensator(friction)
    for name, value in odd.items():
        yield f"Compensator({name})", lambda v=value: wj.Compensator(v)
        for argument in ("level_std", "heat_std", "noise", "noise_time", "share", "dead_band", "most_speed", "longest_gap", "contact_time", "deviations",
                         "heat", "correct", "nonsense"):
            yield f"compensator({argument}={name})", lambda a=argument, v=value: estimate.compensator(**{a: v})
            yield f"Compensator({argument}={name})", lambda a=argument, v=value: wj.Compensator(friction, **{a: v})
        yield f"step({name})", lambda v=value: held.step(v)
        for argument in ("torque", "dt", "position", "motor_position", "load", "ambient_rise", "reference"):
            yield f"step({argument}={name})", lambda a=argument, v=value: held.step(1.0, **{a: v})
        for method in ("run", "rest", "restore"):
            yield f"compensator.{method}({name})", lambda m=method, v=value: getattr(held, m)(v)
        yield f"restore(seconds_off={name})", lambda v=value: held.restore(held.state, v)
        yield f"restore(energy={name})", lambda v=value: held.restore({**held.state, "energy": v})


def native_calls(odd, friction):
    """(name, call) of friction as MuJoCo's springs."""
    import mujoco
    import warmjoint as wj

    arm = """<mujoco><worldbody><body><joint name="elbow" armature="1"/><geom size="0.1"/></body></worldbody></mujoco>"""
    own = wj.native(arm, {"elbow": friction})
    data, other = mujoco.MjData(own.model), mujoco.MjData(mujoco.MjModel.from_xml_string(arm))
    yield "native.step(other data)", lambda: own.step(other)
    for name, value in odd.items():
        yield f"native({name})", lambda v=value: wj.native(v, {"elbow": friction})
        yield f"native(frictions={name})", lambda v=value: wj.native(arm, v)
        for argument in ("approximate", "armatures", "timestep", "integrator", "nonsense"):
            yield f"native({argument}={name})", lambda a=argument, v=value: wj.native(arm, {"elbow": friction}, **{a: v})
        yield f"native.bind({name})", lambda v=value: own.bind(v)
        yield f"native.bind(prefix={name})", lambda v=value: own.bind(own.model, v)
        for method in ("start", "step", "warm"):
            yield f"native.{method}({name})", lambda m=method, v=value: getattr(own, m)(v)
        for argument in ("warm", "speed"):
            yield f"native.start({argument}={name})", lambda a=argument, v=value: own.start(data, **{"warm": 1, a: v})
        for argument in ("nstep", "every"):
            yield f"native.step({argument}={name})", lambda a=argument, v=value: own.step(data, **{a: v})
        yield f"native.warm(steps={name})", lambda v=value: own.warm(data, v)


def calls(group, folder):
    """(name, call) of a group."""
    import warmjoint as wj

    log = wj.Log(**samples())
    estimate = wj.identify(log, "nominal-ls")
    saved = os.path.join(folder, "estimate.json")
    estimate.save(saved)
    friction = wj.Friction(viscous=1, coulomb=2, thermal_gain=-0.1, thermal_time_constant=50)
    odd = oddities()
    if group == "columns":
        for name, value in odd.items():
            for column in ("time", "position", "velocity", "torque", "load", "temperature"):
                yield f"Log({column}={name})", lambda c=column, v=value: wj.Log(**{**samples(), c: v})
    elif group == "settings":
        for name, value in odd.items():
            for setting in ("joint", "unit", "scale", "gear", "torque_constant", "wrap", "trim", "shortest_hold", "name", "rate"):
                yield f"Log({setting}={name})", lambda s=setting, v=value: wj.Log(**samples(), **{s: v})
    elif group == "files":
        for name, value in odd.items():
            for function in (wj.read, wj.load, wj.Friction.load, log.save, estimate.save, friction.save, estimate.report, wj.compare):
                yield f"{function.__name__}({name})", lambda f=function, v=value: f(v)
            yield f"read(map={name})", lambda v=value: wj.read(saved, map=v)
            yield f"read(columns={name})", lambda v=value: wj.read(saved, columns=v)
    elif group == "identify":
        for name, value in odd.items():
            yield f"identify({name})", lambda v=value: wj.identify(v)
            for argument in ("method", "gravity", "motion", "start", "relevance", "holdout", "progress", "law", "torque_lag", "unit", "force", "nonsense"):
                if (argument, name) == ("progress", "type"):  # int, which raises of words
                    continue
                yield f"identify({argument}={name})", lambda a=argument, v=value: wj.identify(log, **{"method": "nominal-ls", a: v})
            yield f"check({name})", lambda v=value: wj.check(v)
    elif group == "friction":
        for name, value in odd.items():
            yield f"Friction({name})", lambda v=value: wj.Friction(v)
            for argument in ("coulomb", "viscous", "thermal_gain", "thermal_time_constant", "gear", "maps", "second"):
                yield f"Friction({argument}={name})", lambda a=argument, v=value: wj.Friction(**{"viscous": 1, "coulomb": 1, a: v})
            yield f"from_dict({name})", lambda v=value: wj.Friction.from_dict(v)
            yield f"from_dict(maps={name})", lambda v=value: wj.Friction.from_dict({"law": "coulomb", "parameters": {"coulomb": 1}, "maps": v})
            for method in ("__call__", "settled_heat"):
                yield f"friction.{method}({name})", lambda m=method, v=value: getattr(friction, m)(v)
            for argument in ("heat", "speed", "dt", "position", "load"):
                arguments = {"heat": 0, "speed": 1, "dt": 1}
                yield f"step({argument}={name})", lambda a=argument, v=value, g=arguments: friction.step(**{**g, a: v})
            yield f"changed({name})", lambda v=value: friction.changed("coulomb", v)
            yield f"changed(of {name})", lambda v=value: friction.changed(v, 1)
    elif group == "estimate":
        for name, value in odd.items():
            for method in ("friction", "predict", "plot", "__getitem__", "__contains__", "temperature_rise", "loss"):
                yield f"estimate.{method}({name})", lambda m=method, v=value: getattr(estimate, m)(v)
            yield f"predict(initial={name})", lambda v=value: estimate.predict(log, v)
            yield f"score({name})", lambda v=value: wj.score(estimate, v)
            for member in ("status", "parameters", "friction", "covariance", "identifier", "recording", "trace"):
                broken = {**estimate.data, member: value}
                yield f"Estimate({member}={name})", lambda d=broken: wj.Estimate(d, log).to_json()
            yield f"log[{name}]", lambda v=value: log[v]
    elif group == "attach":
        yield from attach_calls(odd, friction)
    elif group == "robot":
        yield from robot_calls(odd, folder)
    elif group == "compensator":
        yield from compensator_calls(odd, log, estimate, friction)
    elif group == "native":
        yield from native_calls(odd, friction)
    elif group == "tools":
        yield from tool_calls(odd, log, estimate, friction)
    else:
        for name, value in odd.items():
            yield f"simulate({name})", lambda v=value: wj.simulate(v)
            for argument in ("friction", "motion", "duration", "noise", "seed", "realization"):
                yield f"simulate({argument}={name})", lambda a=argument, v=value: wj.simulate(
                    {"friction": {"law": "coulomb", "parameters": {"coulomb": 2}}, "motion": {"speeds": [0.5, 1], "hold": 5}, "duration": 20},
                    **{a: v})
            yield f"run({name})", lambda v=value: wj.run(v, os.path.join(folder, "run"), realizations=1)


GROUPS = ["columns", "settings", "files", "identify", "friction", "estimate", "attach", "robot", "tools", "compensator", "native", "engine"]


def inside(group):
    """Makes the calls of a group: a line with the name of each before it is made, and one with its fault."""
    import warmjoint as wj

    allowed = (wj.BadInput, wj.Rejected, TypeError, KeyError, OSError, ImportError)
    os.chdir(tempfile.mkdtemp(prefix="attack_"))
    warnings.simplefilter("ignore")
    for name, call in calls(group, os.getcwd()):
        print("call", name, flush=True)
        try:
            call()
        except allowed as refusal:
            text = said(refusal)
            if not text.strip() or len(text) > 20_000:
                print("fault", name, type(refusal).__name__, "says nothing, or a book")
            elif isinstance(refusal, wj.BadInput) and OPTION.search(text):
                print("fault", name, "speaks of options:", text[:300])
            elif isinstance(refusal, wj.BadInput) and CONTROL.search(text):
                print("fault", name, "speaks raw:", ascii(text)[:300])
            elif isinstance(refusal, TypeError) and not NAMES.search(text):
                print("fault", name, "a TypeError of the inside:", text[:300])
        except BaseException as fault:
            print("fault", name, type(fault).__name__, ascii(said(fault))[:300])
    print("end", flush=True)


def main():
    if sys.argv[1:2] == ["--inside"]:
        return inside(sys.argv[2])
    if sys.argv[1:2] == ["--many"]:
        return many(int(sys.argv[2]))
    count, faults = 0, []
    for group in GROUPS:
        with tempfile.TemporaryDirectory(prefix="attack_") as temporary:
            try:
                done = subprocess.run([sys.executable, __file__, "--inside", group], env={**os.environ, "TMPDIR": temporary}, capture_output=True,
                                      text=True, errors="replace", timeout=SECONDS, check=False)
                status, lines = done.returncode, done.stdout.splitlines()
            except subprocess.TimeoutExpired as late:
                status, lines = "no end", (late.stdout or b"").decode("utf-8", "replace").splitlines()
        made = [line for line in lines if line.startswith("call ")]
        count += len(made)
        faults += [line for line in lines if line.startswith("fault ")]
        if not lines or lines[-1] != "end":
            faults.append(f"{group}: status {status} after {made[-1:] or done.stderr[-300:]}")
    print(f"{count} calls, {len(faults)} faults")
    for fault in faults[:60]:
        print(" ", fault)
    sys.exit(1 if faults or count < 1000 else 0)


if __name__ == "__main__":
    main()
