"""The friction of all joints of a robot from its description and one log."""

from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from warmjoint import _core
from warmjoint.engine import _engine
from warmjoint.estimate import Estimate, Parameter
from warmjoint.export import EngineFormat, Export, export_frictions
from warmjoint.figures.view import unpacked
from warmjoint.friction import Friction

Numbers = float | Mapping[str, float]


class RobotEstimate(Mapping[str, Estimate]):
    """What identify_robot answers: an Estimate for each joint by its name, robot["elbow"]. `data` is robot.json as a dict."""

    def __init__(self, data: dict[str, Any], drawn: Sequence[dict[str, Any]] = ()) -> None:
        self.data = data
        self._drawn = {one["file"]: one for one in drawn}

    def __getitem__(self, joint: str) -> Estimate:
        if joint not in self.data["joints"]:
            raise KeyError(f"the log holds no joint '{joint}'; it holds {', '.join(self.data['joints'])}")
        return Estimate(self.data["joints"][joint])

    def __iter__(self) -> Iterator[str]:
        return iter(self.data["joints"])

    def __len__(self) -> int:
        return len(self.data["joints"])

    @property
    def notices(self) -> list[str]:
        """How description and log were understood, one sentence each."""
        return list(self.data["notices"])

    @property
    def summary(self) -> dict[str, dict[str, Any]]:
        """{joint: {"torque_unit", "travel", "top_speed", "minutes", "gain", "gain_is_known", "rms_held_out", "rms_moving",
        "rms_without_friction"}}, torques in the log's unit."""
        return dict(self.data["summary"])

    @property
    def payload(self) -> Parameter | None:
        """Mass of the load at the last link that the description lacks, kg; None where none is shown and tool="unknown" is not given."""
        one = self.data.get("payload")
        if not one:
            return None
        lower, upper = one["interval95"]
        return Parameter("payload", one["value"], one["unit"], one["std"], (lower, upper))

    @property
    def frictions(self) -> dict[str, Friction]:
        """The frictions that are known in N.m or N, as `attach` takes them."""
        found = {name: one.get("friction") for name, one in self.data["joints"].items()}
        return {name: Friction.from_dict(one) for name, one in found.items() if one and one.get("torque_unit") != "A"}

    def plot(self, joint: str, style: str | dict[str, Any] = "screen") -> Any:
        """Draws friction over velocity, along the log, and what is left of one joint; returns the matplotlib Figure."""
        from warmjoint.figures import robots
        from warmjoint.figures.style import use

        if joint not in self._drawn:
            raise _core.BadInput(f"plot: there is no picture of '{joint}'; there are {', '.join(self._drawn) or 'none in a file'}")
        with use(style):
            return robots.joint(self._drawn[joint])

    def export(self, to: EngineFormat, *, warm: float = 0.0, speed: float | None = None) -> Export:
        """The frictions of all joints that are known in N.m or N as the numbers that another engine takes (Estimate.export)."""
        return export_frictions(self.data, to, warm=warm, speed=speed, joint="")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes robot.json, which `warmjoint attach MODEL --friction robot.json` reads."""
        pathlib.Path(path).write_text(json.dumps(self.data, indent=2) + "\n", encoding="utf-8")

    def __repr__(self) -> str:
        rows = [f"  {name}: {one.status}, {one.message}" for name, one in self.items()]
        return "\n".join([f"<RobotEstimate of {len(self)} joints>", *rows])


def identify_robot(model: Any, log: Any, *, map: Mapping[str, str] | None = None, unit: Mapping[str, str] | None = None,
                   scale: Mapping[str, float] | None = None, columns: Sequence[str] = (), rate: float = 0,
                   joints: Sequence[str] = (), gear: Numbers = 0, inertials: float | Literal["exact"] = 0.1,
                   tool: Mapping[str, Any] | Literal["unknown"] | None = None, coupling: str | Sequence[str] = (), cutoff: float = 10,
                   torque_constant: Numbers = 0, holdout: float = 0.4) -> RobotEstimate:
    """The friction of all joints: what `warmjoint identify-robot` does.

    model: path of an MJCF or URDF, or a mujoco.MjModel or MjSpec. log: path of a wide file (several paths: recordings, each from a cold
    start), a data frame, or {"time": [N], "position": [N, n], "torque": [N, n]} in SI with a column for each joint. map, unit, scale,
    columns, rate, joints, gear, coupling, cutoff, torque_constant and holdout are the options of the program: map={"position": "q_{j}"},
    scale={"J4.torque": -1}, gear=101 or {"J4": 101}. inertials: share by which the description may be wrong. tool: {"mass": kg, "com":
    (x, y, z)} at the last link. Needs MuJoCo 4.0. Raises BadInput.
    """
    factors: dict[str, dict[str, float]] = {"torque": {}, "position": {}}
    for name, factor in (scale or {}).items():
        joint, _, column = name.rpartition(".")
        if column not in ("torque", "position"):
            raise _core.BadInput(f"scale: '{name}' is neither torque nor position, nor JOINT.torque or JOINT.position")
        factors[column][joint] = float(factor)
    settings: dict[str, object] = {
        "joints": list(joints), "gear": _numbers(gear), "inertials": 0.0 if inertials == "exact" else float(inertials),
        "coupling": [coupling] if isinstance(coupling, str) else list(coupling), "cutoff": float(cutoff),
        "torque_constant": _numbers(torque_constant), "torque_scale": factors["torque"], "position_scale": factors["position"],
        "holdout": float(holdout), "tool": _tool(tool)}
    files, arrays = _log(log)
    source = {"files": files, "map": dict(map or {}), "unit": dict(unit or {}), "columns": list(columns), "rate": float(rate)}
    with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
        data, facts, columns_of = _engine().identify_robot(_model(model, folder), source, arrays, settings)
    return RobotEstimate(data, unpacked(facts, columns_of))


def load_robot(path: str | os.PathLike[str]) -> RobotEstimate:
    """Reads robot.json."""
    return RobotEstimate(json.loads(pathlib.Path(path).read_text(encoding="utf-8")))


def _numbers(given: Numbers) -> dict[str, float]:
    if isinstance(given, Mapping):
        return {str(joint): float(value) for joint, value in given.items()}
    return {"": float(given)} if given else {}


def _tool(given: Mapping[str, Any] | str | None) -> dict[str, object]:
    if given is None:
        return {}
    if isinstance(given, str):
        if given != "unknown":
            raise _core.BadInput(f"tool: is '{given}'; it must be 'unknown' or {{'mass': kg, 'com': (x, y, z)}}")
        return {"known": "unknown"}
    return {"known": "given", "mass": float(given["mass"]), "centre": [float(one) for one in given.get("com", (0, 0, 0))]}


def _model(model: Any, folder: str) -> str:
    """The path of a description; of a model in memory that of a file in `folder`."""
    if isinstance(model, (str, os.PathLike)):
        return os.fspath(model)
    import mujoco

    compiled = model.compile() if isinstance(model, mujoco.MjSpec) else model
    path = os.path.join(folder, "robot.mjb")
    mujoco.mj_saveModel(compiled, path)
    return path


def _log(log: Any) -> tuple[list[str], dict[str, npt.NDArray[np.float64]]]:
    """Files, or columns by their names: matrices become a column for each joint, numbered from 0."""
    if isinstance(log, (str, os.PathLike)):
        return [os.fspath(log)], {}
    if not isinstance(log, Mapping) and not hasattr(log, "columns"):
        return [os.fspath(one) for one in log], {}
    arrays = {}
    for name in log:
        values = np.asarray(log[name])
        if values.dtype.kind not in "fiub":
            continue
        values = np.ascontiguousarray(values, dtype=np.float64)
        if values.ndim == 1:
            arrays[str(name)] = values
        elif values.ndim == 2:
            arrays |= {f"{name}{j}": np.ascontiguousarray(values[:, j]) for j in range(values.shape[1])}
    return ["log"], arrays
