"""The figure of a design: its motion, and how well its log will know what."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .numerals import look_of_several, significant
from .sheet import Sheet


def half_widths(answers: list[dict[str, Any]], name: str) -> np.ndarray:
    """Of the 95 % interval after each part of the motion, per cent of the value; NaN where an answer has none."""
    found = []
    for answer in answers:
        one = answer["parameters"].get(name)
        known = answer["status"] == "ok" and one and one["interval95"]
        found.append(50 * (one["interval95"][1] - one["interval95"][0]) / abs(one["value"]) if known else np.nan)
    return np.array(found)


def of_friction(answers: list[dict[str, Any]]) -> np.ndarray:
    """The largest of all speeds, per cent of the rms friction."""
    found = []
    for answer in answers:
        rows = answer["friction_at_speeds"] if answer["status"] == "ok" else []
        largest = max((row["interval95"][1] - row["interval95"][0] for row in rows), default=np.nan)
        found.append(50 * largest / np.sqrt(np.mean([row["value"] ** 2 for row in rows])) if rows else np.nan)
    return np.array(found)


def design(facts: dict[str, Any]) -> Sheet:
    """Speed over the minutes; below, the foretold half widths. facts: of a joint, `joint` its name where there are several."""
    answers, motion = facts["design"]["foretold"], facts["motion"]
    names = [name for name in facts["design"]["draws"][0]["deviations"] if np.isfinite(half_widths(answers, name)).any()]
    minutes = np.array([answer["minutes"] for answer in answers])
    against = ", ".join(f"{ratio['middle']:.2f} of that of {ratio['against']}" for ratio in facts["design"]["ratios"])
    whose = f" of {facts['joint']}" if facts["joint"] else ""
    fig = Sheet(facts["file"], f"A motion to record, and how well its log will know the friction{whose}",
                f"half widths of 95 % intervals on a simulated log; standard deviation of what is wanted: {against}",
                f"After {significant(float(minutes[-1]))} min the friction is known to {significant(float(of_friction(answers)[-1]))} %.")
    above, below = fig.panels((200, [1]), (330, [1]))
    draw.line(above, np.array(motion["time"]) / 60, np.array(motion["velocity"]), "", look_of_several(0)[0], 0.6)
    draw.finish(above, "", f"velocity ({motion['unit']})", "")
    lines = [("friction", of_friction(answers))] + [(name, half_widths(answers, name)) for name in names]
    for i, (name, values) in enumerate(lines):
        hue, dash = look_of_several(i)
        draw.line(below, minutes, values, name, hue, 1.4, dash)
    draw.magnitudes(below, [values for _, values in lines])
    for ax in (above, below):
        ax.set_xlim(0, minutes[-1])
    draw.finish(below, "minutes recorded", "half width (%)", "")
    return fig
