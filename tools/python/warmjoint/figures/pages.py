"""The pages of `warmjoint report`: one Jinja2 template a page, self-contained HTML."""

from __future__ import annotations

import base64
import hashlib
import json
import pathlib
import re
from collections.abc import Callable
from typing import Any

import jinja2
from markupsafe import Markup

from . import log_page, robot_page, run_page
from .sheet import Sheet, TooLarge, in_few_colours
from .style import use

HERE = pathlib.Path(__file__).resolve().parent / "templates"
CHARTS = pathlib.Path("/usr/share/javascript/dygraphs")  # of Debian's libjs-dygraphs
LICENCE = pathlib.Path("/usr/share/doc/libjs-dygraphs/copyright")
PRINT = (("N.m", "N·m"), (")^2", ")²"), ("Cramer-Rao", "Cramér-Rao"))


def in_print(text: str) -> str:
    """A text of the terminal as it is set in print."""
    for typed, printed in PRINT:
        text = text.replace(typed, printed)
    return text[:-3] + " µs" if text.endswith(" us") else text


def charts() -> list[str] | None:
    """Script, style and licence of dygraphs; nothing where it is not installed."""
    files = CHARTS / "dygraph.min.js", CHARTS / "dygraph.min.css", LICENCE
    if not all(file.is_file() for file in files):
        return None
    # without the line that names a file for debuggers: the page asks for nothing
    return [re.sub(r"\n[^\n]*# sourceMappingURL[^\n]*\n?", "", file.read_text(encoding="utf-8")) for file in files]


def hashes(texts: list[str]) -> str:
    """What a Content-Security-Policy says of the only texts that may run."""
    digests = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in texts]
    return " ".join(f"'sha256-{digest}'" for digest in digests) or "'none'"


def prepare(table: dict[str, Any]) -> dict[str, Any]:
    """A table with the kind of each column, and the head of each row."""
    header, rows = table["header"], table["rows"]
    head = 1 if header[:1] == ["#"] else 0
    kinds = []
    for i in range(len(header)):
        words = any(not row[i][:1].isdigit() and row[i][:1] not in ("", "-", "–", "+", "−") for row in rows)
        kinds.append(" ".join(["name"] * (i == head) + ["words"] * words))
    heads: list[str] = []
    for row in rows:  # rows that leave it out belong to the one above
        heads.append(row[head] or (heads[-1] if heads else ""))
    return {**table, "head": head, "kinds": kinds, "heads": heads}


def embedded(sheet: Sheet) -> str:
    """A figure as the address of an image."""
    return "data:image/png;base64," + base64.b64encode(in_few_colours(sheet)).decode()


class Picture:
    """A figure in the page's light and dark look."""

    def __init__(self, make: Callable[[], Sheet | None]) -> None:
        self._urls: dict[str, str] = {}
        self.there = False
        for style in ("screen", "dark"):
            with use(style):
                sheet = make()
                if sheet is None:
                    return
                self.there, self.name, self.title, self.finding = True, sheet.name, sheet.title, sheet.finding
                self.width, self.height = (round(72 * side) for side in sheet.get_size_inches())
                self._urls[style] = embedded(sheet)

    def url(self, style: str) -> str:
        return self._urls[style]


def pictures(makers: list[Callable[[], Sheet | None]]) -> list[Picture]:
    """Those that have something to show."""
    return [one for one in map(Picture, makers) if one.there]


def answer(name: str, content: dict[str, Any]) -> bytes:
    """See __main__.py."""
    try:
        page = fill(name, content).encode()
    except TooLarge as refusal:
        return json.dumps({"refusal": {"place": str(content.get("source", "")), "why": str(refusal)}}).encode() + b"\n"
    return json.dumps({"size": len(page)}).encode() + b"\n" + page


def fill(name: str, content: dict[str, Any]) -> str:
    """HTML that needs nothing but itself. name: log, run or robot; content: of PageFacts or RunPageFacts (tools/shown), or {source, answer} of a robot."""
    data = {"log": log_page, "run": run_page, "robot": robot_page}[name].data_of(content)
    data = {**data, "figures": pictures(data["figures"])}
    if data.get("extremes"):
        data["extremes"] = Picture(data["extremes"])
    return render(name, data)


def render(name: str, data: dict[str, Any]) -> str:
    """A template with its style and scripts."""
    style = (HERE / "page.css").read_text(encoding="utf-8")
    own = HERE / f"{name}.js"
    script = [own.read_text(encoding="utf-8")] if own.is_file() else []
    library = charts() if name == "log" else None
    scripts = script if name != "log" else [library[0], *script] if library else []
    # the library of charts sets styles of single elements
    styles = "'unsafe-inline'" if library else hashes([style])

    def json_text(value: Any) -> Markup:
        return Markup(json.dumps(value, separators=(",", ":")).replace("<", "\\u003c"))

    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(print=in_print, prepare=prepare)
    environment.globals.update(json_text=json_text)
    policy = (f"default-src 'none'; img-src data:; style-src {styles}; script-src {hashes(scripts)}; "
              "base-uri 'none'; form-action 'none'")
    return environment.get_template(f"{name}.html").render(
        **data, policy=policy, styles=[Markup(s) for s in [style] + (library[1:2] if library else [])], scripts=[Markup(s) for s in scripts],
        licence=library[2] if library else "")
