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

import copy
import dataclasses
import difflib
import json
import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from warmjoint import mujoco_plugin
from warmjoint._core import BadInput
from warmjoint.friction import place_of, settled_energies

Floats = NDArray[np.float64]

# of the plugin's entries in plugin_state: starts warm at the first step (actuator form)
_STARTS_WARM = 2
_SENSED = ("torque", "heat", "rise", "loss", "held")
_STAGES = ("energy", "second energy")
# at which friction counts as settled where no speed is given
USUAL_SPEED = 1.0  # rad/s
USUAL_LINEAR_SPEED = 0.1  # m/s


class HasJson(Protocol):
    """What can write itself as a friction file or estimate.json: Friction, Estimate."""

    def to_json(self) -> str: ...


FrictionLike = HasJson | Mapping[str, Any] | str | os.PathLike[str]
Warm = float | Sequence[float] | Floats | Literal["end"]


@dataclasses.dataclass(frozen=True)
class _Given:
    """A friction as it was given for some joints."""

    joints: str  # name or pattern
    friction: dict[str, Any]
    end: list[float] | None  # the heat at the end of an estimate's log
    notice: str


def _read(joints: str, given: FrictionLike) -> _Given:
    name = f"friction of '{joints}'"
    if isinstance(given, Mapping):
        tree = dict(given)
    elif isinstance(given, (str, os.PathLike)):
        name = os.fspath(given)
        tree = json.loads(pathlib.Path(given).read_text())
    else:
        tree = json.loads(given.to_json())
    friction = tree.get("friction", tree)
    status = tree.get("status", "ok")
    if friction is None:
        raise BadInput(f"{name}: is {status} and holds no friction; identify again with force to use it anyway")
    notice = "" if status == "ok" else f"{name} is {status}: its friction is void, and so is that of the model"

    # the heat that the log left, each a number or an object with its value
    end = None
    if isinstance(tree.get("state_end"), Mapping):
        heat = [tree["state_end"][key] for key in ("energy", "second_energy") if key in tree["state_end"]]
        end = [float(one["value"] if isinstance(one, Mapping) else one) for one in heat]
    return _Given(joints, friction, end, notice)


def _spec_of(model: mujoco.MjSpec | str | os.PathLike[str]) -> tuple[mujoco.MjSpec, str]:
    """The spec of a model, and what messages call it."""
    if isinstance(model, mujoco.MjSpec):
        return model, model.modelname
    if isinstance(model, str) and model.lstrip().startswith("<"):
        spec = mujoco.MjSpec.from_string(model)
        return spec, spec.modelname
    path = pathlib.Path(model).resolve()
    spec = mujoco.MjSpec.from_file(str(path))
    # its text finds its meshes from anywhere
    spec.meshdir = str(path.parent / spec.meshdir)
    spec.texturedir = str(path.parent / spec.texturedir)
    return spec, os.fspath(model)


class Attached:
    """A model with friction on some of its joints."""

    def __init__(self, spec: mujoco.MjSpec, joints: list[str], notices: list[str], ends: dict[str, list[float] | None]):
        self.spec = spec
        """The spec with the friction, the one that was given where one was."""
        self.joints = joints
        """Names of the joints that carry it, in the order of all arrays."""
        self.notices = notices
        """What was changed besides, one sentence each."""
        self._ends = ends

    @property
    def xml(self) -> str:
        """The model as MJCF text. MuJoCo 3.11 writes six digits of each number."""
        for notation in ("savecompiled", "savecanonical"):
            if hasattr(self.spec.compiler, notation):
                setattr(self.spec.compiler, notation, 0)
        text: str = self.spec.to_xml()
        return text

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData, prefix: str = "") -> BoundFriction:
        """The friction in a model that the spec was compiled to, or in a scene that holds it under a prefix."""
        ends = {prefix + joint: end for joint, end in self._ends.items()}
        return BoundFriction(model, data, ends, [prefix + joint for joint in self.joints])


def attach(
    model: mujoco.MjSpec | str | os.PathLike[str],
    frictions: Mapping[str, FrictionLike],
    form: Literal["passive", "actuator"] = "passive",
    sensors: bool = True,
    randomisable: bool = True,
    armatures: Mapping[str, float] | None = None,
    timestep: float | None = None,
) -> Attached:
    """Puts friction on joints of a robot; their own damping and frictionloss are taken away.

    model: a spec, which is changed; a path to MJCF or URDF; or MJCF text.
    frictions: by a joint's name or a regular expression of whole names, as "joint[1-4]": a Friction or Estimate, a
        friction file or estimate.json, or its content.
    form: passive adds nothing but the friction; actuator adds an actuator to each joint, whose states keyframes and
        derivatives know.
    sensors: a sensor JOINT_friction for each joint, which torque, loss and held need.
    randomisable: the numbers as arrays of the model, which randomise needs.
    armatures: kg.m^2 or kg by joint or pattern, in place of the model's; timestep: s, in place of the model's.
    Raises BadInput, and leaves the spec as it was, for a joint that is unknown, given twice, no hinge or slide, or too
    light for its friction.
    """
    given = [_read(joints, friction) for joints, friction in frictions.items()]
    spec, name = _spec_of(model)
    request: dict[str, Any] = {
        "model": name,
        "frictions": [{"joint": one.joints, "friction": one.friction} for one in given],
        "form": form,
        "sensors": sensors,
        "numbers": randomisable,
        "armatures": dict(armatures or {}),
    }
    if timestep is not None:
        request["timestep"] = timestep
    answer = mujoco_plugin.attach_to_spec(spec, request)
    joints = [joint["name"] for joint in answer["joints"]]
    ends = {joint["name"]: given[joint["given"]].end for joint in answer["joints"]}
    return Attached(spec, joints, [one.notice for one in given if one.notice] + answer["notices"], ends)


def bind(model: mujoco.MjModel, data: mujoco.MjData) -> BoundFriction:
    """The friction in a model that `warmjoint attach` or `attach` wrote, of all its joints."""
    return BoundFriction(model, data, {}, None)


@dataclasses.dataclass(frozen=True)
class JointFriction:
    """One joint's friction at one moment."""

    torque: float  # on the joint, against its motion, N.m or N
    heat: float  # E, by which the level has changed, N.m or N; below 0 where the joint is warm
    rise: float  # of its temperature, K; 0 where the friction knows no temperature
    loss: float  # W
    held: bool


class BoundFriction:
    """The friction of a model's joints in one mjData. Arrays are [joints], in the order of `joints`.

    torque, rise, loss and held are those of the last forward computation; heat is that of the state.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        ends: Mapping[str, list[float] | None],
        joints: Sequence[str] | None,
    ):
        self.model = model
        self.data = data
        described = {joint["name"]: joint for joint in mujoco_plugin.joints_of(model)}
        if not described:
            raise BadInput("no joint of the model has friction of warmjoint; attach it")
        lacking = [joint for joint in joints or [] if joint not in described]
        if lacking:
            raise BadInput(f"joint '{lacking[0]}' has no friction in this model; bind a model that was compiled from the spec")
        self._joints = list(described.values()) if joints is None else [described[joint] for joint in joints]
        self._ends = ends
        self.joints = [joint["name"] for joint in self._joints]
        """Names of the joints."""
        self._sensors = np.array([-1 if joint["sensor"] is None else joint["sensor"] for joint in self._joints])
        self._heat_places = np.array([[self._heat_place(joint, stage) for joint in self._joints] for stage in (0, 1)])

    def _sensed(self, which: str) -> Floats:
        if (self._sensors < 0).any():
            joint = self.joints[int(np.argmin(self._sensors))]
            raise BadInput(f"no sensor reads the friction of '{joint}'; attach with sensors")
        sensed: Floats = self.data.sensordata[self._sensors + _SENSED.index(which)]
        return sensed

    def _heat_place(self, joint: dict[str, Any], stage: int) -> int:
        """Where a stage's heat stands in plugin_state, act and a 0 behind them."""
        places = _heats(joint)
        if stage >= len(places):
            return -1
        return int(joint["state"] + places[stage] + (self.model.npluginstate if joint["form"] == "actuator" else 0))

    @property
    def torque(self) -> Floats:
        """[joints] Torque or force of the friction on each joint, N.m or N."""
        return self._sensed("torque")

    @property
    def heat(self) -> Floats:
        """[joints] Change of the level by the heat, E, N.m or N: 0 cold, below 0 where warm friction is lower."""
        states = np.concatenate((self.data.plugin_state, self.data.act, [0.0]))
        heat: Floats = states[self._heat_places].sum(axis=0)
        return heat

    @property
    def rise(self) -> Floats:
        """[joints] Rise of the temperature, K; 0 where a friction knows no temperature."""
        return self._sensed("rise")

    @property
    def loss(self) -> Floats:
        """[joints] Power lost, W."""
        return self._sensed("loss")

    @property
    def held(self) -> NDArray[np.bool_]:
        """[joints] Whether friction holds the joint."""
        held: NDArray[np.bool_] = self._sensed("held") != 0
        return held

    def __getitem__(self, joint: str) -> JointFriction:
        """The friction of one joint by its name."""
        if joint not in self.joints:
            raise KeyError(f"no friction acts on a joint '{joint}'{_nearest(joint, self.joints)}")
        i = self.joints.index(joint)
        return JointFriction(float(self.torque[i]), float(self.heat[i]), float(self.rise[i]), float(self.loss[i]), bool(self.held[i]))

    def settled(self, speed: float | Sequence[float] | Floats | None = None) -> Floats:
        """[joints] Heat at which each joint settles that slides at a speed for long, N.m or N.

        speed: rad/s or m/s, one or [joints]; by default 1 rad/s or 0.1 m/s.
        """
        return np.array([sum(heat) for heat in self._settled(speed)])

    def reset(self, warm: Warm = 0.0, speed: float | Sequence[float] | Floats | None = None) -> None:
        """Sets the heat of the joints, and relaxes what holds them; pose and speed stay.

        warm: 0 cold, 1 settled at `speed`, any share of it, one or [joints]; "end" as at the end of each estimate's log.
        speed: at which 1 has settled, rad/s or m/s, one or [joints]; by default 1 rad/s or 0.1 m/s.
        Call it after mj_resetData, which resets the heat, too.
        """
        if isinstance(warm, str):
            if warm != "end":
                raise BadInput(f"warm is '{warm}'; it must be a number of 0 or more, or 'end'")
            heats = [self._end(joint) for joint in self.joints]
        else:
            share = self._by_joint(warm, "warm")
            if not np.isfinite(share).all() or (share < 0).any():
                raise BadInput(f"warm is {warm}; it must be 0 or more, or 'end'")
            heats = [[one * energy for energy in heat] for one, heat in zip(share, self._settled(speed))]
        for joint, heat in zip(self._joints, heats):
            states = self._states(self.data, joint)
            states[:] = 0
            states[_heats(joint)[: len(heat)]] = heat
            if joint["form"] == "actuator":
                self.data.plugin_state[joint["report"] + _STARTS_WARM] = 0

    def randomise(
        self,
        worlds: Any,
        *,
        warm: tuple[float, float] | None = None,
        speed: float | Sequence[float] | Floats | None = None,
        rng: np.random.Generator | int | None = None,
        **factors: tuple[float, float],
    ) -> dict[str, Floats]:
        """Draws each world's numbers and heat, for each joint by itself.

        worlds: a mujoco.batch.Batch of the bound model (MuJoCo 3.17 and later).
        factors: for numbers of the friction, as coulomb=(0.7, 1.3): the least and the largest factor on the model's.
        warm: the least and the largest share of the heat at which the world's own friction settles at `speed` (reset);
            the worlds have it now and after each of their resets.
        Returns what was drawn, [worlds x joints] each: factors by their names and the shares, "warm".
        Raises BadInput that names number, joint, world and bound, and changes nothing, where a number would be out of
        its bounds.
        """
        random = np.random.default_rng(rng)
        shape = (int(worlds.nsim), len(self._joints))
        drawn = {name: random.uniform(*between, shape) for name, between in factors.items()}
        places = {name: self._places(name) for name in factors}
        numbers = worlds.expand("numeric_data")
        new = np.array(numbers)
        for name, factor in drawn.items():
            for i, place in places[name].items():
                new[:, place] = self.model.numeric_data[place] * factor[:, i]
                self._check(name, i, new[:, place])
        self._check_static(new)
        if warm is not None:
            drawn["warm"] = random.uniform(*warm, shape)
            self._warm(worlds, new, drawn["warm"], speed)
        numbers[:] = new
        return drawn

    def _places(self, name: str) -> dict[int, int]:
        """By joint, where a number stands in numeric_data."""
        places = {i: joint["numbers"][name]["place"] for i, joint in enumerate(self._joints) if name in joint["numbers"]}
        if places:
            return places
        known = sorted({number for joint in self._joints for number in joint["numbers"]})
        if not known:
            raise BadInput("the model holds no arrays of friction's numbers; attach with randomisable")
        raise BadInput(f"no joint's friction has a number '{name}'{_nearest(name, known)}; there are {', '.join(known)}")

    def _check(self, name: str, i: int, values: Floats) -> None:
        allowed = self._joints[i]["numbers"][name]
        wrong = ~np.isfinite(values)
        wrong |= values < (-np.inf if allowed["least"] is None else allowed["least"])
        wrong |= values <= (-np.inf if allowed["above"] is None else allowed["above"])
        wrong |= values > (np.inf if allowed["most"] is None else allowed["most"])
        for world in np.flatnonzero(wrong):
            raise BadInput(f"{name} of '{self.joints[i]}' would be {values[world]:g} in world {world}; it must be {allowed['words']}")

    def _check_static(self, new: Floats) -> None:
        """A joint at rest holds at least what it slides with."""
        for i, joint in enumerate(self._joints):
            if "static" not in joint["numbers"] or "coulomb" not in joint["numbers"]:
                continue
            static, coulomb = (new[:, joint["numbers"][name]["place"]] for name in ("static", "coulomb"))
            for world in np.flatnonzero(static < coulomb):
                raise BadInput(
                    f"static of '{self.joints[i]}' would be {static[world]:g} in world {world}; it must be at least coulomb, "
                    f"{coulomb[world]:g}"
                )

    def _warm(self, worlds: Any, new: Floats, share: Floats, speed: float | Sequence[float] | Floats | None) -> None:
        """Heats all worlds by their own numbers, now and in the arrays that their resets read."""
        speeds = self._speeds(speed)
        states = {form: worlds.bind(field) for form, field in (("passive", "plugin_state"), ("actuator", "act"))}
        heats = []
        for i, joint in enumerate(self._joints):
            own = [settled_energies(_with_numbers(joint, new[world]), float(speeds[i])) for world in range(len(new))]
            heats.append(share[:, i, None] * np.array(own).reshape(len(new), -1))
        for joint, heat in zip(self._joints, heats):
            rows = states[joint["form"]]
            for stage, place in enumerate(_heats(joint)[: heat.shape[1]]):
                rows[:, joint["state"] + place] = heat[:, stage]
                array = joint["numbers"].get(("initial_energy", "second_initial_energy")[stage])
                if array:
                    new[:, array["place"]] = heat[:, stage]
            if joint["form"] == "actuator":
                states["passive"][:, joint["report"] + _STARTS_WARM] = 0

    def _states(self, data: mujoco.MjData, joint: dict[str, Any]) -> Floats:
        """The joint's states in the data, as a view."""
        all_states: Floats = data.plugin_state if joint["form"] == "passive" else data.act
        return all_states[joint["state"] : joint["state"] + len(joint["states"])]

    def _by_joint(self, given: float | Sequence[float] | Floats, what: str) -> Floats:
        values = np.asarray(given, dtype=np.float64)
        if values.shape not in ((), (len(self.joints),)):
            raise BadInput(f"{what} has shape {values.shape}; give one number, or {len(self.joints)}, one for each joint")
        return np.broadcast_to(values, (len(self.joints),))

    def _speeds(self, speed: float | Sequence[float] | Floats | None) -> Floats:
        if speed is not None:
            return self._by_joint(speed, "speed")
        return np.array([USUAL_LINEAR_SPEED if joint["linear"] else USUAL_SPEED for joint in self._joints])

    def _settled(self, speed: float | Sequence[float] | Floats | None) -> list[list[float]]:
        heats = []
        for joint, own in zip(self._joints, self._speeds(speed)):
            try:
                heats.append(settled_energies(_with_numbers(joint, self.model.numeric_data), float(own)))
            except ValueError as refusal:
                raise BadInput(f"joint '{joint['name']}': {refusal}") from None
        return heats

    def _end(self, joint: str) -> list[float]:
        end = self._ends.get(joint)
        if end is None:
            raise BadInput(f"the friction of '{joint}' is no estimate with a state_end; give reset a share of warm")
        return end


def _heats(joint: dict[str, Any]) -> list[int]:
    """Which of a joint's states are heat."""
    return [place for place, name in enumerate(joint["states"]) if name in _STAGES]


def _with_numbers(joint: dict[str, Any], numbers: Floats) -> dict[str, Any]:
    """The joint's friction with the numbers that stand in numeric_data."""
    friction: dict[str, Any] = copy.deepcopy(joint["friction"])
    for name, number in joint["numbers"].items():
        # but for the heat at a reset, which is no number of the friction
        found = place_of(friction, name)
        if found:
            holder, key = found
            holder[key] = float(numbers[number["place"]])
    return friction


def _nearest(name: str, known: Sequence[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    return f"; did you mean '{near[0]}'?" if near else ""
