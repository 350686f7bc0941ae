"""Kept samples sorted by how fast the joint moved."""

from __future__ import annotations

import numpy as np

from .numerals import significant
from .view import View

ALIKE = 0.05  # relative difference of speeds that count as one
STRAY = 0.02  # share of the samples below which a speed joins its neighbour
LABELLED = 0.9  # share of the samples that a label speaks of
BINS = 3  # where there are too many speeds for a colour each
HUES = ("blue", "green", "orange", "vermilion", "purple", "sky")


def groups_of(view: View, direction: int) -> list[tuple[str, str, np.ndarray]]:
    """(hue, label, samples) of one direction (1 or -1), slow to fast: a group for each speed where the whole recording has up to six, else three
    of about equal numbers of samples. Groups of both directions agree; they may be empty."""
    own = np.full(view.time.size, np.nan)
    for begin, end, speed in view.segments:
        own[begin:end] = speed
    own[~view.keep] = np.nan
    sizes = np.sort(np.abs(own[np.isfinite(own)]))
    if not sizes.size:
        return []
    clusters = _clusters(sizes)
    place = np.searchsorted(np.array([group[-1] for group in clusters]), np.abs(own))
    moved = np.isfinite(own) & (own * direction > 0)
    return [(HUES[i], _label(group, view.speed_unit), np.flatnonzero(moved & (place == i))) for i, group in enumerate(clusters)]


def _clusters(sizes: np.ndarray) -> list[np.ndarray]:
    """sizes: ascending. One array for each group."""
    starts = [0]
    while (further := int(np.searchsorted(sizes, (1 + ALIKE) * sizes[starts[-1]], side="right"))) < sizes.size:
        starts.append(further)
    single = np.split(sizes, starts[1:])
    groups = _without_strays(single, sizes.size)
    if len(groups) <= len(HUES):
        return groups
    # more of them share bins of about as many samples each, whose edges part no speed
    bins: list[list[np.ndarray]] = [[] for _ in range(BINS)]
    before = 0
    for group in single:
        bins[min(before * BINS // sizes.size, BINS - 1)].append(group)
        before += group.size
    return [np.concatenate(one) for one in bins if one]


def _without_strays(single: list[np.ndarray], total: int) -> list[np.ndarray]:
    groups, i = list(single), 0
    while i < len(groups) and len(groups) > 1:
        if groups[i].size >= STRAY * total:
            i += 1
            continue
        up = groups[i + 1][0] / groups[i][-1] if i + 1 < len(groups) else np.inf
        down = groups[i][0] / groups[i - 1][-1] if i else np.inf
        slower = i if up < down else i - 1
        groups[slower:slower + 2] = [np.concatenate(groups[slower:slower + 2])]
        i = slower
    return groups


def _label(sizes: np.ndarray, unit: str) -> str:
    """ "0.3 rad/s" where nearly all samples are about so fast, else "0.3 … 0.6 rad/s"."""
    def text(speed: float) -> str:
        written = significant(speed)
        return written.rstrip("0").rstrip(".") if "." in written and "·" not in written else written

    slow, middle, fast = np.quantile(sizes, ((1 - LABELLED) / 2, 0.5, (1 + LABELLED) / 2))
    if fast <= (1 + 2 * ALIKE) * slow:
        return f"{text(middle)} {unit}"
    return f"{text(sizes[0])} … {text(sizes[-1])} {unit}"
