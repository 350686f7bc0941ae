"""The measured machines: their cards and files, and each joint with an answer attached, exported and drawn."""

import hashlib
import importlib.machinery
import importlib.util
import json
import pathlib
import tomllib

import mujoco
import pytest
import warmjoint as wj

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "models/library"
CARDS = {file.parent.name: json.loads(file.read_text()) for file in sorted(LIBRARY.glob("*/card.json"))}
# an answer whose friction has no interval at any speed is none to count on
OK = [(name, joint["name"]) for name, card in CARDS.items() for joint in card["joints"] if joint["status"] == "ok" and joint["friction"]]
REFUSED = [(name, joint["name"]) for name, card in CARDS.items() for joint in card["joints"] if joint["status"] != "ok"]
ARM = """<mujoco><option timestep="0.001" integrator="implicitfast" gravity="0 0 0"/><worldbody><body>
  <joint name="j" type="{kind}"/><geom type="capsule" fromto="0 0 0 .5 0 0" size=".04" mass="8"/></body></worldbody></mujoco>"""


def joint_of(name, joint):
    return next(one for one in CARDS[name]["joints"] if one["name"] == joint)


def test_the_library_has_forty_joints_of_ten_machines():
    assert len(OK) >= 40
    assert len({name for name, _ in OK}) >= 10


@pytest.mark.parametrize("name", CARDS)
def test_card_tells_where_the_machine_comes_from_and_is_of_its_file(name):
    card = CARDS[name]
    for key in ("machine", "kind", "log", "remake", "made_by"):
        assert card[key], key
    assert card["not_for"] and card["source"]
    for source in card["source"]:
        assert source["repository"] and source["licence"] and source["files"]
        assert not source["repository"].startswith("github.com") or len(source["commit"]) == 40
    text = (LIBRARY / name / "robot.json").read_bytes()
    assert card["robot.json"]["sha256"] == hashlib.sha256(text).hexdigest(), "make the machine again: card and file are made together"
    robot = json.loads(text)
    assert list(robot["joints"]) == [joint["name"] for joint in card["joints"]]
    recipe = tomllib.loads((LIBRARY / name / "recipe.toml").read_text())
    assert recipe["machine"] == card["machine"] and recipe["source"] == card["source"]
    for joint in card["joints"]:
        assert robot["joints"][joint["name"]]["status"] == joint["status"]
        assert joint["command"].startswith("warmjoint identify")


@pytest.mark.parametrize(("name", "joint"), OK)
def test_joint_has_its_friction_with_an_interval(name, joint):
    card = joint_of(name, joint)
    assert card["friction"]
    for row in card["friction"]:
        low, high = row["interval95"]
        assert low <= row["value"] <= high and high > low
    estimate = wj.load(f"library:{name}/{joint}")
    assert estimate.status == "ok"
    assert {one.speed for one in estimate.friction_at_speeds} >= {row["speed"] for row in card["friction"]}


@pytest.mark.parametrize(("name", "joint"), REFUSED)
def test_refused_joint_tells_why_and_gives_no_friction(name, joint):
    assert joint_of(name, joint)["message"]
    with pytest.raises(wj.BadInput, match=r"friction|status|holds no"):
        wj.attach(ARM.format(kind="hinge"), {"j": f"library:{name}/{joint}"})


@pytest.mark.parametrize(("name", "joint"), OK)
def test_joint_is_attached_and_exported(name, joint):
    card, known = joint_of(name, joint), f"library:{name}/{joint}"
    model = ARM.format(kind="slide" if card["speed_unit"] == "m/s" else "hinge")
    if card["unit"] not in ("N.m", "N"):
        with pytest.raises(wj.BadInput, match=r"torque|holds no friction"):
            wj.attach(model, {"j": known})
        return
    # the file's law is within the card's intervals, and in the simulator it brakes; a body as heavy as that joint carries
    row = max(card["friction"], key=lambda row: row["speed"])
    estimate = wj.load(known)
    low, high = row["interval95"]
    loaded = estimate.data["friction"].get("load_gain", 0)  # the card's figures are with what the joint carried
    assert loaded or low <= abs(float(estimate.friction(speed=row["speed"]))) <= high
    attached = wj.attach(model, {"j": known}, armatures={"j": row["value"]})
    compiled = attached.spec.compile()
    data = mujoco.MjData(compiled)
    data.qvel[0] = row["speed"]
    mujoco.mj_step(compiled, data, 5)
    assert 0 <= data.qvel[0] / row["speed"] < 1, "friction brakes"
    for engine in ("mjcf", "isaaclab"):
        assert wj.load(known).export(engine, joint="j").text


def test_robot_is_attached_by_its_name():
    names = [one["name"] for one in CARDS["ur10e"]["joints"]]
    links = "".join(f'<body><joint name="{name}" axis="0 0 1"/><geom size=".5" mass="300"/></body>' for name in names)
    attached = wj.attach(f'<mujoco><option integrator="implicitfast"/><worldbody>{links}</worldbody></mujoco>', "library:ur10e")
    assert attached.joints == names


def test_library_lists_machines_with_their_frictions():
    machines = wj.library()
    assert set(machines) == set(CARDS)
    assert "elbow_joint" in str(machines["ur10e"])
    assert set(machines["ur10e"].frictions) == {joint for name, joint in OK if name == "ur10e"}


def test_unknown_names_are_refused_with_the_nearest():
    with pytest.raises(wj.BadInput, match="ur10"):
        wj.load("library:ur10f/elbow_joint")
    with pytest.raises(wj.BadInput, match="elbow_joint"):
        wj.load("library:ur10e/elbow_joynt")


def test_program_lists_attaches_and_exports(program):
    text = program("list", "library", "ur10e")
    assert "elbow_joint" in text and CARDS["ur10e"]["source"][0]["repository"] in text
    (program.folder / "arm.xml").write_text(ARM.format(kind="hinge"))
    program("attach", "arm.xml", "--joint", "j=library:ur10e/elbow_joint", "-o", "warm.xml")
    assert "warmjoint.friction" in (program.folder / "warm.xml").read_text()
    assert "elbow" in program("export", "library:ur10e", "--to", "isaaclab")


def test_scenario_takes_a_joint_of_the_library(program):
    scenario = {"friction": "library:ur10e/elbow_joint", "motion": {"speeds": {"uniform": [0.1, 0.8]}, "hold": 2}, "noise": {"torque": 0.1}, "sampling": {"rate": 50},
                "duration": 60}
    (program.folder / "elbow.yaml").write_text(json.dumps(scenario))
    program("simulate", "elbow.yaml", "-o", "elbow")
    assert (program.folder / "elbow/recording.csv").exists()


def test_page_and_sheet_are_made_of_the_cards(tmp_path):
    loader = importlib.machinery.SourceFileLoader("page", str(ROOT / "tools/library/page"))
    page = importlib.util.module_from_spec(importlib.util.spec_from_loader("page", loader))
    loader.exec_module(page)
    shown = (LIBRARY / "README.md").read_text()
    for name, card in CARDS.items():
        assert page.section(name, card) == (LIBRARY / name / "README.md").read_text(), "write the pages again: tools/library/page"
        assert page.row(name, card) in shown
    page.draw(CARDS, tmp_path / "sheet.png")
    assert (tmp_path / "sheet.png").stat().st_size > 5000
