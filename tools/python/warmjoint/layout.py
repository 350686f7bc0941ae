"""Where the parts of a figure go: words and their widths, numbers of axes, rows and columns of panels.

Places are points of the figure, from its upper left corner; matplotlib's rcParams say which typeface is measured.
"""

import functools
import math
import re

import matplotlib
import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path
from matplotlib.ticker import FixedLocator, Formatter, LogLocator, MaxNLocator

ROW_STEP = 18  # of tables
ROW = 24  # of the numbers of an upright axis
PAD, MARGIN, GAP, MARK, KEY, BAR = 6, 16, 20, 4, 20, 12
NARROWEST = 230  # of a plot whose numbers can be read
LEAST = (40, 40)  # between the axes
LINE, ASCENT = 2384 / 2048, 1901 / 2048  # of DejaVu Sans, in ems
TITLE, TEXT, TICK = 16 / LINE, 12 / LINE, 11 / LINE  # sizes of words whose lines are 16, 12 and 11 high


class TooSmall(ValueError):
    """A plot would have no room at the size that is asked for."""


def math_text(text):
    """What stands in _{} is set lower."""
    return re.sub(r"_\{(.*?)\}", lambda m: "$_{" + m.group(1) + "}$", text.replace("$", r"\$"))


@functools.lru_cache(maxsize=20000)
def _width(text, size, bold, family):
    weight = "bold" if bold else "normal"
    words = math_text(text)
    return text_to_path.get_text_width_height_descent(
        words, FontProperties(family=list(family), size=size, weight=weight), ismath=words != text.replace("$", r"\$"))[0]


def width_of(text, size, bold=False):
    """Width of a line, points."""
    return _width(text, size, bold, tuple(matplotlib.rcParams["font.family"]))


def wrap(text, size, bold=False, width=None):
    """Lines no wider than `width`, where words allow it."""
    lines = []
    for part in text.split("\n"):
        line = ""
        for word in part.split(" "):
            longer = f"{line} {word}" if line else word
            if line and width and width_of(longer, size, bold) > width:
                lines.append(line)
                longer = word
            line = longer
        lines.append(line)
    return lines


def height_of(text, size, bold=False, width=None):
    return LINE * size * len(wrap(text, size, bold, width)) if text else 0


# numbers


def _power(value, decimals):
    exponent = int(f"{value:.{decimals}e}".split("e")[1])
    mantissa = f"{value / 10.0 ** exponent:.{decimals}f}"
    power = "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return power if mantissa == "1" else mantissa.replace("-", "−") + "·" + power


class Numbers(Formatter):
    """Numbers as people write them: a true minus, one power of ten for a whole axis of very small or large ones."""

    def __init__(self, axis):
        self.of = axis

    def __call__(self, value, pos=None):
        return f"{value:g}".replace("-", "−")

    def format_ticks(self, values):
        self.set_locs(values)
        if self.of["scale"] == "logarithmic":
            return [_power(v, 0) if v and not 0.99e-3 <= abs(v) < 0.99e5 else
                    f"{v:.{max(0, -math.floor(math.log10(v) + 1e-9))}f}" for v in values]
        return linear_texts(values, self.of["lower"], self.of["upper"])


def linear_texts(values, lower, upper):
    largest = max(abs(lower), abs(upper), 1e-300)
    step = min(np.diff(values)) if len(values) > 1 else largest
    decade = math.floor(math.log10(step) + 1e-9)
    if 0.99e-3 <= largest < 0.99e5:
        return [f"{v + 0.0:.{max(0, -decade)}f}".replace("-", "−") if abs(v) > 1e-9 * step else "0" for v in values]
    exponent = math.floor(math.log10(largest) + 1e-9)
    digits, factor = max(0, exponent - decade), 10.0 ** exponent
    power = _power(factor, 0)
    return ["0" if abs(v) < 1e-9 * step else f"{v / factor:.{digits}f}·{power}".replace("-", "−") for v in values]


def locator_of(axis, wanted):
    """Where an axis has its numbers: at most about `wanted` of them."""
    if axis["ticks"]:
        return FixedLocator([tick["value"] for tick in axis["ticks"] if tick["label"]])
    wanted = max(wanted, 1)
    if axis["scale"] == "linear":
        return MaxNLocator(nbins=wanted, steps=[1, 2, 5, 10], integer=axis["finest"] >= 1, min_n_ticks=2)
    decades = math.log10(axis["upper"] / axis["lower"])
    return LogLocator(subs=(1, 2, 5) if 3 * decades <= wanted else (1,), numticks=max(2, wanted))


def ticks_of(axis, wanted):
    """Values and labels between the limits."""
    if axis["ticks"]:
        return [(tick["value"], tick["label"]) for tick in axis["ticks"] if tick["label"]]
    lower, upper = axis["lower"], axis["upper"]
    values = np.asarray(locator_of(axis, wanted).tick_values(lower, upper))
    spare = 1e-9 * (upper - lower)
    return [(v, text) for v, text in zip(values, Numbers(axis).format_ticks(values)) if lower - spare <= v <= upper + spare]


def share_of(axis, value):
    lower, upper = axis["lower"], axis["upper"]
    if axis["scale"] == "linear":
        return (value - lower) / (upper - lower)
    return math.log(value / lower) / math.log(upper / lower)


def wanted_y(height):
    return max(3, int(height / ROW))


def wanted_x(axis, width):
    """As many numbers as leave 18 points between them."""
    for wanted in range(max(3, int(width / 45)), 1, -1):
        ticks = [(width * share_of(axis, v), width_of(text, TICK)) for v, text in ticks_of(axis, wanted)]
        if all(b - a >= (wa + wb) / 2 + 18 for (a, wa), (b, wb) in zip(ticks, ticks[1:])):
            return wanted
    return 1


def category_lines(axis, width):
    """Labels of categories broken to the room that each has, where they must be at their hyphens."""
    room = width / max(1, len(axis["ticks"])) - 6
    labels = [tick["label"] for tick in axis["ticks"] if tick["label"]]
    if any(width_of(word, TICK) > room for label in labels for word in label.split()):
        labels = [label.replace("-", "- ") for label in labels]
    return ["\n".join(wrap(label, TICK, width=room)).replace("- ", "-") for label in labels]


def heat_map_of(plot):
    return next((s["shape"] for s in plot["series"] if s["shape"]["kind"] == "heat_map"), None)


def colour_bar(shape):
    """The scale of a heat map as a plot of its own."""
    (lower, upper), label = shape["limits"], shape["label"]
    ramp = {**shape, "values": np.linspace(lower, upper, 256)[:, None], "x": (0, 1), "y": (lower, upper)}
    return {"x": {"label": "", "lower": 0, "upper": 1, "scale": "linear", "ticks": [{"value": 0, "label": ""}]},
            "y": {"label": label, "lower": lower, "upper": upper, "scale": "linear", "ticks": [], "finest": 0},
            "series": [{"label": "", "hue": "text", "shape": ramp}]}


# places


def entry_width(series):
    return KEY + PAD + width_of(series["label"], TICK)


def legend_lines(plot, width):
    """The series of each line of the legend."""
    lines, at = [], 0
    for series in filter(lambda s: s["label"], plot["series"]):
        entry = entry_width(series)
        if not lines or at + entry > width:
            lines.append([])
            at = 0
        lines[-1].append(series)
        at += entry + 16
    return lines


def legend_height(plot, width):
    return (LINE * TICK + 3) * len(legend_lines(plot, width))


def below_of(plot, width):
    """Room for numbers and name of the horizontal axis of a plot in a cell of that width."""
    lines, name = 1, plot["x"]["label"]
    if plot["x"]["ticks"]:
        lines = max([0, *(label.count("\n") + 1 for label in category_lines(plot["x"], 0.85 * width))])
    return MARK + 2 + LINE * TICK * lines + (3 + height_of(name, TEXT, width=width) if name else 0)


def sides_of(plot, width, height):
    """Room for numbers and names left and right of a plot of that height and about that width."""
    def upright(axis):
        return max([0, *(width_of(text, TICK) for _, text in ticks_of(axis, wanted_y(height)))]), LINE * TEXT * len(wrap(axis["label"], TEXT, width=height))

    left = MARK + 3 + sum(upright(plot["y"])) + PAD + 2
    across = [] if plot["x"]["ticks"] else ticks_of(plot["x"], wanted_x(plot["x"], width))
    right = max([4, *(width_of(text, TICK) / 2 for _, text in across[-1:])])
    shape = heat_map_of(plot)
    if shape:
        right = 10 + BAR + 6 + sum(upright(colour_bar(shape)["y"])) + PAD + 4
    return left, right


def natural_height(content, width):
    if content["kind"] == "words":
        return sum(height_of(p["text"], TEXT, p["bold"], width) + PAD for p in content["paragraphs"])
    return ROW_STEP * len(content["rows"]) if content["kind"] == "table" else 0


def tracks(lengths, begin):
    places = []
    for length in lengths:
        places.append((begin, begin + length))
        begin += length + GAP
    return places


def head_height(figure):
    """y below title and subtitle."""
    width, y = figure["width"] - 2 * MARGIN, MARGIN - 4
    y += height_of(figure["title"], TITLE, True, width) + 2 if figure["title"] else 0
    y += height_of(figure["subtitle"], TEXT, False, width)
    return y + 12 if figure["title"] or figure["subtitle"] else y


def column_tracks(figure):
    room = figure["width"] - 2 * MARGIN - GAP * (len(figure["columns"]) - 1)
    return tracks([room * share / sum(figure["columns"]) for share in figure["columns"]], MARGIN)


def title_height(panel, width):
    return height_of(panel["title"], TEXT, True, width) + 4 if panel["title"] else 0


def heights_of_words(figure):
    """Heights of the rows that are as high as their words need."""
    columns, heights = column_tracks(figure), {}
    for panel in figure["panels"]:
        if figure["rows"][panel["row"]] == 0:
            width = columns[panel["column"] + panel["column_span"] - 1][1] - columns[panel["column"]][0]
            need = title_height(panel, width) + natural_height(panel["content"], width)
            heights[panel["row"]] = max(heights.get(panel["row"], 0), need)
    return heights


def on_page(figure, look, width=0, height=0, titled=True):
    """The figure with its size: width and height in mm, 0 for what the style and the rows ask for."""
    figure = dict(figure) if titled else {**figure, "title": "", "subtitle": ""}
    points = 72 / 25.4 / look["scale"]
    if width or look["width"]:
        figure["width"] = points * (width or look["width"])
    head = head_height(figure)
    if height:
        figure["height"] = points * height
    elif len(figure["panels"]) == 1 and figure["height"]:
        # one plot keeps its form in a column of a journal
        figure["height"] = min(figure["height"], head + 0.75 * figure["width"])
    else:
        figure = stacked(figure, head)
    if not figure["height"]:
        figure["height"] = math.ceil(head + sum(figure["rows"]) + GAP * (len(figure["rows"]) - 1) + MARGIN + sum(heights_of_words(figure).values()))
    return figure


def stacked(figure, head):
    """Panels one below the other where some plot would be too narrow to be read."""
    shares, width = figure["columns"], figure["width"]

    def own(panel):
        return width * sum(shares[panel["column"]:panel["column"] + panel["column_span"]]) / sum(shares)

    if len(shares) < 2 or all(p["content"]["kind"] != "plot" or own(p) >= NARROWEST for p in figure["panels"]):
        return figure
    panels = sorted(figure["panels"], key=lambda p: (p["row"], p["column"]))

    def height(panel):
        rows = sum(figure["rows"][panel["row"]:panel["row"] + panel["row_span"]])
        if figure["height"]:
            rows *= (figure["height"] - head) / sum(figure["rows"])
        return min(rows, 0.75 * width)

    rows = [height(panel) for panel in panels]
    panels = [{**panel, "row": i, "column": 0, "row_span": 1, "column_span": 1} for i, panel in enumerate(panels)]
    return {**figure, "panels": panels, "rows": rows, "columns": [1], "height": 0}


def lay_out(figure):
    """Of each panel its cell and, between the axes or below the title, its area: left, top, right, bottom."""
    columns, words, top = column_tracks(figure), heights_of_words(figure), head_height(figure)
    room = figure["height"] - top - MARGIN - GAP * (len(figure["rows"]) - 1) - sum(words.values())
    rows = tracks([words.get(i, 0) if share == 0 else room * share / sum(figure["rows"]) for i, share in enumerate(figure["rows"])], top)
    widest: dict[tuple[str, int], float] = {}

    def widen(side, track, value):
        widest[side, track] = max(widest.get((side, track), 0), value)

    def tracks_of(panel):
        return panel["column"], panel["row"], panel["column"] + panel["column_span"] - 1, panel["row"] + panel["row_span"] - 1

    def cell_of(panel):
        left, top, right, bottom = tracks_of(panel)
        return columns[left][0], rows[top][0], columns[right][1], rows[bottom][1]

    # plots are in line with their neighbours: first above and below, then at the sides of what is left
    plots = [panel for panel in figure["panels"] if panel["content"]["kind"] == "plot"]
    for panel in plots:
        (_, first, _, last), cell = tracks_of(panel), cell_of(panel)
        width = cell[2] - cell[0]
        legend = legend_height(panel["content"], width)
        widen("above", first, title_height(panel, width) + legend + (4 if legend else 2))
        widen("below", last, below_of(panel["content"], width))
    for panel in plots:
        (first, top, last, bottom), cell = tracks_of(panel), cell_of(panel)
        height = cell[3] - cell[1] - widest["above", top] - widest["below", bottom]
        left, right = sides_of(panel["content"], 0.85 * (cell[2] - cell[0]), height)
        widen("left", first, left)
        widen("right", last, right)

    places = []
    for panel in figure["panels"]:
        (first, top, last, bottom), cell = tracks_of(panel), cell_of(panel)
        area = cell[0], cell[1] + title_height(panel, cell[2] - cell[0]), cell[2], cell[3]
        if panel in plots:
            area = (cell[0] + widest["left", first], cell[1] + widest["above", top], cell[2] - widest["right", last], cell[3] - widest["below", bottom])
            size = area[2] - area[0], area[3] - area[1]
            if size[0] < LEAST[0] or size[1] < LEAST[1]:
                raise TooSmall(f"'{figure['name']}' is too small for '{panel['title']}': {max(0, size[0]):.0f} x {max(0, size[1]):.0f} points "
                               f"are left between its axes, {LEAST[0]} x {LEAST[1]} are needed; give it more room")
        places.append((cell, area))
    return places
