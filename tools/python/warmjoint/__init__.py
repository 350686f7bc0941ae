"""Friction of robot joints that depends on position, motor angle and the heat of its own losses.

    import warmjoint as wj

    log = wj.read("log.csv")                  # or wj.Log(time=t, position=q, torque=tau)
    estimate = wj.identify(log)
    print(estimate["coulomb"].value, estimate["coulomb"].ci95)

Angles are in rad, lengths in m, torques in N.m, forces in N, times in s. What cannot be used raises BadInput with the
program's own sentence; a fit that fails is an Estimate whose `status` and `message` say so.
"""

from warmjoint._core import BadInput, OutputFailed
from warmjoint._core import version as __version__
from warmjoint.engine import Run, Simulated, compare, run, score, simulate
from warmjoint.estimate import Estimate, Parameter, Prediction, Rejected, identifiers, identify, load
from warmjoint.friction import Friction, laws
from warmjoint.log import Check, Log, check, read

__all__ = ["BadInput", "Check", "Estimate", "Friction", "Log", "OutputFailed", "Parameter", "Prediction", "Rejected", "Run",
           "Simulated", "__version__", "check", "compare", "identifiers", "identify", "laws", "load", "read", "run", "score",
           "simulate"]
