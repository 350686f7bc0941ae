"""Reading recordings and writing estimates, shared by the identifiers of this folder."""

import json

import numpy as np


def read(path):
    """Columns of a recording by name: time (s), position (rad), velocity (rad/s), torque (N.m); each [N]."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names}


def write(path, values, deviations=None, thermal=None, status="ok", message=""):
    """Writes the estimate.

    values: parameters by name, SI; deviations: their standard deviations by name; thermal: names
    of those among them that belong to the thermal state.
    """
    units = {
        "viscous": "N.m.s/rad",
        "thermal_gain": "N.m/W",
        "thermal_time_constant": "s",
    }
    thermal = thermal or []
    parameters = {}
    for name, value in values.items():
        std = (deviations or {}).get(name)
        interval = None if std is None else [value - 1.96 * std, value + 1.96 * std]
        unit = units.get(name, "N.m")
        parameters[name] = {"value": value, "unit": unit, "std": std, "interval95": interval}

    nominal = {name: value for name, value in values.items() if name not in thermal}
    friction = {"law": "viscous_coulomb", "parameters": nominal}
    if thermal:
        friction["thermal"] = {name: values[name] for name in thermal}
    answer = {"status": status, "message": message, "parameters": parameters, "friction": friction}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(answer, file)
