"""Friction on the joints of a robot in MuJoCo.

    fr = attach("panda.xml", {"joint[1-4]": estimate, "joint[5-7]": "wrist.json"})
    model = fr.spec.compile()
    data = mujoco.MjData(model)
    friction = fr.bind(model, data)
    friction.reset(warm=0.5)
    mujoco.mj_step(model, data, 500)
    friction.torque, friction["joint2"].heat
"""

from __future__ import annotations

import dataclasses
import json
import os
import pathlib
from collections.abc import Mapping
from typing import Any, Literal, Protocol

import mujoco

from warmjoint import _core, mujoco_library, mujoco_plugin
from warmjoint._core import BadInput
from warmjoint.mujoco_bound import BoundFriction, bind
from warmjoint.values import kind_of, number, path_of, text, text_of

__all__ = ["Attached", "attach", "bind"]


class HasJson(Protocol):
    """What can write itself as a friction file or estimate.json: Friction, Estimate."""

    def to_json(self) -> str: ...


FrictionLike = HasJson | Mapping[str, Any] | str | os.PathLike[str]
Form = Literal["passive", "actuator"]
Integrator = Literal["auto", "Euler", "RK4", "implicit", "implicitfast", "discrete"]


@dataclasses.dataclass(frozen=True)
class _Given:
    """A friction as it was given for some joints."""

    joints: str  # name or pattern
    friction: dict[str, Any]
    end: list[float] | None  # the heat at the end of an estimate's log
    units: dict[str, str]  # of an estimate's parameters, which tell the kind of its joint
    notice: str


def _tree_of(joints: str, given: FrictionLike) -> tuple[str, dict[str, Any]]:
    """What messages call a friction, and its content."""
    name = f"friction of '{joints}'"
    if isinstance(given, Mapping):
        text = _core.to_json(dict(given), name)
    elif isinstance(given, (str, os.PathLike)):
        name = path_of(given, name)
        tree = _core.read_json(name)
        return name, _map_of(tree, name)
    elif hasattr(given, "to_json"):
        text = given.to_json()
    else:
        raise BadInput(f"{name}: is {kind_of(given)}; give a Friction, an Estimate, or the path or the content of a file")
    try:
        tree = json.loads(text)
    except (ValueError, RecursionError) as refusal:
        raise BadInput(f"{name}: is no JSON ({refusal}); give a friction file or an estimate") from None
    return name, _map_of(tree, name)


def _map_of(tree: Any, name: str) -> dict[str, Any]:
    if not isinstance(tree, dict):
        raise BadInput(f"{name}: holds no map; give a friction file or an estimate")
    return tree


def _read(joints: str, given: FrictionLike) -> _Given:
    name, tree = _tree_of(text_of(joints), given)
    friction = tree.get("friction", tree)
    status = tree.get("status", "ok")
    if friction is None:
        raise BadInput(f"{name}: is {status} and holds no friction; identify again with force to use it anyway")
    notice = "" if status == "ok" else f"{name} is {status}: its friction is void, and so is that of the model"

    # the heat that the log left, each a number or an object with its value
    end = None
    if isinstance(tree.get("state_end"), Mapping):
        heat = [(key, tree["state_end"][key]) for key in ("energy", "second_energy") if key in tree["state_end"]]
        end = [number(f"{name}: {key}", one.get("value") if isinstance(one, Mapping) else one) for key, one in heat]
    units = {}
    if isinstance(tree.get("parameters"), Mapping):
        units = {key: one["unit"] for key, one in tree["parameters"].items() if isinstance(one, Mapping) and "unit" in one}
    return _Given(joints, friction, end, units, notice)


def _spec_of(model: mujoco.MjSpec | str | os.PathLike[str]) -> tuple[mujoco.MjSpec, str]:
    """The spec of a model, and what messages call it."""
    if isinstance(model, mujoco.MjSpec):
        return model, model.modelname
    reading = "model: MuJoCo cannot read it"
    if isinstance(model, str) and model.lstrip().startswith("<"):
        with mujoco_library.refusing(reading):
            spec = mujoco.MjSpec.from_string(model)
        return spec, spec.modelname
    path = pathlib.Path(path_of(model, "model")).resolve()
    with mujoco_library.refusing(reading):
        spec = mujoco.MjSpec.from_file(str(path))
    # its text finds its meshes from anywhere
    spec.meshdir = str(path.parent / spec.meshdir)
    spec.texturedir = str(path.parent / spec.texturedir)
    return spec, os.fspath(model)


def text_of_spec(spec: mujoco.MjSpec) -> str:
    """MJCF of a spec with all digits where MuJoCo writes them."""
    for notation in ("savecompiled", "savecanonical"):
        if hasattr(spec.compiler, notation):
            setattr(spec.compiler, notation, 0)
    text: str = spec.to_xml()
    return text


class Attached:
    """A model with friction on some of its joints."""

    def __init__(self, spec: mujoco.MjSpec, joints: list[str], notices: list[str], ends: dict[str, list[float] | None], form: Form):
        self.form = form
        """How the friction acts."""
        self.spec = spec
        """The spec with the friction, the one that was given where one was."""
        self.joints = joints
        """Names of the joints that carry it, in the order of all arrays."""
        self.notices = notices
        """What was changed besides, one sentence each."""
        self._ends = ends

    def __repr__(self) -> str:
        other = {"passive": "form='actuator' adds an actuator to each", "actuator": "form='passive' adds no actuators"}
        lines = [f"friction on {', '.join(self.joints)} in the {self.form} form ({other[self.form]})", *self.notices]
        return "\n".join(lines)

    @property
    def xml(self) -> str:
        """The model as MJCF text. MuJoCo 3.11 writes six digits of each number."""
        return text_of_spec(self.spec)

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData, prefix: str = "") -> BoundFriction:
        """The friction in a model that the spec was compiled to, or in a scene that holds it under a prefix."""
        text("prefix", prefix)
        ends = {prefix + joint: end for joint, end in self._ends.items()}
        return BoundFriction(model, data, ends, [prefix + joint for joint in self.joints])


def attach(
    model: mujoco.MjSpec | str | os.PathLike[str],
    frictions: Mapping[str, FrictionLike] | str | os.PathLike[str],
    form: Form = "passive",
    sensors: bool = True,
    randomisable: bool = True,
    armatures: Mapping[str, float] | None = None,
    timestep: float | None = None,
    integrator: Integrator | None = None,
    stiffest_drive: float = 0.0,
) -> Attached:
    """Puts friction on joints of a robot; their own damping, frictionloss and springs that yield (`springyield`) are taken away, and
    their damping is the friction's constant viscous from then on.

    model: a spec, which is changed; a path to MJCF or URDF; or MJCF text.
    frictions: by a joint's name or a regular expression of whole names, as "joint[1-4]": a Friction or Estimate, a
        friction file or estimate.json, library:MACHINE/JOINT, or the content of one. Or the path of a robot.json, or library:MACHINE, for all
        its joints that are known in N.m or N.
    form: passive adds nothing but the friction; actuator adds an actuator to each joint, whose states keyframes and
        derivatives know.
    sensors: a sensor JOINT_friction for each joint, which torque, loss and held need.
    randomisable: the numbers as arrays of the model, which randomise needs.
    armatures: kg.m^2 or kg by joint or pattern, in place of the model's; timestep: s, and integrator, likewise; integrator "auto" takes
        implicitfast where servos are so stiff that joints would shake, and there alone.
    stiffest_drive: h^2 kp + 2 h kv over the joint's inertia of a servo in your own code, 0 to 3, kp and kv in N.m/rad and
        N.m.s/rad (N/m and N.s/m) and h the timestep, s.
    Raises BadInput, and leaves the spec as it was, for a joint that is unknown, given twice, no hinge or slide, of
    another kind than its estimate's, or too light for its friction. The command line (`warmjoint attach`) does the same,
    in the actuator form where none is asked for.
    """
    asked: object = form  # what a program without types may give
    if isinstance(asked, str) and asked == "native":
        raise BadInput("form: is native, whose springs a driver sets after each step; call wj.native, which has it")
    attached, _ = attach_form(model, frictions, {"form": form, "sensors": sensors, "numbers": randomisable, "stiffest_drive": stiffest_drive}, armatures,
                              timestep, integrator)
    return attached


def robot_frictions(path: str | os.PathLike[str]) -> Mapping[str, FrictionLike]:
    """The frictions of all joints of a robot.json, or of library:MACHINE, that are known in N.m or N. Raises BadInput where there are none."""
    from warmjoint.robot import load_robot

    frictions = load_robot(path).frictions
    if not frictions:
        raise BadInput(f"{path_of(path)}: holds no friction in N.m or N; identify again with torque_constant")
    return frictions


def attach_form(
    model: mujoco.MjSpec | str | os.PathLike[str],
    frictions: Mapping[str, FrictionLike] | str | os.PathLike[str],
    options: dict[str, Any],
    armatures: Mapping[str, float] | None,
    timestep: float | None,
    integrator: Integrator | None,
) -> tuple[Attached, dict[str, Any]]:
    """What `attach` does, in any form, and the library's answer. options: form, sensors, numbers, approximate, stiffest_drive."""
    armatures = {} if armatures is None else armatures
    if isinstance(frictions, (str, os.PathLike)):
        frictions = robot_frictions(frictions)
    for argument, value in (("frictions", frictions), ("armatures", armatures)):
        if not isinstance(value, Mapping):
            raise BadInput(f"{argument}: is {kind_of(value)}; give a dict by joint")
    given = [_read(joints, friction) for joints, friction in frictions.items()]
    spec, name = _spec_of(model)
    request: dict[str, Any] = {
        "model": name,
        "frictions": [{"joint": one.joints, "friction": one.friction} for one in given],
        **options,
        "armatures": {text_of(joint): number("armatures", armature) for joint, armature in armatures.items()},
    }
    request["units"] = {one.joints: one.units for one in given if one.units}
    if timestep is not None:
        request["timestep"] = timestep
    if integrator is not None:
        request["integrator"] = integrator
    answer = mujoco_plugin.attach_to_spec(spec, request)
    joints = [joint["name"] for joint in answer["joints"]]
    ends = {joint["name"]: given[joint["given"]].end for joint in answer["joints"]}
    notices = [one.notice for one in given if one.notice] + answer["notices"]
    return Attached(spec, joints, notices, ends, options["form"]), answer
