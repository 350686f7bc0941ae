"""Nominal friction with a map over the position by scikit-learn's RidgeCV.

Normalised Gaussian kernels over the position for each direction of motion are added to v and sign(v). All weights share
one penalty, chosen by cross validation; the two nominal ones are scaled up, which frees them of it.
"""

import sys

import numpy as np
import recording
from sklearn.linear_model import RidgeCV

KERNELS = 20
FREE = 1e3  # scale of the columns that are not to be penalised


def kernels(position):
    """Normalised kernels (16): [N, KERNELS]; rows sum to 1."""
    centres = np.linspace(position.min(), position.max(), KERNELS)
    width = centres[1] - centres[0]
    exponent = -((position[:, None] - centres) ** 2) / (2 * width**2)
    weights = np.exp(exponent - exponent.max(axis=1, keepdims=True))
    return weights / weights.sum(axis=1, keepdims=True)


def main(source, target):
    log = recording.read(source)
    moving = log["velocity"] != 0
    velocity, torque = log["velocity"][moving], log["torque"][moving]
    direction = np.sign(velocity)[:, None]
    maps = kernels(log["position"][moving])
    nominal = np.column_stack([velocity, np.sign(velocity)])
    columns = np.hstack([FREE * nominal, maps * (direction > 0), maps * (direction < 0)])

    fit = RidgeCV(alphas=np.logspace(-3, 5, 20), fit_intercept=False).fit(columns, torque)
    viscous, coulomb = FREE * fit.coef_[:2]
    recording.write(target, {"viscous": max(viscous, 0.0), "coulomb": max(coulomb, 0.0)})


if __name__ == "__main__":
    main(*sys.argv[1:])
