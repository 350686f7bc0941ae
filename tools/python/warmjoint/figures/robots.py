"""Figures of robots: a joint of a robot's answer, and a simulated robot whose joint warms."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from . import sheet as draw
from .along_log import strokes
from .friction import over_place, places_of
from .numerals import significant, unit_text
from .sheet import Sheet
from .view import View

MOST = 60  # panels in a sheet: laying out takes the square of their number
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


Panel = Callable[[Any], None]


def all_joints(answer: dict[str, Any], along: list[dict[str, Any]]) -> Sheet:
    """The friction of all joints of a robot: over speed, and of those where it differs by place or warms, over the angle and over time.
    answer: robot.json; along: the series of its joints along the log, or none."""
    sheets = all_joints_sheets(answer, along, most=10**6)
    return sheets[0]() if sheets else Sheet("all_joints", "Friction of all joints", "", "No joint has an answer.")


def all_joints_sheets(answer: dict[str, Any], along: list[dict[str, Any]], most: int = MOST) -> list[Callable[[], Sheet]]:
    """Makers of the same on sheets with at most so many panels."""
    of_log = {one["joint"]: one for one in along}
    panels = [panel for name, one in answer["joints"].items() for panel in _panels(name, one, of_log.get(name))]
    parts = [panels[i : i + most] for i in range(0, len(panels), most)]
    ok = sum(one["status"] == "ok" for one in answer["joints"].values())
    said = f"{ok} of {len(answer['joints'])} joints ok; cold, with 95 % intervals" + ("; points: means of the log" if along else "")
    return [functools.partial(_sheet, part, "all_joints" + (f"_{i + 1}" if i else ""), said) for i, part in enumerate(parts)]


def _sheet(panels: list[Panel], name: str, said: str) -> Sheet:
    fig = Sheet(name, "Friction of all joints", said, "Friction of each joint over speed in both directions.")
    for ax, panel in zip(fig.grid(len(panels), 230), panels):
        panel(ax)
    return fig


def _panels(name: str, answer: dict[str, Any], facts: dict[str, Any] | None) -> list[Panel]:
    """Those of one joint."""
    found: list[Panel] = []
    if answer.get("friction_at_speeds") or facts:
        found.append(functools.partial(_over_speed, name=name, answer=answer, facts=facts))
    for band, is_load in places_of(answer):
        found.append(functools.partial(over_place, band=band, unit=_unit_of(answer), is_load=is_load, title=f"{name}, over the place"))
    if facts and facts["energy"].size:
        found.append(functools.partial(_warm_up, name=name, facts=facts))
    return found


def _unit_of(answer: dict[str, Any]) -> str:
    at = answer.get("friction_at_speeds") or [{}]
    return unit_text(at[0].get("unit", ""))


def cold_at_speeds(answer: dict[str, Any], way: int) -> list[dict[str, Any]]:
    """The cold friction of an answer in one direction, the slowest first."""
    at = answer.get("friction_at_speeds", [])
    return sorted((one for one in at if not one.get("energy") and way * one["speed"] > 0), key=lambda one: abs(one["speed"]))


def _over_speed(ax: Any, name: str, answer: dict[str, Any], facts: dict[str, Any] | None) -> None:
    """Both directions on one axis from 0."""
    top, is_linear = 0.0, any(one.get("speed_unit") == "m/s" for one in answer.get("friction_at_speeds", []))
    for way, label, hue in ((1, "forwards", "blue"), (-1, "backwards", "vermilion")):
        if facts:
            one = (facts["keep"] > 0) & (facts["velocity"] * way > 0)
            x, y = _means(np.abs(facts["velocity"][one]), way * facts["measured"][one]) if one.any() else (np.zeros(0), np.zeros(0))
            top = max(top, y.max(initial=0))
            draw.dots(ax, x, y, label, hue, 3)
        part = cold_at_speeds(answer, way)
        if not part:
            continue
        speed, value = np.array([abs(one["speed"]) for one in part]), np.array([one["value"] for one in part])
        lower, upper = np.array([one["interval95"] or [one["value"]] * 2 for one in part]).T
        top = max(top, upper.max())
        draw.band(ax, speed, lower, upper, hue=hue)
        draw.line(ax, speed, value, "" if facts else label, hue)
        draw.dots(ax, speed, value, "", hue, 2, "diamond")
    ax.set_xlim(0, None)
    ax.set_ylim(0, 1.1 * top or None)
    unit = unit_text(facts["torque_unit"]) if facts else _unit_of(answer)
    draw.finish(ax, f"speed ({'m/s' if is_linear else 'rad/s'})", f"friction ({unit})", name if answer["status"] == "ok" else f"{name}: {answer['status']}")


def _warm_up(ax: Any, name: str, facts: dict[str, Any]) -> None:
    """E along the log."""
    draw.line(ax, facts["time"] / 60, facts["energy"], "", "vermilion", 1.5)
    draw.finish(ax, "time (min)", f"change by heat, E ({unit_text(facts['torque_unit'])})", f"{name}, while it warms")


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
