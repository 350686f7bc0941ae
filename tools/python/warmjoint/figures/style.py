"""Colours, type sizes and rcParams of all figures: the one place that says how they look."""

from __future__ import annotations

import contextlib
import contextvars
from collections.abc import Iterator
from typing import Any

# blue to sky are the palette of Okabe and Ito (2008), which colour-blind readers tell apart; caution is for words
HUES = ("text", "grey", "blue", "vermilion", "green", "purple", "orange", "sky", "caution")
TITLE, TEXT, TICK = 13.7, 10.3, 9.4  # points of the page, times the scale
DASHES = {"solid": "-", "dashed": (0, (4, 2.5)), "dotted": (0, (1.2, 1.8))}
MARKERS = {"circle": "o", "square": "s", "diamond": "D", "up": "^"}


def _look(hues: str, **look: Any) -> dict[str, Any]:
    return {**look, "hues": dict(zip(HUES, hues.split()))}


# scale: of words and lines; width: mm, 0 for that of the page; dpi: pixels an inch
_LIGHT: dict[str, Any] = {"scale": 1.0, "width": 0.0, "dpi": 144, "background": "#ffffff", "text": "#1c2026", "faint": "#545b66",
                          "axis": "#6e7580", "grid": "#e2e5ea", "rc": {}}
_HUES = "#1c2026 #80868f #0072b2 #d55e00 #008c66 #aa4d8c #d68f00 #43a5de #965c00"
STYLES = {
    "screen": _look(_HUES, **_LIGHT),
    "dark": _look("#e8ebf0 #9298a2 #4ca6e2 #f0803c #30b88e #d88abe #ecb03e #8cccf4 #f6be50",
                  **{**_LIGHT, "background": "#16191e", "text": "#e8ebf0", "faint": "#a8afba", "axis": "#868d98", "grid": "#32373f"}),
    # two columns of a journal are 180 mm wide, one is 88; its captions are of 8 points
    "paper": _look(_HUES.replace("#1c2026", "#000000").replace("#80868f", "#737373"),
                   **{**_LIGHT, "scale": 0.78, "width": 180.0, "dpi": 300, "text": "#000000", "faint": "#000000", "axis": "#000000"}),
}
_now: contextvars.ContextVar[dict[str, Any]] = contextvars.ContextVar("look", default=STYLES["screen"])


def style_of(style: Any) -> dict[str, Any]:
    """A style by its name, or as a dictionary of changes to the one called `base` (screen). Raises ValueError where there is none."""
    name = style.get("base", "screen") if isinstance(style, dict) else style
    if not isinstance(name, str) or name not in STYLES:
        given = ascii(name) if isinstance(name, str) else f"of the type {type(name).__name__}"
        raise ValueError(f"style: is {given}; it must be one of {', '.join(STYLES)}, or a dict of changes to one")
    base = STYLES[name]
    if isinstance(style, str):
        return base
    unknown = set(style) - {"base", *base}
    if unknown:
        raise ValueError(f"style: has no {min(unknown, key=str)!a}; it has {', '.join(base)}")
    return {**base, **{k: v for k, v in style.items() if k != "base"}, "hues": {**base["hues"], **style.get("hues", {})}}


def rc_of(look: dict[str, Any]) -> dict[str, Any]:
    """matplotlib's rcParams of a style."""
    scale = look["scale"]
    return {"font.family": ["DejaVu Sans"], "mathtext.fontset": "dejavusans", "mathtext.default": "regular", "axes.unicode_minus": True,
            "font.size": scale * TEXT, "axes.titlesize": scale * TEXT, "axes.titleweight": "bold", "axes.titlelocation": "left",
            "axes.labelsize": scale * TEXT, "xtick.labelsize": scale * TICK, "ytick.labelsize": scale * TICK, "legend.fontsize": scale * TICK,
            "text.color": look["text"], "axes.labelcolor": look["text"], "axes.titlecolor": look["text"], "axes.edgecolor": look["axis"],
            "xtick.color": look["axis"], "ytick.color": look["axis"], "xtick.labelcolor": look["faint"], "ytick.labelcolor": look["faint"],
            "xtick.minor.size": 0, "ytick.minor.size": 0, "axes.linewidth": scale, "xtick.major.width": scale, "ytick.major.width": scale,
            "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True, "axes.facecolor": "none",
            "grid.color": look["grid"], "grid.linewidth": scale, "figure.facecolor": look["background"], "axes.formatter.useoffset": False,
            "axes.formatter.limits": (-4, 6), "axes.xmargin": 0.02, "axes.ymargin": 0.06, "legend.frameon": False, "legend.borderpad": 0,
            "legend.borderaxespad": 0.4, "legend.handlelength": 1.8, "legend.columnspacing": 1.6, "pdf.fonttype": 42, "svg.fonttype": "none",
            "svg.hashsalt": "warmjoint", "path.simplify": True, "agg.path.chunksize": 20000, **look["rc"]}


@contextlib.contextmanager
def use(style: Any) -> Iterator[dict[str, Any]]:
    """Figures that are made within have this style."""
    import matplotlib

    look = style_of(style)
    token = _now.set(look)
    try:
        with matplotlib.rc_context(rc_of(look)):
            yield look
    finally:
        _now.reset(token)


def look() -> dict[str, Any]:
    """The style in use."""
    return _now.get()


def colour(hue: str) -> str:
    """Of a hue in the style in use; a colour stays as it is."""
    return str(look()["hues"].get(hue, hue))
