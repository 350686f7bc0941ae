"""The friction of a model's joints as arrays, and the model without the plugin: what engines take that do not run MuJoCo's plugins.

    robot = wj.attach("panda.xml", {"joint[1-7]": "estimate.json"})
    model, friction = wj.split(robot)
    friction.joints, friction.numbers["thermal_gain"]
"""

from __future__ import annotations

import dataclasses
import os
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from warmjoint import _core
from warmjoint._core import BadInput
from warmjoint.friction import laws, place_of
from warmjoint.values import flag, of_kind, text
from warmjoint.values import numbers as values_of

if TYPE_CHECKING:
    import mujoco

    from warmjoint.mujoco_attach import Attached

FloatArray = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int_]

LAWS = tuple(name for name, law in laws().items() if "bristle_stiffness" not in law["parameters"])
"""The laws that arrays hold; those that bring a bristle of their own are not among them."""
_NAMES = ("coulomb", "coulomb_positive", "coulomb_negative", "static", "static_rise", "stribeck_velocity", "stribeck_exponent", "thermal_gain",
          "thermal_time_constant", "second_thermal_gain", "second_thermal_time_constant", "level_per_temperature", "viscous_per_energy", "load_gain")
# what stands where a joint's friction has no such number and a formula reads it
_ABSENT = {"stribeck_velocity": 1.0, "stribeck_exponent": 2.0, "thermal_time_constant": np.inf, "second_thermal_time_constant": np.inf}
LARGEST_GIVE = {False: 0.05, True: 0.005}  # rad, and m of a linear joint
_PLUGIN = "warmjoint.friction"


class Levels(NamedTuple):
    """A law's own levels, [J] or [worlds x J] each: g(side, |v|) = kc + rise exp(-(|v| / velocity)^exponent); of a law that breaks away
    kc while it slides and static at rest."""

    positive: FloatArray  # kc for v > 0, N.m or N
    negative: FloatArray
    rise: FloatArray  # N.m or N
    static: FloatArray  # N.m or N
    velocity: FloatArray  # rad/s or m/s
    exponent: FloatArray  # 1
    breaks_away: Bools  # [J]


@dataclasses.dataclass(frozen=True)
class FrictionArrays:
    """Friction of J joints, [J] each; `numbers` also [worlds x J]. `changed` makes one with other numbers."""

    joints: tuple[str, ...]
    laws: tuple[str, ...]
    dofs: Ints  # of the model
    positions: Ints  # in qpos
    linear: Bools
    gear: FloatArray  # motor turns for each joint turn
    inertia: FloatArray  # effective at the reference pose, kg.m^2 or kg
    stiffness: FloatArray  # A of the bristles, in units of M/h^2
    damping: FloatArray  # B, in units of M/h
    initial_energy: FloatArray  # [2 x J] E1 and E2 at a reset, N.m or N
    timestep: float  # h, s
    numbers: Mapping[str, FloatArray]
    """By the names of friction files, SI: 0 where a joint's friction has no such number. Viscous is `dof_damping` of the model."""
    maps: tuple[tuple[int, dict[str, Any]], ...]
    """The place of a joint in `joints`, and a map of its friction as files hold it."""
    frictions: tuple[dict[str, Any], ...]
    """What each joint's friction file holds, with the numbers before `changed`."""

    @property
    def worlds(self) -> int | None:
        """How many worlds the numbers are for; None where all have the same."""
        sizes = [len(values) for values in self.numbers.values() if values.ndim == 2]
        return sizes[0] if sizes else None

    def levels(self) -> Levels:
        """What the laws' levels follow from."""
        number = self.numbers
        law = np.array(self.laws)
        sided = np.isin(law, ("asymmetric", "asymmetric_stribeck"))
        coulomb, static = number["coulomb"], number["static"]
        breaks = law == "stiction"
        positive, negative = (np.where(sided, number[f"coulomb_{side}"], coulomb) for side in ("positive", "negative"))
        rise = np.where(law == "asymmetric_stribeck", number["static_rise"], np.where(law == "stribeck", static - coulomb, 0.0))
        return Levels(positive, negative, rise, static, number["stribeck_velocity"], number["stribeck_exponent"], breaks)

    def at_rest(self) -> FloatArray:
        """[J] The largest level at rest of a cold joint without load, N.m or N, over all worlds."""
        from warmjoint.friction_maps import largest_at_rest

        of = self.levels()
        rest: FloatArray = np.where(of.breaks_away, of.static, np.maximum(of.positive, of.negative) + of.rise)
        rest = (rest.max(axis=0) if rest.ndim == 2 else rest).copy()
        for joint, friction_map in self.maps:
            rest[joint] += largest_at_rest(friction_map)
        return rest

    def changed(self, **numbers: Any) -> FrictionArrays:
        """The same with other numbers, in all worlds or in each: by their names in friction files, one, [J] or [worlds x J].
        Raises BadInput that names number, joint and bound."""
        new = dict(self.numbers)
        for name, given in numbers.items():
            if name == "viscous":
                raise BadInput("viscous: is dof_damping of the model; change it there")
            having = [place_of(friction, name) is not None for friction in self.frictions]
            if name not in _NAMES or not any(having):
                known = [one for one in _NAMES if any(place_of(friction, one) for friction in self.frictions)]
                raise BadInput(f"'{name}' is no number of this friction; there are {', '.join(known)}")
            values = values_of(name, given)
            if values.ndim > 2 or values.shape[-1:] not in ((), (1,), (len(self.joints),)):
                raise BadInput(f"{name}: has shape {values.shape}; give one number, [{len(self.joints)}] or [worlds x {len(self.joints)}]")
            new[name] = np.where(having, values, self.numbers[name])
        sizes = {len(values) for values in new.values() if values.ndim == 2}
        if len(sizes) > 1:
            raise BadInput(f"numbers are for {' and '.join(map(str, sorted(sizes)))} worlds; give each for as many")
        found = dataclasses.replace(self, numbers=new)
        _check(found, list(numbers))
        return found

    def in_model(self, model: mujoco.MjModel, prefix: str = "") -> FrictionArrays:
        """The same in a scene that holds the robot under a prefix, by the joints' names. Raises BadInput for one that the scene lacks."""
        import mujoco

        of_kind("model", model, mujoco.MjModel)
        text("prefix", prefix)
        ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, prefix + joint) for joint in self.joints]
        if -1 in ids:
            raise BadInput(f"the model has no joint '{prefix + self.joints[ids.index(-1)]}'; give the prefix under which the robot was attached")
        return dataclasses.replace(self, joints=tuple(prefix + joint for joint in self.joints), dofs=np.array([model.jnt_dofadr[one] for one in ids]),
                                   positions=np.array([model.jnt_qposadr[one] for one in ids]))

    def check_give(self) -> None:
        """Raises BadInput where a bristle gives way too far before it slides: by level h^2 / (A m)."""
        give = self.at_rest() * self.timestep**2 / (self.stiffness * self.inertia)
        for i in np.flatnonzero(give > np.where(self.linear, LARGEST_GIVE[True], LARGEST_GIVE[False])):
            unit, most = ("m", LARGEST_GIVE[True]) if self.linear[i] else ("rad", LARGEST_GIVE[False])
            raise BadInput(f"joint '{self.joints[i]}': friction would give way by {give[i]:.3g} {unit} before it slides, at most {most} are allowed; "
                           "take more armature or a smaller timestep")


def _check(found: FrictionArrays, names: list[str]) -> None:
    """Each joint's friction must stand with the least and the most that any world has of a number."""
    for i, friction in enumerate(found.frictions):
        for pick in (np.min, np.max):
            data = {**friction, "parameters": dict(friction["parameters"])}
            if "thermal" in data:
                data["thermal"] = {**data["thermal"], **({"second": dict(data["thermal"]["second"])} if "second" in data["thermal"] else {})}
            for name in names:
                place = place_of(data, name)
                if place:
                    place[0][place[1]] = float(pick(found.numbers[name][..., i]))
            try:
                _core.complete_friction(data)
            except BadInput as refused:
                raise BadInput(f"joint '{found.joints[i]}': {refused}") from None
        if "static" in friction["parameters"] and (found.numbers["static"][..., i] < found.numbers["coulomb"][..., i]).any():
            raise BadInput(f"joint '{found.joints[i]}': static is below coulomb in some world; it must be at least coulomb")
    found.check_give()


@overload
def split(model: Attached | mujoco.MjSpec | str | os.PathLike[str], spec: Literal[False] = False) -> tuple[mujoco.MjModel, FrictionArrays]: ...


@overload
def split(model: Attached | mujoco.MjSpec | str | os.PathLike[str], spec: Literal[True]) -> tuple[mujoco.MjSpec, FrictionArrays]: ...


def split(model: Attached | mujoco.MjSpec | str | os.PathLike[str], spec: bool = False) -> tuple[mujoco.MjModel | mujoco.MjSpec, FrictionArrays]:
    """A model with friction as a model without the plugin, whose `dof_damping` holds the friction's viscous, and the friction as arrays.

    model: what `attach` returned, its spec, or a path or text of MJCF that `attach` wrote; it stays as it was.
    spec: with True a mujoco.MjSpec in place of the compiled model. It and its XML (`to_xml()`) name no plugin, so that they load where warmjoint
    is not installed; meshes are named by absolute paths.
    Raises BadInput where there is no friction, for a law that brings a bristle of its own, for a friction that does not hold its
    viscous in the joint's damping (attach it anew), for one that several instances share on a tree, and with spec=True for a scene whose meshes
    lie in several folders, of which XML names one.
    """
    import mujoco

    from warmjoint import mujoco_library, mujoco_plugin
    from warmjoint.mujoco_attach import Attached, _spec_of

    as_spec = flag("spec", spec)
    if isinstance(model, mujoco.MjModel):
        raise BadInput("split: is a compiled model, from which the plugin cannot be taken; give what attach returned, or its spec")
    copied = (model.spec if isinstance(model, Attached) else _spec_of(model)[0]).copy()
    with mujoco_library.refusing("model: MuJoCo cannot compile it"):
        full = copied.compile()
    joints = mujoco_plugin.joints_of(full)
    if not joints:
        raise BadInput("split: no joint of the model has friction of warmjoint; attach it")
    _refuse(joints)
    bare = _without_friction(copied)
    return _without_extension(copied, bare) if as_spec else bare, arrays_of(bare, joints)


def _refuse(joints: list[dict[str, Any]]) -> None:
    for joint in joints:
        law = joint["friction"]["law"]
        if law not in LAWS:
            raise BadInput(f"joint '{joint['name']}': the law {law} brings a bristle of its own and runs in the plugin alone; take one of {', '.join(LAWS)}")
        if joint["instances"] > 1:
            raise BadInput(f"joint '{joint['name']}': {joint['instances']} instances act on its kinematic tree; attach all friction of a robot at once")
        if not joint["damping"] and joint["friction"]["parameters"].get("viscous", 0) != 0:
            raise BadInput(f"joint '{joint['name']}': its viscous is the plugin's own; attach the friction anew, which makes it the joint's damping")


def _without_friction(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """The compiled model without instances, actuators, sensors and arrays of the friction. spec: is changed."""
    from warmjoint import mujoco_plugin

    mujoco_plugin.remove_from_spec(spec)
    return spec.compile()


def _without_extension(spec: mujoco.MjSpec, bare: mujoco.MjModel) -> mujoco.MjSpec:
    """A spec of its own that does not ask for the plugin, which a spec that once did does for ever. bare: what spec compiles to."""
    import mujoco

    from warmjoint.mujoco_attach import text_of_spec

    if any((spec.meshes, spec.textures, spec.hfields, spec.skins)):
        spec.meshdir, spec.texturedir = (os.path.abspath(os.path.join(spec.modelfiledir, folder)) for folder in (spec.meshdir, spec.texturedir))
    tree = ET.fromstring(text_of_spec(spec))
    for extension in tree.findall("extension"):
        for plugin in extension.findall("plugin"):
            if plugin.get("plugin") == _PLUGIN:
                extension.remove(plugin)
        if not len(extension):
            tree.remove(extension)
    try:
        found = mujoco.MjSpec.from_string(ET.tostring(tree, encoding="unicode"), assets=dict(spec.assets))
        same = _same_numbers(found.copy().compile(), bare)
    except ValueError as refusal:
        raise BadInput(f"split: the model without friction does not load from its XML ({refusal}); leave spec=True out") from None
    if not same:
        raise BadInput("split: the XML of this model makes another one, as that of a scene whose meshes lie in several folders; leave spec=True out")
    return found


def _same_numbers(one: mujoco.MjModel, other: mujoco.MjModel) -> bool:
    """Whether two compiled models hold the same arrays. Why 1e-5: MuJoCo 3.11 writes six digits."""
    names = [name for name in dir(one) if not name.startswith("_") and isinstance(getattr(one, name), np.ndarray) and name != "names"]
    arrays = [(np.asarray(getattr(one, name)), np.asarray(getattr(other, name))) for name in names if getattr(one, name).dtype.kind in "fiu"]
    return all(a.shape == b.shape and np.allclose(a, b, rtol=1e-5, atol=1e-5 * max(1.0, float(np.abs(b).max(initial=0.0)))) for a, b in arrays)


def arrays_of(bare: mujoco.MjModel, joints: list[dict[str, Any]]) -> FrictionArrays:
    """The arrays of joints of a model. joints: name, friction, inertia, bristle, linear and initial_energy of each (mujoco_plugin.joints_of)."""
    def column(name: str) -> FloatArray:
        found = [place_of(joint["friction"], name) for joint in joints]
        return np.array([_ABSENT.get(name, 0.0) if at is None else at[0].get(at[1], 0.0) for at in found], dtype=np.float64)

    ids = [bare.joint(joint["name"]).id for joint in joints]
    dofs = np.array([bare.jnt_dofadr[one] for one in ids])
    inertia = np.array([joint["inertia"] for joint in joints])
    h = float(bare.opt.timestep)
    shapes = [joint["bristle"] for joint in joints]
    return FrictionArrays(
        joints=tuple(joint["name"] for joint in joints),
        laws=tuple(joint["friction"]["law"] for joint in joints),
        dofs=dofs,
        positions=np.array([bare.jnt_qposadr[one] for one in ids]),
        linear=np.array([joint["linear"] for joint in joints]),
        gear=column("gear"),
        inertia=inertia,
        stiffness=np.array([shape["stiffness"] for shape in shapes]),
        damping=np.array([shape["damping"] for shape in shapes]),
        initial_energy=np.array([joint["initial_energy"] for joint in joints], dtype=np.float64).T.copy(),
        timestep=h,
        numbers={name: column(name) for name in _NAMES},
        maps=tuple((i, one) for i, joint in enumerate(joints) for one in joint["friction"].get("maps", [])),
        frictions=tuple(joint["friction"] for joint in joints),
    )
