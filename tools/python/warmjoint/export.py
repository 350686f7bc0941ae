"""Friction as the numbers that other engines take, and what these leave out; as code and parameters of controllers, and as an FMU."""

from __future__ import annotations

import dataclasses
import os
import pathlib
import warnings
from collections.abc import Mapping
from typing import Any, Literal

from warmjoint import _core
from warmjoint.fmu import pack
from warmjoint.values import path_of

EngineFormat = Literal["mjcf", "urdf", "physx", "isaaclab", "mjlab", "ur", "c", "cpp", "python", "ros2", "fmu"]


@dataclasses.dataclass(frozen=True)
class LeftOut:
    """What the numbers do not say: asymmetry, speed, rest, heat, position, load or creep."""

    what: str
    percent: float | None  # of the mean friction over the speeds; None where no size is known
    meaning: str


@dataclasses.dataclass(frozen=True)
class EngineFriction:
    """F = viscous v + level sign(v), N.m or N, of one joint at one warmth."""

    viscous: float  # N.m.s/rad or N.s/m
    level: float  # while it slides, N.m or N
    static_level: float  # at rest, N.m or N
    energy: float  # E at that warmth, N.m or N
    speed: float  # at which warm = 1 has settled, rad/s or m/s
    slowest: float  # of the speeds over which it is right, rad/s or m/s
    fastest: float
    left_out: list[LeftOut]


@dataclasses.dataclass(frozen=True)
class Export:
    """What the engine reads, and the numbers in it; where heat is a state the text alone. Of an FMU the text is its model description."""

    text: str
    joints: dict[str, EngineFriction]
    notices: list[str]  # which joints were left out, one sentence each
    model: str = ""  # of an FMU, its modelIdentifier
    files: dict[str, str] = dataclasses.field(default_factory=dict)  # of an FMU, by their paths in it

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the text; of an FMU the archive, with the library that a C compiler makes (the variable CC, else cc). Warns where there is
        none."""
        if not self.files:
            _core.write_text(path_of(path), self.text)
            return
        archive, notices = pack(self.model, self.files)
        for notice in notices:
            warnings.warn(notice, stacklevel=2)
        written = pathlib.Path(f"{path_of(path)}.part")
        written.write_bytes(archive)
        written.replace(path_of(path))

    def __str__(self) -> str:
        return self.text


def export_frictions(given: Mapping[str, Any], to: EngineFormat, *, warm: float, speed: float | None, joint: str) -> Export:
    """Of what estimate.json, robot.json or a friction file holds."""
    request: dict[str, Any] = {"to": to, "warm": warm, "joint": joint}
    if speed is not None:
        request["speed"] = speed
    found = _core.export_frictions(dict(given), request)
    joints = {}
    for name, one in found["joints"].items():
        left_out = [LeftOut(left["what"], left["percent"], left["meaning"]) for left in one["left_out"]]
        numbers = {key: one[key] for key in ("viscous", "level", "static_level", "energy", "speed", "slowest", "fastest")}
        joints[name] = EngineFriction(**numbers, left_out=left_out)
    return Export(found["text"], joints, found["notices"], found.get("model", ""), found.get("files", {}))
