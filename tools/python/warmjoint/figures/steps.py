"""Figures of how an answer came to be: the trace of an identifier that iterates, the first guess of a warming, kernels."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .numerals import hue_of, significant, unit_text
from .sheet import Sheet
from .view import Answer, View

FEW = 12  # iterations, each of which gets a mark


def trace(answer: Answer, source: str = "") -> Sheet | None:
    """Parameters and RMSE of each iteration with the final intervals, as in the paper's Fig. 8. Nothing where it did not iterate."""
    steps = answer.facts["trace"]
    if len(steps) < 2:
        return None
    iteration = np.array([step["iteration"] for step in steps], float)
    names = [name for name in steps[-1]["parameters"] if name not in ("thermal_gain_discrete", "thermal_pole")]
    names.sort(key=answer.symbols.place)
    values = {name: np.array([step["parameters"].get(name) if step["parameters"].get(name) is not None else np.nan for step in steps], float)
              for name in names}
    found = ", ".join(f"{name} {significant(values[name][0])} to {significant(values[name][-1])}" for name in names)
    fig = Sheet("trace", f"Parameters by iteration: {answer.identifier}", source, f"From the first iteration to the last: {found}.")
    hue, count = hue_of(answer.method), len(names) + 1
    # rows without an empty place
    across = 3 if count % 3 == 0 or count > 4 else 2 if count % 2 == 0 else count
    rows = [(210.0, [1.0] * min(across, count - at)) for at in range(0, count, across)]
    axes = iter(fig.panels(*rows))
    unit = ""
    for name in names:
        row = answer.parameters.get(name)
        own = f" ({unit_text(row['unit'])})" if row and row["unit"] != "1" else ""
        unit = own if name.startswith("coulomb") else unit
        ax = next(axes)
        if row and row.get("interval95"):
            low, high = row["interval95"]
            draw.band(ax, iteration[[0, -1]], [low, low], [high, high], "final 95 % interval", hue)
        _curve(ax, iteration, values[name], hue)
        draw.finish(ax, "iteration", answer.symbols.of(name) + own, answer.symbols.with_name(name))
    ax, rmse = next(axes), np.array([step["rmse"] if step["rmse"] is not None else np.nan for step in steps], float)
    _curve(ax, iteration, rmse, hue)
    draw.magnitudes(ax, [rmse])
    draw.finish(ax, "iteration", "RMSE" + unit, "Root mean square error of the fit")
    return fig


def _curve(ax: Any, iteration: np.ndarray, values: np.ndarray, hue: str) -> None:
    draw.line(ax, iteration, values, "", hue, 2.0)
    if iteration.size <= FEW:
        draw.dots(ax, iteration, values, "", hue, 3.0)
    draw.whole_numbers(ax)


def _thermal(gain: float, time_constant: float, unit: str) -> str:
    return f"k = {significant(gain)} {unit_text(unit)}, τ = {significant(time_constant)} s"


def envelope(view: View, guess: dict[str, Any] | None, name: str = "") -> Sheet | None:
    """Torque with its envelope, and the friction level c(t) with what (25) reads off it: levels cold and settled, 63 % time, gain and time
    constant, as in the paper's Fig. 4. What it reads is rough: the fit's numbers, or the truth, stand beside it."""
    if not guess:
        return None
    read = _thermal(guess["gain"], guess["time_constant"], guess["gain_unit"])
    said = f"first guess (25), from which a fit starts: {read}"
    fitted = [view.parameters[which] for which in ("thermal_gain", "thermal_time_constant") if which in view.parameters]
    doubt = ""
    if guess.get("truth"):
        doubt = f"; truth: {_thermal(guess['truth']['gain'], guess['truth']['time_constant'], guess['gain_unit'])}"
    elif len(fitted) == 2 and view.passed:
        gain, tau = fitted
        inside = all(one.get("interval95") and one["interval95"][0] <= guess[key] <= one["interval95"][1]
                     for one, key in ((gain, "gain"), (tau, "time_constant")))
        doubt = f"; the fit says {_thermal(gain['value'], tau['value'], guess['gain_unit'])}" + ("" if inside else ", and the guess is off")
    fig = Sheet("envelope", "The level of friction and the first guess of its warming", f"{name or view.source}; {said}{doubt}",
                f"The level of friction goes from {significant(guess['cold'])} to {significant(guess['settled'])} {view.torque_unit}; 63 % of the way "
                f"takes {significant(guess['time_to_63'] / view.seconds)} {view.time_unit}. Guess: {read}{doubt}.")
    left, right = fig.panels((365, [1, 1]))
    middle, level = guess["time"] / view.seconds, guess["level"]
    draw.line(left, view.clock, view.torque, "torque", "grey", 0.8)
    draw.line(left, middle, level, "level of friction", "blue", 2.0)
    draw.line(left, middle, -level, "", "blue", 2.0)
    kept = view.kept(view.torque)  # accelerations may leave the picture
    reach = 1.06 * max(np.abs(kept).max(), level.max())
    left.set_ylim(-reach if kept.min() < 0 else min(0.0, float(level.min())), reach)
    draw.finish(left, view.time_name, view.torque_name("torque"), "The recording and its level of friction")
    draw.line(right, middle, level, "level of friction", "blue", 1.4)
    draw.dots(right, middle, level, "", "blue", 3.0)
    draw.level(right, guess["cold"], "cold", "green")
    end = guess["time"][-1] / view.seconds
    draw.line(right, [0.75 * end, end], [guess["settled"]] * 2, "settled: mean of the last quarter", "vermilion", 2.5)
    reached, at = guess["cold"] + 0.632 * (guess["settled"] - guess["cold"]), guess["time_to_63"] / view.seconds
    low = min(level.min(), guess["settled"])
    draw.line(right, [0, at, at], [reached, reached, low], "63 % of the way", "text", 1.2, "dashed")
    draw.finish(right, view.time_name, view.torque_name("sign(v) · torque − k_{v} |v|"), "What the guess is read off")
    return fig


def kernels(facts: dict[str, Any]) -> Sheet:
    """A parabola seen with noise on a part of its axis, and what ridge regression makes of it with plain (10)-(13) and with normalised (16)
    kernels, beyond the data too; below, both sets of kernels. As in the paper's Fig. 3, of no recording."""
    t, seen, reach = facts["t"], facts["seen"], facts["reach"]
    edge, count = 0.3 * reach**2 - 0.5, facts["kernels"]["plain"].shape[1]
    fig = Sheet("kernels", "Normalised kernels keep their value beyond the data",
                f"{count} Gaussian kernels fitted to {seen.size} noisy values of 0.3 t² − 0.5 between −{reach:g} and {reach:g}",
                f"At t = {t[-1]:g}, beyond the data, the plain kernels say {significant(facts['fits']['plain'][-1], 2)} and the normalised ones "
                f"{significant(facts['fits']['normalised'][-1], 2)}; at the edge of the data the function is {significant(edge, 2)}.")
    ax, *below = fig.panels((320, [1]), (200, [1, 1]))
    draw.line(ax, t, facts["truth"], "0.3 t² − 0.5", "text", 1.2, "dashed")
    draw.dots(ax, seen, facts["values"], "data", "grey", 2.0)
    draw.line(ax, t, facts["fits"]["plain"], "plain kernels", "orange", 2.0)
    draw.line(ax, t, facts["fits"]["normalised"], "normalised kernels", "blue", 2.0)
    ax.set(xlim=(t[0], t[-1]), ylim=(-0.7, 1.8))
    draw.finish(ax, "t", "value")
    for one, kind, hue, title in zip(below, ("plain", "normalised"), ("orange", "blue"), ("Plain kernels", "Normalised kernels: their sum is 1")):
        for kernel in facts["kernels"][kind].T:
            draw.line(one, t, kernel, "", hue, 1.4)
        one.set(xlim=(t[0], t[-1]), ylim=(0, 1.05))
        draw.finish(one, "t", "kernel", title)
    return fig
