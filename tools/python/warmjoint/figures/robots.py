"""Figures of robots: a joint of a robot's answer, and a simulated robot whose joint warms."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .along_log import strokes
from .numerals import significant, unit_text
from .sheet import Sheet
from .view import View

COLD = 0.01  # of the largest heat: what is less is called cold


def joint(facts: dict[str, Any]) -> Sheet:
    """Friction over velocity, along the log, and what is left, of a joint of identify-robot."""
    unit = unit_text(facts["torque_unit"])
    keep = facts["keep"] > 0
    length = facts["time"][-1]
    clock, name = (facts["time"] / 60, "time (min)") if length > 300 else (facts["time"], "time (s)")
    gap = lambda column: np.where(keep, column, np.nan)
    left = facts["measured"] - facts["fitted"]
    said = facts["status"] + (f", held-out residual {facts['rms_held_out']:.3g} {unit}" if facts["rms_held_out"] is not None else "")
    fig = Sheet(facts["file"], f"Friction of {facts['joint']}", said, facts["message"] or said)
    over, along, rest = fig.panels((330, [1]), (230, [1]), (200, [1]))
    speed, measured, fitted = (facts[key][keep] for key in ("velocity", "measured", "fitted"))
    draw.dots(over, speed, measured, "torque less all that is no friction")
    draw.dots(over, speed, fitted, "fitted", "blue", 0.9)
    limits = draw.bulk([measured, fitted])
    over.set_ylim(limits)
    draw.finish(over, f"velocity ({'m/s' if unit == 'N' else 'rad/s'})", f"friction ({unit})", "Over velocity")
    draw.line(along, clock, gap(facts["measured"]), "", "grey", 1.0)
    draw.line(along, clock, gap(facts["fitted"]), "", "blue", 1.0)
    along.set_ylim(limits)
    draw.finish(along, name, f"friction ({unit})", "Along the log")
    draw.line(rest, clock, gap(left), "", "grey", 1.0)
    shown = [left[keep]]
    if facts["energy"].size:
        draw.line(rest, clock, facts["energy"], "heat E", "vermilion", 1.5)
        shown.append(facts["energy"])
    rest.set_ylim(draw.bulk(shown))
    draw.finish(rest, name, f"residual{' and heat' if facts['energy'].size else ''} ({unit})", "What is left")
    return fig


def _means(speed: np.ndarray, values: np.ndarray, count: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """Means of values over equal parts of the speeds that hold ten samples or more. Returns speeds and means."""
    part = np.minimum((speed / max(speed.max(), 1e-12) * count).astype(int), count - 1)
    held = [part == k for k in range(count) if np.sum(part == k) >= 10]
    return np.array([speed[one].mean() for one in held]), np.array([values[one].mean() for one in held])


def all_joints(joints: list[dict[str, Any]]) -> Sheet:
    """The friction of all joints of identify-robot over speed, a panel each: means of the log and of the fit in both directions."""
    ok = sum(one["status"] == "ok" for one in joints)
    fig = Sheet("all_joints", "Friction of all joints", f"{ok} of {len(joints)} fits ok; points: means of the log, lines: of the fit",
                "Torque against the motion that is left of the log without rigid-body torque, and what is fitted of it.")
    columns = min(3, len(joints))
    rows = -(-len(joints) // columns)
    panels = fig.panels(*[(230, [1.0] * columns)] * rows)
    for ax, facts in zip(panels, joints, strict=False):
        keep, unit = facts["keep"] > 0, unit_text(facts["torque_unit"])
        velocity, top = facts["velocity"][keep], 0.0
        for way, label, hue in ((1, "forwards", "blue"), (-1, "backwards", "vermilion")):
            one = velocity * way > 0
            if not one.any():
                continue
            speed = np.abs(velocity[one])
            for key, draw_one in (("measured", draw.dots), ("fitted", draw.line)):
                x, y = _means(speed, way * facts[key][keep][one])
                top = max(top, y.max(initial=0))
                if key == "measured":
                    draw_one(ax, x, y, label, hue, 3)
                else:
                    draw_one(ax, x, y, "", hue, 1.5)
        ax.set_xlim(0, None)
        ax.set_ylim(0, 1.15 * top or None)
        title = facts["joint"] if facts["status"] == "ok" else f"{facts['joint']}: {facts['status']}"
        draw.finish(ax, f"speed ({'m/s' if unit == 'N' else 'rad/s'})", f"friction ({unit})", title)
    for ax in panels[len(joints):]:
        ax.set_axis_off()
    return fig


def warm_robot(view: View, scene: dict[str, Any], name: str) -> Sheet:
    """The robot cold and at its warmest, E over time in the colours of the link, and the friction as it is and as it were without warming."""
    from matplotlib.colors import LinearSegmentedColormap

    largest = abs(view.energy[view.warmest])
    sign = "−" if view.energy[view.warmest] < 0 else ""
    warmest = scene["pictures"][-1]
    fig = Sheet("warm_robot", f"{scene['robot']}, {scene['joint']}: heat and the friction that it changes",
                f"{name}; the joint's link has the colour of {sign}E",
                f"The joint's own heat changes its friction by {significant(warmest['energy'])} {view.torque_unit} at most, after "
                f"{significant(warmest['time'] / view.seconds, 2)} {view.time_unit}.")
    *robots, strip, below = fig.panels((360, [1] * len(scene["pictures"])), (50, [1]), (290, [1]))
    for ax, one in zip(robots, scene["pictures"]):
        cold = abs(one["energy"]) < COLD * largest
        heat = "cold" if cold else f"E = {significant(one['energy'], 2)} {view.torque_unit}"
        _picture(ax, one, f"After {significant(one['time'] / view.seconds, 2)} {view.time_unit}: {heat}")
    heats = np.interp(np.linspace(view.time[0], view.time[-1], 240), view.time, np.abs(view.energy))
    mesh = draw.cells(strip, heats[np.newaxis], (0, view.clock[-1]), (0, 1), (0, largest), LinearSegmentedColormap.from_list("heat", scene["colours"]))
    strip.set_yticks([])
    strip.tick_params(axis="x", labelbottom=False, length=0)
    bar = fig.colorbar(mesh, ax=[strip, below], pad=0.01, aspect=26)
    bar.set_label(view.torque_name(sign + "E"))
    bar.outline.set_visible(False)
    draw.finish(strip, "", "")
    friction = view.fitted * np.sign(view.velocity)
    draw.dots(below, view.kept(view.clock), view.kept(friction), "friction", "grey", 1.0)
    strokes(below, view, friction, "its mean at each speed", "text")
    strokes(below, view, friction - view.energy, "the mean if it had stayed cold", "blue")
    below.set_xlim(0, view.clock[-1])
    draw.finish(below, view.time_name, view.torque_name("friction · sign(v)"))
    return fig


def _picture(ax: Any, one: dict[str, Any], title: str) -> None:
    """The robot with the axis of its joint and an arrow about it."""
    packed = one["pixels"].astype(np.uint32)
    ax.imshow(np.stack([packed >> 16, packed >> 8 & 255, packed & 255], axis=-1).astype(np.uint8), interpolation="lanczos")
    scale = draw.look()["scale"]
    ax.plot(*np.transpose(one["axis"]), color="#1c2026", linewidth=1.3 * scale, linestyle=(0, (5, 2, 1, 2)))
    arc = np.array(one["arc"])
    ax.plot(*arc[:-1].T, color="#1c2026", linewidth=2 * scale)
    ax.annotate("", arc[-1], arc[-3], arrowprops={"arrowstyle": "-|>", "color": "#1c2026", "lw": 2 * scale, "shrinkA": 0, "shrinkB": 0,
                                                 "mutation_scale": 14 * scale})
    ax.set_xlim(-0.5, packed.shape[1] - 0.5)
    ax.set_ylim(packed.shape[0] - 0.5, -0.5)
    ax.set_axis_off()
    ax.set_title(title)
