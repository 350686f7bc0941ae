"""What the pages of `warmjoint report` hold, as data and words. Made-up views stand for those of C++ (shown.py)."""

import base64
import io

import numpy as np
import pytest

pytest.importorskip("matplotlib")
import shown
from warmjoint.figures import friction, log_page, run_page
from warmjoint.figures.sheet import encode
from warmjoint.figures.style import use


def test_the_page_of_a_log_says_why_it_was_refused_and_what_to_do():
    facts = shown.warm_facts(status="inadequate_model", tests=[shown.test_of("direction", "velocity")], remarks=["It depends on <direction>."])
    check = {"faults": ["the clock jumps"], "excitation": [{"what": "law stribeck", "sufficient": False, "reason": "needs 5 speeds"}]}
    data = log_page.data_of({"fit": facts, "check": check, "commands": ["warmjoint identify warm.csv"]})
    assert not data["passed"] and not data["attachable"]
    assert "the model does not describe these data" in data["verdict"]
    assert data["next"] == ["The log: the clock jumps.", "try another law for direction", "To identify law stribeck: needs 5 speeds"]
    assert data["tests"]["rows"][0][1:3] == ["yes", "3.0 N·m"]
    assert data["parameters"]["caption"].startswith("Void")


def test_the_page_of_a_log_gives_numbers_and_assumptions_in_per_cent():
    assumed = [{"sentence": "A tenth warm.", "moves": {"coulomb": 1.2, "viscous": 0}}, {"sentence": "true_clock.", "moves": {"coulomb": 0.001}},
               {"sentence": "Far off.", "moves": {"coulomb": 845.0}}]
    data = log_page.data_of({"fit": shown.warm_facts(assumptions=assumed), "check": {"faults": [], "excitation": []}, "commands": []})
    assert data["passed"] and data["parameters"]["rows"][0][:2] == ["viscous", "5.000"]
    table = data["assumptions"]
    assert table["header"] == ["taken for granted", "coulomb"]  # nothing moves viscous
    assert table["rows"] == [["A tenth warm.", "+8.0 %"], ["Far off.", "more than +100 %"]]  # 0.007 % is nought


def test_a_page_holds_no_more_samples_than_it_can_carry_and_loses_no_extreme():
    rng = np.random.default_rng(3)
    columns = [rng.standard_normal(100_000) for _ in range(3)]
    kept = log_page.thinned(columns, 2500)
    assert kept.size < 30_000 and np.all(np.diff(kept) > 0)
    for column in columns:
        assert {int(np.argmax(column)), int(np.argmin(column))} <= set(kept.tolist())


def test_the_page_of_a_run_lists_answers_with_how_to_make_them_again():
    content = {"variants": ["quiet", "loud"], "torque_unit": "N.m", "identifiers": [{"label": "mine"}],
               "replay": ["warmjoint simulate --from RUN --variant quiet --realization 0 -o replay"] * 2}
    answers = [{"realization": 3, "variant": 1, "identifier": 0, "status": "crashed", "npe": None, "rmse": None, "fit": 93.0}]
    table = run_page.realizations(content, answers)
    assert table["rows"] == [["3", "loud", "mine", "crashed", "-", "-", "93", "warmjoint simulate --from RUN --variant quiet --realization 3 -o replay"]]


def test_a_page_without_the_library_of_charts_says_so(monkeypatch):
    pages = pytest.importorskip("warmjoint.figures.pages")
    monkeypatch.setattr(pages, "CHARTS", pages.HERE / "nowhere")
    facts = shown.warm_facts(remarks=["a <b>c</b>"])
    text = pages.fill("log", {"fit": facts, "check": {"faults": [], "excitation": []}, "commands": []})
    assert "sudo apt install libjs-dygraphs" in text and "<script" not in text
    assert text.count("<img ") == 6 and "a &lt;b&gt;c&lt;/b&gt;" in text
    assert len(text) < 2_000_000  # a mail takes it


def test_a_page_shows_a_picture_in_256_colours_that_look_alike():
    pages = pytest.importorskip("warmjoint.figures.pages")
    image = pytest.importorskip("PIL.Image")
    with use("screen"):
        sheet = friction.warm_up(shown.warm_view())
        whole, small = encode(sheet), base64.b64decode(pages.embedded(sheet).partition(",")[2])
    assert len(small) < 0.6 * len(whole)
    a, b = (np.asarray(image.open(io.BytesIO(one)).convert("RGB"), int) for one in (whole, small))
    assert a.shape == b.shape and np.abs(a - b).mean() < 1


VISCOUS = {"value": 2.0, "std": 0.05, "interval95": [1.9, 2.1], "unit": "N.m.s/rad"}
SPEEDS = [{"speed": v, "value": 5 + abs(v), "std": 0.1, "interval95": [4.8 + abs(v), 5.2 + abs(v)], "speed_unit": "rad/s", "unit": "N.m"} for v in (-1, -0.1, 0.1, 1)]
ABOUT = {"torque_unit": "N.m", "travel": 2.0, "top_speed": 1.0, "minutes": 9.5, "gain": 0.98, "gain_is_known": True, "rms_held_out": 0.2, "rms_moving": 0.3,
         "rms_without_friction": 7.0}
PASSED = {"status": "ok", "message": "fitted", "parameters": {"viscous": VISCOUS}, "friction_at_speeds": SPEEDS}


def test_the_page_of_a_robot_holds_each_joint():
    pages = pytest.importorskip("warmjoint.figures.pages")
    nothing = ABOUT | {"gain": None, "rms_held_out": None, "rms_moving": None, "rms_without_friction": None}
    answer = {"robot": "arm.xml", "log": ["log.csv"], "notices": ["the torque of <b> is turned"], "payload": None,
              "summary": {"shoulder": ABOUT, "elbow": nothing},
              "joints": {"shoulder": PASSED,
                         "elbow": {"status": "not_identifiable", "message": "elbow did not move", "parameters": {}, "friction_at_speeds": []}}}
    text = pages.fill("robot", {"source": "robot.json", "answer": answer})
    assert "1 of 2 joints" in text and "2.000 ± 0.1" in text and "lbow did not move" in text.replace("Elbow", "elbow")
    assert "the torque of &lt;b&gt; is turned" in text.replace("The", "the") and text.count("<img ") == 1


def test_many_joints_stand_on_several_sheets():
    from warmjoint.figures import robots

    answer = {"joints": {f"j{i}": PASSED for i in range(2 * robots.MOST + 1)} | {"still": PASSED | {"friction_at_speeds": []}}}
    makers = robots.all_joints_sheets(answer, [])
    assert [maker.args[1] for maker in makers] == ["all_joints", "all_joints_2", "all_joints_3"]
    assert [len(maker.args[0]) for maker in makers] == [robots.MOST, robots.MOST, 1] and makers[2]().name == "all_joints_3"
    assert robots.all_joints_sheets({"joints": {}}, []) == []


def test_a_page_with_a_number_that_no_axis_holds_is_refused_with_its_place():
    import json

    pages = pytest.importorskip("warmjoint.figures.pages")
    large = PASSED | {"friction_at_speeds": [SPEEDS[0] | {"interval95": [-1e308, 1e308]}, *SPEEDS[1:]]}
    answer = {"robot": "arm.xml", "log": ["log.csv"], "notices": [], "payload": None, "summary": {"shoulder": ABOUT}, "joints": {"shoulder": large}}
    refusal = json.loads(pages.answer("robot", {"source": "robot.json", "answer": answer}))["refusal"]
    assert refusal["place"] == "robot.json" and "1e+308" in refusal["why"] and "1e+100" in refusal["why"]
