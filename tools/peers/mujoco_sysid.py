"""Damping and frictionloss by MuJoCo's own system identification toolbox, mujoco.sysid.

A light joint is driven along the recorded velocity by a stiff velocity servo; the toolbox fits the joint's `damping` and
`frictionloss` so that the servo's force follows the recorded torque. It knows no friction that warms up.
"""

import sys

import mujoco
import numpy as np
import recording
from mujoco import sysid

SERVO = 1e4  # gain of the velocity servo, N.m.s/rad: the joint lags by a few mrad/s

MODEL = """
<mujoco>
  <option timestep="{step}" integrator="implicitfast" gravity="0 0 0"/>
  <worldbody>
    <body>
      <joint name="joint" type="hinge" axis="0 0 1" armature="1e-3" frictionloss="1" damping="1"
             solreffriction="-1 -1e6"/>
      <geom type="sphere" size="0.01" mass="1e-3"/>
    </body>
  </worldbody>
  <actuator>
    <velocity name="servo" joint="joint" kv="{servo}"/>
  </actuator>
  <sensor>
    <jointvel name="velocity" joint="joint"/>
  </sensor>
</mujoco>
"""


def set_damping(spec, parameter):
    spec.joint("joint").damping = np.array([parameter.value[0], 0, 0])


def set_frictionloss(spec, parameter):
    spec.joint("joint").frictionloss = parameter.value[0]


def fit(log):
    """Best damping and frictionloss, and their standard deviations: two arrays [2]."""
    time, velocity, torque = (log[name] for name in ("time", "velocity", "torque"))
    spec = mujoco.MjSpec.from_string(MODEL.format(step=np.median(np.diff(time)), servo=SERVO))
    model = spec.compile()
    data = mujoco.MjData(model)

    # the servo's force at the end of each implicit step, on the samples that move
    def residual(params, predicted, measured, model, return_all, state=None):
        reached = state[:, 2]
        steps = len(reached)
        error = SERVO * (velocity[:steps] - reached) - torque[:steps]
        return error[velocity[:steps] != 0][:, None], predicted, measured

    parameters = sysid.ParameterDict()
    bound = 10 * np.max(np.abs(torque))
    parameters.add(sysid.Parameter("damping", 1.0, 0.0, bound, modifier=set_damping))
    parameters.add(sysid.Parameter("frictionloss", 1.0, 0.0, bound, modifier=set_frictionloss))
    sequence = sysid.ModelSequences(
        "joint", spec, "recording", sysid.create_initial_state(model, data.qpos, data.qvel, data.act),
        sysid.TimeSeries(time - time[0], velocity[:, None]),
        sysid.TimeSeries.from_names(time - time[0], velocity[:, None], model))
    residual_of = sysid.build_residual_fn(models_sequences=[sequence], modify_residual=residual, resample_true=False)
    best, result = sysid.optimize(parameters, residual_of, verbose=False, xtol=1e-5)

    residuals, _, _ = residual_of(result.x, best)
    covariance, _ = sysid.calculate_intervals(residuals, result.jac)
    return best.as_vector(), np.sqrt(np.diag(covariance))


def main(source, target):
    names = ["viscous", "coulomb"]
    best, deviations = fit(recording.read(source))
    recording.write(target, dict(zip(names, best.tolist())), dict(zip(names, deviations.tolist())))


if __name__ == "__main__":
    main(*sys.argv[1:])
