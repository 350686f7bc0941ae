"""Figures and panels over the time of a recording: the log, the level of friction, close-ups, loops."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .sheet import Sheet
from .view import View

Window = tuple[int, int]  # samples [begin, end)


def log(view: View) -> Sheet:
    """Position, velocity and torque over time, with the samples in colour that are kept for the fit."""
    share = 100 * view.count / view.time.size
    motion = "from motion of any kind" if view.any_motion else f"in {len(view.segments)} segments of constant speed"
    fig = Sheet("log", view.source, f"{view.time.size} samples; {share:.0f} % of them are kept, {motion}",
                f"Of {view.time.size} samples {share:.0f} % are kept for the fit, {motion}.")
    columns = ((view.position, view.position_name), (view.velocity, view.speed_name), (view.torque + view.rigid, view.torque_name("torque")))
    axes = fig.panels(*[(185 if i == 0 else 170, [1]) for i in range(3)])
    for i, (ax, (values, name)) in enumerate(zip(axes, columns)):
        draw.line(ax, view.clock, values, "" if i else "all samples", "grey", 1.0)
        draw.line(ax, view.clock, view.or_gap(values), "" if i else "kept for the fit", "blue", 1.4)
        draw.finish(ax, view.time_name if i == 2 else "", name)
    return fig


def level_over_time(ax: Any, view: View, title: str = "") -> None:
    """Torque in the direction of motion, which is the level of friction, with the fit."""
    sign = np.sign(view.velocity)
    draw.dots(ax, view.kept(view.clock), view.kept(view.torque * sign), "measured")
    if view.has_fit:
        level = view.fitted * sign
        if not view.segments:  # it moves all the time: its fit is dots as its samples are
            draw.dots(ax, view.kept(view.clock), view.kept(level), view.fit_name, "blue", 0.9)
        elif view.has_maps:  # the ripple of maps would fill the panel: its range, and its mean
            _ranges(ax, view, level)
            strokes(ax, view, level, f"{view.fit_name}, mean of each segment", "blue")
        else:
            shown = np.where(view.keep, level, np.nan)
            for begin, _, _ in view.segments[1:]:  # lines do not cross from one segment to the next
                if begin and np.isfinite(shown[begin]) and np.isfinite(shown[begin - 1]):
                    shown[begin - 1] = np.nan
            draw.line(ax, view.clock, shown, view.fit_name, "blue", 1.5, view.dash)
    draw.finish(ax, view.time_name, view.torque_name("torque · sign(v)"), title)


def _ranges(ax: Any, view: View, values: np.ndarray) -> None:
    x, lower, upper = [], [], []
    for begin, end, _ in view.segments:
        own = view.of_segment(begin, end, values)
        if own.size:
            x += [view.clock[begin], view.clock[end - 1], np.nan]
            lower += [own.min(), own.min(), np.nan]
            upper += [own.max(), own.max(), np.nan]
    draw.band(ax, x, lower, upper, "its range", "blue", 0.22)


def strokes(ax: Any, view: View, values: np.ndarray, label: str, hue: str, width: float = 2.0) -> None:
    """The mean over the kept samples of each segment, from its first sample to its last."""
    x, y = [], []
    for begin, end, _ in view.segments:
        own = view.of_segment(begin, end, values)
        if own.size:
            x += [view.clock[begin], view.clock[end - 1], np.nan]
            y += [own.mean(), own.mean(), np.nan]
    draw.line(ax, x, y, label, hue, width)


def window(view: View, which: str, segments: int = 6) -> Window:
    """The first or the last segments, half of them where they are few, and a little around them; a twelfth of a recording without."""
    n = view.time.size
    if not view.segments:
        span = max(min(n, 3), n // 12)
        return (0, span) if which == "first" else (n - span, n)
    count = min(max(len(view.segments) // 2, 1), segments)
    own = view.segments[:count] if which == "first" else view.segments[-count:]
    begin, end = own[0][0], own[-1][1]
    spare = (end - begin) // 20
    return max(0, begin - spare), min(n, end + spare)


LOOPS, MOVES = 2, 0.05  # back and forth in a picture; share of the largest speed from which a joint moves


def loops(view: View, which: str) -> Window:
    """The first or the last times back and forth: the samples up to the turn of the direction that ends them."""
    speed = np.nan_to_num(view.or_gap(view.velocity))
    if which == "last":
        speed = speed[::-1]
    moving = np.flatnonzero(np.abs(speed) > MOVES * np.abs(speed).max())
    turns = moving[1:][np.diff(np.sign(speed[moving])) != 0]
    end = int(turns[2 * LOOPS - 1]) if turns.size >= 2 * LOOPS else speed.size
    return (0, end) if which == "first" else (speed.size - end, speed.size)


def torque_limits(view: View, *windows: Window) -> tuple[float, float]:
    """Limits that hold the torque of windows at constant speed: accelerations may leave the picture."""
    kept = np.concatenate([view.or_gap(view.torque)[slice(*one)] for one in windows])
    known = kept[np.isfinite(kept)]
    if not known.size:
        known = np.concatenate([view.torque[slice(*one)] for one in windows])
    spare = 0.12 * (known.max() - known.min()) or 1.0
    return known.min() - spare, known.max() + spare


def close_up(ax: Any, view: View, part: Window, limits: tuple[float, float], title: str = "") -> None:
    """Torque and fit as they were logged."""
    own = slice(*part)
    time = view.clock[own]
    draw.line(ax, time, view.torque[own], "measured", "grey", 2.0)
    draw.line(ax, time, view.or_gap(view.torque)[own], "kept: moves clearly" if view.any_motion else "kept: at constant speed", "sky", 2.0)
    if view.has_fit:  # only where it was asked of the samples
        draw.line(ax, time, view.or_gap(view.fitted)[own], view.fit_name, "vermilion", 1.2, view.dash)
    ax.set_ylim(limits)
    draw.finish(ax, view.time_name, view.torque_name("torque"), title)


def hysteresis(view: View) -> Sheet | None:
    """Torque over position in the first and in the last segments, with the fit. Nothing where the joint moves in one direction alone."""
    kept = view.kept(view.velocity)
    if not kept.size or kept.min() >= 0 or kept.max() <= 0:
        return None
    parts = loops(view, "first"), loops(view, "last")
    limits = torque_limits(view, *parts)
    taken = f"; the torque is less {view.taken_off}" if view.taken_off else ""
    fig = Sheet("hysteresis", "Torque over position, back and forth", view.origin + taken,
                "The height of the loop is twice the friction; from the first to the last it changes by what the joint has warmed.")
    titles = ("The beginning", "The end")
    for ax, part, title in zip(fig.panels((340, [1, 1])), parts, titles):
        own = slice(*part)
        draw.line(ax, view.position[own], view.torque[own], "measured", "grey", 1.4)
        if view.has_fit:
            draw.line(ax, view.position[own], view.or_gap(view.fitted)[own], view.fit_name, "vermilion", 1.6, view.dash)
        ax.set_ylim(limits)
        draw.finish(ax, view.position_name, view.torque_name("torque"), title)
    return fig


def extremes(found: list[dict[str, Any]]) -> Sheet:
    """Torque and fit of the best, the median and the worst realization of an identifier: each whole, and its end close up."""
    fig = Sheet("extremes", "Torque and fit of the best, the median and the worst realization",
                f"{found[0]['label']}, by the NPE of its parameters; simulated once more",
                "Left: measured torque in the direction of motion with the fit. Right: the last segments as they were logged. Where even the worst "
                "fit follows its torque, the errors of the parameters are what noise leaves.")
    axes = fig.panels(*[(215, [1, 1])] * len(found))
    for one, left, right in zip(found, axes[::2], axes[1::2]):
        view = View(one["fit"])
        level_over_time(left, view, f"The {one['rank']}: {one['name']}, NPE {100 * one['npe']:.3g} %")
        part = window(view, "last")
        close_up(right, view, part, torque_limits(view, part), "Its last segments")
    return fig
