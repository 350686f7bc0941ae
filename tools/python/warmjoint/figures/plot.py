"""Figures of sources as files, for `warmjoint plot` and --plot, all of a command at once."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from . import friction
from .families import Refusal, Source, chosen, left_out
from .sheet import Sheet, TooLarge, TooSmall, encode, page_size
from .style import use


def answer(request: dict[str, Any]) -> bytes:
    """See __main__.py."""
    setting, wanted = request["setting"], request["figures"]
    size = {"width": setting["width"], "height": setting["height"], "titled": setting["titled"]}
    heads: list[dict[str, Any]] = []
    files: list[bytes] = []
    notes: list[str] = []
    try:
        with use(setting["style"]), page_size(size):
            for place, sheet in _sheets(request["sources"], wanted, notes):
                try:
                    drawn = encode(sheet, setting["format"], setting["dpi"])
                except TooSmall as refusal:
                    if wanted:
                        raise
                    notes.append(f"{request['sources'][place]['place']}: {sheet.name}: left out: {refusal}")
                    continue
                bytes_of = [(f"{sheet.name}.{setting['format']}", drawn, sheet.finding, False)]
                if request["data"]:
                    bytes_of.append((f"{sheet.name}.csv", sheet.csv().encode(), f"the series of {sheet.name}", True))
                for name, data, finding, is_data in bytes_of:
                    heads.append({"source": place, "name": name, "finding": finding, "is_data": is_data, "size": len(data)})
                    files.append(data)
    except Refusal as refusal:
        return json.dumps({"refusal": {"place": refusal.place, "why": str(refusal)}}).encode() + b"\n"
    except TooSmall as refusal:
        return json.dumps({"refusal": {"place": "--size", "why": str(refusal)}}).encode() + b"\n"
    except TooLarge as refusal:
        sources = ", ".join(dict.fromkeys(str(one["place"]) for one in request["sources"]))
        return json.dumps({"refusal": {"place": sources, "why": str(refusal)}}).encode() + b"\n"
    return json.dumps({"files": heads, "left_out": notes}).encode() + b"\n" + b"".join(files)


def _sheets(given: list[dict[str, Any]], wanted: list[str], notes: list[str]) -> Iterator[tuple[int, Sheet]]:
    """(position of the source, figure). A figure that was not asked for by name and has no room is left out, and noted."""
    sources = []
    for place, facts in enumerate(given):
        source = Source(facts)
        sources.append(source)
        if wanted:
            yield from ((place, sheet) for sheet in chosen(source, wanted))
            continue
        lacking = []
        for name, (make, _) in source.figures().items():
            try:
                sheet = make()
            except TooSmall as refusal:
                notes.append(f"{source.place}: {name}: left out: {refusal}")
                continue
            if sheet is None:
                lacking.append(name)
            else:
                yield place, sheet
        if lacking:
            notes.append(f"{source.place}: left out: {left_out(source, lacking)}")
    named = [(_stem(one.place), one.view) for one in sources if one.kind == "estimate" and one.view]
    several = friction.estimates(named) if not wanted else None
    if several is not None:
        yield len(sources), several


def _stem(place: str) -> str:
    from pathlib import PurePath

    return PurePath(place).stem
