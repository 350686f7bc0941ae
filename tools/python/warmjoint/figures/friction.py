"""Figures of a fitted friction: over velocity at three heats, at one speed while it warms, several in one picture."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .numerals import look_of_several, significant, unit_text
from .sheet import Sheet
from .speeds import groups_of
from .view import View

HEATS = (("cold", "blue"), ("half as warm", "orange"), ("warmest", "vermilion"))
Z95 = 1.959964


def over_velocity(ax: Any, view: View, title: str = "") -> None:
    """Samples, coloured by their heat, and the fitted curve cold, half as warm and at its warmest with their 95 % bands. With maps the mean at
    each speed over the places where the joint moved so."""
    speed, torque = view.kept(view.velocity), view.kept(view.torque)
    heats = HEATS if view.warms else HEATS[:1]
    if view.warms:
        nearest = np.rint(2 * view.kept(view.energy) / (view.energy[view.warmest] or 1)).clip(0, 2)
        for i, (name, hue) in enumerate(heats):
            of_heat = nearest == i
            draw.dots(ax, speed[of_heat], torque[of_heat], f"measured, {name}", hue, 1.0, opacity=0.45)
    else:
        draw.dots(ax, speed, torque, "measured")
    for i, (name, hue) in enumerate(heats):
        label = f"{view.fit_name}, {name}" if view.warms else view.fit_name
        if view.has_maps and view.has_fit:
            _means_of_maps(ax, view, view.facts["at_heats"][i]["force"], label, hue)
        else:
            _curves(ax, [one for one in view.facts.get("curves", ()) if _same(one["energy"], i, view)], label, hue, view)
    draw.finish(ax, view.speed_name, view.torque_name("torque"), title)


def _same(energy: float, place: int, view: View) -> bool:
    return bool(np.isclose(energy, view.energy[view.warmest] * place / 2)) if view.warms else True


def _curves(ax: Any, curves: list[dict[str, Any]], label: str, hue: str, view: View) -> None:
    """One for each direction; the label stands in the legend once."""
    for curve in curves:
        if curve["std"].size:
            half = Z95 * curve["std"]
            draw.band(ax, curve["speed"], curve["force"] - half, curve["force"] + half, hue=hue, opacity=0.35)
        draw.line(ax, curve["speed"], curve["force"], label, hue, 2.0, view.dash)
        label = ""


def _means_of_maps(ax: Any, view: View, force: np.ndarray, label: str, hue: str) -> None:
    for direction in (1, -1):
        found = [(np.mean(view.velocity[own]), np.mean(force[own])) for _, _, own in groups_of(view, direction) if own.size]
        if found:
            speeds, means = map(np.array, zip(*found))
            draw.line(ax, speeds, means, label, hue, 2.0, view.dash)
            draw.dots(ax, speeds, means, "", hue, 3.0, "diamond")
            label = ""


def friction_curve(view: View) -> Sheet | None:
    """Friction over velocity."""
    if not view.has_fit or not view.count:
        return None
    taken = f"; the torque is less {view.taken_off}" if view.taken_off else ""
    bands = "; bands are 95 % intervals of the curve" if any(one["std"].size for one in view.facts["curves"]) else ""
    bands += "; lines are means at each speed over the places of the samples" if view.has_maps else ""
    said = ", ".join(f"{row['name']} {significant(row['value'])} {unit_text(row['unit'])}" for row in view.facts["parameters"]
                     if row["name"] not in ("thermal_gain_discrete", "thermal_pole"))
    fig = Sheet("friction_curve", "Friction over velocity", view.origin + taken + bands, f"Friction over velocity from these parameters: {said}.")
    over_velocity(fig.panels((400, [1]))[0], view)
    return fig


def while_warming(ax: Any, view: View, title: str = "") -> None:
    """Friction at one speed over time with its 95 % band, what the samples say of it, and the same of a joint that stays cold. Of a friction
    with maps its change E."""
    sign = np.sign(view.velocity)
    left = view.kept((view.torque - view.fitted) * sign)
    at = view.facts.get("at_speed")
    curve = at["force"] if at else view.energy
    deviation = at["std"] if at else view.energy_std
    limits = draw.bulk([view.kept(curve) + left], 0.01)
    draw.dots(ax, view.kept(view.clock), view.kept(curve) + left, "measured, brought to that speed" if at else "(torque − F_{n}) · sign(v)")
    if deviation is not None and deviation.size:
        half = Z95 * deviation
        # an interval may be thinner than any line
        label = f"95 % interval, ± {significant(half.max(), 2)} {view.torque_unit} at most"
        draw.band(ax, view.clock, curve - half, curve + half, label, "vermilion", 0.5)
    draw.line(ax, view.clock, curve, view.fit_name if at else "E (void)" if view.void else "E", "vermilion", 1.0, view.dash)
    if at:
        draw.level(ax, at["cold"], "cold model, without heat", "blue", 1.6)
    reach = (curve.min(), curve.max(), at["cold"] if at else 0.0)
    spare = 0.04 * (max(*reach, limits[1]) - min(*reach, limits[0]))
    ax.set_ylim(min(*reach, limits[0]) - spare, max(*reach, limits[1]) + spare)
    speed = f"friction at {significant(at['speed'], 2)} {view.speed_unit}" if at else "change of the level, E"
    draw.finish(ax, view.time_name, view.torque_name(speed), title)


def places_of(answer: dict[str, Any]) -> list[tuple[dict[str, Any], bool]]:
    """The bands of an answer over the position, and whether each is of a torque that is no friction."""
    maps = (answer.get("friction") or {}).get("maps", [])
    return [(band, one.get("factor", "direction") == "one") for one, band in zip(maps, answer.get("bands", []), strict=False)
            if band["quantities"] == ["position"]]


def over_place(ax: Any, band: dict[str, Any], unit: str, is_load: bool, title: str = "") -> None:
    """Friction at the median speed over the position, or a torque over the position that is no friction, with its 95 % interval."""
    place = np.array(band["points"])[:, 0]
    lower, upper = np.array(band["interval95"]).T
    hue = "grey" if is_load else "blue"
    draw.band(ax, place, lower, upper, hue=hue)
    draw.line(ax, place, np.array(band["value"]), "", hue)
    if not is_load:
        ax.set_ylim(0, 1.1 * upper.max())
    draw.finish(ax, f"position ({'m' if unit == 'N' else 'rad'})", f"{'torque that is no friction' if is_load else 'friction'} ({unit})", title)


def friction_over_place(answer: dict[str, Any], unit: str) -> Sheet | None:
    """What an answer has over the position; nothing where it is the same everywhere."""
    found = places_of(answer)
    if not found:
        return None
    friction = [band for band, is_load in found if not is_load]
    said = "The torque has a part over the position that is no friction."
    if friction:
        values = np.array(friction[0]["value"])
        said = f"Friction is {significant(values.min())} to {significant(values.max())} {unit} over the position."
    fig = Sheet("friction_over_place", "Friction over the position", "at the median speed, cold, with its 95 % interval", said)
    for ax, (band, is_load) in zip(fig.panels(*[(260, [1])] * len(found)), found):
        over_place(ax, band, unit, is_load)
    return fig


MEANS = 80  # of a log: dots about as far apart as they are wide in a picture


def about_the_fit(ax: Any, view: View) -> None:
    """The same less the fit, as means over parts of the log, on an axis on which the interval of the fit can be seen."""
    at = view.facts.get("at_speed")
    half = Z95 * (at["std"] if at else view.energy_std)
    clock, left = view.kept(view.clock), view.kept((view.torque - view.fitted) * np.sign(view.velocity))
    known = np.isfinite(left)
    parts = [own for own in np.array_split(np.flatnonzero(known), min(MEANS, np.count_nonzero(known))) if own.size]
    means = np.array([left[own].mean() for own in parts])
    draw.dots(ax, [clock[own].mean() for own in parts], means, f"means of {len(parts[0])} samples" if parts else "", size=2.0)
    draw.band(ax, view.clock, -half, half, "95 % interval of the fit", "vermilion", 0.35)
    draw.level(ax, 0.0, "", "vermilion", 1.0, "solid")
    reach = 1.1 * max(np.quantile(np.abs(means), 0.98) if parts else 0.0, half.max())
    ax.set_ylim(-reach, reach)
    draw.finish(ax, view.time_name, view.torque_name("less the fit"))


def warm_up(view: View) -> Sheet | None:
    """Friction at one speed while the joint warms, and below it what the fit leaves, beside the fit's interval. Nothing without a fit that warms."""
    if not view.warms or not view.count:
        return None
    at, warmest = view.facts.get("at_speed"), view.warmest
    when = f"after {significant(view.clock[warmest])} {view.time_unit}"
    if at:
        title = f"Friction at {significant(at['speed'], 2)} {view.speed_unit} while the joint warms"
        found = (f"Friction at {significant(at['speed'], 2)} {view.speed_unit} goes from {significant(at['force'][0])} to "
                 f"{significant(at['force'][warmest])} {view.torque_unit} {when}.")
    else:
        title = "Change of friction by its own heat"
        found = f"Friction changes by E = {significant(view.energy[warmest])} {view.torque_unit} at most, {when}."
    fig = Sheet("warm_up", title, view.origin, found)
    deviation = at["std"] if at else view.energy_std
    if deviation is None or not deviation.size:
        while_warming(fig.panels((390, [1]))[0], view)
        return fig
    above, below = fig.panels((300, [1]), (170, [1]))
    while_warming(above, view)
    about_the_fit(below, view)
    return fig


def estimates(named: list[tuple[str, View]]) -> Sheet | None:
    """Friction over velocity of each, cold, over the samples of the first, and E over time of those that warm. Nothing of fewer than two."""
    fits = [(name, view) for name, view in named if view.has_fit and view.count]
    if len(fits) < 2:
        return None
    first = fits[0][1]
    warm = [(i, name, view) for i, (name, view) in enumerate(fits) if view.warms]
    fig = Sheet("estimates", "Friction by several estimates", f"samples are of {first.source}",
                f"Cold friction over velocity by {', '.join(name for name, _ in fits)}.")
    axes = fig.panels((370, [1, 1] if warm else [1]))
    draw.dots(axes[0], first.kept(first.velocity), first.kept(first.torque), "measured")
    for i, (name, view) in enumerate(fits):
        hue, dash = look_of_several(i)
        label = name
        for curve in view.facts["curves"]:
            if curve["energy"] == 0:
                draw.line(axes[0], curve["speed"], curve["force"], label, hue, 2.0, dash)
                label = ""
        if view.has_maps:
            _means_of_maps(axes[0], view, view.facts["at_heats"][0]["force"], name, hue)
    draw.finish(axes[0], first.speed_name, first.torque_name("torque"), "Friction over velocity, cold")
    for i, name, view in warm:
        draw.line(axes[1], view.time / first.seconds, view.energy, name, look_of_several(i)[0], 2.0, look_of_several(i)[1])
    if warm:
        draw.finish(axes[1], first.time_name, first.torque_name("E"), "Warm-up")
    return fig
