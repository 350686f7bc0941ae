"""What the library keeps of an answer, how the halves of its log agree, and the card of a machine."""

import math

# of an answer; what is left out is of its log, or says again what these say
KEPT = ("identifier", "options", "status", "message", "warnings", "parameters", "metrics", "holdout", "friction", "gravity", "friction_at_speeds",
        "covariance", "half_widths", "assumptions", "state_end")
SUMMARY = ("torque_unit", "travel", "top_speed", "minutes", "gain", "gain_is_known", "rms_held_out", "rms_moving", "rms_without_friction")
DIGITS = 6  # why: figures are known to two or three


def rounded(value):
    """Numbers with DIGITS significant digits, everywhere in a tree."""
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) and math.isfinite(value) else value


def over_place(friction_map):
    return any(axis["quantity"] in ("position", "motor_angle") for axis in friction_map["axes"])


def kept(estimate):
    found = {key: estimate[key] for key in KEPT if key in estimate}
    # a torque over the position is of the log's other joints and of what the arm carried, as much as of this joint
    if found.get("friction"):
        friction = dict(found["friction"])
        friction["maps"] = [one for one in friction.get("maps", []) if not over_place(one)]
        if not friction["maps"]:
            del friction["maps"]
        found["friction"] = friction
    # a friction in the drive's own unit is a figure, and no friction that anything takes
    if (found.get("friction") or {}).get("torque_unit") not in (None, "", "A"):
        found["friction"] = None
    return rounded(found)


def summary(estimate, given):
    """A joint's entry of `summary` in robot.json; of one that was fitted by itself only the unit is known."""
    if given:
        return rounded({key: given[key] for key in SUMMARY if key in given})
    return {"torque_unit": unit(estimate), "travel": 0, "top_speed": 0, "minutes": 0}


def unit(estimate):
    """Of the friction: N.m, N, A or another of the log."""
    given = (estimate.get("friction") or {}).get("torque_unit")
    if given:
        return given
    rows = [one for key, one in estimate.get("parameters", {}).items() if key.startswith("coulomb")]
    return rows[0]["unit"] if rows else "N.m"


def figures(estimate):
    """[{speed, value, interval95}] of an answer that is ok: cold where it warms, in the unit of the log."""
    rows = estimate.get("friction_at_speeds") or [] if estimate.get("status") == "ok" else []
    return [row for row in rows if row.get("interval95") and not row.get("energy")]


def at(rows, speed):
    """(value, half width) at a speed, on straight lines between those that are known in its direction; None beyond them."""
    known = sorted((abs(row["speed"]), row["value"], (row["interval95"][1] - row["interval95"][0]) / 2) for row in rows if row["speed"] * speed > 0)
    for low, high in zip(known, known[1:], strict=False):
        if low[0] <= abs(speed) <= high[0]:
            share = (abs(speed) - low[0]) / (high[0] - low[0]) if high[0] > low[0] else 0
            return tuple(a + share * (b - a) for a, b in zip(low[1:], high[1:], strict=True))
    # one speed alone, or a speed at the end of what is known: within a tenth it is the same
    near = [one for one in known if abs(one[0] - abs(speed)) <= 0.1 * abs(speed)]
    return near[0][1:] if near else None


def halves(whole, first, second):
    """[{speed, z}] at the speeds of the whole log's answer that both halves tell: z is the difference over its standard deviation, of 95 % intervals."""
    found = []
    for row in figures(whole):
        one, other = at(figures(first), row["speed"]), at(figures(second), row["speed"])
        if one and other:
            spread = math.hypot(one[1], other[1]) / 1.96
            if spread > 0:
                found.append({"speed": row["speed"], "z": abs(one[0] - other[0]) / spread})
    return [{"speed": float(f"{one['speed']:.4g}"), "z": float(f"{one['z']:.2g}")} for one in found]


def fall(estimate):
    """Share of the friction that goes when the joint is as warm as its fastest known speed makes it; None where no warming is known."""
    rows = estimate.get("friction_at_speeds") or []
    cold = [row for row in rows if row["speed"] > 0 and not row.get("energy")]
    warm = [row for row in rows if row["speed"] > 0 and row.get("energy")]
    if estimate.get("status") != "ok" or not cold or not warm:
        return None
    pairs = [(a["value"], b["value"]) for a in cold for b in warm if math.isclose(a["speed"], b["speed"], rel_tol=1e-3)]
    return float(f"{max((1 - b / a for a, b in pairs), key=abs):.3g}") if pairs else None


def in_torque(rows, estimate, given):
    """The figures in N.m or N, where a current's gain is known so well that the friction is."""
    friction = estimate.get("friction") or {}
    if friction.get("torque_unit") or not given or not given.get("gain_is_known") or given.get("torque_unit") != "A":
        return rows
    gain = abs(given["gain"])
    return [{**row, "unit": "N.m", "value": row["value"] / gain, "interval95": [one / gain for one in row["interval95"]]} for row in rows]


def joint_card(joint, run, estimate, given, agree, recipe):
    rows = in_torque(figures(estimate), estimate, given)
    own = recipe.get("joint", {}).get(joint, {})
    return {"name": joint, "status": estimate["status"], "unit": rows[0]["unit"] if rows else unit(estimate),
            "speed_unit": rows[0]["speed_unit"] if rows else "rad/s",
            "friction": rounded([{key: row[key] for key in ("speed", "value", "interval95")} for row in rows]),
            "fall": fall(estimate), "halves": agree, "command": f"warmjoint {run['command']} -o {joint}.json",
            "message": "" if estimate["status"] == "ok" else estimate["message"].split("\n")[0], "remedy": own.get("remedy", ""),
            "rated": own.get("rated")}


def card(name, recipe, rows, sha256, version):
    """What card.json holds: the recipe's words, and of each joint what was found."""
    joints = [joint_card(*row, recipe) for row in rows]
    return {"machine": recipe["machine"], "kind": recipe["kind"], "origin": "measured", "menagerie": recipe.get("menagerie", ""),
            "source": recipe["source"], "tables": recipe.get("table", []), "log": recipe["log"], "remake": f"tools/library/make {name}", "made_by": version,
            "robot.json": {"sha256": sha256}, "joints": joints, "not_for": recipe["not_for"]}
