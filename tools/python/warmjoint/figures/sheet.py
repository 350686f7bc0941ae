"""A matplotlib Figure with title, subtitle and panels, and what is drawn on it: series that are remembered for CSV and tests."""

from __future__ import annotations

import contextlib
import contextvars
import dataclasses
import html
import io
import itertools
import math
import re
import textwrap
import warnings
from collections.abc import Iterator, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullLocator

from .numerals import significant
from .style import DASHES, MARKERS, TEXT, TICK, TITLE, colour, look, rc_of

PAGE = 960.0  # width of all figures, points: side by side they have words of one size
NARROWEST = 230.0  # of a panel whose numbers can be read, points
ABREAST = 3  # panels in a row of a grid
MARGIN = 14.0
LINE = 1.25  # of the height of words
LETTER = 0.56  # mean width of one, of their height: lines are broken by their count of letters
APART, PLACES = 300, 3000  # dots and places of lines that files of vectors hold one by one; more are a picture in them
CROWD = 3000  # dots that are all drawn; of more, one in each cell
LARGEST = 1e100  # of what is drawn: products and differences of two such numbers are still numbers
CELLS = (480, 240)  # across and up: closer than the smallest dots are wide


class TooSmall(ValueError):
    """A panel would have no room at the size that is asked for."""


class TooLarge(ValueError):
    """A number that no axis can hold."""


@dataclasses.dataclass
class Series:
    """What is drawn of one series; x, y, lower, upper, value are arrays of one length where they are there."""

    ax: Any
    label: str
    kind: str
    columns: dict[str, np.ndarray]
    hue: str = ""


class Sheet(Figure):
    """One figure. name: of its file; finding: one sentence that says what one sees, the alt text."""

    def __init__(self, name: str, title: str, subtitle: str = "", finding: str = "") -> None:
        own = look()
        super().__init__(dpi=own["dpi"], facecolor=own["background"])
        FigureCanvasAgg(self)
        self._rc = rc_of(own)
        self.name, self.title, self.subtitle, self.finding = name, title, subtitle, finding
        self.drawn: list[Series] = []

    def draw(self, renderer: Any) -> None:
        """In its own style, whenever that is: ticks are made when they are drawn."""
        with matplotlib.rc_context(self._rc):
            super().draw(renderer)

    def savefig(self, *given: Any, **named: Any) -> None:
        with matplotlib.rc_context(self._rc):
            super().savefig(*given, **named)

    def _repr_png_(self) -> bytes:
        """What a notebook shows of a cell that ends with a figure."""
        return in_few_colours(self)

    def panels(self, *rows: tuple[float, Sequence[float]]) -> list[Any]:
        """Axes of rows, each a height (points) and the shares of its panels: in the order of reading. Panels that would be too narrow stand
        one below the other."""
        size, own = _size.get({}), look()
        scale = own["scale"]
        width = (size.get("width") or own["width"]) / 25.4 * 72 / scale or PAGE
        flat = []
        for height, shares in rows:
            if min(shares) / sum(shares) * width < NARROWEST and len(shares) > 1:
                flat += [(min(height, 0.75 * width), [1.0])] * len(shares)
            else:
                flat.append((min(height, 0.75 * width) if len(rows) == 1 and len(shares) == 1 else height, list(shares)))
        titled = size.get("titled", True)
        head = self._write_head(width, titled, scale)
        heights = [height for height, _ in flat]
        wanted = size.get("height", 0) / 25.4 * 72 / scale
        total = wanted or head + sum(heights) + MARGIN
        if total - head < 40 * len(heights) or width < 90:
            raise TooSmall(f"'{self.name}' is too small: {width * scale * 25.4 / 72:.0f} x {total * scale * 25.4 / 72:.0f} mm leave its panels "
                           "no room; give a larger --size")
        self.set_size_inches(scale * width / 72, scale * total / 72)
        margin = MARGIN / width
        self.set_layout_engine("constrained", h_pad=5 * scale / 72, w_pad=5 * scale / 72, hspace=0.01, wspace=0.01,
                               rect=(margin / 2, MARGIN / 2 / total, 1 - margin, 1 - (head + MARGIN / 2) / total))
        self._place_head(width, total, scale)
        # rows of like panels stand in line
        groups = [list(rows) for _, rows in itertools.groupby(flat, key=lambda row: tuple(row[1]))]
        grid = self.add_gridspec(len(groups), 1, height_ratios=[sum(height for height, _ in rows) for rows in groups])
        places = []
        for i, alike in enumerate(groups):
            shares = alike[0][1]
            part = grid[i].subgridspec(len(alike), len(shares), height_ratios=[height for height, _ in alike], width_ratios=shares)
            places += [[part[k, column] for column in range(len(shares))] for k in range(len(alike))]
        axes = []
        for row, (height, shares) in zip(places, flat):
            for place, share in zip(row, shares):
                ax = self.add_subplot(place)
                ax.panel_width = width * share / sum(shares)
                ax.xaxis.set_major_locator(MaxNLocator(max(3, int(ax.panel_width / 62)), steps=[1, 2, 2.5, 5, 10]))
                ax.yaxis.set_major_locator(MaxNLocator(max(3, int(height / 38)), steps=[1, 2, 2.5, 5, 10]))
                axes.append(ax)
        return axes

    def grid(self, count: int, height: float) -> list[Any]:
        """Axes of `count` panels of one height (points), ABREAST in a row; the last row may have room left."""
        columns = min(ABREAST, count)
        axes = self.panels(*[(height, [1.0] * columns)] * -(-count // columns))
        for ax in axes[count:]:
            ax.set_axis_off()
        return axes[:count]

    def _write_head(self, width: float, titled: bool, scale: float) -> float:
        """Breaks title and subtitle into lines; returns the height that they take, points."""
        self._head = []
        room, height = width - 2 * MARGIN, MARGIN if titled else 2.0
        for text, size, bold in ((self.title, TITLE, True), (self.subtitle, TEXT, False)):
            for line in lines_of(text, room, size * (1.08 if bold else 1)) if titled and text else ():
                self._head.append((line, size, bold, height))
                height += LINE * size
        return height + (6 if self._head else 0)

    def _place_head(self, width: float, total: float, scale: float) -> None:
        for text, size, bold, top in self._head:
            self.text(MARGIN / width, 1 - top / total, math_text(text), fontsize=scale * size, weight="bold" if bold else "normal", va="top",
                      color=look()["text" if bold else "faint"])

    def csv(self) -> str:
        """All that is drawn: panel, series, kind, x, y, lower, upper, value. kind: line, dot, band, bar, box (y: median; lower, upper:
        quartiles), whiskers, outlier, cell (value: its colour), level (x or y). Lines that begin with # name the axes with their units."""
        axes = list(dict.fromkeys(series.ax for series in self.drawn))
        names = {ax: ax.get_title(loc="left") or f"panel {i + 1}" for i, ax in enumerate(axes)}
        text = "".join(f"# {plain(names[ax])}: x is {plain(ax.get_xlabel())}; y is {plain(ax.get_ylabel())}\n" for ax in axes)
        rows = ["panel,series,kind,x,y,lower,upper,value"]
        count = dict.fromkeys(axes, 0)
        for series in self.drawn:
            count[series.ax] += 1
            head = f"{_quoted(plain(names[series.ax]))},{_quoted(plain(series.label) or f'series {count[series.ax]}')},{series.kind}"
            size = max(map(np.size, series.columns.values()))
            columns = [_texts(series.columns.get(name), size) for name in ("x", "y", "lower", "upper", "value")]
            rows += [f"{head},{','.join(row)}" for row in zip(*columns)]
        return text + "\n".join(rows) + "\n"

    def series(self) -> dict[str, dict[str, np.ndarray]]:
        """{series: {x, y, lower, upper, value}} of what is drawn; of several panels and unnamed series by panel and number."""
        axes = list(dict.fromkeys(one.ax for one in self.drawn))
        found: dict[str, dict[str, np.ndarray]] = {}
        for one in self.drawn:
            panel = plain(one.ax.get_title(loc="left")) or (f"panel {axes.index(one.ax) + 1}" if len(axes) > 1 else "")
            name = ": ".join(filter(None, (panel, plain(one.label) or one.kind)))
            count = sum(known == name or known.startswith(name + " (") for known in found)
            found[f"{name} ({count + 1})" if count else name] = one.columns
        return found

    def summary(self) -> str:
        """A line for each series with the mean size of its numbers: that of two figures is alike where their data are."""
        lines = []
        for series in self.drawn:
            known = {key: np.abs(np.asarray(value, float)) for key, value in series.columns.items()}
            means = [f"{key} {value.size} {np.nanmean(value):.6g}" for key, value in known.items() if np.isfinite(value).any()]
            lines.append(", ".join([plain(series.label), *means]))
        return "\n".join(lines)


_size: contextvars.ContextVar[dict[str, Any]] = contextvars.ContextVar("size")


@contextlib.contextmanager
def page_size(size: dict[str, Any]) -> Iterator[None]:
    """Figures that are made within have this width and height (mm; 0: what they need), and a title where `titled`."""
    token = _size.set(size)
    try:
        yield
    finally:
        _size.reset(token)


def lines_of(text: str, width: float, size: float = TEXT) -> list[str]:
    """A text in lines of about that width, points."""
    return textwrap.wrap(text, max(12, int(width / (LETTER * size))), break_long_words=False, break_on_hyphens=False)


def math_text(text: str) -> str:
    """What stands in _{} is set lower, where it is letters, digits and signs: others may be no mathematics."""
    return re.sub(r"_\{([A-Za-z0-9+−-]+)\}", lambda m: "$_{" + m.group(1) + "}$", text.replace("$", r"\$"))


def plain(text: str) -> str:
    """The inverse: a label without mathematics."""
    return text.replace("$_{", "_{").replace("}$", "}").replace(r"\$", "$").replace("\n", " ")


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if any(letter in text for letter in ',"#') else text


def _texts(values: Any, size: int) -> list[str]:
    """With all digits, as short as they can be; NaN stays empty."""
    if values is None:
        return [""] * size
    written = repr(np.broadcast_to(np.asarray(values, float), size).tolist())[1:-1].split(", ")
    return [text[:-2] if text.endswith(".0") else "" if text == "nan" else text for text in written]


def _keep(ax: Any, label: str, kind: str, hue: str, **columns: Any) -> None:
    arrays = {name: np.atleast_1d(np.asarray(value, float)) for name, value in columns.items()}
    known = np.concatenate([np.abs(array[np.isfinite(array)]) for array in arrays.values()])
    if known.size and known.max() > LARGEST:
        raise TooLarge(f"'{getattr(ax.figure, 'name', kind)}': {label or kind} reaches {known.max():.3g}; at most {LARGEST:g} can be drawn")
    if hasattr(ax.figure, "drawn"):
        ax.figure.drawn.append(Series(ax, label, kind, arrays, hue))


# series


def line(ax: Any, x: Any, y: Any, label: str = "", hue: str = "blue", width: float = 1.5, dash: str = "solid") -> None:
    """y over x; NaN interrupts."""
    _keep(ax, label, "line", hue, x=x, y=y)
    ax.plot(x, y, color=colour(hue), linewidth=look()["scale"] * width, linestyle=DASHES[dash], label=math_text(label) or None,
            solid_joinstyle="round", dash_capstyle="butt", rasterized=np.size(x) > PLACES)


def dots(ax: Any, x: Any, y: Any, label: str = "", hue: str = "grey", size: float = 1.1, marker: str = "circle", opacity: float = 1.0) -> None:
    """Markers; size: radius, points. Of a crowd, one in each cell of the picture."""
    _keep(ax, label, "dot", hue, x=x, y=y)
    x, y = np.asarray(x, float), np.asarray(y, float)
    shown = _uncrowded(x, y)
    scale = look()["scale"]
    ax.plot(x[shown], y[shown], linestyle="", marker=MARKERS[marker], color=colour(hue), markersize=2 * scale * size, markeredgewidth=0,
            alpha=opacity, rasterized=np.count_nonzero(shown) > APART, zorder=1.9)
    if label:
        ax.plot([], [], linestyle="", marker=MARKERS[marker], color=colour(hue), markersize=2 * scale * max(2.5, size), markeredgewidth=0,
                label=math_text(label))


def _uncrowded(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    known = np.isfinite(x) & np.isfinite(y)
    if known.sum() <= CROWD:
        return known
    cells = []
    for values, count in zip((x[known], y[known]), CELLS):
        low, high = np.quantile(values, (0.001, 0.999))
        cells.append(np.floor((values - low) / ((high - low) or 1) * count).astype(np.int64))
    _, first = np.unique(cells[0] * 1_000_003 + cells[1], return_index=True)
    shown = np.zeros(x.size, bool)
    shown[np.flatnonzero(known)[first]] = True
    return shown


def band(ax: Any, x: Any, lower: Any, upper: Any, label: str = "", hue: str = "blue", opacity: float = 0.25) -> None:
    """The area between two curves, over dots and below lines."""
    _keep(ax, label, "band", hue, x=x, lower=lower, upper=upper)
    ax.fill_between(x, lower, upper, color=colour(hue), alpha=opacity, linewidth=0, label=math_text(label) or None, zorder=1.95)


def bar(ax: Any, x: float, height: float, label: str = "", hue: str = "blue", opacity: float = 1.0) -> None:
    """An upright bar from 0."""
    _keep(ax, label, "bar", hue, x=x, y=height)
    ax.bar([x], [height], 0.6, color=colour(hue), alpha=opacity, linewidth=0, label=math_text(label) or None)


def box(ax: Any, x: float, values: np.ndarray, hue: str) -> None:
    """A box plot: the middle half with its median, whiskers from the 5 % to the 95 % quantile, what lies beyond one by one."""
    low, q25, median, q75, high = np.quantile(values, (0.05, 0.25, 0.5, 0.75, 0.95))
    beyond = values[(values < low) | (values > high)]
    _keep(ax, "", "box", hue, x=x, y=median, lower=q25, upper=q75)
    _keep(ax, "", "whiskers", hue, x=x, lower=low, upper=high)
    if beyond.size:
        _keep(ax, "", "outlier", hue, x=np.full(beyond.size, float(x)), y=beyond)
    scale, paint = look()["scale"], colour(hue)
    thin = {"color": paint, "linewidth": 1.3 * scale}
    ax.bxp([{"med": median, "q1": q25, "q3": q75, "whislo": low, "whishi": high, "fliers": beyond}], positions=[x], widths=[0.5],
           patch_artist=True, manage_ticks=False, boxprops={"facecolor": (*to_rgb(paint), 0.25), "edgecolor": paint, "linewidth": 1.3 * scale},
           whiskerprops=thin, capprops=thin, medianprops={"color": paint, "linewidth": 2.5 * scale},
           flierprops={"marker": "o", "markersize": 3.6 * scale, "markerfacecolor": paint, "markeredgewidth": 0})


def cells(ax: Any, values: np.ndarray, x: tuple[float, float], y: tuple[float, float], limits: tuple[float, float], colours: Any = "viridis") -> Any:
    """Cells coloured by value over a rectangle, [rows, columns], row 0 at the lowest y; NaN stay empty. Returns what a colour bar needs."""
    rows, columns = values.shape
    middles = [low + (high - low) * (np.arange(count) + 0.5) / count for (low, high), count in ((x, columns), (y, rows))]
    _keep(ax, "", "cell", "", x=np.tile(middles[0], rows), y=np.repeat(middles[1], columns), value=values.ravel())
    ax.grid(False)
    return ax.pcolormesh(np.linspace(*x, columns + 1), np.linspace(*y, rows + 1), np.ma.masked_invalid(values), cmap=colours, vmin=limits[0],
                         vmax=limits[1], rasterized=True)


def level(ax: Any, y: float, label: str = "", hue: str = "text", width: float = 1.2, dash: str = "dashed") -> None:
    """A straight line across the whole panel."""
    _keep(ax, label, "level", hue, y=y)
    ax.axhline(y, color=colour(hue), linewidth=look()["scale"] * width, linestyle=DASHES[dash], label=math_text(label) or None)


# axes


def finish(ax: Any, x: str, y: str, title: str = "") -> None:
    """Names of axes and panel, and a legend between title and panel where series have names."""
    ax.set_xlabel(math_text(x))
    ax.set_ylabel("\n".join(map(math_text, lines_of(y, 330, TEXT))))
    handles, labels = ax.get_legend_handles_labels()
    rows, scale = 0, look()["scale"]
    if labels:
        # as many columns as their letters leave room for
        room = getattr(ax, "panel_width", 400) - 60
        widths = [LETTER * TICK * len(plain(label)) + 44 for label in labels]
        columns = next((n for n in range(len(labels), 1, -1) if sum(max(widths[i::n]) for i in range(n)) < room), 1)
        rows = math.ceil(len(labels) / columns)
        # matplotlib fills columns first; read along the rows
        order = [i for column in range(columns) for i in range(column, len(labels), columns)]
        ax.legend([handles[i] for i in order], [labels[i] for i in order], ncol=columns, loc="lower left", bbox_to_anchor=(0, 1.0))
    ax.set_title("\n".join(map(math_text, lines_of(title, getattr(ax, "panel_width", 400) - 40, TEXT * 1.1))),
                 y=1.0, pad=scale * (5 + rows * 1.45 * TICK))  # with y, matplotlib looks for no better place


def whole_numbers(ax: Any) -> None:
    """An axis that counts iterations: logarithmic beyond 100."""
    low, high = ax.dataLim.x0, ax.dataLim.x1
    if high > 100:
        ax.set_xlim(max(1, low), high)
        logarithmic(ax, "x")
    else:
        ax.xaxis.set_major_locator(MaxNLocator(8, integer=True, steps=[1, 2, 5, 10]))


def logarithmic(ax: Any, side: str) -> None:
    """Makes an axis logarithmic, x or y, with plain numbers at it: 1, 2, 5, 10 where it spans up to three decades."""
    (ax.set_xscale if side == "x" else ax.set_yscale)("log")
    axis = ax.xaxis if side == "x" else ax.yaxis
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 2000 * low else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}" if 1e-4 < value < 1e6 else significant(value, 1)))
    axis.set_minor_locator(NullLocator())


def magnitudes(ax: Any, values: Sequence[Any]) -> None:
    """Logarithmic where the values span more than a factor of 30 and none is below 0, else from zero."""
    known = np.concatenate([np.ravel(one) for one in values]) if len(values) else np.zeros(0)
    known = known[np.isfinite(known)]
    if known.size and known.min() > 0 and known.max() > 30 * known.min():
        ax.set_ylim(known.min() / 1.2, known.max() * 1.2)
        logarithmic(ax, "y")
    else:
        ax.set_ylim(0, 1.08 * known.max() if known.size and known.max() > 0 else 1)


def categories(ax: Any, names: Sequence[str]) -> None:
    """Names at 0, 1, 2, ..., in lines as wide as their place."""
    room = getattr(ax, "panel_width", 400) * 0.9 / max(1, len(names))
    ax.set_xlim(-0.5, len(names) - 0.5)
    ax.xaxis.set_major_locator(FixedLocator(range(len(names))))
    ax.set_xticklabels(["\n".join("\n".join(lines_of(part, room, TICK)) for part in name.split("\n")) for name in names])
    ax.grid(False, axis="x")
    ax.tick_params(axis="x", length=0)


def one_turn(ax: Any) -> None:
    """0 ... 2 pi rad."""
    ax.set_xlim(0, 2 * math.pi)
    ax.set_xticks([i * math.pi / 2 for i in range(5)], ["0", "π/2", "π", "3π/2", "2π"])


def bulk(values: Sequence[Any], outermost: float = 0.001) -> tuple[float, float]:
    """Limits that hold all but that share of the values at either end, with 15 % to spare; all where that holds everything."""
    known = np.concatenate([np.ravel(one) for one in values])
    known = known[np.isfinite(known)]
    if not known.size:
        return 0.0, 1.0
    low, high = np.quantile(known, (outermost, 1 - outermost))
    spare = 0.15 * (high - low)
    low, high = max(known.min(), low - spare), min(known.max(), high + spare)
    if low == high:
        spare = 0.1 * abs(low) or 1.0
        return low - spare, high + spare
    return low - 0.04 * (high - low), high + 0.04 * (high - low)


def beyond(values: Sequence[Any], limits: tuple[float, float]) -> int:
    """How many values limits leave out."""
    return int(sum(np.count_nonzero((np.ravel(one) < limits[0]) | (np.ravel(one) > limits[1])) for one in values))


# words


def words(ax: Any, title: str, paragraphs: Sequence[tuple[str, str, bool]]) -> None:
    """(text, hue, bold) one below the other in place of a plot."""
    ax.set_axis_off()
    ax.set_title(title, y=1.0)
    scale, y = look()["scale"], 0.0
    for text, hue, bold in paragraphs:
        for part in lines_of(text, ax.panel_width - 30, TEXT * (1.06 if bold else 1)):
            ax.annotate(math_text(part), (0, 1), (0, -scale * y), xycoords="axes fraction", textcoords="offset points", va="top", color=colour(hue),
                        weight="bold" if bold else "normal", annotation_clip=False).set_in_layout(False)
            y += LINE * TEXT
        y += 4


def words_height(paragraphs: Sequence[tuple[str, str, bool]], width: float) -> float:
    """What `words` needs in a panel of that width, points."""
    return 34 + sum(4 + LINE * TEXT * len(lines_of(text, width - 30, TEXT * (1.06 if bold else 1))) for text, _, bold in paragraphs)


TABLE_ROW = 17.0


def table(ax: Any, title: str, rows: Sequence[Sequence[str]]) -> None:
    """Rows of texts, the first the head; columns but the first stand to the right."""
    ax.set_axis_off()
    ax.set_title(title, y=1.0)
    scale = look()["scale"]
    widths = [max(len(plain(row[i])) for row in rows) + 2 for i in range(len(rows[0]))]
    size = min(TICK, (ax.panel_width - 20) / (0.6 * sum(widths)))
    ends = np.cumsum(widths) / sum(widths)
    for k, row in enumerate(rows):
        for i, text in enumerate(row):
            ax.annotate(math_text(text), (ends[i] if i else 0, 1), (0, -scale * TABLE_ROW * k), xycoords="axes fraction", textcoords="offset points",
                        va="top", ha="right" if i else "left", fontsize=scale * size, weight="normal" if k else "bold",
                        annotation_clip=False).set_in_layout(False)


# files


def encode(sheet: Sheet, format: str = "png", dpi: float = 0) -> bytes:
    """The bytes of a file, the same for the same figure; its title and finding are inside as words. Raises TooSmall."""
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message=".*constrained_layout.*")
        try:
            sheet.get_layout_engine().execute(sheet)
        except UserWarning:
            raise TooSmall(f"'{sheet.name}' is too small for its panels; give a larger --size") from None
    sheet.set_layout_engine("none")  # it is laid out, once
    dpi = dpi or look()["dpi"]
    return _png(sheet, dpi) if format == "png" else _vectors(sheet, format, dpi)


def in_few_colours(sheet: Sheet) -> bytes:
    """The figure as PNG with a palette of 256 colours: few lines have more, and pages and notebooks are to fit into a mail."""
    from PIL import Image

    file = io.BytesIO()
    Image.open(io.BytesIO(encode(sheet))).quantize(256, dither=Image.Dither.NONE).save(file, "png", compress_level=9)
    return file.getvalue()


def _png(sheet: Sheet, dpi: float) -> bytes:
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    words, file = PngInfo(), io.BytesIO()
    for key, text in (("Title", sheet.title), ("Description", sheet.finding), ("Data", sheet.summary()), ("Software", "warmjoint")):
        words.add_itxt(key, text)
    sheet.set_dpi(dpi)
    sheet.canvas.draw()
    Image.fromarray(np.asarray(sheet.canvas.buffer_rgba())).convert("RGB").save(file, "png", pnginfo=words, dpi=(dpi, dpi), compress_level=4)
    return file.getvalue()


def _vectors(sheet: Sheet, format: str, dpi: float) -> bytes:
    file = io.BytesIO()
    if format == "svg":
        about = {"Title": sheet.title, "Description": sheet.finding, "Date": None, "Creator": "warmjoint"}
    else:
        about = {"Title": sheet.title, "Subject": sheet.finding, "CreationDate": None, "Creator": "warmjoint", "Producer": "warmjoint"}
    sheet.savefig(file, format=format, dpi=dpi, facecolor=look()["background"], metadata=about)
    if format != "svg":
        return file.getvalue()
    # places to a hundredth of a point, and what screen readers say of it
    short = re.sub(rb' d="[^"]*"', lambda path: re.sub(rb"(\.\d\d)\d+", rb"\1", path[0]), file.getvalue())
    said = f"<title>{html.escape(sheet.title)}</title><desc>{html.escape(sheet.finding)}</desc>"
    return re.sub(rb"(<svg [^>]*>)", lambda m: m[1] + said.encode(), short, count=1)
