"""Friction that acts in a model of MuJoCo: what it does, its heat, and worlds with numbers of their own."""

from __future__ import annotations

import copy
import dataclasses
import difflib
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import mujoco
import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from warmjoint import mujoco_plugin
from warmjoint._core import BadInput
from warmjoint.friction import Friction, place_of, settled_energies
from warmjoint.values import kind_of, numbers, of_kind, shown, text_of, whole

Floats = NDArray[np.float64]
Warm = float | Sequence[float] | Floats | Literal["end"]

# of the plugin's entries in plugin_state: starts warm at the first step (actuator form)
_STARTS_WARM = 2
_SENSED = ("torque", "heat", "rise", "loss", "held")
_STAGES = ("energy", "second energy")
# at which friction counts as settled where no speed is given
USUAL_SPEED = 1.0  # rad/s
USUAL_LINEAR_SPEED = 0.1  # m/s


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


class _Sensed:
    """What the sensors of joints read: arrays are [joints], of a batch [worlds x joints], in the order of `joints`."""

    def _sensed(self, which: str) -> Floats:
        """A number of each joint's sensor: torque, rise, loss or held."""
        raise NotImplementedError

    @property
    def torque(self) -> Floats:
        """Torque or force of the friction on each joint, N.m or N."""
        return self._sensed("torque")

    @property
    def rise(self) -> Floats:
        """Rise of the temperature, K; 0 where a friction knows no temperature."""
        return self._sensed("rise")

    @property
    def loss(self) -> Floats:
        """Power lost, W."""
        return self._sensed("loss")

    @property
    def held(self) -> NDArray[np.bool_]:
        """Whether friction holds the joint."""
        held: NDArray[np.bool_] = self._sensed("held") != 0
        return held


class BoundFriction(_Sensed):
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
        of_kind("model", model, mujoco.MjModel)
        of_kind("data", data, mujoco.MjData)
        if (len(data.qvel), len(data.act), len(data.plugin_state)) != (model.nv, model.na, model.npluginstate):
            raise BadInput("data: is of another model; make it by mujoco.MjData(model)")
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
        self.heat_places = np.array([[self._heat_place(joint, stage) for joint in self._joints] for stage in (0, 1)])
        """[2 x joints] Where each stage's heat stands in plugin_state, act and a 0 behind them."""

    def sensed_places(self, which: str) -> NDArray[np.intp]:
        """[joints] Where a number of each joint's sensor stands in sensordata: torque, heat, rise, loss or held."""
        if (self._sensors < 0).any():
            joint = self.joints[int(np.argmin(self._sensors))]
            raise BadInput(f"no sensor reads the friction of '{joint}'; attach with sensors")
        return self._sensors + _SENSED.index(which)

    def _sensed(self, which: str) -> Floats:
        sensed: Floats = self.data.sensordata[self.sensed_places(which)]
        return sensed

    def _heat_place(self, joint: dict[str, Any], stage: int) -> int:
        """Where a stage's heat stands in plugin_state, act and a 0 behind them."""
        places = _heats(joint)
        if stage >= len(places):
            return -1
        return int(joint["state"] + places[stage] + (self.model.npluginstate if joint["form"] == "actuator" else 0))

    @property
    def heat(self) -> Floats:
        """[joints] Change of the level by the heat, E, N.m or N: 0 cold, below 0 where warm friction is lower."""
        states = np.concatenate((self.data.plugin_state, self.data.act, [0.0]))
        heat: Floats = states[self.heat_places].sum(axis=0)
        return heat

    def __getitem__(self, joint: str) -> JointFriction:
        """The friction of one joint by its name."""
        if not isinstance(joint, str) or joint not in self.joints:
            raise KeyError(f"no friction acts on a joint {shown(joint)}{_nearest(text_of(joint), self.joints)}")
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
                raise BadInput(f"warm is {shown(warm)}; it must be a number of 0 or more, or 'end'")
            heats = [self._end(joint) for joint in self.joints]
        else:
            share = self._by_joint(warm, "warm")
            if not np.isfinite(share).all() or (share < 0).any():
                raise BadInput(f"warm is {shown(warm)}; it must be 0 or more, or 'end'")
            heats = [[one * energy for energy in heat] for one, heat in zip(share, self._settled(speed))]
        for joint, heat in zip(self._joints, heats):
            states = self._states(self.data, joint)
            states[:] = 0
            states[_heats(joint)[: len(heat)]] = heat
            if joint["form"] == "actuator":
                self.data.plugin_state[joint["report"] + _STARTS_WARM] = 0

    def inverse(self, q: npt.ArrayLike, v: npt.ArrayLike, a: npt.ArrayLike, heat: npt.ArrayLike | None = None) -> Floats:
        """Forces along a motion with friction of steady sliding, [nv] or [times x nv], N.m or N: mj_inverse without the plugin, whose bristles have no
        state off a run, and F(v) at that heat in its place. At speed 0 friction is 0; what it holds there is any force up to its level.

        q: qpos, [nq] or [times x nq]; v, a: qvel and qacc, [nv] or [times x nv]; heat: E, N.m or N, one, [joints] or [times x joints]; by
        default that of the state. The bound data stay as they are."""
        one, (positions, speeds, accelerations) = self._motion(q, v, a)
        energies = np.asarray(self.heat if heat is None else numbers("heat", heat))
        try:
            energies = np.broadcast_to(energies, (len(positions), len(self.joints)))
        except ValueError:
            raise BadInput(f"heat: has shape {energies.shape}; give one number, [{len(self.joints)}] or [{len(positions)} x {len(self.joints)}]") from None
        if not np.isfinite(energies).all():
            raise BadInput("heat: must hold finite numbers")
        data, forces, loads = mujoco.MjData(self.model), np.zeros(speeds.shape), np.zeros(speeds.shape)
        for time in range(len(positions)):
            data.qpos[:], data.qvel[:], data.qacc[:] = positions[time], speeds[time], accelerations[time]
            mujoco.mj_inverse(self.model, data)
            # all passive forces but those of plugins, of which friction's are left out
            passive = data.qfrc_spring + data.qfrc_damper + data.qfrc_gravcomp + data.qfrc_fluid
            forces[time], loads[time] = data.qfrc_inverse, data.qfrc_bias
            for joint in self._joints:
                dof = self.model.joint(joint["name"]).dofadr[0]
                if joint["form"] == "passive":
                    forces[time, dof] += data.qfrc_passive[dof] - passive[dof]
                forces[time, dof] += data.qfrc_damper[dof] if joint["damping"] else 0.0
        for i, joint in enumerate(self._joints):
            of = self.model.joint(joint["name"])
            dof, place = of.dofadr[0], of.qposadr[0]
            friction = Friction.from_dict(_with_numbers(joint, self.model, {}))
            forces[:, dof] += friction(speeds[:, dof], positions[:, place], energies[:, i], loads[:, dof])
        return forces[0] if one else forces

    def _motion(self, q: npt.ArrayLike, v: npt.ArrayLike, a: npt.ArrayLike) -> tuple[bool, list[Floats]]:
        """Whether it is one moment, and the motion as [times x n] each."""
        found = []
        for argument, values, size in (("q", q, self.model.nq), ("v", v, self.model.nv), ("a", a, self.model.nv)):
            rows = np.asarray(numbers(argument, values))
            if rows.ndim not in (1, 2) or rows.shape[-1] != size:
                raise BadInput(f"{argument}: has shape {rows.shape}; give [{size}] or [times x {size}]")
            if not np.isfinite(rows).all():
                raise BadInput(f"{argument}: must hold finite numbers")
            found.append(rows)
        if len({rows.shape[:-1] for rows in found}) > 1:
            raise BadInput(f"q, v and a have shapes {', '.join(str(rows.shape) for rows in found)}; give each for as many times")
        return found[0].ndim == 1, [np.atleast_2d(rows) for rows in found]

    def of(self, worlds: Any) -> WorldsFriction:
        """The same numbers in all worlds of a mujoco.batch.Batch of the bound model (MuJoCo 3.17 and later)."""
        return WorldsFriction(self, worlds)

    def randomise(
        self,
        worlds: Any,
        *,
        ids: Sequence[int] | NDArray[np.integer[Any]] | None = None,
        warm: tuple[float, float] | None = None,
        speed: float | Sequence[float] | Floats | None = None,
        rng: np.random.Generator | int | None = None,
        **factors: tuple[float, float],
    ) -> dict[str, Floats]:
        """Draws worlds' numbers and heat, for each joint by itself.

        worlds: a mujoco.batch.Batch of the bound model (MuJoCo 3.17 and later).
        ids: the worlds that draw, as those whose episode has ended; by default all. The others keep theirs.
        factors: for numbers of the friction, as coulomb=(0.7, 1.3): the least and the largest factor on the model's.
        warm: the least and the largest share of the heat at which the world's own friction settles at `speed` (reset), from 0
            cold to 1 settled; the worlds have it now and after each of their resets.
        Returns what was drawn, [ids x joints] each: factors by their names and the shares, "warm".
        Raises BadInput that names number, joint, world and bound, and changes nothing, where a number would be out of
        its bounds.
        """
        random = rng if isinstance(rng, np.random.Generator) else np.random.default_rng(None if rng is None else whole("rng", rng))
        chosen = self._ids(worlds, ids)
        shape = (len(chosen), len(self._joints))
        drawn = {name: random.uniform(*_range(name, between), shape) for name, between in factors.items()}
        numbers = {name: self._numbers(name) for name in factors}

        # in copies first, so that what is refused changes nothing
        fields = {number["field"] for of_joints in numbers.values() for number in of_joints.values()} | {"numeric_data"}
        expanded = {field: worlds.expand(field) for field in sorted(fields)}
        new = {field: np.array(values) for field, values in expanded.items()}
        for name, factor in drawn.items():
            for i, number in numbers[name].items():
                model = getattr(self.model, number["field"])
                new[number["field"]][chosen, number["place"]] = model[number["place"]] * factor[:, i]
                self._check(name, i, new[number["field"]][:, number["place"]], chosen)
        self._check_static(new["numeric_data"], chosen)
        if warm is not None:
            drawn["warm"] = random.uniform(*_shares(warm), shape)
            self._warm(worlds, new, chosen, drawn["warm"], speed)
        for field, values in expanded.items():
            values[chosen] = new[field][chosen]
        return drawn

    def _ids(self, worlds: Any, ids: Sequence[int] | NDArray[np.integer[Any]] | None) -> NDArray[np.intp]:
        """The chosen worlds by their numbers."""
        count = int(_batch(worlds).nsim)
        if ids is None:
            return np.arange(count)
        # a mask is no list of numbers
        chosen = np.flatnonzero(ids) if isinstance(ids, np.ndarray) and ids.dtype == bool and ids.shape == (count,) else numbers("ids", ids)
        if chosen.ndim != 1 or (chosen != np.floor(chosen)).any() or (chosen < 0).any() or (chosen >= count).any():
            raise BadInput(f"ids is {shown(ids)}; give numbers of worlds from 0 to {count - 1}, or a mask of {count}")
        return chosen.astype(np.intp)

    def _numbers(self, name: str) -> dict[int, dict[str, Any]]:
        """By joint, where a number stands in the model."""
        numbers = {i: joint["numbers"][name] for i, joint in enumerate(self._joints) if name in joint["numbers"]}
        if numbers:
            return numbers
        known = sorted({number for joint in self._joints for number in joint["numbers"]})
        if not any(number["field"] == "numeric_data" for joint in self._joints for number in joint["numbers"].values()):
            raise BadInput("the model holds no arrays of friction's numbers; attach with randomisable")
        raise BadInput(f"no joint's friction has a number '{name}'{_nearest(name, known)}; there are {', '.join(known)}")

    def _check(self, name: str, i: int, values: Floats, worlds: NDArray[np.intp]) -> None:
        allowed = self._joints[i]["numbers"][name]
        for world in worlds:
            value = values[world]
            right = np.isfinite(value) and (allowed["least"] is None or value >= allowed["least"])
            right = right and (allowed["above"] is None or value > allowed["above"])
            if right and (allowed["most"] is None or value <= allowed["most"]):
                continue
            raise BadInput(f"{name} of '{self.joints[i]}' would be {value:g} in world {world}; it must be {allowed['words']}")

    def _check_static(self, new: Floats, worlds: NDArray[np.intp]) -> None:
        """A joint at rest holds at least what it slides with."""
        for i, joint in enumerate(self._joints):
            if "static" not in joint["numbers"] or "coulomb" not in joint["numbers"]:
                continue
            static, coulomb = (new[:, joint["numbers"][name]["place"]] for name in ("static", "coulomb"))
            for world in worlds[static[worlds] < coulomb[worlds]]:
                raise BadInput(
                    f"static of '{self.joints[i]}' would be {static[world]:g} in world {world}; it must be at least coulomb, "
                    f"{coulomb[world]:g}"
                )

    def _warm(
        self,
        worlds: Any,
        new: dict[str, Floats],
        chosen: NDArray[np.intp],
        share: Floats,
        speed: float | Sequence[float] | Floats | None,
    ) -> None:
        """Heats worlds by their own numbers, now and in the arrays that their resets read."""
        speeds = self._speeds(speed)
        if not chosen.size:
            return
        states = {form: worlds.bind(field) for form, field in (("passive", "plugin_state"), ("actuator", "act"))}
        heats = []
        for i, joint in enumerate(self._joints):
            own = []
            for world in chosen:
                friction = _with_numbers(joint, self.model, {field: values[world] for field, values in new.items()})
                own.append(settled_energies(friction, float(speeds[i])))
            heats.append(share[:, i, None] * np.array(own).reshape(len(chosen), -1))
        for joint, heat in zip(self._joints, heats):
            rows = states[joint["form"]]
            for stage, place in enumerate(_heats(joint)[: heat.shape[1]]):
                rows[chosen, joint["state"] + place] = heat[:, stage]
                array = joint["numbers"].get(("initial_energy", "second_initial_energy")[stage])
                if array:
                    new["numeric_data"][chosen, array["place"]] = heat[:, stage]
            if joint["form"] == "actuator":
                states["passive"][chosen, joint["report"] + _STARTS_WARM] = 0

    def _states(self, data: mujoco.MjData, joint: dict[str, Any]) -> Floats:
        """The joint's states in the data, as a view."""
        all_states: Floats = data.plugin_state if joint["form"] == "passive" else data.act
        return all_states[joint["state"] : joint["state"] + len(joint["states"])]

    def _by_joint(self, given: float | Sequence[float] | Floats, what: str) -> Floats:
        values = numbers(what, given)
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
                heats.append(settled_energies(_with_numbers(joint, self.model, {}), float(own)))
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


def _with_numbers(joint: dict[str, Any], model: mujoco.MjModel, fields: Mapping[str, Floats]) -> dict[str, Any]:
    """The joint's friction with the numbers that stand in fields of a world, or of the model where the world has none."""
    friction: dict[str, Any] = copy.deepcopy(joint["friction"])
    for name, number in joint["numbers"].items():
        # but for the heat at a reset, which is no number of the friction
        found = place_of(friction, name)
        if found:
            holder, key = found
            field = number["field"]
            holder[key] = float((fields[field] if field in fields else getattr(model, field))[number["place"]])
    return friction


class WorldsFriction(_Sensed):
    """The friction of joints in all worlds of a batch. Arrays are [worlds x joints], in the order of `joints`.

    torque, rise, loss and held are those of each world's last forward computation; heat is that of its state.
    """

    def __init__(self, friction: BoundFriction, worlds: Any):
        worlds = _batch(worlds)
        self.joints = friction.joints
        """Names of the joints."""
        self._friction = friction
        self._fields = {field: worlds.bind(field) for field in ("plugin_state", "act")}
        self._sensordata = worlds.bind("sensordata")

    def _sensed(self, which: str) -> Floats:
        sensed: Floats = self._sensordata[:, self._friction.sensed_places(which)]
        return sensed

    @property
    def heat(self) -> Floats:
        """[worlds x joints] Change of the level by the heat, E, N.m or N."""
        states = np.concatenate((*self._fields.values(), np.zeros((len(self._sensordata), 1))), axis=1)
        heat: Floats = states[:, self._friction.heat_places].sum(axis=1)
        return heat


def _batch(worlds: Any) -> Any:
    """Worlds that are a batch."""
    if not all(hasattr(worlds, member) for member in ("nsim", "bind", "expand")):
        raise BadInput(f"worlds: is {kind_of(worlds)}; give a mujoco.batch.Batch of the bound model")
    return worlds


def _range(argument: str, between: Any) -> tuple[float, float]:
    """The least and the largest of what is drawn."""
    found = numbers(argument, between)
    if found.shape != (2,) or not np.isfinite(found).all():
        raise BadInput(f"{argument} is {shown(between)}; give the least and the largest, as (0.7, 1.3)")
    least, largest = map(float, found)
    if least > largest:
        raise BadInput(f"{argument}: the least, {least:g}, is above the largest, {largest:g}; give ({largest:g}, {least:g})")
    return least, largest


def _shares(warm: Any) -> tuple[float, float]:
    """The least and the largest share of the settled heat."""
    least, largest = _range("warm", warm)
    if least < 0 or largest > 1:
        raise BadInput(f"warm: is from {least:g} to {largest:g}; give shares from 0, cold, to 1, settled at `speed`: a faster one is warmer")
    return least, largest


def _nearest(name: str, known: Sequence[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    return f"; did you mean '{near[0]}'?" if near else ""
