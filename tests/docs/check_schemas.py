"""The JSON Schemas of estimate.json and of friction files say what the program writes and reads.

    check_schemas.py ROOT WARMJOINT

- Every estimate that the identifiers write, answered or refused, is valid; so is every friction file of the project.
- Each change of a good friction file that the schema refuses is refused by the program, too, and each key that the schema
  names is one that the program takes.
- Every ```json block of every page is valid: an estimate, a friction, maps of one, or the answer of an identifier of others, which may
  leave out all but its status. CITATION.cff has what its format asks for.

Exits 77, with the reason, where jsonschema is absent: tools/docs/setup fetches it.
"""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages  # noqa: E402


try:
    import jsonschema
    import referencing
except ImportError as missing:
    print(f"skipped: {missing}; tools/docs/setup fetches it")
    sys.exit(77)

SCENARIO = """
friction:
  law: viscous_coulomb
  parameters: {viscous: 5, coulomb: 15}
  thermal: {thermal_gain: -3, thermal_time_constant: 600}
  gear: 100
motion: {speeds: {uniform: [0.1, 1]}, hold: 20}
noise: {torque: 0.5}
sampling: {rate: 1}
duration: 3600
seed: 3
"""

# what each estimate is to be, beside its identifier
ESTIMATES = [
    (["--identifier", "energy-ml"], "ok"),
    (["--identifier", "energy-ml", "--gravity", "sincos"], "ok"),
    (["--identifier", "energy-als", "--set", "iterations=5"], "not_converged"),
    (["--identifier", "nominal-ls"], "inadequate_model"),
    (["--identifier", "position-ridge", "--set", "kernels=10", "--force"], None),
    (["--identifier", "energy-ml", "--set", "position=map", "--set", "kernels=10"], None),
    (["--identifier", "kalman"], None),
    (["--identifier", "stribeck"], None),
    (["--identifier", "rls"], None),
]

FRICTION = {
    "law": "asymmetric",
    "parameters": {"viscous": 0.8, "coulomb_positive": 4.5, "coulomb_negative": 5.0},
    "thermal": {"thermal_gain": -0.4, "thermal_time_constant": 180, "ambient": 20,
                "second": {"thermal_gain": -0.1, "thermal_time_constant": 30}},
    "gear": 100,
    "level_per_temperature": -0.02,
    "viscous_per_energy": 0.05,
    "load_gain": 0.05,
    "maps": [{"axes": [{"quantity": "motor_position", "centres": [0, 2, 4], "width": 1, "period": 6.283185307179586,
                        "sides": "together"}],
              "weights": [0.1, 0, -0.1], "kernels": "normalised", "factor": "direction"}],
}

# changes of FRICTION, as (path, value), that no reader may take
WRONG = [
    (["law"], "coulombs"),
    (["law"], None),
    (["parameters", "viscous"], "much"),
    (["parameters", "viscous"], -1),
    (["parameters", "viscosity"], 1),
    (["thermal", "thermal_gain"], None),
    (["thermal", "thermal_time_constant"], 0),
    (["thermal", "surroundings"], 20),
    (["thermal", "second", "ambient"], 20),
    (["load_gain"], -1),
    (["gears"], 1),
    (["maps", 0, "axes", 0, "quantity"], "angle"),
    (["maps", 0, "axes", 0, "width"], 0),
    (["maps", 0, "axes", 0, "centers"], [0]),
    (["maps", 0, "axes"], []),
    (["maps", 0, "factor"], "speed"),
    (["maps", 0, "weights"], None),
]


def validators(root):
    schemas = {path.name: json.loads(path.read_text()) for path in (root / "tools/docs/schemas").glob("*.json")}
    for schema in schemas.values():
        jsonschema.Draft202012Validator.check_schema(schema)
    registry = referencing.Registry().with_resources(
        [(name, referencing.Resource.from_contents(schema)) for name, schema in schemas.items()])
    return (jsonschema.Draft202012Validator(schemas[name], registry=registry)
            for name in ("estimate.schema.json", "friction.schema.json"))


def changed(path, value):
    """FRICTION with one entry changed; None takes it out."""
    result = copy.deepcopy(FRICTION)
    inner = result
    for step in path[:-1]:
        inner = inner[step]
    if value is None:
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    return result


class Program:
    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)

    def __call__(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              check=False)

    def reads(self, friction):
        """Whether `attach` takes it as a friction file."""
        (self.folder / "friction.json").write_text(json.dumps(friction))
        done = self("attach", "rotary", "--joint", "hinge=friction.json", "-o", "model.xml")
        assert done.returncode in (0, 2), done.stderr
        return done.returncode == 0, done.stderr


def estimates(program):
    (program.folder / "scenario.yaml").write_text(SCENARIO)
    done = program("simulate", "scenario.yaml", "-o", "log")
    assert done.returncode == 0, done.stderr
    for options, status in ESTIMATES:
        done = program("identify", "log/recording.csv", *options, "-o", "estimate.json")
        assert done.returncode in (0, 3), done.stderr
        estimate = json.loads((program.folder / "estimate.json").read_text())
        assert status in (None, estimate["status"]), (options, estimate["status"], estimate["message"])
        yield " ".join(options), estimate


def main():
    root, program = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    estimate_schema, friction_schema = validators(root)
    problems, counts = [], {"estimates": 0, "friction files": 0, "refusals": 0, "blocks": 0}

    def check(schema, value, what, kind):
        counts[kind] += 1
        for error in schema.iter_errors(value):
            problems.append(f"{what}: {error.json_path}: {error.message[:300]}")

    with tempfile.TemporaryDirectory() as folder:
        call = Program(program, folder)
        for options, estimate in estimates(call):
            check(estimate_schema, estimate, f"identify {options}", "estimates")
        for path in [*root.glob("models/robots/*/friction.json"), *root.glob("tests/fuzz/corpus/friction/*.json")]:
            check(friction_schema, json.loads(path.read_text()), path, "friction files")

        # what the schema refuses, the program refuses, and the other way round
        taken, words = call.reads(FRICTION)
        check(friction_schema, FRICTION, "FRICTION", "friction files")
        if not taken:
            problems.append(f"the program refuses FRICTION: {words}")
        for path, value in WRONG:
            counts["refusals"] += 1
            wrong = changed(path, value)
            if friction_schema.is_valid(wrong):
                problems.append(f"{path} = {value}: the schema takes it")
            if call.reads(wrong)[0]:
                problems.append(f"{path} = {value}: the program takes it")

    answer_schema = estimate_schema.evolve(schema={**estimate_schema.schema, "required": ["status"]})
    map_schema = friction_schema.evolve(schema={"$ref": "friction.schema.json#/$defs/map"})
    for page in pages.pages(root):
        for block in pages.blocks((root / page).read_text()):
            if block.language == "json":
                value = json.loads(block.text)
                schema = (map_schema if isinstance(value, list) else friction_schema if "status" not in value
                          else estimate_schema if "identifier" in value else answer_schema)
                for one in value if isinstance(value, list) else [value]:
                    check(schema, one, f"{page}:{block.line}", "blocks")
    citation = (root / "CITATION.cff").read_text()
    problems += [f"CITATION.cff lacks {key}" for key in ("cff-version", "message", "title", "authors", "version")
                 if not re.search(rf"^{key}: *", citation, re.M)]

    print("\n".join(problems) or ", ".join(f"{count} {kind}" for kind, count in counts.items()) + ": all as the schemas say")
    sys.exit(1 if problems or not all(counts.values()) else 0)


main()
