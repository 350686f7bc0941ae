"""Simulated recordings with their truth, suites of them, and scores. Simulation needs MuJoCo 4.0."""

from __future__ import annotations

import contextlib
import dataclasses
import html
import json
import math
import os
import pathlib
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from warmjoint import _core, mujoco_library
from warmjoint.answers import FrictionAtSpeed, Parameter
from warmjoint.estimate import Estimate
from warmjoint.log import Log
from warmjoint.values import kind_of, of_kind, path_of, whole

if TYPE_CHECKING:
    import pandas

Identifier = Callable[[Log], "Estimate | Mapping[str, Any]"]
Progress = Callable[[int, int], None]


@dataclasses.dataclass(frozen=True)
class Simulated:
    """A recording and the truth behind its N samples."""

    log: Log
    truth: dict[str, Any]  # friction as a dict, initial_energy; velocity, force, loss and energy as [N] arrays

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes recording.csv and truth.json, as `warmjoint simulate` does."""
        path = pathlib.Path(path_of(folder, "folder"))
        path.mkdir(parents=True, exist_ok=True)
        self.log.save(path / "recording.csv")
        text = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in self.truth.items()}
        lines = ",\n".join(f" {json.dumps(name)}: {json.dumps(value)}" for name, value in text.items())
        _core.write_text(os.fspath(path / "truth.json"), f"{{\n{lines}\n}}\n")


def simulate(scenario: str | os.PathLike[str] | Mapping[str, Any], *, seed: int | None = None, realization: int = 0,
             **changes: Any) -> Simulated:
    """Carries out a scenario: the path of a YAML file, or what such a file holds.

        simulate({"friction": {"law": "coulomb", "parameters": {"coulomb": 2}}, "motion": {"speeds": [0.1, 1], "hold": 5},
                  "duration": 60}, noise={"torque": 0.1})

    changes go over its entries. The same seed and realization give the same recording. Raises BadInput.
    """
    set_ = [(key, _core.to_json(value, key)) for key, value in changes.items()]
    with _file_of(scenario, "scenario") as path:
        arguments, truth = _engine().simulate(path, set_, None if seed is None else whole("seed", seed), whole("realization", realization))
    for name in ("velocity", "force", "loss", "energy"):
        truth[name] = np.asarray(truth[name], dtype=np.float64)
    return Simulated(Log(**arguments, name="simulation"), truth)


def score(estimate: Estimate, truth: Simulated | Mapping[str, Any], log: Log | None = None) -> dict[str, Any]:
    """An estimate against the truth: {continuous{parameter: {truth, estimate, estimated, interval95, covered, relative_error,
    bound}}, discrete, npe_continuous, npe_discrete, ...}. bound: Cramer-Rao standard deviation, SI. log: that it was identified
    from, where the estimate does not know it."""
    of_kind("estimate", estimate, Estimate)
    if log is not None:
        of_kind("log", log, Log)
    if not isinstance(truth, (Simulated, Mapping)):
        raise _core.BadInput(f"truth: is {kind_of(truth)}; give what simulate returns, or what truth.json holds")
    known = truth.truth if isinstance(truth, Simulated) else dict(truth)
    one = log or estimate.log or (truth.log if isinstance(truth, Simulated) else None)
    if one is None:
        raise _core.BadInput("score: the estimate comes from a file; give the log that it was identified from")
    return _core.score(estimate.data, one._core, known)


@dataclasses.dataclass(frozen=True)
class Run:
    """What became of a suite. `directory` is that of `warmjoint run`."""

    directory: pathlib.Path
    results: int
    rejected: int  # by the identifier's own tests
    unanswered: int  # crashed, took too long, or wrote something else
    not_simulated: int
    silent: list[tuple[str, str]]  # identifiers that never answered, with their first reason
    notice: str  # of joints that did not follow their motion


def run(suite: str | os.PathLike[str] | Mapping[str, Any], output: str | os.PathLike[str] | None = None, *,
        identifiers: Mapping[str, Identifier | None] | Iterable[str] = (), realizations: int | None = None,
        seed: int | None = None, jobs: int | None = None, progress: Progress | None = None) -> Run:
    """Runs a suite (a name of `warmjoint list suites`, a YAML file, or what such a file holds) into a directory, or goes on where an
    earlier run stopped.

    identifiers: names, or {"mine": function, "energy-ml": None}. A function gets a Log and returns an Estimate or what an
    estimate.json holds; it is judged as our own are. output: a new temporary directory where it is left out. progress is called
    with the realizations that are finished, and all. Ctrl-C ends it, resumably. Raises BadInput.
    """
    named = dict(identifiers) if isinstance(identifiers, Mapping) else dict.fromkeys(identifiers)
    functions = {name: _answer(function) for name, function in named.items() if function is not None}
    options: dict[str, object] = {"identifiers": [name for name, function in named.items() if function is None]}
    options |= {name: value for name, value in (("realizations", realizations), ("seed", seed), ("jobs", jobs)) if value is not None}
    directory = pathlib.Path(path_of(output, "output") if output is not None else tempfile.mkdtemp(prefix="warmjoint_"))
    with _file_of(suite, "suite") as path:
        ending = _engine().run(path, os.fspath(directory), options, functions, progress or (lambda done, of: None))
    return Run(directory, **ending)


class Board(list[dict[str, Any]]):
    """A leaderboard, best identifier first, or a comparison: a list of rows, each a dict."""

    def to_pandas(self) -> pandas.DataFrame:
        import pandas

        return pandas.DataFrame(list(self))

    def _repr_html_(self) -> str:
        names = list(dict.fromkeys(name for row in self for name in row))
        rows = "".join("<tr>" + "".join(f"<td>{html.escape(_cell(row.get(name)))}</td>" for name in names) + "</tr>" for row in self)
        return "<table><tr>" + "".join(f"<th>{html.escape(name)}</th>" for name in names) + f"</tr>{rows}</table>"


def compare(run: Run | str | os.PathLike[str] | Estimate, other: Estimate | None = None) -> Board:
    """The leaderboard of a run, best identifier first: what `warmjoint compare --format json` prints of `rows`, as a list of dicts with
    to_pandas().

    Of two estimates of one joint their numbers beside each other, a row each: the parameters, and the friction of the cold joint at the
    speeds that both logs hold. difference: second less first; apart: the difference as a share of sqrt(a^2 + b^2), a and b the half
    widths of both 95 % intervals, so that independent answers that agree are below 1 in 95 of 100 rows; None where an interval is missing.
    Raises BadInput, also for estimates in different units.
    """
    if isinstance(run, Estimate) or other is not None:
        return Board(_side_by_side(run, other))
    directory = run.directory if isinstance(run, Run) else path_of(run, "run")
    board = json.loads(_engine().leaderboard(os.fspath(directory), "json"))
    return Board(_flat(row) | ({"variant": group["variant"]} if "variant" in group else {})
                 for group in board.get("groups", [board]) for row in group["rows"])


def _side_by_side(first: Any, second: Any) -> Iterator[dict[str, Any]]:
    for argument, one in (("run", first), ("other", second)):
        if not isinstance(one, Estimate):
            raise _core.BadInput(f"{argument}: is {kind_of(one)}; give two estimates, compare(one, other), or a run alone")
    rows = [estimate.parameters for estimate in (first, second)]
    for name in dict.fromkeys([*rows[0], *rows[1]]):
        yield _row_of(name, [found.get(name) for found in rows])
    for speed in _speeds_of_both(first, second):
        found: list[Parameter | None] = [_friction_at(estimate, speed) for estimate in (first, second)]
        yield _row_of(f"friction at {speed:.3g} {first.friction_at_speeds[0].speed_unit}", found)


def _row_of(name: str, found: list[Parameter | None]) -> dict[str, Any]:
    """A number of the first and the second estimate; None of one that has it not."""
    units = {one.unit for one in found if one}
    if len(units) > 1:
        raise _core.BadInput(f"compare: {name} is in {' and in '.join(sorted(units))}; identify both with one unit, as by torque_constant")
    row: dict[str, Any] = {"name": name, "unit": units.pop()}
    for which, one in zip(("first", "second"), found, strict=True):
        lower, upper = (one and one.ci95) or (None, None)
        row |= {which: one.value if one else None, f"{which}_lower": lower, f"{which}_upper": upper}
    both = [one for one in found if one]
    row["difference"] = both[1].value - both[0].value if len(both) == 2 else None
    halves = [(one.ci95[1] - one.ci95[0]) / 2 for one in both if one.ci95]
    row["apart"] = abs(row["difference"]) / math.hypot(*halves) if len(halves) == 2 and any(halves) else None
    return row


def _cold(estimate: Estimate, way: float) -> list[FrictionAtSpeed]:
    """What is known of the cold joint in one direction, slow to fast; nothing of an estimate whose numbers are void."""
    rows = [row for row in estimate.friction_at_speeds if not row.heat and row.speed * way > 0]
    return sorted(rows, key=lambda row: abs(row.speed)) if estimate.data.get("friction") else []


def _speeds_of_both(first: Estimate, second: Estimate) -> list[float]:
    """Speeds of either estimate, rad/s or m/s, that lie between the slowest and the fastest of both."""
    found = []
    for way in (1.0, -1.0):
        known = [[abs(row.speed) for row in _cold(estimate, way)] for estimate in (first, second)]
        if all(known):
            slowest, fastest = max(one[0] for one in known), min(one[-1] for one in known)
            found += [way * speed for speed in sorted({*known[0], *known[1]}) if slowest <= speed <= fastest]
    return found


def _friction_at(estimate: Estimate, speed: float) -> Parameter:
    """Friction of the cold joint against its motion, N.m or N, as its estimate knows it: between the speeds that it gives half widths, and what the
    mean over positions adds to the law, go over in straight lines."""
    way, rows = np.sign(speed), _cold(estimate, float(np.sign(speed)))
    at = np.array([abs(row.speed) for row in rows])
    value = way * estimate.fitted(speed) + np.interp(abs(speed), at, [row.value for row in rows] - way * estimate.fitted(way * at))
    half = np.interp(abs(speed), at, [(row.ci95[1] - row.ci95[0]) / 2 for row in rows])
    return Parameter("friction", float(value), rows[0].unit, float(half / 1.96), (float(value - half), float(value + half)))


def require_mujoco() -> None:
    """Loads MuJoCo's library. Raises ImportError where MuJoCo 4.0 is not installed."""
    try:
        import mujoco
    except ImportError:
        raise ImportError("simulation needs MuJoCo 4.0: pip install 'mujoco==4.0.*'") from None
    if not mujoco.__version__.startswith("4.0."):
        raise ImportError(f"simulation needs MuJoCo 4.0, and {mujoco.__version__} is installed: pip install 'mujoco==4.0.*'; "
                          "identification and attach work with it as it is")
    mujoco_library.share()


def _engine() -> ModuleType:
    """The module that needs MuJoCo 4.0."""
    require_mujoco()
    from warmjoint import _engine

    return _engine


@contextlib.contextmanager
def _file_of(given: str | os.PathLike[str] | Mapping[str, Any], argument: str) -> Iterator[str]:
    """The path of a scenario or a suite; of one that is given as a dict that of a temporary file."""
    if not isinstance(given, Mapping):
        yield path_of(given, argument)
        return
    text = _core.to_json(dict(given), argument)
    with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
        path = pathlib.Path(folder) / f"{argument}.yaml"
        path.write_text(text, encoding="utf-8")
        try:
            yield os.fspath(path)
        except _core.BadInput as refusal:
            raise _core.BadInput(str(refusal).replace(os.fspath(path), argument)) from None


def _answer(function: Identifier) -> Callable[[dict[str, Any]], str]:
    def answer(arguments: dict[str, Any]) -> str:
        estimate = function(Log(**arguments))
        return estimate.to_json() if isinstance(estimate, Estimate) else _core.to_json(dict(estimate), "estimate")

    return answer


def _cell(value: Any) -> str:
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def _flat(row: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested figures under joined names: npe_continuous_median."""
    flat: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, Mapping):
            flat |= _flat(value, f"{prefix}{name}_")
        else:
            flat[prefix + name] = value
    return flat

