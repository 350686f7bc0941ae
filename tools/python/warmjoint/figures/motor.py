"""Figures of what a joint's torque owes to the angle of its motor or its position, and of maps fitted to it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from . import sheet as draw
from .numerals import significant
from .sheet import Sheet
from .speeds import groups_of
from .view import View, binned_median

FAINT = 0.3  # opacity of samples behind lines of the same colour
MEDIANS = 24  # of the samples over one turn
TURNS = 4  # of the motor, in the close-up
MOST_BINS, FEWEST_BINS, IN_A_BIN = 72, 8, 12


def _beyond(count: int) -> str:
    return f"; {count} of the samples {'is' if count == 1 else 'are'} beyond the axes" if count else ""


def _both_ways(fig: Sheet, view: View, panel: Callable[[Any, int], list[np.ndarray]], titles: tuple[str, str], name: str) -> None:
    """A panel for each direction that the joint took; the subtitle counts what the axes leave out."""
    ways = [(way, title) for way, title in zip((1, -1), titles) if any(own.size for _, _, own in groups_of(view, way))]
    left_out = 0
    for ax, (way, title) in zip(fig.panels((365, [1] * len(ways))), ways):
        shown = panel(ax, way)
        limits = draw.bulk(shown)
        left_out += draw.beyond(shown, limits)
        ax.set_ylim(limits)
        draw.one_turn(ax)
        draw.finish(ax, "motor angle (rad)", name, title)
    fig.subtitle += _beyond(left_out)


def motor_angle(view: View) -> Sheet | None:
    """Torque over motor angle by direction and speed, with medians in bins. Where the fit warms, its E is taken off."""
    if view.motor_angle is None or not view.segments:
        return None
    swing = 0.0
    medians = {}
    for way in (1, -1):
        for hue, _, own in groups_of(view, way):
            if own.size:
                torque = view.torque[own] - (way * view.energy[own] if view.warms else 0)
                bins = min(max(own.size // IN_A_BIN, FEWEST_BINS), MOST_BINS)
                medians[way, hue] = torque, binned_median(view.motor_angle[own], torque, bins)
                known = medians[way, hue][1][1]
                swing = max(swing, np.nanmax(known) - np.nanmin(known)) if np.isfinite(known).any() else swing
    if not medians:
        return None
    fig = Sheet("motor_angle", "Torque over motor angle", f"{view.source}: samples at constant speed, with their medians",
                f"Over one turn of the motor the median torque at a speed varies by up to {significant(swing, 2)} {view.torque_unit}.")

    def panel(ax: Any, way: int) -> list[np.ndarray]:
        shown = []
        for hue, label, own in groups_of(view, way):
            if own.size:
                torque, (x, y) = medians[way, hue]
                draw.dots(ax, view.motor_angle[own], torque, "", hue, 0.8, opacity=FAINT)
                draw.line(ax, x, y, label, hue, 2.0)
                shown.append(torque)
        return shown

    _both_ways(fig, view, panel, ("Forwards", "Backwards"), view.torque_name("torque − sign(v) E" if view.warms else "torque"))
    return fig


def _worth(view: View) -> str:
    """What figures of a motor map say of it."""
    rms = [significant(np.sqrt(np.nanmean(view.kept(view.torque - view.facts["motor_maps"][which]) ** 2))) for which in ("without", "with")]
    return f"The map over motor angle takes the RMSE from {rms[0]} to {rms[1]} {view.torque_unit}."


def motor_map(view: View) -> Sheet | None:
    """What law, heat and other maps leave of the torque over the motor's angle, and what the map makes of the same samples, in the same bins."""
    maps = view.facts.get("motor_maps")
    if not maps or not view.segments or not view.count:
        return None
    left, part = view.torque - maps["without"], maps["with"] - maps["without"]
    fig = Sheet("motor_map", "The map over motor angle",
                f"{view.origin}; diamonds are medians of the samples, lines those of the map at the same samples", _worth(view))

    def panel(ax: Any, way: int) -> list[np.ndarray]:
        shown = []
        for hue, label, own in groups_of(view, way):
            if own.size:
                angle = view.motor_angle[own]
                draw.dots(ax, angle, left[own], "", hue, 0.8, opacity=FAINT)
                draw.line(ax, *binned_median(angle, part[own], min(max(own.size // IN_A_BIN, FEWEST_BINS), MOST_BINS)), f"map at {label}", hue, 2.2)
                draw.dots(ax, *binned_median(angle, left[own], MEDIANS), "", hue, 3.0, "diamond")
                shown.append(left[own])
        return shown

    _both_ways(fig, view, panel, ("Forwards: torque less law and warming", "Backwards"), view.torque_name("torque − law"))
    return fig


def motor_fit(view: View) -> Sheet | None:
    """The torque in time with and without the maps over the motor's angle: a few turns in the first and in the last slow segment."""
    maps = view.facts.get("motor_maps")
    if not maps or not view.segments or not view.count:
        return None
    slowest = np.nanmax([np.abs(view.velocity[own]).max() for _, _, own in groups_of(view, 1)[:1] + groups_of(view, -1)[:1] if own.size])
    slow = [one for one in view.segments if abs(one[2]) <= slowest and view.keep[one[0]:one[1]].any()] or view.segments
    fig = Sheet("motor_fit", "Fit with and without the map over motor angle", view.origin, _worth(view))
    titles = ("Cold: in the first slow segment", "Warm: in the last one") if view.warms else ("In the first slow segment", "In the last one")
    for ax, (begin, end, _), title in zip(fig.panels((365, [1, 1])), (slow[0], slow[-1]), titles):
        turned = np.abs((np.diff(view.motor_angle[begin:end]) + np.pi) % (2 * np.pi) - np.pi).sum()
        samples = int(TURNS * 2 * np.pi * (end - begin) / max(turned, 1e-9))
        own = slice(begin, begin + min(max(samples, 8), end - begin))
        draw.dots(ax, view.time[own], view.torque[own], "measured", "grey", 1.6)
        draw.line(ax, view.time[own], maps["without"][own], "fit without the map", "orange", 1.5)
        draw.line(ax, view.time[own], maps["with"][own], "with it", "blue", 2.0)
        draw.finish(ax, "time (s)", view.torque_name("torque"), title)
    return fig


def passed(view: View, angle: np.ndarray, lower: float, upper: float, fastest: float, shape: tuple[int, int]) -> np.ndarray:
    """Whether the joint moved about so fast at a place, [rows, columns]: at its kept samples, and between two of them that follow each other."""
    spare = 0.1  # of a speed: over so little no friction changes much
    rows, columns = shape
    kept = np.flatnonzero(view.keep & (view.velocity != 0))
    column = ((angle - lower) / ((upper - lower) or 1) * columns).astype(int).clip(0, columns - 1)
    row_of = lambda v: ((v / fastest + 1) / 2 * rows).astype(int).clip(0, rows - 1)
    near, far = row_of((1 - spare) * view.velocity), row_of((1 + spare) * view.velocity)
    cells = np.zeros(shape, bool)
    for i in kept:
        before = column[i - 1] if i and view.keep[i - 1] else column[i]
        if abs(column[i] - before) > columns / 2:  # a motor's angle begins anew after each turn
            before = column[i]
        cells[min(near[i], far[i]):max(near[i], far[i]) + 1, min(column[i], before):max(column[i], before) + 1] = True
    return cells


def friction_map(view: View) -> Sheet | None:
    """sign(v) F over motor angle (or joint position, where the maps have that) and velocity, cold and at its warmest, each direction with colours
    that both share. Empty where the joint did not move about so fast."""
    grid = view.facts.get("angle_map")
    if not grid:
        return None
    over_motor, lower, upper, fastest = grid["over_motor"], grid["lower"], grid["upper"], grid["fastest"]
    angle = view.motor_angle if over_motor else view.position
    if angle is None:
        return None
    was_there = passed(view, angle, lower, upper, fastest, grid["levels"][0].shape)
    levels = [np.where(was_there, one, np.nan) for one in grid["levels"]]
    names = ["cold", f"warmest: E = {significant(grid['energies'][-1])} {view.torque_unit}"][:len(levels)]
    said = "".join(f" {word} {significant(np.nanmin(one))} to {significant(np.nanmax(one))} {view.torque_unit}," for word, one in zip(("cold", "warm"), levels))
    ways = [(way, title) for way, title in ((1, "Forwards"), (-1, "Backwards")) if np.isfinite(_half(levels[0], way)).any()]
    fig = Sheet("friction_map", f"Friction over {'motor angle' if over_motor else 'position'} and velocity",
                f"{view.origin}; empty where the joint did not move about so fast, dots are samples", f"Friction{said[:-1]}.")
    axes = iter(fig.panels(*[(250, [1] * len(levels))] * len(ways)))
    for way, title in ways:
        halves = [_half(one, way) for one in levels]
        limits = np.nanmin(halves), np.nanmax(halves)
        limits = limits if limits[0] < limits[1] else (limits[0], limits[0] + 1)
        for half, name in zip(halves, names):
            ax = next(axes)
            mesh = draw.cells(ax, half, (lower, upper), (0, fastest) if way > 0 else (-fastest, 0), limits)
            own = view.keep & (view.velocity * way > 0)
            draw.dots(ax, angle[own], view.velocity[own], "samples", "grey", 0.7, opacity=0.6)
            bar = fig.colorbar(mesh, ax=ax, pad=0.02, aspect=18)
            bar.set_label(view.torque_name("sign(v) · friction"))
            bar.outline.set_visible(False)
            ax.set_ylim((0, fastest) if way > 0 else (-fastest, 0))
            if over_motor:
                draw.one_turn(ax)
            else:
                ax.set_xlim(lower, upper)
            draw.finish(ax, "motor angle (rad)" if over_motor else view.position_name, view.speed_name, f"{title}, {name}")
    return fig


def _half(level: np.ndarray, way: int) -> np.ndarray:
    middle = level.shape[0] // 2
    return level[middle:] if way > 0 else level[:middle]
