"""Real logs of shared/data through `identify`: status, Fit, and whether the halves of each log agree. Printed, not tested.

usage: real_logs.py WARMJOINT SHARED [IDENTIFIER]...        default: auto nominal-ls

A half is every sample before or after the middle of the log. For each parameter of law and heat that has a 95 % interval in both halves, z is
the difference over the root of the sum of squares of both standard errors (half an interval over 1.96). The same for the friction
at the speeds below which 10, 50 and 90 % of the moving samples lie, forwards and backwards: between those of `friction_at_speeds`, or, of
a program that tells none, by the parameters' covariance as wide as their intervals. Beside it stands least squares by NumPy: viscous and asymmetric Coulomb friction, gravity and inertia, the first 70 % predicting the last 30 %.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from shared_logs import logs

FRICTION = ("viscous", "coulomb", "coulomb_positive", "coulomb_negative", "thermal_gain", "thermal_time_constant")


def least_squares(path, columns, to_radians):
    """Fit in per cent of least squares on the last 30 % of the moving samples."""
    table = np.genfromtxt(path, delimiter=",", names=True, usecols=[one for one in columns if one])
    t, q, tau = table[columns[0]], table[columns[1]] * to_radians, table[columns[3]]
    v = table[columns[2]] if columns[2] else np.gradient(q, t)
    half = max(1, round(0.02 / np.median(np.diff(t))))  # samples of a 40 ms mean, as a low-pass
    smooth = lambda x: np.convolve(x, np.ones(2 * half + 1) / (2 * half + 1), "same")
    v, tau = smooth(v), smooth(tau)
    rows = np.column_stack([v, v > 0, -(v < 0).astype(float), np.sin(q), np.cos(q), np.gradient(v, t)])
    moving = np.abs(v) > 0.02 * np.abs(v).max()
    rows, tau = rows[moving], tau[moving]
    n = round(0.7 * len(tau))
    x = np.linalg.lstsq(rows[:n], tau[:n], rcond=None)[0]
    rest = tau[n:]
    return 100 * (1 - np.linalg.norm(rest - rows[n:] @ x) / np.linalg.norm(rest - rest.mean()))


def speeds_of(path, columns, to_radians):
    """Three speeds of the moving samples, rad/s or m/s."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    v = np.abs(np.gradient(table[columns[1]], table[columns[0]])) * to_radians
    return np.quantile(v[v > 0.05 * np.sqrt(np.mean(v**2))], (0.1, 0.5, 0.9))


def friction_at(estimate, speeds):
    """{(speed, state): (value, half width)} of an answer, between the speeds that it tells, with directions as signs."""
    found = {}
    if estimate["status"] != "ok":
        return found
    rows = estimate.get("friction_at_speeds")
    if rows is None:
        return by_covariance(estimate, speeds)
    for sign in (1, -1):
        for state in ("cold", "warm"):
            known = sorted((abs(r["speed"]), r["value"], (r["interval95"][1] - r["interval95"][0]) / 2) for r in rows
                           if np.sign(r["speed"]) == sign and (state == "warm") == bool(r.get("energy")))
            for speed in speeds if known else ():
                v, value, half = np.transpose(known)
                # an answer tells nothing of speeds beyond its own
                if not v[0] / 1.22 <= speed <= v[-1] * 1.22:
                    continue
                found[sign * speed, state] = (np.interp(speed, v, value), np.interp(speed, v, half))
    return found


def by_covariance(estimate, speeds):
    """The same, cold, of a law of levels and a slope."""
    found, parameters, known = {}, estimate["parameters"], estimate.get("covariance")
    if not known:
        return found
    for sign in (1, -1):
        level = "coulomb" if "coulomb" in parameters else "coulomb_positive" if sign > 0 else "coulomb_negative"
        of_law = [n for n in ("viscous", level) if n in parameters]
        if not of_law or not all(n in known["parameters"] and parameters[n].get("interval95") for n in of_law):
            continue
        at = [known["parameters"].index(n) for n in of_law]
        matrix = np.array(known["matrix"])[np.ix_(at, at)]
        scale = np.array([np.diff(parameters[n]["interval95"])[0] / 2 for n in of_law]) / np.sqrt(np.diag(matrix))
        for speed in speeds:
            d = np.array([speed if n == "viscous" else 1 for n in of_law])
            value = d @ [parameters[n]["value"] for n in of_law]
            found[sign * speed, "cold"] = (value, np.sqrt(d @ (matrix * np.outer(scale, scale)) @ d))
    return found


def identify(program, path, arguments, identifier, folder):
    """The content of estimate.json, or the refusal to read."""
    out = pathlib.Path(folder, "estimate.json")
    out.unlink(missing_ok=True)
    done = subprocess.run([program, "identify", path, *arguments.split(), "--identifier", identifier, "-o", out],
                          capture_output=True, text=True)
    return json.loads(out.read_text()) if out.exists() else {"status": "bad input", "message": done.stderr}


def halves(path, folder):
    """Two files: the first and the second half of a log."""
    header, *rows = pathlib.Path(path).read_text().splitlines()
    for i, part in enumerate((rows[:len(rows) // 2], rows[len(rows) // 2:])):
        half = pathlib.Path(folder, f"half{i}.csv")
        half.write_text("\n".join([header, *part]) + "\n")
        yield half


def distances(one, other):
    """{parameter: z} of those of the friction that have an interval in both."""
    known = lambda estimate: {n: p for n, p in (estimate.get("parameters") or {}).items()
                              if n in FRICTION and p.get("interval95")}
    a, b = known(one), known(other)
    error = lambda p: (p["interval95"][1] - p["interval95"][0]) / 3.92
    return {n: (a[n]["value"] - b[n]["value"]) / np.hypot(error(a[n]), error(b[n])) for n in a.keys() & b.keys()}


def main():
    program, shared = sys.argv[1], pathlib.Path(sys.argv[2])
    everything, friction_z, half_widths = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for identifier in sys.argv[3:] or ["auto", "nominal-ls"]:
            for name, log in logs(shared).items():
                path, columns, unit = log.path(shared, folder), log.columns, log.radians
                whole = identify(program, path, log.arguments, identifier, folder)
                parts = [identify(program, half, log.arguments, identifier, folder) for half in halves(path, folder)]
                z = distances(*parts) if all(part["status"] == "ok" for part in parts) else {}
                everything += z.values()
                speeds = speeds_of(path, columns, unit)
                at = friction_at(whole, speeds)
                half_widths += [half / abs(value) for value, half in at.values()]
                one, other = (friction_at(part, speeds) for part in parts)
                off = {key: (one[key][0] - other[key][0]) / np.hypot(one[key][1] / 1.96, other[key][1] / 1.96)
                       for key in one.keys() & other.keys()}
                friction_z += off.values()
                fit = (whole.get("metrics") or {}).get("fit")
                print(f"{name:8} {identifier:12} {whole['status']:16} Fit {fit if fit is None else round(fit, 1)} %, "
                      f"least squares held out {least_squares(path, columns, unit):.1f} %; halves {parts[0]['status']}, {parts[1]['status']}:",
                      ", ".join(f"{n} z {value:.1f}" for n, value in z.items()))
                print("    friction at", ", ".join(
                    f"{speed:.3g} {state} {value:.4g} +- {100 * half / abs(value):.1f} %" +
                    (f" (halves z {off[speed, state]:.1f})" if (speed, state) in off else "")
                    for (speed, state), (value, half) in at.items()))
                print("   ", whole["message"].replace("\n", "\n    "))
    size = np.abs(everything)
    if len(size):
        print(f"{len(size)} pairs: |z| <= 2 in {100 * np.mean(size <= 2):.0f} %, worst {size.max():.1f}")
    if half_widths:
        print(f"friction at speeds: {len(half_widths)} with a median half width of {100 * np.median(half_widths):.1f} %")
    if friction_z:
        z = np.abs(friction_z)
        print(f"halves: {len(z)} pairs with a median |z| of {np.median(z):.2f}; |z| <= 2 in {100 * np.mean(z <= 2):.0f} %, "
              f"worst {z.max():.1f}")


if __name__ == "__main__":
    main()
