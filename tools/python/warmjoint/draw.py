"""Draws figures by matplotlib. A figure is data: tools/figures/figure.h says what it holds, as JSON.

    draw(figure, style="paper")       a matplotlib Figure
    draw(figure, ax=axes)             a figure of one plot, into given axes
    encode(figure, format="pdf")      the bytes of a PNG, SVG or PDF file

Colours, sizes and rcParams are those of STYLES; a dictionary as style changes some of them:
draw(figure, style={"base": "paper", "rc": {"font.family": "serif"}, "hues": {"blue": "#003366"}}).
As a program it answers one request of `warmjoint` on standard input: figures to draw, or a page to fill (page.py).
"""

import sys

if __name__ == "__main__":  # modules of this folder are no modules of others
    FOLDER = sys.path.pop(0)

import base64
import html
import io
import json
import re
from typing import Any

import matplotlib
import matplotlib.axes
import matplotlib.figure
import matplotlib.image
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import LogLocator, NullFormatter, NullLocator
from PIL.PngImagePlugin import PngInfo

if __package__:
    from . import layout
else:
    if __name__ == "__main__":
        sys.path.insert(0, FOLDER)
    import layout

HUES = ("text", "grey", "blue", "vermilion", "green", "purple", "orange", "sky", "caution")


def _look(**look):
    look["hues"] = dict(zip(HUES, look["hues"].split()))
    return look


# scale: points of the page for each of the figure, whose words have 9.4 to 13.7; width: mm; dpi: pixels an inch
_LIGHT = dict(scale=1.0, width=0.0, dpi=144, background="#ffffff", text="#1c2026", faint="#545b66", axis="#6e7580",
              grid="#e2e5ea", minor_grid="#f1f3f5", rc={},
              hues="#1c2026 #80868f #0072b2 #d55e00 #008c66 #aa4d8c #d68f00 #43a5de #965c00")
STYLES = {
    "screen": _look(**_LIGHT),
    "dark": _look(scale=1.0, width=0.0, dpi=144, background="#16191e", text="#e8ebf0", faint="#a8afba", axis="#868d98",
                  grid="#32373f", minor_grid="#24282f", rc={},
                  hues="#e8ebf0 #9298a2 #4ca6e2 #f0803c #30b88e #d88abe #ecb03e #8cccf4 #f6be50"),
    # two columns of a journal are 180 mm wide, one is 88; its captions are of 8 points
    "paper": _look(**{**_LIGHT, "scale": 0.78, "width": 180.0, "dpi": 300, "text": "#000000", "faint": "#000000",
                      "axis": "#000000", "hues": _LIGHT["hues"].replace("#1c2026", "#000000").replace("#80868f", "#737373")}),
}
# vector files hold so many markers of a plot's width (900 points of the figure) one by one, and lines of so many places: what is
# denser hides its own parts, and is a picture in them
MARKERS_APART, PLACES_APART = 300, 3000
DASHES = {"solid": "-", "dashed": (0, (4, 2.5)), "dotted": (0, (1.2, 1.8))}
MARKERS = {"circle": "o", "square": "s", "diamond": "D", "up": "^", "down": "v", "cross": "X"}


def style_of(style):
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


def _rc(look):
    return {"font.family": ["DejaVu Sans"], "mathtext.fontset": "dejavusans", "mathtext.default": "regular",
            "axes.unicode_minus": True, "text.color": look["text"], "pdf.fonttype": 42, "svg.fonttype": "none",
            "svg.hashsalt": "warmjoint", "path.simplify": True, "agg.path.chunksize": 20000, **look["rc"]}


# series


def _array(values):
    return np.array(values, dtype=float)


def _line(ax, shape, colour, scale):
    ax.plot(_array(shape["x"]), _array(shape["y"]), color=colour, linewidth=scale * shape["width"], linestyle=DASHES[shape["dash"]],
            solid_joinstyle="round", dash_capstyle="butt", rasterized=len(shape["x"]) > PLACES_APART)


def _scatter(ax, shape, colour, scale):
    ax.plot(_array(shape["x"]), _array(shape["y"]), linestyle="", marker=MARKERS[shape["marker"]], color=colour,
            markersize=2 * scale * shape["size"], markeredgewidth=0, alpha=shape["opacity"], rasterized=len(shape["x"]) > MARKERS_APART)


def _band(ax, shape, colour, scale):
    x, lower, upper = _array(shape["x"]), _array(shape["lower"]), _array(shape["upper"])
    ax.fill_between(x, lower, upper, where=np.isfinite(lower) & np.isfinite(upper), color=colour, alpha=shape["opacity"], linewidth=0)


def _bars(ax, shape, colour, scale):
    base = ax.get_ylim()[0] if ax.get_yscale() == "log" else max(0, ax.get_ylim()[0])
    ax.bar(_array(shape["x"]), _array(shape["height"]) - base, shape["width"], bottom=base, color=colour, alpha=shape["opacity"], linewidth=0)


def _box(ax, shape, colour, scale):
    thin = {"color": colour, "linewidth": 1.3 * scale}
    stats = {"med": shape["median"], "q1": shape["q25"], "q3": shape["q75"], "whislo": shape["lower"], "whishi": shape["upper"],
             "fliers": _array(shape["outliers"])}
    ax.bxp([stats], positions=[shape["x"]], widths=[shape["width"]], patch_artist=True, manage_ticks=False,
           boxprops={"facecolor": (*matplotlib.colors.to_rgb(colour), 0.25), "edgecolor": colour, "linewidth": 1.3 * scale},
           whiskerprops=thin, capprops=thin, medianprops={"color": colour, "linewidth": 2.5 * scale},
           flierprops={"marker": "o", "markersize": 3.6 * scale, "markerfacecolor": colour, "markeredgewidth": 0})


def _heat_map(ax, shape, colour, scale):
    values = np.ma.masked_invalid(np.array(shape["values"], dtype=float))
    x, y = (np.linspace(*shape[side], count + 1) for side, count in (("x", values.shape[1]), ("y", values.shape[0])))
    colours = LinearSegmentedColormap.from_list("own", shape["colours"]) if shape["colours"] else "viridis"
    ax.pcolormesh(x, y, values, cmap=colours, vmin=shape["limits"][0], vmax=shape["limits"][1], rasterized=True)


def _level(ax, shape, colour, scale):
    (ax.axvline if shape["vertical"] else ax.axhline)(shape["value"], color=colour, linewidth=scale * shape["width"], linestyle=DASHES[shape["dash"]])


def _note(ax, shape, colour, scale):
    side = {"left": "left", "centre": "center", "right": "right"}[shape["side"]]
    ax.text(shape["x"], shape["y"], layout.math_text(shape["text"]), ha=side, va="center", fontsize=layout.TICK * scale, color=colour, clip_on=True)


SHAPES = {"line": _line, "scatter": _scatter, "band": _band, "bars": _bars, "box": _box, "heat_map": _heat_map, "level": _level, "note": _note}


def _handle(series, look):
    """What stands before a label in the legend."""
    shape, colour, scale = series["shape"], look["hues"][series["hue"]], look["scale"]
    if shape["kind"] in ("line", "level"):
        return Line2D([], [], color=colour, linewidth=scale * shape["width"], linestyle=DASHES[shape["dash"]])
    if shape["kind"] == "scatter":
        return Line2D([], [], color=colour, linestyle="", marker=MARKERS[shape["marker"]], markeredgewidth=0, markersize=2 * scale * max(2.5, shape["size"]))
    return Patch(facecolor=colour, alpha=shape.get("opacity", 0.6), linewidth=0)


def fill(ax, plot, look):
    """Limits, grid, series, ticks; everything that stands between the axes and at them."""
    scale = look["scale"]
    for axis, set_scale, set_limits in ((plot["x"], ax.set_xscale, ax.set_xlim), (plot["y"], ax.set_yscale, ax.set_ylim)):
        log = axis["scale"] == "logarithmic"
        if not axis["lower"] < axis["upper"] or (log and axis["lower"] <= 0):
            raise ValueError(f"axis '{axis['label']}' cannot run from {axis['lower']} to {axis['upper']}")
        if log:
            set_scale("log")
        set_limits(axis["lower"], axis["upper"])
    limits = ax.get_xlim(), ax.get_ylim()
    for series in plot["series"]:
        SHAPES[series["shape"]["kind"]](ax, series["shape"], look["hues"][series["hue"]], scale)
    ax.set_xlim(limits[0])
    ax.set_ylim(limits[1])
    ax.set_axisbelow(True)
    ax.set_facecolor("none")
    for side, spine in ax.spines.items():
        spine.set(visible=side in ("left", "bottom"), color=look["axis"], linewidth=scale)
    ax.tick_params(which="major", length=layout.MARK * scale, width=scale, pad=2 * scale, labelsize=layout.TICK * scale, color=look["axis"], labelcolor=look["faint"])
    ax.tick_params(which="minor", length=0)
    for name, axis in (("x", plot["x"]), ("y", plot["y"])):
        if name == "y" or not axis["ticks"]:
            ax.grid(True, axis=name, which="major", color=look["grid"], linewidth=scale)
        if axis["scale"] == "logarithmic":
            ax.grid(True, axis=name, which="minor", color=look["minor_grid"], linewidth=scale)


def set_ticks(ax, plot, width, height):
    """width, height: between the axes, points of the figure."""
    for name, axis in (("x", plot["x"]), ("y", plot["y"])):
        drawn = ax.xaxis if name == "x" else ax.yaxis
        if axis["ticks"]:
            drawn.set_major_locator(layout.locator_of(axis, 0))
            labels = layout.category_lines(axis, width) if name == "x" else [tick["label"] for tick in axis["ticks"] if tick["label"]]
            drawn.set_ticklabels([layout.math_text(label) for label in labels])
        else:
            drawn.set_major_locator(layout.locator_of(axis, layout.wanted_x(axis, width) if name == "x" else layout.wanted_y(height)))
            drawn.set_major_formatter(layout.Numbers(axis))
        drawn.set_minor_formatter(NullFormatter())
        drawn.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99) if axis["scale"] == "logarithmic" else NullLocator())


def _name_upright(ax, plot, look, height, **place):
    lines = layout.wrap(plot["y"]["label"], layout.TEXT, width=height)
    ax.set_ylabel(layout.math_text("\n".join(lines)), fontsize=layout.TEXT * look["scale"], color=look["text"], linespacing=layout.LINE, **place)


def colour_bar(cax, shape, look, height):
    plot = layout.colour_bar(shape)
    fill(cax, plot, look)
    set_ticks(cax, plot, layout.BAR, height)
    cax.grid(False)
    cax.set_frame_on(False)
    cax.yaxis.tick_right()
    cax.yaxis.set_label_position("right")
    _name_upright(cax, plot, look, height, labelpad=layout.PAD * look["scale"])


class Sheet:
    """A matplotlib figure on which places are points of our figure, from its upper left corner."""

    def __init__(self, figure, look):
        self.look, self.scale, self.width, self.height = look, look["scale"], figure["width"], figure["height"]
        self.fig = matplotlib.figure.Figure(figsize=(self.scale * self.width / 72, self.scale * self.height / 72), dpi=look["dpi"],
                                            facecolor=look["background"])
        FigureCanvasAgg(self.fig)

    def at(self, x, y):
        return x / self.width, 1 - y / self.height

    def axes(self, area):
        left, top, right, bottom = area
        return self.fig.add_axes([left / self.width, 1 - bottom / self.height, (right - left) / self.width, (bottom - top) / self.height])

    def write(self, text, x, y, size, bold=False, colour=None, width=None, side="left"):
        """Lines with their upper left (or right) corner there; returns their height."""
        for i, line in enumerate(layout.wrap(text, size, bold, width)):
            self.fig.text(*self.at(x, y + size * (layout.ASCENT + layout.LINE * i)), layout.math_text(line), fontsize=size * self.scale, ha=side, va="baseline",
                          weight="bold" if bold else "normal", color=colour or self.look["text"])
        return layout.height_of(text, size, bold, width)

    def rule(self, x0, x1, y, colour):
        self.fig.add_artist(Line2D(*zip(self.at(x0, y), self.at(x1, y)), color=colour, linewidth=self.scale))


def _draw_words(sheet, content, area):
    y = area[1]
    for p in content["paragraphs"]:
        y += sheet.write(p["text"], area[0], y, layout.TEXT, p["bold"], sheet.look["hues"][p["hue"]], area[2] - area[0]) + layout.PAD


def _draw_table(sheet, content, area):
    rows, room = content["rows"], area[2] - area[0]
    widths = [max(layout.width_of(row[i], layout.TICK, row is rows[0]) for row in rows if i < len(row)) for i in range(len(rows[0]))]
    gaps = max(1, len(widths) - 1)
    shrink = min(1, room / (sum(widths) + 6 * gaps))
    gap = min(max((room - shrink * sum(widths)) / gaps, shrink * 6), 28)
    y = area[1]
    for row in rows:
        x = area[0]
        for i, (text, width) in enumerate(zip(row, widths)):
            sheet.write(text, x + (shrink * width if i else 0), y, shrink * layout.TICK, row is rows[0], side="right" if i else "left")
            x += shrink * width + gap
        y += layout.ROW_STEP
        sheet.rule(area[0], x - gap, y - 2.5, sheet.look["axis" if row is rows[0] else "grid"])


def _draw_picture(sheet, content, area):
    pixels = matplotlib.image.imread(io.BytesIO(base64.b64decode(content["png"])))
    scale = min((area[2] - area[0]) / pixels.shape[1], (area[3] - area[1]) / pixels.shape[0])
    width, middle = scale * pixels.shape[1], (area[0] + area[2]) / 2
    ax = sheet.axes((middle - width / 2, area[1], middle + width / 2, area[1] + scale * pixels.shape[0]))
    ax.imshow(pixels, aspect="auto", interpolation="lanczos")
    ax.set_axis_off()


def _draw_plot(sheet, panel, cell, area, legend_at):
    plot, look, scale = panel["content"], sheet.look, sheet.scale
    ax = sheet.axes(area)
    width, height = area[2] - area[0], area[3] - area[1]
    fill(ax, plot, look)
    set_ticks(ax, plot, width, height)
    # below the middle of the axis, or where a long name stays in its cell
    name = layout.wrap(plot["x"]["label"], layout.TEXT, width=cell[2] - cell[0])
    half = max(layout.width_of(line, layout.TEXT) for line in name) / 2
    middle = min(max((area[0] + area[2]) / 2, cell[0] + half), cell[2] - half)
    ax.set_xlabel(layout.math_text("\n".join(name)), fontsize=layout.TEXT * scale, color=look["text"], labelpad=3 * scale, x=(middle - area[0]) / width,
                  ha="center")
    _name_upright(ax, plot, look, height, va="top")
    ax.yaxis.set_label_coords((cell[0] - area[0]) / width, 0.5)
    shape = layout.heat_map_of(plot)
    if shape:
        colour_bar(sheet.axes((area[2] + 10, area[1], area[2] + 10 + layout.BAR, area[3])), shape, look, height)
    x, y = legend_at
    for line in layout.legend_lines(plot, cell[2] - x):
        sheet.fig.legend([_handle(s, look) for s in line], [layout.math_text(s["label"]) for s in line], ncol=len(line), loc="upper left",
                         bbox_to_anchor=sheet.at(x, y), frameon=False, borderpad=0, borderaxespad=0, handlelength=layout.KEY / layout.TICK,
                         handletextpad=layout.PAD / layout.TICK, columnspacing=16 / layout.TICK, fontsize=layout.TICK * scale, labelcolor=look["text"])
        y += layout.LINE * layout.TICK + 3


def _draw_panel(sheet, panel, cell, area):
    content = panel["content"]
    is_plot = content["kind"] == "plot"
    # titles and legends begin at the axis, or at the cell where they are long
    left, room = (area[0], cell[2] - area[0]) if is_plot else (cell[0], cell[2] - cell[0])
    lines = layout.legend_lines(content, room) if is_plot else []
    long = lines and (len(lines) > len(layout.legend_lines(content, cell[2] - cell[0])) or max(layout.entry_width(line[0]) for line in lines) > room)
    if long or layout.width_of(panel["title"], layout.TEXT, True) > room:
        left = cell[0]
    y = cell[1]
    if panel["title"]:
        y += sheet.write(panel["title"], left, y, layout.TEXT, True, width=cell[2] - cell[0]) + 4
    if panel.get("frame"):
        x0, y0 = sheet.at(cell[0] - 6, cell[3] + 6)
        x1, y1 = sheet.at(cell[2] + 6, cell[1] - 6)
        sheet.fig.add_artist(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor=sheet.look["hues"][panel["frame"]], linewidth=2 * sheet.scale))
    if is_plot:
        _draw_plot(sheet, panel, cell, area, (left, y))
    else:
        {"words": _draw_words, "table": _draw_table, "picture": _draw_picture}[content["kind"]](sheet, content, area)


def draw(figure: Any, style: Any = "screen", ax: Any = None, width: float = 0, height: float = 0, titled: bool = True) -> Any:
    """A matplotlib Figure of a figure (a dictionary, as JSON has it). width, height: mm, 0 for those of style and figure.

    ax: axes that a figure of one plot is drawn into, in place of a figure of its own.
    Raises layout.TooSmall where a plot has no room, ValueError for an axis without extent or several plots for one `ax`.
    """
    look = style_of(style)
    with matplotlib.rc_context(_rc(look)):
        if ax is not None:
            return _draw_into(ax, figure, look)
        figure = layout.on_page(figure, look, width, height, titled)
        places = layout.lay_out(figure)
        sheet = Sheet(figure, look)
        y = layout.MARGIN - 4
        if figure["title"]:
            y += sheet.write(figure["title"], layout.MARGIN, y, layout.TITLE, True, width=figure["width"] - 2 * layout.MARGIN) + 2
        sheet.write(figure["subtitle"], layout.MARGIN, y, layout.TEXT, colour=look["faint"], width=figure["width"] - 2 * layout.MARGIN)
        for panel, (cell, area) in zip(figure["panels"], places):
            _draw_panel(sheet, panel, cell, area)
        return sheet.fig


def _draw_into(ax, figure, look):
    plots = [panel["content"] for panel in figure["panels"] if panel["content"]["kind"] == "plot"]
    if len(plots) != 1:
        raise ValueError(f"'{figure['name']}' has {len(plots)} plots, and axes take one; leave ax out")
    if not isinstance(ax, matplotlib.axes.Axes):
        raise ValueError(f"ax: is a value of the type {type(ax).__name__}; give axes of matplotlib")
    box = ax.get_window_extent().transformed(ax.figure.dpi_scale_trans.inverted())
    fill(ax, plots[0], look)
    set_ticks(ax, plots[0], 72 * box.width / look["scale"], 72 * box.height / look["scale"])
    ax.set(xlabel=layout.math_text(plots[0]["x"]["label"]), ylabel=layout.math_text(plots[0]["y"]["label"]))
    named = [series for series in plots[0]["series"] if series["label"]]
    if named:
        ax.legend([_handle(s, look) for s in named], [layout.math_text(s["label"]) for s in named], loc="lower left", bbox_to_anchor=(0, 1), ncol=3, frameon=False)
    return ax.figure


def encode(figure, format="png", style="screen", dpi=0, **size):
    """The bytes of a file, the same for the same figure; its title and finding are inside as words. size: as draw."""
    look = style_of(style)
    with matplotlib.rc_context(_rc(look)):
        drawn = draw(figure, style, **size)
        title, finding = figure["title"], figure["finding"]
        metadata = {"svg": {"Title": title, "Description": finding, "Date": None, "Creator": "warmjoint"},
                    "pdf": {"Title": title, "Subject": finding, "CreationDate": None, "Creator": "warmjoint", "Producer": "warmjoint"}}
        inside = {"metadata": metadata[format]} if format in metadata else {"pil_kwargs": {"pnginfo": png_words(figure)}}
        file = io.BytesIO()
        drawn.savefig(file, format=format, dpi=dpi or look["dpi"], facecolor=look["background"], **inside)
    if format != "svg":
        return file.getvalue()
    # places to a hundredth of a point
    short = re.sub(rb' d="[^"]*"', lambda path: re.sub(rb"(\.\d\d)\d+", rb"\1", path[0]), file.getvalue())
    # what screen readers say of it
    words = f"<title>{html.escape(title)}</title><desc>{html.escape(finding)}</desc>"
    return re.sub(rb"(<svg [^>]*>)", lambda m: m[1] + words.encode(), short, count=1)


def summary(figure):
    """What is drawn, a line for each series with the mean size of its numbers: that of two figures is alike where their data are."""
    lines = []
    for panel in figure["panels"]:
        for series in panel["content"].get("series", []):
            lists = {key: value for key, value in series["shape"].items() if isinstance(value, list)}
            numbers = {key: np.abs(_array(value)) for key, value in lists.items() if not any(isinstance(one, (str, dict)) for one in value)}
            means = [f"{key} {value.size} {np.nanmean(value):.6g}" for key, value in numbers.items() if np.isfinite(value).any()]
            lines.append(", ".join([series["label"], *means]))
    return "\n".join(lines)


def png_words(figure):
    """Title, description and data inside of a PNG file, in UTF-8."""
    words = PngInfo()
    for key, text in (("Title", figure["title"]), ("Description", figure["finding"]), ("Data", summary(figure)), ("Software", "warmjoint")):
        words.add_itxt(key, text)
    return words


def size_of(figure, style="screen"):
    """Width and height of a drawn figure, points."""
    look = style_of(style)
    with matplotlib.rc_context(_rc(look)):
        page = layout.on_page(figure, look)
        return look["scale"] * page["width"], look["scale"] * page["height"]


def answer_figures(request, out):
    """One line with the sizes of the files and refusals, then their bytes."""
    setting = request["setting"]
    files, heads = [], []
    for figure in request["figures"]:
        try:
            files.append(encode(figure, **setting))
            heads.append({"size": len(files[-1])})
        except layout.TooSmall as refusal:
            heads.append({"size": 0, "refusal": str(refusal)})
    out.write(json.dumps(heads).encode() + b"\n" + b"".join(files))


def main():
    request = json.load(sys.stdin.buffer)
    if "figures" in request:
        return answer_figures(request, sys.stdout.buffer)
    import page
    return sys.stdout.buffer.write(page.fill(request["page"], request["data"], sys.modules["__main__"]).encode())


if __name__ == "__main__":
    main()
