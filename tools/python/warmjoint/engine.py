"""Simulated recordings with their truth, suites of them, and scores. Simulation needs MuJoCo 4.0."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
import pathlib
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import ModuleType
from typing import Any

import numpy as np

from warmjoint import _core
from warmjoint.estimate import Estimate
from warmjoint.log import Log

Identifier = Callable[[Log], "Estimate | Mapping[str, Any]"]
Progress = Callable[[int, int], None]


@dataclasses.dataclass(frozen=True)
class Simulated:
    """A recording and the truth behind its N samples."""

    log: Log
    truth: dict[str, Any]  # friction as a dict, initial_energy; velocity, force, loss and energy as [N] arrays

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes recording.csv and truth.json, as `warmjoint simulate` does."""
        path = pathlib.Path(folder)
        path.mkdir(parents=True, exist_ok=True)
        self.log.save(path / "recording.csv")
        text = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in self.truth.items()}
        lines = ",\n".join(f" {json.dumps(name)}: {json.dumps(value)}" for name, value in text.items())
        (path / "truth.json").write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")


def simulate(scenario: str | os.PathLike[str] | Mapping[str, Any], *, seed: int | None = None, realization: int = 0,
             **changes: Any) -> Simulated:
    """Carries out a scenario: the path of a YAML file, or what such a file holds.

        simulate({"friction": {"law": "coulomb", "parameters": {"coulomb": 2}}, "motion": {"speeds": [0.1, 1], "hold": 5},
                  "duration": 60}, noise={"torque": 0.1})

    changes go over its entries. The same seed and realization give the same recording. Raises BadInput.
    """
    set_ = [(key, json.dumps(value)) for key, value in changes.items()]
    with _file_of(scenario) as path:
        arguments, truth = _engine().simulate(path, set_, seed, realization)
    for name in ("velocity", "force", "loss", "energy"):
        truth[name] = np.asarray(truth[name], dtype=np.float64)
    return Simulated(Log(**arguments, name="simulation"), truth)


def score(estimate: Estimate, truth: Simulated | Mapping[str, Any], log: Log | None = None) -> dict[str, Any]:
    """An estimate against the truth: {continuous{parameter: {truth, estimate, estimated, interval95, covered, relative_error,
    bound}}, discrete, npe_continuous, npe_discrete, ...}. bound: Cramer-Rao standard deviation, SI. log: that it was identified
    from, where the estimate does not know it."""
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


def run(suite: str | os.PathLike[str], output: str | os.PathLike[str] | None = None, *,
        identifiers: Mapping[str, Identifier | None] | Iterable[str] = (), realizations: int | None = None,
        seed: int | None = None, jobs: int | None = None, progress: Progress | None = None) -> Run:
    """Runs a suite (a name of `warmjoint list suites`, or a YAML file) into a directory, or goes on where an earlier run stopped.

    identifiers: names, or {"mine": function, "energy-ml": None}. A function gets a Log and returns an Estimate or what an
    estimate.json holds; it is judged as our own are. output: a new temporary directory where it is left out. progress is called
    with the realizations that are finished, and all. Ctrl-C ends it, resumably. Raises BadInput.
    """
    named = dict(identifiers) if isinstance(identifiers, Mapping) else dict.fromkeys(identifiers)
    functions = {name: _answer(function) for name, function in named.items() if function is not None}
    options: dict[str, object] = {"identifiers": [name for name, function in named.items() if function is None]}
    options |= {name: value for name, value in (("realizations", realizations), ("seed", seed), ("jobs", jobs)) if value is not None}
    directory = pathlib.Path(output) if output is not None else pathlib.Path(tempfile.mkdtemp(prefix="warmjoint_"))
    ending = _engine().run(os.fspath(suite), os.fspath(directory), options, functions, progress or (lambda done, of: None))
    return Run(directory, **ending)


def compare(run: Run | str | os.PathLike[str]) -> Any:
    """The leaderboard of a run, best identifier first: a pandas DataFrame where pandas is, else a list of dicts. Both are what
    `warmjoint compare --format json` prints of `rows`."""
    directory = run.directory if isinstance(run, Run) else run
    board = json.loads(_engine().leaderboard(os.fspath(directory), "json"))
    rows = [_flat(row) | ({"variant": group["variant"]} if "variant" in group else {})
            for group in board.get("groups", [board]) for row in group["rows"]]
    try:
        import pandas
    except ImportError:
        return rows
    return pandas.DataFrame(rows)


def require_mujoco() -> None:
    """Loads MuJoCo's library. Raises ImportError where MuJoCo 4.0 is not installed."""
    try:
        import mujoco
    except ImportError:
        raise ImportError("simulation needs MuJoCo 4.0: pip install 'mujoco==4.0.*'") from None
    if not mujoco.__version__.startswith("4.0."):
        raise ImportError(f"simulation needs MuJoCo 4.0, and {mujoco.__version__} is installed: pip install 'mujoco==4.0.*'; "
                          "identification and attach work with it as it is")


def _engine() -> ModuleType:
    """The module that needs MuJoCo 4.0."""
    require_mujoco()
    from warmjoint import _engine

    # the robots and suites of an installed package
    data = pathlib.Path(__file__).parent / "data"
    if data.is_dir():
        os.environ.setdefault("WARMJOINT_DATA", os.fspath(data))
    return _engine


@contextlib.contextmanager
def _file_of(scenario: str | os.PathLike[str] | Mapping[str, Any]) -> Iterator[str]:
    """The path of a scenario; of one that is given as a dict that of a temporary file."""
    if not isinstance(scenario, Mapping):
        yield os.fspath(scenario)
        return
    with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
        path = pathlib.Path(folder) / "scenario.yaml"
        path.write_text(json.dumps(dict(scenario)), encoding="utf-8")
        yield os.fspath(path)


def _answer(function: Identifier) -> Callable[[dict[str, Any]], str]:
    def answer(arguments: dict[str, Any]) -> str:
        estimate = function(Log(**arguments))
        return estimate.to_json() if isinstance(estimate, Estimate) else json.dumps(dict(estimate))

    return answer


def _flat(row: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested figures under joined names: npe_continuous_median."""
    flat: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, Mapping):
            flat |= _flat(value, f"{prefix}{name}_")
        else:
            flat[prefix + name] = value
    return flat

