"""The friction of all joints of a robot from its description and one log."""

from __future__ import annotations

import dataclasses
import json
import os
import pathlib
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from warmjoint import _core, mujoco_library, other_formats
from warmjoint.answers import Parameter, Residuals
from warmjoint.engine import Board, _engine, compare
from warmjoint.estimate import Estimate, Rejected
from warmjoint.export import EngineFormat, Export, export_frictions
from warmjoint.figures.view import unpacked
from warmjoint.friction import Friction
from warmjoint.tables import Asked, Table, numbers_of, tables_of, with_objects
from warmjoint.values import Array, kind_of, named, number, numbers, path_of, shown, style_of, text, texts

Numbers = float | Mapping[str, float]


@dataclasses.dataclass(frozen=True)
class ExternalJoint:
    """One joint along a log, filtered; arrays [N]."""

    velocity: Array  # rad/s or m/s
    torque: Array  # measured, N.m or N
    rigid: Array  # weight, inertia and rotor, N.m or N
    friction: Array  # 0 at rest, N.m or N
    energy: Array  # heat E, N.m or N
    external: Array  # on the joint: rigid + friction - torque, N.m or N
    half_width: Array  # of its 95 % band, N.m or N; at rest friction is anywhere within its level
    contact: Array  # 1 where it is more than friction explains, else 0


@dataclasses.dataclass(frozen=True)
class ExternalTorque:
    """What acts on a robot from outside, along a log of N samples."""

    time: Array  # [N] s
    joints: dict[str, ExternalJoint]  # those whose friction is known
    force: Array  # [N, 3] at the last link, N, in the axes of the world; nan where the joints do not tell it
    force_half_width: Array  # [N, 3] of its 95 % bands, N
    notices: list[str]  # one sentence each


class RobotJoint(Estimate):
    """One joint of a robot's answer: an Estimate whose pictures and residuals are those of the robot's log."""

    def __init__(self, robot: RobotEstimate, joint: str) -> None:
        super().__init__(robot.data["joints"][joint])
        self._robot, self._joint = robot, joint

    @property
    def residuals(self) -> Residuals:
        """Torque less fit at the samples that the fit takes. Raises Rejected where there is no fit, BadInput of a robot.json."""
        if self._joint not in self._robot._drawn and not self.ok:
            raise Rejected(self.message)
        drawn = self._robot._drawn_of(self._joint, "residuals")
        keep = np.asarray(drawn["keep"], dtype=bool)
        return Residuals(np.asarray(drawn["time"])[keep], (np.asarray(drawn["measured"]) - np.asarray(drawn["fitted"]))[keep])

    def figures(self) -> dict[str, dict[str, dict[str, Any]]]:
        """What the one figure of a robot's joint shows, {"joint": {series: {x, y, ...}}}."""
        from warmjoint.figures import robots, style

        with style.use("screen"):
            return {"joint": robots.joint(self._robot._drawn_of(self._joint, "figures")).series()}

    def plot(self, figure: str = "", ax: Any = None, style: str | dict[str, Any] = "screen") -> Any:
        """RobotEstimate.plot of this joint; returns the matplotlib Figure. figure: joint, or none."""
        if figure not in ("", "joint") or ax is not None:
            raise _core.BadInput(f"figure: a robot's joint gives one figure, of three panels: robot.plot('{self._joint}'); leave figure and ax out")
        return self._robot.plot(self._joint, style)


class RobotEstimate(Mapping[str, Estimate]):
    """What identify_robot answers: an Estimate for each joint by its name, robot["elbow"]. `data` is robot.json as a dict."""

    def __init__(self, data: dict[str, Any], drawn: Sequence[dict[str, Any]] = ()) -> None:
        if not isinstance(data, Mapping) or not isinstance(data.get("joints"), Mapping):
            raise _core.BadInput("robot: holds no map of joints; give what robot.json holds, of one estimate Estimate or load")
        self.data = data
        self._drawn = {one["file"]: one for one in drawn}

    def __getitem__(self, joint: str) -> Estimate:
        if not isinstance(joint, str) or joint not in self.data["joints"]:
            raise KeyError(f"the log holds no joint {shown(joint)}; it holds {', '.join(map(shown, self.data['joints']))}")
        return RobotJoint(self, joint)

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

    @property
    def gravity(self) -> tuple[float, ...] | None:
        """Gravity in the description's axes, m/s^2, of a base that does not stand as described; None where it does."""
        one = self.data.get("gravity")
        return tuple(one["value"]) if one else None

    @property
    def delay(self) -> Parameter | None:
        """Time by which all torques come after the positions, s; None where the log shows none."""
        one = self.data.get("delay")
        return Parameter("delay", one["value"], one["unit"], one["std"], tuple(one["interval95"])) if one else None

    def compare(self, other: RobotEstimate) -> Board:
        """Two answers of one robot, of two days or of two like arms: for each joint that both answer the rows of `compare`, with its name as
        `joint`. Which joint has changed: rows with |apart| above 1. Raises BadInput, also for answers without a joint in common.
        """
        if not isinstance(other, RobotEstimate):
            raise _core.BadInput(f"other: is {kind_of(other)}; give a RobotEstimate, of identify_robot or load_robot")
        both = [name for name in self if name in other.data["joints"] and self[name].ok and other[name].ok]
        if not both:
            raise _core.BadInput("other: no joint is answered in both; compare answers of one robot")
        return Board({"joint": name} | row for name in both for row in compare(self[name], other[name]))

    def plot(self, joint: str = "", style: str | dict[str, Any] = "screen") -> Any:
        """Draws friction over velocity, along the log, and what is left of one joint. Without a name the friction of all joints, a panel each:
        over speed with its 95 % interval, from a log with its means, over the place where it differs, and the warm-up. Returns the matplotlib
        Figure."""
        from warmjoint.figures import robots
        from warmjoint.figures.style import use

        if not isinstance(joint, str):
            raise _core.BadInput(f"joint: is {kind_of(joint)}; give the name of one joint, or none for all")
        drawn = self._drawn_of(joint, "plot") if joint else None
        with use(style_of(style)):
            return robots.joint(drawn) if drawn else robots.all_joints(self.data, list(self._drawn.values()))

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes one self-contained web page: a verdict for each joint with its friction at three speeds, what was noticed, the pictures of
        plot(), parameters and residuals; what `warmjoint report robot.json` writes, with the log's means where there is a log."""
        from warmjoint.figures import pages

        content = {"source": "robot.json", "answer": self.data, "along": list(self._drawn.values())}
        _core.write_text(path_of(path), pages.fill("robot", content))

    def _drawn_of(self, joint: str, what: str) -> dict[str, Any]:
        """The series of a joint along its log."""
        if isinstance(joint, str) and joint in self._drawn:
            return self._drawn[joint]
        there = f"the joints that were fitted are {', '.join(map(shown, self._drawn))}" if self._drawn else "a robot.json holds none: identify_robot(model, log)"
        raise _core.BadInput(f"{what}: there is no fit along the log of {shown(joint)}; {there}")

    def export(self, to: EngineFormat, *, warm: float = 0.0, speed: float | None = None) -> Export:
        """The frictions of all joints that are known in N.m or N as the numbers that another engine takes (Estimate.export)."""
        return export_frictions(self.data, to, warm=warm, speed=speed, joint="")

    def external_torque(self, log: Any, model: Any = None, *, correct: bool = False, map: Mapping[str, str] | None = None,
                        unit: Mapping[str, str] | None = None, scale: Mapping[str, float] | None = None, columns: Sequence[str] = (),
                        rate: float = 0, joints: Sequence[str] = (), tool: Mapping[str, Any] | None = None, coupling: str | Sequence[str] = (),
                        cutoff: float = 10, torque_constant: Numbers = 0, topic: str | None = None) -> ExternalTorque:
        """What of a log's torques is neither rigid-body torque nor friction: what `warmjoint compensate LOG --robot` finds. log: of the
        robot that was identified, as identify_robot takes one. model: its description; where not given the file that identify_robot
        read. correct: the level of each friction by the torque, while there is no contact. The other arguments are those of the
        identification. The force is at the origin of the last link, or at tool's com. Raises BadInput, also where no joint has a friction in
        N.m or N."""
        settings = _settings(scale=scale, joints=joints, gear=0, inertials=0.1, tool=tool, coupling=coupling, cutoff=cutoff,
                             torque_constant=torque_constant, holdout=0)
        tables = tables_of(log, "log", Asked(topic, joints="all"))
        read = _read(tables, map, unit, columns, rate)
        compensation = {"correct": "by_torque" if correct else "none"}
        with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
            answer = os.path.join(folder, "robot.json")
            self.save(answer)
            path = _model(self.data["robot"] if model is None else model, folder)
            found = _engine().external_torque(path, answer, [_given(one) for one in tables], read, settings, compensation)
        return ExternalTorque(found["time"], {name: ExternalJoint(**one) for name, one in found["joints"].items()}, found["force"],
                              found["force_half_width"], found["notices"])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes robot.json, which `warmjoint attach MODEL --friction robot.json` reads."""
        _core.write_text(path_of(path), json.dumps(self.data, indent=2) + "\n")

    def __repr__(self) -> str:
        rows = [f"  {name}: {one.status}, {one.message}" for name, one in self.items()]
        return "\n".join([f"<RobotEstimate of {len(self)} joints>", *rows])


def identify_robot(model: Any, log: Any, *, map: Mapping[str, str] | None = None, unit: Mapping[str, str] | None = None,
                   scale: Mapping[str, float] | None = None, columns: Sequence[str] = (), rate: float = 0,
                   joints: Sequence[str] = (), gear: Numbers = 0, inertials: float | Literal["exact"] = 0.1,
                   tool: Mapping[str, Any] | Literal["unknown"] | None = None, coupling: str | Sequence[str] = (), cutoff: float = 10,
                   torque_constant: Numbers = 0, holdout: float = 0.4, fields: str = "auto", gravity: Sequence[float] = (),
                   zero: Mapping[str, float] | None = None, at: Mapping[str, float] | None = None,
                   topic: str | None = None) -> RobotEstimate:
    """The friction of all joints: what `warmjoint identify-robot` does.

    model: path or text of an MJCF or URDF, or a mujoco.MjModel or MjSpec. log: path of a wide file or bag of any kind that read takes, a
    table that Log.from_frame takes, or {"time": [N], "position": [N, n], "torque": [N, n]} with a column for each joint; a list of these are
    recordings, each from a cold start. Samples that a mask hides, or that hold no number, are left out. topic: of a bag. map, unit, scale,
    columns, rate, joints, gear, coupling, cutoff, torque_constant, holdout and fields are the options of the program: map={"position": "q_{j}"},
    scale={"J4.torque": -1}, gear=101 or {"J4": 101}. inertials: share by which the description may be wrong. tool: {"mass": kg, "com":
    (x, y, z)} at the last link. gravity: (x, y, z) m/s^2 in the description's axes, of a base that stands otherwise. zero: what the log reads
    where the description is at 0, at: where joints stand that it does not hold, {"waist": .5}, rad or m. Needs MuJoCo 4.0. Raises BadInput.
    """
    settings = _settings(scale=scale, joints=joints, gear=gear, inertials=inertials, tool=tool, coupling=coupling, cutoff=cutoff,
                         torque_constant=torque_constant, holdout=holdout)
    settings |= {"gravity": [number("gravity", one) for one in gravity], "zero": _of_joints("zero", zero), "at": _of_joints("at", at)}
    settings["fields"] = text("fields", fields)
    asked = Asked(topic, joints="all")
    tables = tables_of(log, "log", asked)
    read = _read(tables, map, unit, columns, rate)
    with tempfile.TemporaryDirectory(prefix="warmjoint_") as folder:
        path = _model(model, folder)
        try:
            data, facts, arrays = _engine().identify_robot(path, [_given(one) for one in tables], read, settings)
        except _core.BadInput as refusal:
            again = _with_objects(tables, refusal, asked)
            data, facts, arrays = _engine().identify_robot(path, [_given(one) for one in again], read, settings)
    return RobotEstimate(data, unpacked(facts, arrays))


def _settings(*, scale: Mapping[str, float] | None, joints: Sequence[str], gear: Numbers, inertials: float | Literal["exact"],
              tool: Mapping[str, Any] | Literal["unknown"] | None, coupling: str | Sequence[str], cutoff: float, torque_constant: Numbers,
              holdout: float) -> dict[str, object]:
    """What the engine is asked besides the log."""
    factors: dict[str, dict[str, float]] = {"torque": {}, "position": {}}
    for name, factor in named("scale", scale).items():
        joint, _, column = name.rpartition(".")
        if column not in factors:
            raise _core.BadInput(f"scale: {shown(name)} is neither torque nor position, nor JOINT.torque or JOINT.position")
        factors[column][joint] = number("scale", factor)
    is_exact = isinstance(inertials, str) and inertials == "exact"
    return {"joints": texts("joints", joints), "gear": _numbers("gear", gear), "inertials": 0.0 if is_exact else number("inertials", inertials),
            "coupling": texts("coupling", coupling), "cutoff": number("cutoff", cutoff),
            "torque_constant": _numbers("torque_constant", torque_constant), "torque_scale": factors["torque"],
            "position_scale": factors["position"], "holdout": number("holdout", holdout), "tool": _tool(tool)}


def _of_joints(argument: str, given: Mapping[str, float] | None) -> dict[str, float]:
    """Numbers by the names of joints."""
    return {joint: number(argument, one) for joint, one in named(argument, given).items()}


def _read(tables: list[Table], map: Mapping[str, str] | None, unit: Mapping[str, str] | None, columns: Sequence[str], rate: float) -> dict[str, object]:
    """How the logs are read."""
    return {"files": [one.name for one in tables], "map": named("map", map), "unit": named("unit", unit), "columns": texts("columns", columns),
            "rate": number("rate", rate)}


def load_robot(path: str | os.PathLike[str]) -> RobotEstimate:
    """Reads robot.json, or library:MACHINE. Raises BadInput for another file."""
    return RobotEstimate(_core.read_json(path_of(path)))


def _numbers(argument: str, given: Any) -> dict[str, float]:
    """Numbers by their joints; one for all has an empty name."""
    if isinstance(given, Mapping):
        return {joint: number(argument, value) for joint, value in named(argument, given).items()}
    value = number(argument, given)
    return {"": value} if value else {}


def _tool(given: Any) -> dict[str, object]:
    if given is None:
        return {}
    if isinstance(given, str) and given == "unknown":
        return {"known": "unknown"}
    if not isinstance(given, Mapping) or "mass" not in given or not {*named("tool", given)} <= {"mass", "com"}:
        raise _core.BadInput(f"tool: is {shown(given)}; it must be 'unknown' or {{'mass': kg, 'com': (x, y, z)}}")
    centre = numbers("tool: com", given.get("com", (0, 0, 0)))
    if centre.shape != (3,):
        raise _core.BadInput(f"tool: com has the shape {centre.shape}; give (x, y, z), m")
    return {"known": "given", "mass": number("tool: mass", given["mass"]), "centre": centre.tolist()}


def _model(model: Any, folder: str) -> str:
    """The path of a description; of a model in memory that of a file in `folder`."""
    if isinstance(model, str) and model.lstrip().startswith("<"):
        path = os.path.join(folder, "robot.urdf" if "<robot" in model else "robot.xml")
        pathlib.Path(path).write_text(model, encoding="utf-8")
        return path
    import mujoco

    if not isinstance(model, (mujoco.MjModel, mujoco.MjSpec)):
        return path_of(model, "model")
    with mujoco_library.refusing("model: MuJoCo cannot compile it"):
        compiled = model.compile() if isinstance(model, mujoco.MjSpec) else model
    path = os.path.join(folder, "robot.mjb")
    mujoco.mj_saveModel(compiled, path)
    return path


def _given(table: Table) -> tuple[str, Any, str | None]:
    """A log as the engine takes it."""
    return table.name, None if table.columns is None else numbers_of(table), table.text


def _with_objects(tables: list[Table], refusal: _core.BadInput, asked: Asked) -> list[Table]:
    """The logs again, files that may hold cells and compounds by the readers of other formats. Raises the refusal where there are none."""
    if not any(one.columns is None and one.text is None and other_formats.may_hold_objects(one.name) for one in tables):
        raise refusal
    return [with_objects(one, refusal, asked) if one.columns is None and one.text is None else one for one in tables]
