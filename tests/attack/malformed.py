#!/usr/bin/env python3
"""Some 700 malformed recordings, options, scenarios, suites, JSON files and models. malformed.py WARMJOINT"""

import json
import os
import sys

from attack import FRICTION, RECORDING, SCENARIO, Attack, suite

NUMBERS = ["x", "inf", "-inf", "1e999", "0x10", "1,5", "1e", "--1", "+-1", "1.2.3", "\u0663", "1_000",
           "1\x00", "\ufeff1", "true", "=1+1", "\x1b[31m1", "1 2", "'1'", "1e+", ".", "e5", "1f", "0b1"]
VALUES = ["x", "nan", ".inf", "-1", "1e999", "[]", "{}", "[1, 2, 3]", "'1'x", "&a [*a]", "!!binary x", "1e308"]
KEYS = ["friction", "friction.law", "friction.parameters.viscous", "friction.thermal.thermal_gain",
        "friction.thermal.thermal_time_constant", "friction.gear", "motion", "motion.speeds", "motion.hold", "motion.order",
        "motion.rests", "motion.travel", "noise.torque", "sampling.rate", "sampling.sensor_rate", "sampling.cutoff",
        "duration", "timestep", "seed", "plant", "robot", "joint_kind", "initial_energy", "controller.bandwidth",
        "disturbances.outliers"]


def recordings(attack):
    rows = RECORDING.splitlines()
    for column in range(4):
        for number in NUMBERS:
            cells = rows[30].split(",")
            cells[column] = number
            text = "\n".join([*rows[:30], ",".join(cells), *rows[31:]]) + "\n"
            attack.file("log.csv", text)
            attack.expect(f"recording {column} {number!r}", ["check", "log.csv"], (2,), "log.csv")
    header, body = rows[0], "\n".join(rows[1:]) + "\n"
    texts = {
        "empty": b"", "blank": b"\n\n\n", "header": header + "\n", "one row": header + "\n0,0,1,1\n",
        "no header": body, "twice": header.replace("velocity", "time") + "\n" + body, "short": header + "\n0,0\n" + body,
        "utf32": RECORDING.encode("utf-32"), "latin": b"zeit\xe4,p\n1,2\n",
        "binary": bytes(range(256)) * 40, "png": b"\x89PNG\r\n\x1a\n" + bytes(500), "elf": b"\x7fELF" + bytes(500),
        "nul": RECORDING.encode().replace(b"1", b"\x00"), "commas": "," * 1_000_000, "wide": "a," * 200_000 + "\n",
        "wide row": header + "\n" + "1," * 200_000 + "\n", "quotes": '"' * 100_001, "open": header + '\n"0,0,1,1\n' + body,
        "long": "a" * 5_000_000, "backwards": header + "\n3,0,1,1\n2,0,1,2\n1,0,1,3\n", "same time": header + "\n" + "0,0,1,1\n" * 9,
        "constant": header + "\n" + "".join(f"{i},0,1,5\n" for i in range(9)), "semicolons": RECORDING.replace(",", ";", 4),
        "json": json.dumps({"time": [1]}), "yaml": SCENARIO, "html": "<html>",
        "controls": "\x1b]0;x\x07,\x9b31m,\u202e\n1,2,3\n", "huge": header + "\n" + "1" * 400_000 + ",0,1,1\n",
    }
    for name, text in texts.items():
        attack.file("log.csv", text)
        attack.expect(f"recording {name}", ["check", "log.csv"], (2,), "log.csv")
        attack.expect(f"identify {name}", ["identify", "log.csv", "-o", "e.json"], (2,), "log.csv")
        os.rename(attack.work / "log.csv", attack.work / "log.h5")
        attack.expect(f"hdf5 {name}", ["check", "log.h5"], (2,), "log.h5")
        os.unlink(attack.work / "log.h5")


def options(attack):
    attack.file("log.csv", RECORDING)
    bad = ["", "=", "x", "torque", "torque=", "=torque", "torqe=torque", "torque=no", "torque=torque,torque=time",
           "position=furlong", "time=deg", "torque=m", "\x1b[2J=x", "a=b=c", "velocity=\u202e"]
    for option in ("--map", "--unit"):
        for pair in bad:
            attack.expect(f"{option} {pair!r}", ["check", "log.csv", option, pair], (0, 2))
    for option, values in {"--gear": ["0", "nan", "inf", "x", ""], "--joint": ["linaer", "", "2"],
                           "--identifier": ["", "energi-ml", "x" * 5000, "a=b"],
                           "--set": ["", "x", "x=1", "=1", "initial_energy=", "initial_energy=nope"],
                           "-o": ["/dev/null/x", "/proc/x.json", "nope/e.json", "x" * 400, "log.csv", "/dev/zero", "."]}.items():
        for value in values:
            attack.expect(f"{option} {value[:20]!r}", ["identify", "log.csv", option, value], (2,))
    attack.file("s.yaml", SCENARIO)
    attack.file("t.yaml", suite())
    for option in ("--seed", "--realization"):
        for value in ["-1", "", "x", "1.5", "18446744073709551616", "1e3", "0x1", "nan", "1 1"]:
            attack.expect(f"{option} {value!r}", ["simulate", "s.yaml", option, value, "-o", "S"], (2,), option)
    for option in ("--realizations", "--jobs"):
        for value in ["-1", "0", "", "x", "1.5", "2147483648", "4294967297", "99999999999999999999"]:
            attack.expect(f"{option} {value!r}", ["run", "t.yaml", option, value, "-o", "R"], (2,), option)
    for value in ["", "0/1", "2/1", "1/0", "-1/2", "1", "a/b", "1/2/3", "1/99999999999"]:
        attack.expect(f"--shard {value!r}", ["run", "t.yaml", "--shard", value, "-o", "R"], (2,))
    for arguments in [[], ["nope"], ["--nope"], ["check"], ["check", "a", "--nope"], ["list", "nope"], ["compare"],
                      ["merge"], ["plot", "nope", "-o", "p"], ["report", "nope"], ["compare", "nope"], ["merge", "a", "-o", "m"]]:
        attack.expect(f"arguments {arguments}", arguments, (2,))
    for name in ("log.csv", "s.yaml", "t.yaml"):
        os.unlink(attack.work / name)


def scenarios(attack):
    attack.file("s.yaml", SCENARIO)
    for key in KEYS:
        for value in VALUES:
            setting = f"{key}={value}"
            attack.expect(f"--set {setting}", ["simulate", "s.yaml", "--set", setting, "-o", "S"], (0, 2))
    laughs = "a0: &a0 [1, 1]\n" + "".join(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]\n" for i in range(1, 12))
    texts = {
        "empty": "", "list": "[]", "text": "hello", "tab": "a:\n\t- b", "open": "a: [", "cycle": "friction: &a {maps: [*a]}",
        "cycle at the root": "&a {friction: *a}", "laughs": laughs + SCENARIO, "deep": "a: " + "[" * 100_000,
        "deep maps": "".join(" " * i + "a:\n" for i in range(2000)), "binary": bytes(range(256)), "latin": b"name: \xe4\n",
        "nul": b"name: \x00\n", "twice": SCENARIO + "duration: 5\n", "unknown": SCENARIO + "durration: 5\n",
        "no motion": "friction: " + FRICTION + "\nduration: 5\n", "no friction": "duration: 5\n",
        "key list": "? [1]\n: 2\n", "merge": "<<: *x\n", "two": SCENARIO + "---\n" + SCENARIO,
        "surrogate": b"name: \xed\xa0\x80\n", "file": "friction: ../../../etc/passwd\nmotion: {speeds: [1], hold: 1}\nduration: 5\n",
        "device": "friction: /dev/zero\nmotion: {speeds: [1], hold: 1}\nduration: 5\n", "long": "a" * 20_000_000,
        "tilde": SCENARIO.replace("viscous: 5", '"~x": {uniform: [0, 1]}'), "dot": SCENARIO.replace("viscous: 5", '"a.": 1'),
        "hold": SCENARIO.replace("hold: 5", "hold: 1e-9"), "travel": SCENARIO.replace("hold: 5", "travel: [0, 1e-9]"),
        "memory": SCENARIO.replace("duration: 120", "duration: 1e8") + "sampling: {rate: 1}\n",
        "rate": SCENARIO + "sampling: {rate: 1e12}\n", "timestep": SCENARIO + "timestep: 1e-300\nplant: mujoco\nrobot: pendulum\njoint: hinge\n",
    }
    for name, text in texts.items():
        attack.file("s.yaml", text)
        attack.expect(f"scenario {name}", ["simulate", "s.yaml", "-o", "S"], (2,))
        attack.file("t.yaml", text)
        attack.expect(f"as a suite {name}", ["run", "t.yaml", "-o", "R"], (2,))
    os.unlink(attack.work / "t.yaml")
    os.unlink(attack.work / "s.yaml")


def suites(attack):
    good = suite()
    texts = {
        "count": good.replace("realizations: 3", "realizations: 2147483648"),
        "more": good.replace("realizations: 3", "realizations: 9223372036854775807"),
        "many": good.replace("realizations: 3", "realizations: 1000000000"), "minus": good.replace("realizations: 3", "realizations: -1"),
        "half": good.replace("realizations: 3", "realizations: 1.5"), "none": good.replace("[{name: nominal-ls}, {name: energy-ml}]", "[]"),
        "unknown": good.replace("nominal-ls", "nominal_ls"), "label": good.replace("{name: energy-ml}", "{name: nominal-ls}"),
        "option": good.replace("{name: energy-ml}", "{name: energy-ml, options: {nope: 1}}"), "question": good.replace("question", "qestion"),
        "command": suite('[{name: external, options: {command: "touch x {recording} {estimate}"}}]'),
        "no estimate": suite('[{name: external, options: {command: "true"}}]'),
        "seed": good + "seed: -1\n", "seed twice": good.replace("  duration", "  seed: 4\n  duration"),
        "ladder": good + "ladder: {variable: nope, values: [1]}\n", "ladder text": good + "ladder: {variable: noise.torque, values: [x]}\n",
        "long ladder": good + "ladder: {variable: noise.torque, values: [" + ", ".join(map(str, range(20_000))) + "]}\n",
        "both": good + "ladder: {variable: noise.torque, values: [1], variants: {a: {}}}\n", "neither": good + "ladder: {}\n",
        "variant": good + "ladder: {variants: {a: {nope: 1}}}\n", "claim": good.replace("{name: energy-ml}", "{name: energy-ml, claim: {fit: 1}}"),
        "too large": good.replace("realizations: 3", "realizations: 10000000") + "ladder: {variable: noise.torque, values: ["
        + ", ".join(map(str, range(1000))) + "]}\n",
    }
    for name, text in texts.items():
        attack.file("t.yaml", text)
        attack.expect(f"suite {name}", ["run", "t.yaml", "-o", "R"], (2,))
    os.unlink(attack.work / "t.yaml")


def leaves(value, path=()):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, (*path, key))
    elif isinstance(value, list) and value:
        yield from leaves(value[0], (*path, 0))
    yield path


def replaced(value, path, new):
    if not path:
        return new
    copy = dict(value) if isinstance(value, dict) else list(value)
    copy[path[0]] = replaced(value[path[0]], path[1:], new)
    return copy


def json_files(attack):
    attack.file("log.csv", RECORDING)
    attack.run(["identify", "log.csv", "--identifier", "nominal-ls", "--force", "-o", "good.json"])
    good = json.loads((attack.work / "good.json").read_text())
    os.unlink(attack.work / "good.json")
    model = '<mujoco><worldbody><body><joint name="j" type="hinge"/><geom size="0.1" mass="9"/></body></worldbody></mujoco>'
    attack.file("m.xml", model)
    for path in leaves(good):
        for new in (None, -1, "x", [[]], {"a": 1}):
            attack.file("e.json", json.dumps(replaced(good, path, new)))
            name = f"estimate {'.'.join(map(str, path))} = {new}"
            attack.expect(name, ["attach", "m.xml", "--joint", "j=e.json", "-o", "o.xml"], (0, 2))
    texts = {"empty": "", "null": "null", "number": "1", "overflow": '{"friction": 1e999}', "deep": "[" * 100_000,
             "deep objects": '{"a":' * 100_000, "latin": b'{"a": "\xe4"}', "surrogate": b'{"a": "\\ud800"}', "open": '{"a": ',
             "twice": '{"law": "coulomb", "law": "dahl"}', "comment": "// x\n{}", "nul": b"{\x00}", "bom": b"\xef\xbb\xbf[1", "nan": '{"a": NaN}'}
    for name, text in texts.items():
        attack.file("e.json", text)
        for command in (["attach", "m.xml", "--joint", "j=e.json", "-o", "o.xml"], ["plot", "e.json", "-o", "p"]):
            attack.expect(f"json {name} {command[0]}", command, (2,), "e.json")
    os.unlink(attack.work / "e.json")


def models(attack):
    attack.file("f.json", '{"law": "coulomb", "parameters": {"coulomb": 1}}')
    body = '<body><joint name="j" type="hinge"/><geom size="0.1" mass="9"/></body>'
    texts = {
        "empty": "", "text": "hello", "open": "<mujoco>", "binary": bytes(range(256)), "deep": "<mujoco>" + "<body>" * 100_000,
        "itself": '<mujoco><include file="m.xml"/></mujoco>', "texture": '<mujoco><asset><texture builtin="flat" width="100000" height="100000"/></asset></mujoco>',
        "no joint": "<mujoco><worldbody/></mujoco>", "urdf": "<robot name='r'/>", "urdf deep": "<robot name='r'>" + "<a>" * 100_000,
        "urdf massless": "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>",
        "memory": f'<mujoco><size memory="900000G"/><worldbody>{body}</worldbody></mujoco>',
        "plugin": f'<mujoco><extension><plugin plugin="nope.nope"/></extension><worldbody>{body}</worldbody></mujoco>',
        "entities": '<!DOCTYPE a [<!ENTITY a "x"><!ENTITY b "&a;&a;">]><mujoco>&b;</mujoco>',
    }
    for name, text in texts.items():
        attack.file("m.xml", text)
        attack.expect(f"model {name}", ["attach", "m.xml", "--joint", "j=f.json", "-o", "o.xml"], (2,))
    for name in ("/dev/zero", "/dev/null", "/proc/self/mem", ".", "nope.xml", "", "x" * 300, "no\npe\x1b[31m.xml"):
        for command in (["attach", name, "--joint", "j=f.json", "-o", "o.xml"], ["check", name], ["simulate", name, "-o", "S"],
                        ["plot", name, "-o", "p"], ["identify", name]):
            attack.expect(f"name {name[:20]!r} {command[0]}", command, (2,))


def main():
    with Attack(sys.argv[1], 700) as attack:
        for family in (recordings, options, scenarios, suites, json_files, models):
            before = attack.count
            family(attack)
            print(f"{family.__name__}: {attack.count - before}", flush=True)


if __name__ == "__main__":
    main()
