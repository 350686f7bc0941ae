"""What the page of a robot shows: verdict and friction of each joint, how well it predicts, what was noticed, friction over speed."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from . import sheet as draw
from .fit_page import sentence
from .numerals import range_text, significant, to_digits_of, unit_text
from .sheet import Sheet
from .view import VERDICTS

ABREAST = 3  # panels in a row
MOST = 60  # panels in a sheet: laying out takes the square of their number

TERMS = (
    ("viscous, Coulomb", "Friction that grows with speed (N·m for each rad/s), and that which does not, in each direction. Of a joint under gravity their mean is "
     "known best, since gravity holds their difference."),
    ("load", "Friction over the torque that the joint carries, by gravity and Coriolis forces."),
    ("rotor", "Inertia of the motor and gear, beside that of the links."),
    ("gain", "The log's torque over that of the description; in A the inverse of the torque constant. With a question mark it is known to worse than a factor of 1.5."),
    ("warming", "Change of friction by each watt of the joint's own heat, and how long that takes; none where the log shows none."),
    ("held-out residual", "Rms on the end of the log, which a second fit has not seen; beside it that of gain and offset alone, without friction."),
    ("±", "Half of the 95 % interval, which knows that the description may be wrong."),
)

COLUMNS = (("viscous", "viscous"), ("coulomb_positive", "Coulomb +"), ("coulomb_negative", "Coulomb −"), ("coulomb", "their mean"), ("load_gain", "load"),
           ("rotor_inertia", "rotor"))


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
            "joints": [(name, f"{VERDICTS[one['status']]}. {sentence(one['message'])}") for name, one in joints.items()],
            "notices": [sentence(one) for one in notices], "friction": _friction(joints, summary), "residuals": _residuals(joints, summary),
            "attachable": bool(passed), "terms": TERMS, "figures": over_speed_sheets(joints)}


def _friction(joints: dict[str, Any], summary: dict[str, Any]) -> dict[str, Any]:
    rows = []
    for name, one in joints.items():
        own, about = one["parameters"], summary[name]
        known = [_shown(own.get(key)) for key, _ in COLUMNS]
        rows.append([name, unit_text(about["torque_unit"]), *known, _gain(about), _warming(own)])
    return {"caption": "Friction of each joint, in the log's unit", "header": ["joint", "unit", *(title for _, title in COLUMNS), "gain", "warming"], "rows": rows}


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


def over_speed_sheets(joints: dict[str, Any]) -> list[Callable[[], Sheet]]:
    """Makers of sheets with at most MOST joints each, of those that have figures at speeds."""
    shown = [(name, one["friction_at_speeds"]) for name, one in joints.items() if one.get("friction_at_speeds")]
    parts = [dict(shown[i : i + MOST]) for i in range(0, len(shown), MOST)]
    names = ["friction_over_speed"] + [f"friction_over_speed_{i + 2}" for i in range(len(parts) - 1)]
    return [functools.partial(over_speed, part, name) for part, name in zip(parts, names)]


def over_speed(shown: dict[str, Any], name: str) -> Sheet:
    """Cold friction of each joint over speed, with its 95 % interval."""
    rows = -(-len(shown) // ABREAST)
    fig = Sheet(name, "Friction over speed", "cold, with 95 % intervals", f"Friction of {len(shown)} joints at the speeds of the log.")
    axes = fig.panels(*[(220, [1] * ABREAST)] * rows)
    for ax, (name, figures) in zip(axes, shown.items(), strict=False):
        figures = sorted((one for one in figures if not one.get("energy")), key=lambda one: one["speed"])
        for side in (-1, 1):
            part = [one for one in figures if side * one["speed"] > 0]
            if not part:
                continue
            speed, value = (np.array([one[key] for one in part]) for key in ("speed", "value"))
            lower, upper = np.array([one["interval95"] or [one["value"]] * 2 for one in part]).T
            draw.band(ax, speed, lower, upper)
            draw.line(ax, speed, value)
            draw.dots(ax, speed, value, "", "blue", 3)
        draw.finish(ax, f"velocity ({unit_text(figures[0]['speed_unit'])})" if figures else "velocity", f"friction ({unit_text(figures[0]['unit'])})" if figures else "", name)
    for ax in axes[len(shown):]:
        ax.set_axis_off()
    return fig
