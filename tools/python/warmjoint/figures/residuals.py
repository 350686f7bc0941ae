"""What a fit leaves: residuals over what they may depend on and over their own past, and prediction against measurement."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .friction import Z95
from .numerals import significant
from .sheet import Sheet
from .view import View, binned_median

BINS, LAGS = 40, 40
OVER = {"time": "time", "position": "position", "velocity": "velocity", "energy": "warmth", "motor_angle": "motor angle"}


def over(ax: Any, view: View, what: str, title: str = "") -> None:
    """Residuals over time, position, velocity, energy or motor_angle with their median in 40 bins: flat where the model is complete. Single wild
    ones leave the panel."""
    across, name = {"time": (view.clock, view.time_name), "position": (view.position, view.position_name), "velocity": (view.velocity, view.speed_name),
                    "energy": (view.energy, view.torque_name("E")), "motor_angle": (view.motor_angle, "motor angle (rad)")}[what]
    x, left = view.kept(across), view.residuals()
    middles, medians = binned_median(x, left, BINS)
    draw.dots(ax, x, left, "", "grey", 0.9)
    draw.level(ax, 0)
    draw.line(ax, middles, medians, "", "vermilion", 2.0)
    draw.dots(ax, middles, medians, "", "vermilion", 1.8)
    # zero in the middle; medians stay inside
    limits = draw.bulk([left], 0.002)
    reach = max(abs(limits[0]), abs(limits[1]), 1.05 * np.nanmax(np.abs(medians), initial=0))
    ax.set_ylim(-reach, reach)
    draw.finish(ax, name, view.torque_name("residual"), title)


def correlation(view: View, lag: int) -> float:
    """Of residuals with those `lag` samples later, over pairs that are both kept."""
    left = view.residuals()
    variance = left.var() if left.size else 0
    centred = view.torque - view.fitted - (left.mean() if left.size else 0)
    pairs = view.keep[:-lag] & view.keep[lag:]
    count = np.count_nonzero(pairs)
    return float((centred[:-lag][pairs] * centred[lag:][pairs]).sum() / (count * variance)) if count and variance > 0 else 0.0


def memory(ax: Any, view: View, title: str = "") -> None:
    """Correlation of residuals over lag, as far as a typical segment; within the dashed lines where white."""
    n = view.time.size
    longest = n // 4 if not view.segments else min(max(view.count // len(view.segments), 20), n // 4)
    lags = np.unique(np.rint(np.geomspace(1, max(longest, 2), LAGS)).astype(int))
    found = [correlation(view, int(lag)) for lag in lags]
    seconds = lags * float(np.median(np.diff(view.time)))
    draw.line(ax, seconds, found, "", "blue", 1.2)
    draw.dots(ax, seconds, found, "", "blue", 2.5)
    for bound in (1, -1):
        draw.level(ax, bound * Z95 / np.sqrt(view.count))
    draw.logarithmic(ax, "x")
    draw.finish(ax, "lag (s), from one sample on", "correlation", title)


def panels_of(view: View) -> Sheet:
    """Residuals over time, velocity and position, and their correlation over lag."""
    fig = Sheet("residuals", "What the fit leaves", "", "Residuals over time, position and velocity, and their correlation over lag: a complete "
                "model leaves none of them a pattern.")
    a, b, c, d = fig.panels((220, [1, 1]), (220, [1, 1]))
    over(a, view, "time", "Over time")
    over(b, view, "velocity", "Over velocity")
    over(c, view, "position", "Over position")
    memory(d, view, "Correlation over lag")
    return fig


def predicted(view: View) -> Sheet | None:
    """Predicted over measured torque at the kept samples with the line of equality, and the residuals over the predicted torque."""
    return _predicted(view, "predicted", "Predicted against measured torque", "samples")


def held_out(view: View) -> Sheet | None:
    """The same of samples that the fit has not seen, the only ones that the view keeps."""
    return _predicted(view, "held_out", "Predicted against measured torque, on samples that were held out", "samples that this fit has not seen")


def _predicted(view: View, name: str, title: str, samples: str) -> Sheet | None:
    if not view.has_fit or not view.count:
        return None
    sign = np.where(view.kept(view.velocity) < 0, -1, 1)
    # along the motion friction has one sign, and fills the plane; torques have their rigid part, as the sensor has them
    measured, fitted = view.kept(view.torque + view.rigid) * sign, view.kept(view.fitted + view.rigid) * sign
    rmse = f"{significant(float(np.sqrt(np.mean(view.residuals() ** 2))))} {view.torque_unit}"
    fig = Sheet(name, title + (" (void)" if view.void else ""), f"{view.origin}: RMSE {rmse} over {view.count} {samples}",
                f"Measured and predicted torque differ by {rmse} rms.")
    left, right = fig.panels((365, [1, 1]))
    for way, label, hue in ((1, "forwards", "blue"), (-1, "backwards", "vermilion")):
        own = sign == way
        if own.any():
            draw.dots(left, measured[own], fitted[own], label, hue)
            draw.dots(right, fitted[own], (measured - fitted)[own])
    ends = np.array([min(measured.min(), fitted.min()), max(measured.max(), fitted.max())])
    draw.line(left, ends, ends, "equal", "text", 1.2, "dashed")
    left.set_xlim(ends + (ends[1] - ends[0]) * np.array([-0.04, 0.04]))
    left.set_ylim(left.get_xlim())
    for way, label, hue in ((1, "forwards", "blue"), (-1, "backwards", "vermilion")):
        if (sign == way).any():
            draw.line(right, *binned_median(fitted[sign == way], (measured - fitted)[sign == way], BINS), f"median {label}", hue, 2.0)
    draw.level(right, 0)
    right.set_ylim(draw.bulk([measured - fitted]))
    draw.finish(left, view.torque_name("measured · sign(v)"), view.torque_name("predicted · sign(v)"))
    draw.finish(right, view.torque_name("predicted · sign(v)"), view.torque_name("residual · sign(v)"))
    return fig
