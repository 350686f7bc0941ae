"""Bags, Parquet, NumPy, JSON and Excel files: their columns, read by a child process (formats/__main__.py) with limits of its own."""

from __future__ import annotations

import json
import pathlib
import signal
import subprocess
import sys
import warnings
from collections.abc import Mapping

import numpy as np

from warmjoint import _core
from warmjoint.values import Column


def is_other(path: str) -> bool:
    """Whether the program leaves a file, by its name, or a folder to these readers."""
    return _core.is_other_format(path)


def may_hold_objects(path: str) -> bool:
    """Whether a file that the program reads may hold cells, compounds or structs, which it does not read."""
    return _core.may_hold_objects(path)


def read(path: str, *, topic: str | None = None, joint: str | None = None, joints: str = "one",
         map: Mapping[str, str] | None = None) -> list[Column] | str:
    """The columns that `map` names, by our names, or all; or a table of text. joints: "one" or "all" of a bag, where none is named. Warns of
    what is left out. Raises BadInput."""
    for name, column in (map or {}).items():
        if not isinstance(column, str):
            raise _core.BadInput(f"map.{name}: is a {type(column).__name__}; give the name of a column")
    readers = {one["ending"]: one["reader"] for one in _core.log_formats() if one["reader"]}
    request = {"file": path, "readers": readers, "topic": topic or "", "joint": joint or "", "joints": joints, "map": dict(map or {})}
    script = pathlib.Path(__file__).parent / "formats/__main__.py"
    done = subprocess.run([sys.executable, "-P", "-B", str(script), json.dumps(request)], capture_output=True, check=False)
    if done.returncode < 0:
        late = -done.returncode in (signal.SIGALRM, signal.SIGXCPU, signal.SIGKILL)
        raise _core.BadInput(f"{path}: cannot be read: " + ("its reader takes too long; the file is damaged, or too large: take a part of it" if late
                                                           else f"its reader crashed (signal {-done.returncode})"))
    head, newline, rest = done.stdout.partition(b"\n")
    if done.returncode or not newline:
        words = done.stderr.decode(errors="replace").strip().splitlines()
        raise _core.BadInput(f"{path}: cannot be read: {words[-1][:200] if words else 'its reader broke off'}")
    answer = json.loads(head)
    if "error" in answer:
        raise _core.BadInput(_core.in_python(answer["error"]))
    for note in answer["notes"]:
        warnings.warn(f"{path}: {note}", stacklevel=5)
    if "text" in answer:
        return _text_of(rest)
    columns, at = [], 0
    for one in answer["columns"]:
        columns.append(Column(one["name"], one["unit"], np.frombuffer(rest, dtype=np.float64, count=one["count"], offset=at)))
        at += 8 * one["count"]
    return columns


def _text_of(table: bytes) -> str:
    """A table of text: of a packed file in the characters of its own program."""
    try:
        return table.decode("utf-16" if table[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8")
    except UnicodeDecodeError:
        return table.decode("latin-1")
