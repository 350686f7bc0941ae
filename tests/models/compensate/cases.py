"""cases.py OUT: the recordings of tests/golden of laws that slide steadily, as arrays in C for compensate_test.c."""

import json
import pathlib
import sys

GOLDEN = pathlib.Path(__file__).resolve().parents[2] / "golden"
NAMES = ("coulomb", "viscous_coulomb", "asymmetric", "stiction", "stribeck", "asymmetric_stribeck", "everything")
COLUMNS = ("velocity", "position", "load", "ambient_rise", "force", "energy")
CASE = """typedef struct {
  const char* name;
  void (*numbers)(wj_friction*);
  int count;
  wj_real step, initial_energy;
  const wj_real *velocity, *position, *load, *ambient_rise, *force, *energy;
} Case;
"""

def array(name, values):
    return f"static const wj_real {name}[] = {{{', '.join(f'(wj_real){value!r}' for value in values)}}};\n"


def law_numbers(parameters):
    """Members of wj_friction: a law is its levels to both sides, their rise at rest and its slope."""
    p = dict(parameters)
    coulomb = p.pop("coulomb", None)
    numbers = {"coulomb_positive": coulomb, "coulomb_negative": coulomb} if coulomb is not None else {}
    static = p.pop("static", None)
    # a joint that broke away slides at its Coulomb level
    if static is not None and "stribeck_velocity" in p:
        numbers["static_rise"] = static - coulomb
    return {**numbers, **p}


def numbers_of(friction):
    numbers = law_numbers(friction["parameters"])
    thermal = friction["thermal"]
    for prefix, stage in (("", thermal), ("second_", thermal.get("second", {}))):
        for key in ("thermal_gain", "thermal_time_constant"):
            if key in stage:
                numbers[prefix + key] = stage[key]
    for key in ("level_per_temperature", "viscous_per_energy", "load_gain"):
        numbers[key] = friction.get(key, 0)
    return numbers


def maps_text(name, maps):
    """Arrays of a recording's maps, each over one position axis."""
    text = ""
    for i, one in enumerate(maps):
        (axis,) = one["axes"]
        assert axis["quantity"] == "position" and one["kernels"] == "normalised"
        text += array(f"{name}_centres{i}", axis["centres"]) + array(f"{name}_weights{i}", one["weights"])
    rows = [f"{{1, {{{{WJ_POSITION, WJ_TOGETHER, {len(one['axes'][0]['centres'])}, {name}_centres{i}, (wj_real){one['axes'][0]['width']!r}, 0}}}}, "
            f"WJ_NORMALISED, WJ_BY_ONE, {name}_weights{i}}}" for i, one in enumerate(maps)]
    return text + (f"static const wj_map {name}_maps[] = {{{', '.join(rows)}}};\n" if rows else "")


def case_text(name):
    golden = json.loads((GOLDEN / f"{name}.json").read_text())
    friction, text, n = golden["friction"], "", len(golden["velocity"])
    for column in COLUMNS:
        text += array(f"{name}_{column}", golden.get(column, [0] * n))
    maps = friction.get("maps", [])
    text += maps_text(name, maps)
    body = "".join(f"  friction->{key} = (wj_real){value!r};\n" for key, value in numbers_of(friction).items())
    if maps:
        body += f"  friction->map_count = {len(maps)};\n  friction->maps = {name}_maps;\n"
    return text + f"static void {name}_numbers(wj_friction* friction) {{\n{body}}}\n", n, golden


def main(out):
    texts, rows = [], []
    for name in NAMES:
        text, n, golden = case_text(name)
        texts.append(text)
        columns = ", ".join(f"{name}_{column}" for column in COLUMNS)
        rows.append(f'  {{"{name}", {name}_numbers, {n}, (wj_real){golden["step"]!r}, (wj_real){golden.get("initial_energy", 0)!r}, {columns}}},\n')
    pathlib.Path(out).write_text(CASE + "".join(texts) + "static const Case cases[] = {\n" + "".join(rows) + "};\n")


main(sys.argv[1])
