"""Figures of a run that compares compensators."""

from __future__ import annotations

import numpy as np

from . import sheet as draw
from .numerals import look_of_several, significant
from .run_view import Run
from .sheet import Sheet


def residual_by_minute(run: Run) -> Sheet | None:
    """The residual of each compensator over the minutes of the log, medians over the realizations: a panel each, in it a line for each variant."""
    shown = [row for row in run.rows if np.nanmax(row.by_minute, initial=0) > 0]
    if not shown:
        return None
    reached = ", ".join(f"{row.label} {significant(float(np.nanmedian(row.by_minute)))} %" for row in shown)
    fig = Sheet("residual_by_minute", "What each compensator leaves of the friction",
                run.about("rms of true friction less the compensator's within each minute, medians", each=True), f"Median minute: {reached}.")
    longest = max(row.by_minute.shape[1] for row in shown)
    unit, minutes = ("h", 60) if longest > 120 else ("min", 1)
    lines = [[_medians(row.by_minute if rung is None else row.by_minute[row.variant == rung]) for rung in run.rungs] for row in shown]
    for ax, row, own in zip(fig.grid(len(shown), 210), shown, lines):
        for i, (rung, median) in enumerate(zip(run.rungs, own)):
            hue, dash = look_of_several(i)
            draw.line(ax, np.arange(median.size) / minutes, median, run.name_of(rung), hue, 1.2, dash)
        # one scale, so that panels can be compared
        draw.magnitudes(ax, [median for of_row in lines for median in of_row])
        draw.finish(ax, f"time ({unit})", "residual (% of friction)", row.label)
    return fig


def _medians(by_minute: np.ndarray) -> np.ndarray:
    """Over the realizations, [minutes]; NaN where none has a value."""
    known = np.isfinite(by_minute).any(axis=0)
    medians = np.full(by_minute.shape[1], np.nan)
    medians[known] = np.nanmedian(by_minute[:, known], axis=0)
    return medians
