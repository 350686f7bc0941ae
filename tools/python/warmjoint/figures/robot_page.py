"""What the page of a robot shows: verdict and friction of each joint, how well it predicts, what was noticed, friction over speed."""

from __future__ import annotations

from typing import Any

from .fit_page import sentence
from .numerals import range_text, significant, to_digits_of, unit_text
from .robots import all_joints_sheets, cold_at_speeds
from .view import VERDICTS

TERMS = (
    ("viscous, Coulomb", "Friction that grows with speed (N·m for each rad/s), and that which does not, in each direction. Of a joint under gravity their mean is "
     "known best, since gravity holds their difference."),
    ("slow, middle, fast", "Speeds below which 5, 50 and 95 % of the log's samples are, in each direction."),
    ("offset", "Of the torque, where both directions differ by more than a gear's friction does; it is not friction."),
    ("load", "Friction over the torque that the joint carries, by gravity and Coriolis forces."),
    ("rotor", "Inertia of the motor and gear, beside that of the links."),
    ("gain", "The log's torque over that of the description; in A the inverse of the torque constant. With a question mark it is known to worse than a factor of 1.5."),
    ("warming", "Change of friction by each watt of the joint's own heat, and how long that takes; none where the log shows none."),
    ("held-out residual", "Rms on the end of the log, which a second fit has not seen; beside it that of gain and offset alone, without friction."),
    ("±", "Half of the 95 % interval, which knows that the description may be wrong."),
)

COLUMNS = (("viscous", "viscous"), ("coulomb_positive", "Coulomb +"), ("coulomb_negative", "Coulomb −"), ("coulomb", "their mean"),
           ("torque_offset", "offset"), ("rotor_inertia", "rotor"))


def data_of(content: dict[str, Any]) -> dict[str, Any]:
    """What the template robot.html shows. content: {source, answer}, the latter a robot.json."""
    answer = content["answer"]
    joints, summary = answer["joints"], answer["summary"]
    passed = [name for name, one in joints.items() if one["status"] == "ok"]
    verdict = f"{len(passed)} of {len(joints)} joints have numbers that can be used"
    load = answer["payload"]
    notices = list(answer["notices"])
    if load:
        notices.append(f"load at the last link: {_shown(load)} kg")
    return {"source": content["source"], "robot": answer["robot"], "logs": answer["log"], "passed": bool(passed), "verdict": verdict,
            "verdicts": _verdicts(joints, summary),
            "joints": [(name, f"{VERDICTS[one['status']]}. {sentence(one['message'])}") for name, one in joints.items()],
            "notices": [sentence(one) for one in notices], "friction": _friction(joints, summary), "residuals": _residuals(joints, summary),
            "attachable": bool(passed), "terms": TERMS, "figures": all_joints_sheets(answer, content.get("along", []))}


def _verdicts(joints: dict[str, Any], summary: dict[str, Any]) -> dict[str, Any]:
    """A row for each direction of a joint."""
    rows = []
    for name, one in joints.items():
        unit = summary[name]["torque_unit"]
        row = [name, _use(one), "+", *_at_speeds(one, 1), unit_text(unit), _warming(one["parameters"]), _shown(one["parameters"].get("load_gain"))]
        rows.append(row)
        if one.get("friction_at_speeds"):
            rows.append(["", "", "−", *_at_speeds(one, -1), "", "", ""])
    return {"caption": "Friction of each joint, cold, at three of its speeds in both directions", "rows": rows,
            "header": ["joint", "may be used for", "direction", "slow", "middle", "fast", "unit", "warming", "load"]}


def _use(one: dict[str, Any]) -> str:
    if one["status"] != "ok":
        return "nothing"
    return "compensation, in A" if (one.get("friction") or {}).get("torque_unit") == "A" else "MuJoCo, compensation"


def _at_speeds(one: dict[str, Any], way: int) -> list[str]:
    cells = [f"{to_digits_of(at['value'], at['std'])} ± {significant((at['interval95'][1] - at['interval95'][0]) / 2, 2)}" for at in cold_at_speeds(one, way)[:3]]
    return cells + ["–"] * (3 - len(cells))


def _friction(joints: dict[str, Any], summary: dict[str, Any]) -> dict[str, Any]:
    rows = []
    for name, one in joints.items():
        own, about = one["parameters"], summary[name]
        known = [_shown(own.get(key)) for key, _ in COLUMNS]
        rows.append([name, unit_text(about["torque_unit"]), *known, _gain(about)])
    return {"caption": "Parameters of each joint, in the log's unit", "header": ["joint", "unit", *(title for _, title in COLUMNS), "gain"], "rows": rows}


def _residuals(joints: dict[str, Any], summary: dict[str, Any]) -> dict[str, Any]:
    keys = ("rms_held_out", "rms_moving", "rms_without_friction", "travel", "top_speed", "minutes")
    rows = [[name, unit_text(summary[name]["torque_unit"]), *(significant(summary[name][key]) for key in keys)] for name in joints]
    return {"caption": "How well it predicts what it has not seen, rms, and how far the log moves the joint", "rows": rows,
            "header": ["joint", "unit", "held out", "all that moves", "no friction", "travel (rad or m)", "top speed (by s)", "minutes"]}


def _shown(parameter: dict[str, Any] | None) -> str:
    """Value and half of its interval."""
    if not parameter:
        return "–"
    value = to_digits_of(parameter["value"], parameter["std"])
    if not parameter["interval95"]:
        return value
    lower, upper = parameter["interval95"]
    if at_bound := range_text(parameter["value"], (lower, upper)):
        return at_bound
    return f"{value} ± {significant((upper - lower) / 2, 2)}"


def _gain(about: dict[str, Any]) -> str:
    if about["gain"] is None:
        return "–"
    return significant(about["gain"]) + ("" if about["gain_is_known"] else " ?")


def _warming(parameters: dict[str, Any]) -> str:
    gain, tau = parameters.get("thermal_gain"), parameters.get("thermal_time_constant")
    if not gain or not tau:
        return "none" if parameters else "–"
    return f"{_shown(gain)} {unit_text(gain['unit'])}, {significant(tau['value'])} s"
