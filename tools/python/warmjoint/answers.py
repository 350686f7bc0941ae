"""What an estimate is asked for: parameters, friction at speeds, predictions, residuals."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from warmjoint.figures.numerals import range_at_bound
from warmjoint.values import Array


@dataclasses.dataclass(frozen=True)
class Parameter:
    """An estimated parameter in SI. std and ci95 (95 % confidence interval) are None where they do not exist; value is nan where the
    log or the motion cannot tell it."""

    name: str
    value: float
    unit: str
    std: float | None
    ci95: tuple[float, float] | None

    def __repr__(self) -> str:
        interval = f" ({self.ci95[0]:.6g} .. {self.ci95[1]:.6g})" if self.ci95 and not range_at_bound(self.value, self.ci95) else ""
        return f"{self.name} = {value_text(self, 6)}{interval} {self.unit}"


@dataclasses.dataclass(frozen=True)
class FrictionAtSpeed:
    """What the joint brakes with at a speed, N.m or N, with its standard deviation and its 95 % confidence interval."""

    speed: float  # rad/s or m/s; below 0: backwards
    value: float  # N.m or N, against the motion
    std: float
    ci95: tuple[float, float]
    unit: str  # of value
    speed_unit: str
    heat: float | None  # E, N.m or N: 0 of a cold joint, else that of the log's warmest moment; None where nothing warms

    def __repr__(self) -> str:
        state = "" if self.heat is None else ", warm" if self.heat else ", cold"
        way = "backwards" if self.speed < 0 else "forwards"
        return (f"friction {way} at {abs(self.speed):.3g} {self.speed_unit}{state} = {self.value:.5g} "
                f"({self.ci95[0]:.5g} .. {self.ci95[1]:.5g}) {self.unit}")


@dataclasses.dataclass(frozen=True)
class Prediction:
    """An estimate along a log of N samples."""

    time: Array  # [N] s
    torque: Array  # [N] predicted, N.m or N
    heat: Array  # [N] E, N.m or N
    compared: npt.NDArray[np.bool_]  # [N] samples that the metrics run over
    metrics: dict[str, float]  # rmse and mae in N.m or N, fit in %


@dataclasses.dataclass(frozen=True)
class Residuals:
    """What a fit leaves of the torque at the n samples that it takes."""

    time: Array  # [n] s
    torque: Array  # [n] torque less fit, N.m or N

    def __len__(self) -> int:
        return len(self.time)


def value_text(one: Parameter, digits: int) -> str:
    """The value, or the range of one at its bound."""
    ends = range_at_bound(one.value, one.ci95)
    return f"{ends[0]:.2g} to {ends[1]:.2g}" if ends else f"{one.value:.{digits}g}"


def interval_text(one: Parameter) -> str:
    return f"{one.ci95[0]:.5g} .. {one.ci95[1]:.5g}" if one.ci95 else ""
