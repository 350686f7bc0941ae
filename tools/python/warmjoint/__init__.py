"""Friction of robot joints that depends on position, motor angle and the heat of its own losses.

    import warmjoint as wj

    log = wj.read("log.csv")                  # or wj.Log(time=t, position=q, torque=tau)
    estimate = wj.identify(log)
    print(estimate["coulomb"].value, estimate["coulomb"].ci95)
    robot = wj.attach("robot.xml", {"elbow": estimate})       # needs MuJoCo

Angles are in rad, lengths in m, torques in N.m, forces in N, times in s. What cannot be used raises BadInput with the
program's own sentence; a fit that fails is an Estimate whose `status` and `message` say so.
"""

import contextlib
import importlib
import os
import pathlib
from typing import TYPE_CHECKING, Any

from warmjoint._core import BadInput, OutputFailed
from warmjoint._core import version as __version__
from warmjoint.answers import FrictionAtSpeed, Parameter, Prediction, Residuals
from warmjoint.compensate import Compensated, Compensator
from warmjoint.design import Design, Enough, RobotDesign, design, design_robot, enough
from warmjoint.engine import Board, Run, Simulated, compare, run, score, simulate
from warmjoint.estimate import Estimate, Rejected, Void, identifiers, identify, load
from warmjoint.friction import Friction, laws
from warmjoint.library import Machine, library
from warmjoint.log import Check, Log, check, read
from warmjoint.robot import RobotEstimate, identify_robot, load_robot

if TYPE_CHECKING:
    from warmjoint import reference
    from warmjoint.friction_arrays import split
    from warmjoint.mujoco_attach import attach, bind
    from warmjoint.native_springs import native

# what needs MuJoCo, or an engine, is imported where it is asked for: names of modules, and of what stands in one
_IN = {"attach": "mujoco_attach", "bind": "mujoco_attach", "native": "native_springs", "split": "friction_arrays"}
_MODULES = ("reference", "mjx", "warp")


def __getattr__(name: str) -> Any:
    """What is imported where it is asked for."""
    if name in _IN:
        return getattr(importlib.import_module(f"warmjoint.{_IN[name]}"), name)
    if name in _MODULES:
        return importlib.import_module(f"warmjoint.{name}")
    raise AttributeError(f"module 'warmjoint' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


# The robots, the library and the suites of an installed package
_data = pathlib.Path(__file__).parent / "data"
if _data.is_dir():
    os.environ.setdefault("WARMJOINT_DATA", os.fspath(_data))

# The plugin, so that models with friction load wherever the package is imported, as in a worker that unpickles one. Where there is no MuJoCo, or
# none that a build fits, attach and bind say so once they are asked for.
with contextlib.suppress(Exception):
    importlib.import_module("warmjoint.mujoco_plugin")


__all__ = ["BadInput", "Board", "Check", "Compensated", "Compensator", "Design", "Enough", "Estimate", "Friction", "FrictionAtSpeed", "Log", "Machine", "OutputFailed", "Parameter", "Prediction", "Rejected",
           "Residuals", "RobotDesign", "RobotEstimate", "Run", "Simulated", "Void", "__version__", "attach", "bind", "check", "compare", "design", "design_robot", "enough", "identifiers", "identify",
           "identify_robot", "laws", "library", "load", "load_robot", "native", "read", "reference", "run", "score", "simulate", "split"]
