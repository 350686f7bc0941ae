"""Figures of a run that compares compensators."""

from __future__ import annotations

import numpy as np

from . import sheet as draw
from .numerals import look_of_several, significant
from .run_view import Run
from .sheet import Sheet


def residual_by_minute(run: Run) -> Sheet | None:
    """The residual of each compensator over the minutes of the log, medians over the realizations; a panel for each variant."""
    shown = [row for row in run.rows if np.nanmax(row.by_minute, initial=0) > 0]
    if not shown:
        return None
    reached = ", ".join(f"{row.label} {significant(float(np.nanmedian(row.by_minute)))} %" for row in shown)
    fig = Sheet("residual_by_minute", "What each compensator leaves of the friction",
                run.about("rms of true friction less the compensator's within each minute, medians", each=True), f"Median minute: {reached}.")
    longest = max(row.by_minute.shape[1] for row in shown)
    unit, minutes = ("h", 60) if longest > 120 else ("min", 1)
    for ax, rung in zip(fig.panels(*[(370, [1]) for _ in run.rungs]), run.rungs):
        lines = []
        for i, row in enumerate(shown):
            own = row.by_minute if rung is None else row.by_minute[row.variant == rung]
            counts = np.isfinite(own).any(axis=0)
            median = np.full(own.shape[1], np.nan)
            median[counts] = np.nanmedian(own[:, counts], axis=0)
            hue, dash = look_of_several(i)
            draw.line(ax, np.arange(median.size) / minutes, median, row.label, hue, 1.4, dash)
            lines.append(median)
        draw.magnitudes(ax, lines)
        draw.finish(ax, f"time ({unit})", "residual (% of friction)", run.name_of(rung))
    return fig
