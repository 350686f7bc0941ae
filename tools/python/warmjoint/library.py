"""Measured robots: the friction of their joints with intervals, from public logs.

    print(wj.library()["ur10e"])                       # its joints, each with friction and interval
    elbow = wj.load("library:ur10e/elbow_joint")       # an Estimate
    robot = wj.attach("ur10e.xml", "library:ur10e")    # all joints, on your model of that robot
"""

from __future__ import annotations

import dataclasses
from typing import Any

from warmjoint import _core
from warmjoint.friction import Friction

__all__ = ["Machine", "library"]


@dataclasses.dataclass(frozen=True)
class Machine:
    """A measured machine. joints: by name what its card says of each, with `status`, `friction` ([{speed, value, interval95}], rad/s and `unit`, or m/s),
    `fall` by warming, `halves` of the log, and for one that is refused its `message`. card: the whole card, with source, commit, licence and commands.
    """

    name: str
    machine: str
    joints: dict[str, dict[str, Any]]
    card: dict[str, Any]

    @property
    def frictions(self) -> dict[str, Friction]:
        """The frictions that are known in N.m or N, as `attach` takes them."""
        from warmjoint.robot import load_robot

        return load_robot(f"library:{self.name}").frictions

    def __str__(self) -> str:
        lines = [f"{self.name}: {self.machine}"]
        for name, joint in self.joints.items():
            rows = joint["friction"]
            known = ""
            if rows:
                row = rows[len(rows) // 2]
                low, high = row["interval95"]
                known = f"{row['value']:.3g} ({low:.3g} .. {high:.3g}) {joint['unit']} at {row['speed']:.3g} {joint['speed_unit']}"
            lines.append(f"  {name}  {joint['status']}  {known}".rstrip())
        return "\n".join(lines)


def library() -> dict[str, Machine]:
    """The measured machines by name; `library:NAME` and `library:NAME/JOINT` stand wherever a friction file does."""
    return {card["name"]: Machine(card["name"], card["machine"], {one["name"]: one for one in card["joints"]}, card) for card in _core.library()}
