#!/usr/bin/env python3
"""Some 1,000 hostile descriptions, logs, names, robot.json and outputs. robots.py WARMJOINT [FAMILY]...

Whatever comes: no signal, no error of the inside, no code out of a name, no raw control character, no input written over, no half file."""

import ast
import json
import math
import os
import random
import sys

from attack import Attack

NAMES = ["a\nimport os; os.system('touch owned')", "a\r\nb", "\x1b[31mred", "a\tb", "\x00", "\x7f", "\x9b31m", "\u202eabc", "\u2028x", "\ufeffx", "\ufffe",
         "a/b", "../../up", ".", "..", "", " ", "-o", "a'b\"c", "<b>&amp;", "]]>", "--><x/>", "*/ exit(1); /*", "a\\", "$(touch owned)", "{a}", "%s%n", "x" * 5000,
         "\u00e9\u00e8", "\U0001f600", "a=b", "a,b", "=1+1", "_{\\frac}", "$x$", "'''", "\"\"\"", "#", "//", "`touch owned`"]
NUMBERS = ["nan", "NaN", "-nan", "inf", "-inf", "Infinity", "-1", "x", "1,5", "", " ", "1e999", "-1e999", "1e300", "1e-320", "0", "-0", "1 2", "0x10", "1.2.3", "\u0663", "true", "9" * 400]
TEXTS = [None, -1, 0, 1e308, -1e308, 5e-324, 1e300, "x", "", [], {}, [[]], {"a": 1}, True, "\x1b[31m", "a\nb", 10**400, "1"]

URDF = """<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 .2" rpy="0 0 0"/><mass value="4"/><inertia ixx=".05" iyy=".05" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius=".1"/></geometry></collision></link>
  <link name="lower"><inertial><origin xyz="0 0 .1" rpy="0 0 0"/><mass value="2"/><inertia ixx=".02" iyy=".02" izz=".005" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="a" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 .1" rpy="0 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="50" velocity="3"/><dynamics damping="0" friction="0"/></joint>
  <joint name="b" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 .4" rpy="0 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="50" velocity="3"/></joint></robot>
"""
MJCF = """<mujoco model="arm"><compiler angle="radian"/><size nuserdata="1"/><option timestep="0.001"/>
<asset><texture name="t" builtin="flat" width="8" height="8"/><material name="m"/></asset>
<worldbody><body name="upper" pos="0 0 .1"><joint name="a" type="hinge" axis="0 1 0" range="-3 3" damping="0" armature=".01" stiffness="0"/>
  <geom name="g" type="capsule" fromto="0 0 0 0 0 .4" size=".04" mass="4" friction="1 .005 .0001"/>
  <body name="lower" pos="0 0 .4"><joint name="b" type="hinge" axis="0 1 0" range="-3 3"/><inertial pos="0 0 .1" mass="2" diaginertia=".02 .02 .005"/></body></body></worldbody>
<actuator><motor name="drive" joint="a" gear="1"/></actuator></mujoco>
"""


def log(rows=900):
    """Two joints in sines, with gravity as it is for neither: answers may be refused, their way is what counts."""
    lines = ["time,a_position,a_torque,b_position,b_torque"]
    for i in range(rows):
        t = i / 50
        cells = [t]
        for rate, inertia, friction in ((0.9, 0.9, 3), (1.3, 0.1, 1.5)):
            p, v, w = math.sin(rate * t), rate * math.cos(rate * t), -rate * rate * math.sin(rate * t)
            cells += [p, inertia * w + friction * math.copysign(1, v) + 0.8 * v - 3 * math.sin(p) + 0.05 * math.sin(71.7 * i)]
        lines.append(",".join(f"{cell:.6f}" for cell in cells))
    return "\n".join(lines) + "\n"


LOG = log()
ROBOT = ["--mjcf", "m.xml", "-o", "o.json"]


def attributes(text):
    """(begin, end) of the values of all attributes."""
    at = 0
    while (at := text.find('="', at)) >= 0:
        end = text.find('"', at + 2)
        yield at + 2, end
        at = end


def changed(text, random_one):
    """Some bytes taken out, doubled, or others."""
    data = bytearray(text, "utf-8")
    for _ in range(random_one.randint(1, 4)):
        at, length = random_one.randrange(len(data)), random_one.randrange(20)
        kind = random_one.randrange(4)
        if kind == 0:
            data[at] = random_one.randrange(256)
        elif kind == 1:
            del data[at : at + length]
        elif kind == 2:
            data[at:at] = data[at : at + length]
        else:
            data[at:at] = random_one.choice([b"<body>", b"</body>", b"<include file='r.xml'/>", b'"', b"&#10;", b"\xe9", b"\x1b", b"nan", b"-1", b"1e308", b"<!--", b"]]>"])
    return bytes(data)


def identify(attack, name, text, end, statuses=(0, 2, 3), place=""):
    attack.file("r" + end, text)
    attack.expect(f"identify-robot {name}", ["identify-robot", "r" + end, "log.csv", *ROBOT], statuses, place)
    attack.remove("r" + end)


def attach(attack, name, text, end, statuses=(0, 2), place=""):
    attack.file("r" + end, text)
    attack.file("f.json", '{"law": "coulomb", "parameters": {"coulomb": 1}}')
    attack.expect(f"attach {name}", ["attach", "r" + end, "--joint", "a=f.json", "-o", "w.xml"], statuses, place)
    attack.remove("r" + end, "f.json")


def descriptions(attack):
    attack.file("log.csv", LOG)
    identify(attack, "good urdf", URDF, ".urdf", (0, 3))
    identify(attack, "good mjcf", MJCF, ".xml", (0, 3))
    chance = random.Random(7)
    for text, end in ((URDF, ".urdf"), (MJCF, ".xml")):
        for begin, stop in attributes(text):
            # each value with some of the numbers
            for number in chance.sample(NUMBERS, 4):
                one = text[:begin] + number + text[stop:]
                name = f"{text[max(0, begin - 20) : begin]}{number}{end}"
                chance.choice((identify, attach))(attack, name, one, end)
        for _ in range(80):
            chance.choice((identify, attach))(attack, f"changed{end}", changed(text, chance), end)
    for number in ("nan", "inf", "-1", "x", "1,5"):
        identify(attack, f"mass {number}", URDF.replace('mass value="4"', f'mass value="{number}"'), ".urdf", (2,), "upper")
        identify(attack, f"inertia {number}", URDF.replace('ixx=".05"', f'ixx="{number}"'), ".urdf", (2,), "upper")
    for number in ("nan", "-1", "x", "1,5"):
        identify(attack, f"effort {number}", URDF.replace('effort="50"', f'effort="{number}"', 1), ".urdf", (2,), "'a'")
    identify(attack, "no bound", URDF.replace('effort="50"', 'effort="inf"').replace('upper="3"', 'upper="inf"'), ".urdf", (0, 3))
    attack.remove("log.csv")


def structures(attack):
    attack.file("log.csv", LOG)
    body = '<body name="{}"><joint name="{}" axis="0 1 0"/><geom size=".1" mass="1"/>{}</body>'
    many = "".join(body.format(f"b{i}", f"j{i}", "") for i in range(3000))
    deep = "".join(f'<body name="d{i}"><joint name="k{i}"/><geom size=".1"/>' for i in range(450)) + "</body>" * 450
    texts = {
        "itself": MJCF.replace("<asset>", '<include file="r.xml"/><asset>'), "replicate": f'<mujoco><worldbody><replicate count="100000000" offset="0 0 1">{body.format("a", "a", "")}</replicate></worldbody></mujoco>',
        "nested": "<mujoco><worldbody>" + '<replicate count="1000">' * 4 + '<geom size=".1"/>' + "</replicate>" * 4 + "</worldbody></mujoco>",
        "composite": '<mujoco><worldbody><body><composite type="cable" count="100000000 1 1" size="1 0 0"><geom type="capsule" size=".01"/></composite></body></worldbody></mujoco>',
        "flex": '<mujoco><worldbody><flexcomp name="f" type="grid" count="2000 2000 2000" spacing=".1 .1 .1" mass="1"/></worldbody></mujoco>',
        "texture": MJCF.replace('width="8" height="8"', 'width="1000000" height="1000000"'), "hfield": MJCF.replace("<material", '<hfield name="h" nrow="100000" ncol="100000" size="1 1 1 1"/><material'),
        "many": f"<mujoco><worldbody>{many}</worldbody></mujoco>", "deep": f"<mujoco><worldbody>{deep}</worldbody></mujoco>",
        **{f"size {key}": MJCF.replace('nuserdata="1"', f'{key}="{value}"') for key in ("nuserdata", "nkey", "nuser_body", "nuser_geom", "nuser_sensor", "njmax", "nconmax", "memory")
           for value in ("100000000", "1e8", "-5", "99999999999999")},
        "numeric": MJCF.replace("<asset>", '<custom><numeric name="n" size="100000000" data="1"/></custom><asset>'),
        "include": MJCF.replace("<asset>", '<include file="/etc/passwd"/><asset>'), "folder": MJCF.replace("<asset>", '<include file="."/><asset>'),
        "device": MJCF.replace("<asset>", '<include file="/dev/zero"/><asset>'), "mesh device": MJCF.replace("<material", '<mesh name="h" file="/dev/zero"/><material'),
        "doctype": '<!DOCTYPE a [<!ENTITY a "x">]>' + MJCF,
    }
    for name, text in texts.items():
        identify(attack, name, text, ".xml")
        attach(attack, name, text, ".xml")
    # links that hold each other, and names that stand twice
    loop = URDF.replace('<parent link="base"/>', '<parent link="lower"/>')
    twice = URDF.replace('name="lower"', 'name="upper"')
    for name, text in {"loop": loop, "twice": twice, "joints twice": URDF.replace('name="b"', 'name="a"'), "no parent": URDF.replace('<parent link="base"/>', ""),
                       "self": URDF.replace('<child link="upper"/>', '<child link="base"/>'), "mimic": URDF.replace("<dynamics", '<mimic joint="nope" multiplier="nan"/><dynamics'),
                       "xacro": URDF.replace('value="4"', 'value="${m}"').replace("<robot", '<robot xmlns:xacro="x"')}.items():
        identify(attack, name, text, ".urdf")
        attach(attack, name, text, ".urdf")
    # what is no file
    os.mkfifo(attack.work / "pipe")
    for kind in ('<include file="pipe"/>', '<asset><mesh name="p" file="pipe"/></asset>', '<asset><texture type="2d" name="p" file="pipe"/></asset>',
                 '<asset><hfield name="p" file="pipe" size="1 1 1 1"/></asset>', '<asset><model name="p" file="pipe"/></asset>'):
        text = MJCF.replace("<asset>", kind + "<asset>")
        identify(attack, kind, text, ".xml", (2,), "pipe")
        attach(attack, kind, text, ".xml", (2,), "pipe")
    mesh = URDF.replace('<sphere radius=".1"/>', '<mesh filename="pipe"/>')
    attach(attack, "mesh of a urdf", mesh, ".urdf", (2,), "pipe")
    attack.expect("robot pipe", ["identify-robot", "pipe", "log.csv", *ROBOT], (2,))
    attack.remove("pipe", "log.csv")


def names(attack):
    attack.file("log.csv", LOG)
    for name in NAMES:
        refused = any(not character.isprintable() and character != " " for character in name)
        shown = name.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
        for text, end in ((URDF, ".urdf"), (MJCF, ".xml")):
            for raw in (shown, "".join(f"&#{ord(c)};" for c in name)[:2000]):
                one = text.replace('name="a"', f'name="{raw}"').replace('joint="a"', f'joint="{raw}"')
                attack.file("r" + end, one)
                given = ["identify-robot", "r" + end, "log.csv", "--map", "position={a|b}_position,torque={a|b}_torque,time=time", *ROBOT]
                statuses = (2,) if refused and raw == shown and "\x00" not in name else (0, 2, 3)
                attack.expect(f"name {name[:20]!r}{end}", given, statuses)
                attack.remove("r" + end)
    # bytes that are no UTF-8, in a description and in the name of a log
    for text, end in ((URDF, ".urdf"), (MJCF, ".xml")):
        identify(attack, "latin" + end, text.encode().replace(b'name="a"', b'name="a\xe9"').replace(b'joint="a"', b'joint="a\xe9"'), end, (2,), "byte")
    attack.file("r.urdf", URDF)
    for latin in (b"l\xe9g.csv", b"l\x1bg.csv"):
        (attack.work / os.fsdecode(latin)).write_text(LOG)
        attack.expect(f"log {latin}", ["identify-robot", "r.urdf", latin, *ROBOT], (2,), "byte")
        attack.expect(f"identify {latin}", ["identify", latin, "-o", "e.json"], (2,), "byte")
        os.unlink(attack.work / os.fsdecode(latin))
    attack.remove("r.urdf", "log.csv")
    assert not (attack.work / "owned").exists()


def logs(attack):
    attack.file("r.urdf", URDF)
    rows = LOG.splitlines()
    chance = random.Random(5)
    for column in range(5):
        for number in ("nan", "inf", "-inf", "x", "1e999", "1e300", "", "\x1b[31m", "\u0663", "1,5"):
            cells = [row.split(",") for row in rows]
            for i in chance.choice(([40], range(1, len(rows)), range(100, 200))):
                cells[i][column] = number
            attack.file("log.csv", "\n".join(map(",".join, cells)) + "\n")
            attack.expect(f"log {column} {number!r}", ["identify-robot", "r.urdf", "log.csv", *ROBOT], (0, 2, 3))
    for _ in range(60):
        attack.file("log.csv", changed(LOG, chance))
        attack.expect("log changed", ["identify-robot", "r.urdf", "log.csv", *ROBOT], (0, 2, 3))
    for name in NAMES:
        attack.file("log.csv", LOG.replace("a_torque", name.replace("\n", "")))
        attack.expect(f"column {name[:20]!r}", ["identify-robot", "r.urdf", "log.csv", *ROBOT], (0, 2, 3))
    attack.file("log.csv", LOG)
    for option, values in {"--tool": ["mass=-5", "mass=nan", "mass=inf", "mass=1e300", "mass=x", "mass=1,com=1e300,0,0", "mass=1,com=1,2", "com=0,0,0", ""],
                           "--gear": ["1e300", "nan", "inf", "-1e300", "x", "a=1e300", "nope=3", "", "0", "1e6"],
                           "--joints": ["a,a", "a,b,a", "nope", "", ",".join(["a"] * 5000)], "--torque-constant": ["0", "nan", "1e300", "a=x"],
                           "--scale": ["torque=0", "torque=1e300", "a.torque=nan", "velocity=1"], "--coupling": ["a=a+b+", "a=1e300*a", "a", "a=a-a", "nope=a"],
                           "--inertials": ["given:-1", "given:nan", "given:1e300", "x"], "--cutoff": ["0", "nan", "1e300"], "--holdout": ["1", "nan", "-1"]}.items():
        for value in values:
            attack.expect(f"{option} {value[:30]}", ["identify-robot", "r.urdf", "log.csv", option, value, *ROBOT], (2,) if value != "0" or option != "--gear" else (0, 3))
    attack.remove("r.urdf", "log.csv")


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


def is_data(text, engine):
    """Whether what Python reads of it is numbers by names, and nothing that is called."""
    text = "{\n" + text + "}" if engine == "mjlab" else "dict(\n" + text + ")"
    calls = [node.func for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)]
    return all(isinstance(one, ast.Name) and one.id == "dict" for one in calls)


def answers(attack):
    attack.file("r.urdf", URDF)
    attack.file("log.csv", LOG)
    attack.run(["identify-robot", "r.urdf", "log.csv", "-o", "good.json"])
    good = json.loads((attack.work / "good.json").read_text())
    # a friction for each joint, whatever the log said
    for one in good["joints"].values():
        one["status"], one["friction"] = "ok", {"law": "viscous_coulomb", "parameters": {"viscous": 1.0, "coulomb": 2.0}}
        one["friction_at_speeds"] = [{"speed": v, "value": v, "std": 0.1, "interval95": [v - 1, v + 1], "speed_unit": "rad/s", "unit": "N.m"} for v in (-1.0, -0.5, 0.5, 1.0)]
    attack.remove("good.json")
    chance = random.Random(3)
    commands = [["attach", "r.urdf", "--friction", "o.json", "-o", "w.xml"], ["export", "o.json", "--to", "mjcf", "-o", "x.elements"],
                ["export", "o.json", "--to", "isaaclab", "-o", "x.py"], ["report", "o.json", "-o", "p.html"]]
    attack.file("o.json", json.dumps(good))
    for command in commands:
        attack.expect(f"good {command[:4]}", command, (0,))
    paths = [path for path in leaves(good) if path]
    for path in chance.sample(paths, min(len(paths), 150)):
        for new in chance.sample(TEXTS, 2):
            attack.file("o.json", json.dumps(replaced(good, path, new)).replace("1" + "0" * 400, "1e400" if new is not None else ""))
            command = chance.choice(commands[:3] if chance.random() < 0.8 else commands)
            attack.expect(f"robot.json {'.'.join(map(str, path))} = {str(new)[:20]} {command[0]}", command, (0, 2))
    for name in NAMES:
        text = json.dumps(good).replace('"a":', json.dumps(name) + ":")
        attack.file("o.json", text)
        for engine in ("mjcf", "urdf", "physx", "isaaclab", "mjlab"):
            end = {"mjcf": ".txt", "urdf": ".txt", "physx": ".cpp"}.get(engine, ".py")
            found = attack.expect(f"export {name[:20]!r} {engine}", ["export", "o.json", "--to", engine], (0, 2))
            if found and found.returncode == 0 and end == ".py" and not is_data(found.stdout.decode(), engine):
                attack.fault(f"export {name!r} {engine}", "is code")
        attack.expect(f"report {name[:20]!r}", ["report", "o.json", "-o", "p.html"], (0, 2))
        attack.expect(f"attach {name[:20]!r}", commands[0], (0, 2))
    # numbers that no axis holds, and many joints
    for value in (1e308, -1e308, 5e-324, 0, 1e99):
        one = json.loads(json.dumps(good))
        one["joints"]["a"]["friction_at_speeds"][0].update(interval95=[-value, value], value=value)
        attack.file("o.json", json.dumps(one))
        attack.expect(f"report of {value}", commands[3], (0, 2))
    joints = {f"j{i}": good["joints"]["a"] for i in range(130)}
    attack.file("o.json", json.dumps({**good, "joints": joints, "summary": {name: good["summary"]["a"] for name in joints}}))
    attack.expect("report of many joints", commands[3], (0,), timeout=120)
    attack.remove("o.json", "r.urdf", "log.csv")


def outputs(attack):
    (attack.work / "parts").mkdir()
    attack.file("parts/link.stl", b"solid x\nendsolid x\n")
    inner = '<mujocoinclude><body name="upper"><joint name="a" axis="0 1 0"/><geom size=".1" mass="4"/><body name="lower" pos="0 0 .4"><joint name="b" axis="0 1 0"/><geom size=".1" mass="2"/></body></body></mujocoinclude>'
    attack.file("parts/body.xml", inner)
    attack.file("r.xml", '<mujoco><compiler meshdir="parts"/><asset><mesh name="unused" file="link.stl"/></asset><worldbody><include file="parts/body.xml"/></worldbody></mujoco>')
    attack.file("plain.xml", MJCF)
    attack.file("r.urdf", URDF)
    attack.file("log.csv", LOG)
    attack.file("f.json", '{"law": "coulomb", "parameters": {"coulomb": 1}}')
    os.symlink("log.csv", attack.work / "link.csv")
    inputs = ["parts/body.xml", "parts/link.stl", "r.xml", "./parts/../r.xml", "f.json"]
    for target in inputs:
        attack.expect(f"attach onto {target}", ["attach", "r.xml", "--joint", "a=f.json", "-o", target], (2,), target)
    for target in ("parts/body.xml", "parts/link.stl", "r.xml", "log.csv", "link.csv"):
        for option in ("-o", "--mjcf"):
            attack.expect(f"identify-robot {option} {target}", ["identify-robot", "r.xml", "log.csv", option, target], (2,), target)
    # pictures in a folder with an input of their name
    (attack.work / "a.png").write_text("mine")
    attack.expect("picture on a log", ["identify-robot", "plain.xml", "log.csv", "--plot", "log.csv"], (2,), "log.csv")
    attack.expect("one name twice", ["identify-robot", "plain.xml", "log.csv", "-o", "o.json", "--mjcf", "o.json"], (2,), "o.json")
    attack.expect("picture with another end", ["identify", "log.csv", "--plot", "log.csv"], (2,), "log.csv")
    attack.expect("nowhere", ["identify-robot", "plain.xml", "log.csv", "-o", "no/o.json"], (2,), "no")
    attack.expect("nowhere model", ["identify-robot", "plain.xml", "log.csv", "-o", "o.json", "--mjcf", "no/m.xml"], (2,), "no")
    attack.expect("report onto itself", ["report", "f.json", "-o", "f.json"], (2,), "f.json")
    # a model that cannot be attached to leaves no answer
    attack.file("bad.urdf", URDF.replace('<sphere radius=".1"/>', '<mesh filename="no.stl"/>'))
    attack.expect("model that is not made", ["identify-robot", "bad.urdf", "log.csv", *ROBOT], (0, 2, 3))
    # two joints whose pictures would have one name
    twins = MJCF.replace('name="a"', 'name="x/y"').replace('joint="a"', 'joint="x/y"').replace('name="b"', 'name="x_y"')
    attack.file("t.xml", twins)
    before = attack.state()
    done = attack.run(["identify-robot", "t.xml", "log.csv", "--map", "position={a|b}_position,torque={a|b}_torque,time=time", "--plot", "pictures"], 120)
    drawn = sorted(path.name for path in (attack.work / "pictures").iterdir()) if (attack.work / "pictures").exists() else []
    attack.count += 1
    if len(drawn) not in (0, 2):
        attack.fault("twins", f"{done.returncode}: {drawn}")
    attack.clear(before)
    attack.clear([])


def surroundings(attack):
    """What lies in the working folder changes no picture and breaks none."""
    attack.file("log.csv", LOG.replace("a_position", "position").replace("a_torque", "torque"))
    draw = ["check", "log.csv", "--plot", "fit.png"]
    attack.run(draw)
    wanted = (attack.work / "fit.png").read_bytes()
    attack.remove("fit.png")
    traps = {**{f"{module}.py": "import os; os.system('touch owned'); raise SystemExit(9)" for module in ("matplotlib", "jinja2", "numpy", "json", "PIL", "sitecustomize", "re", "os")},
             "matplotlibrc": "backend: nope\nfont.size: 40\nsavefig.dpi: 7\n"}
    for name, text in traps.items():
        attack.file(name, text)
    for variables in ({}, {"MPLBACKEND": "nope"}, {"PYTHONPATH": "."}, {"PYTHONPATH": ":"}, {"MATPLOTLIBRC": str(attack.work / "matplotlibrc")}, {"PYTHONSTARTUP": "json.py"}):
        earlier = dict(attack.environment)
        attack.environment.update(variables)
        done = attack.run(draw, 120)
        attack.count += 1
        if done.returncode != 0 or (attack.work / "fit.png").read_bytes() != wanted:
            attack.fault(f"surroundings {variables}", f"{done.returncode}: {done.stderr[-300:]!r}")
        if (attack.work / "owned").exists():
            attack.fault(f"surroundings {variables}", "code of the working folder ran")
        attack.environment = earlier
    attack.clear([])


FAMILIES = (descriptions, structures, names, logs, answers, outputs, surroundings)


def main():
    wanted = sys.argv[2:]
    with Attack(sys.argv[1], 0 if wanted else 1000) as attack:
        for family in FAMILIES:
            if wanted and family.__name__ not in wanted:
                continue
            before = attack.count
            family(attack)
            print(f"{family.__name__}: {attack.count - before}, {len(attack.faults)} faults so far", flush=True)


if __name__ == "__main__":
    main()
