"""Which motion to record, and whether a log is enough."""

from __future__ import annotations

import dataclasses
import os
import pathlib
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core
from warmjoint.engine import _engine
from warmjoint.estimate import Estimate
from warmjoint.friction import Friction
from warmjoint.log import Log, log_of
from warmjoint.values import kind_of, named, path_of, texts, whole
from warmjoint.values import number as number_of

Array = npt.NDArray[np.float64]
Prior = Estimate | Friction | Mapping[str, Any] | str | os.PathLike[str]
Start = Literal["cold", "unknown", "estimated"]


@dataclasses.dataclass(frozen=True)
class Design:
    """A motion of one joint, and what its log will tell: what `warmjoint design` writes."""

    time: Array  # [n] s, of knots between which the velocity is linear
    position: Array  # [n] rad or m
    velocity: Array  # [n] rad/s or m/s
    data: dict[str, Any]  # what design.json holds: foretold[], enough, ratios[], draws[]
    files: dict[str, str]  # text by name: motion.csv, setpoints.csv, trajectory.yaml, motion.script, design.json

    @property
    def parameters(self) -> dict[str, dict[str, Any]]:
        """{name: {value, unit, std, interval95}} foretold of the whole motion."""
        return dict(self.data["foretold"][-1]["parameters"])

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes the files, as `warmjoint design -o` does."""
        _save(self.files, folder)


@dataclasses.dataclass(frozen=True)
class RobotDesign:
    """A motion of several joints of a robot at once, and what its log will tell: what `warmjoint design ROBOT` writes."""

    joints: dict[str, Design]  # by name, in the order of the robot
    data: dict[str, Any]  # what design.json holds: joints, coupling[], notices[]
    files: dict[str, str]  # text by name: motion.csv, setpoints.csv, trajectory.yaml, design.json

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes the files, as `warmjoint design ROBOT -o` does."""
        _save(self.files, folder)


def design(minutes: float = 20, *, limits: Mapping[str, Any] | None = None, aim: str = "D",
           prior: Prior | None = None, method: str = "auto", start: Start = "cold", noise: float | None = None, rate: float = 20, hold: float = 10,
           kind: Literal["rotary", "linear"] = "rotary", joint: str = "joint", seed: int = 1) -> Design:
    """The sequence of speeds, holds and rests whose log tells the most: what `warmjoint design` does.

    limits: {"position": (lower, upper), "velocity": (slowest, fastest), "acceleration": a, "torque": t}, each where it is known; rad, s and
    N.m, or m, s and N. aim: "D", "friction" or a parameter, with =5% the half width of the 95 % interval that is enough. prior: the
    friction that is expected: an Estimate, a Friction, what a friction file holds, whose numbers may be {"log_uniform": [a, b]}, or the
    path of one; broad ranges where it is left out. method: the identifier that will read the log. noise: standard deviation of a torque
    sample. rate: samples in a second. hold: longest stroke at one speed, s. joint: its name in the files. Needs MuJoCo 4.0.
    The same arguments give the same motion. Raises BadInput.
    """
    settings = _settings(minutes, limits, aim, method, start, noise, rate, hold, seed) | {"joint": kind}
    with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
        settings["prior"] = _file_of(prior, pathlib.Path(folder))
        try:
            data, (time, position, velocity), files = _engine().design(settings, joint)
        except _core.BadInput as refusal:
            raise _core.BadInput(str(refusal).replace(settings["prior"] or "\0", "prior")) from None
    return Design(time, position, velocity, data, files)


def design_robot(robot: str | os.PathLike[str], joints: Sequence[str], minutes: float = 20, *, limits: Mapping[str, Any] | None = None,
                 at: Mapping[str, float] | None = None, clearance: float = 0.01, aim: str = "D", prior: Prior | None = None,
                 priors: Mapping[str, Prior] | None = None, method: str = "auto", start: Start = "cold",
                 noise: float | None = None, rate: float = 20, hold: float = 10, seed: int = 1) -> RobotDesign:
    """One motion for several joints of a robot: what `warmjoint design ROBOT` does. Each joint keeps to the limits of position, velocity and effort
    that the robot's file has, and links keep apart; a block that would break that is exchanged for another.

    robot: path of an MJCF or URDF file, or a robot of the project. joints: names, or patterns of names. at: rad or m, where joints begin or
    stand. clearance: between links, m. prior: of all joints; priors: of single ones. limits (which count beside the robot's), aim, method,
    start, noise, rate, hold, seed: as of `design`. What is foretold of each joint is so as if its rigid torque were known. Raises BadInput.
    """
    settings = _settings(minutes, limits, aim, method, start, noise, rate, hold, seed)
    with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
        settings["prior"] = _file_of(prior, pathlib.Path(folder))
        files_of = {}
        for number, (name, one) in enumerate(named("priors", priors).items()):
            (own := pathlib.Path(folder) / str(number)).mkdir()
            files_of[name] = _file_of(one, own)
        positions = {name: number_of(f"at[{name!r}]", value) for name, value in named("at", at).items()}
        data, of_joints, files = _engine().design_robot(settings, os.fspath(path_of(robot, "robot")), texts("joints", joints), positions,
                                                        number_of("clearance", clearance), files_of)
    made = {name: Design(time, position, velocity, one, its) for name, (one, (time, position, velocity), its) in of_joints.items()}
    return RobotDesign(made, data, files)


@dataclasses.dataclass(frozen=True)
class Enough:
    """Whether a log holds the interval that is wanted. False in an `if` where it does not."""

    reached: bool
    minutes: float  # of the log
    half_width: float | None  # of the 95 % interval, as a share; None where the answer has none
    minutes_more: float | None  # of the same motion; None where that is not foretold
    status: str  # of the answer
    message: str

    def __bool__(self) -> bool:
        return self.reached


def enough(log: Log | Any, goal: str, method: str = "auto", **options: Any) -> Enough:
    """Whether the log so far holds an interval, as "friction=5%" or "thermal_time_constant=5%", and how many minutes more of its motion it
    takes: what `warmjoint check --until` says of a whole log. For a recorder that asks now and then. options: arguments of read.
    Raises BadInput."""
    found = _core.enough(log_of(log, **options)._core, goal, {"identifier": method})
    return Enough(**found)


def _file_of(prior: Any, folder: pathlib.Path) -> str:
    """The path of a prior; of one that is given as a value that of a file in the folder."""
    if prior is None:
        return ""
    if isinstance(prior, (str, os.PathLike)):
        return os.fspath(path_of(prior, "prior"))
    path = folder / "prior.yaml"
    if isinstance(prior, Estimate):
        path.write_text(prior.to_json(), encoding="utf-8")
    elif isinstance(prior, Friction):
        path.write_text(_core.to_json(prior.data, "prior"), encoding="utf-8")
    elif isinstance(prior, Mapping):
        path.write_text(_core.to_json(dict(prior), "prior"), encoding="utf-8")
    else:
        raise _core.BadInput(f"prior: is {kind_of(prior)}; give an Estimate, a Friction, a dict or a path")
    return os.fspath(path)


def _settings(minutes: float, limits: Mapping[str, Any] | None, aim: str, method: str, start: Start, noise: float | None, rate: float,
              hold: float, seed: int) -> dict[str, Any]:
    """As DesignSettings has them."""
    settings: dict[str, Any] = {"minutes": minutes, "for": aim, "identifier": method, "start": start, "rate": rate, "hold": hold,
                                "seed": whole("seed", seed)}
    return settings | {name: value for name, value in (("noise", noise), ("limits", limits)) if value is not None}


def _save(files: Mapping[str, str], folder: str | os.PathLike[str]) -> None:
    path = pathlib.Path(path_of(folder, "folder"))
    path.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        _core.write_text(os.fspath(path / name), text)
