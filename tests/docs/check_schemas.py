"""The JSON Schemas, made of what the program reads (tools/docs/tables), hold for its files; the examples of pages run.

    check_schemas.py ROOT WARMJOINT

- Valid are: estimates of the identifiers, answered or refused, the friction files, scenarios and suites of the project, and every
  block of a page in JSON or YAML that is one. An answer of an identifier of others may leave out all but its status.
- Each change of a good file that its schema refuses is refused by the program, too. Each example of scenarios/keys/ runs.
- CITATION.cff has what its format asks for.

Exits 77, with the reason, where jsonschema is absent: tools/docs/setup fetches it.
"""

import copy
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT / "tools/docs"))

import pages  # noqa: E402

try:
    import jsonschema
    import referencing
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}; tools/docs/setup fetches it")
    sys.exit(77)

# 1e-4 is a number, which YAML 1.1 writes as 1.0e-4
yaml.SafeLoader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"^-?\d+(\.\d*)?[eE][-+]?\d+$"), list("-0123456789"))

IDENTIFIED = [
    "energy-ml --holdout 0.3", "energy-ml --gravity sincos", "energy-als --set iterations=5", "nominal-ls",
    "position-ridge --set kernels=10 --force", "energy-ml --set position=map --set kernels=10", "kalman", "stribeck", "rls",
]

FILES = ["models/robots/*/friction.json", "tests/fuzz/corpus/friction/*.json", "scenarios/*/*.yaml", "tests/studies/**/*.yaml",
         "tools/examples/*.yaml"]

# what reads a file, a good one, and changes of it that nobody may take: a path and its value, None for absent
WRONG = {
    "friction": ("attach rotary --joint hinge={file} -o {out}.xml", "tests/fuzz/corpus/friction/maps_inner.json", [
        ("law", "coulombs"), ("law", None), ("parameters.viscous", "much"), ("parameters.viscous", -1),
        ("parameters.viscosity", 1), ("thermal.thermal_gain", None), ("thermal.thermal_time_constant", 0),
        ("thermal.surroundings", 20), ("thermal.second", {"thermal_gain": 0}), ("load_gain", -1), ("gears", 1),
        ("maps.0.axes.0.quantity", "angle"), ("maps.0.axes.0.width", 0), ("maps.0.axes.0.centers", [0]),
        ("maps.0.factor", "speed"), ("maps.0.weights", None)]),
    "scenario": ("simulate {file} -o {out}", "scenarios/templates/scenario.yaml", [
        ("plant", "real"), ("friction", None), ("friction.parameters.viscous", "much"), ("friction.gear", {"uniform": [1]}),
        ("motion.speeds", "fast"), ("motion.speeds", [0]), ("motion.hold", 0), ("motion.holds", 1), ("motion.order", "any"),
        ("motion.travel", "limits"), ("motion.rests", {"run": 1}), ("noise.torque", -1), ("sampling.rate", 0),
        ("duration", None), ("seed", -1), ("disturbances", {"outlier": {}}), ("disturbances", {"gap": {"time": 1}}),
        ("disturbances", {"lost_samples": {"fraction": 1}}), ("disturbances", {"without_load": {"a": 1}})]),
    "suite": ("run {file} --jobs 2 --realizations 1 -o {out}", "scenarios/templates/suite.yaml", [
        ("question", None), ("realizations", 0), ("scenario.seed", 1), ("scenario.duration", 0), ("ladder.values", None),
        ("ladder.variants", {}), ("ladder.steps", 1), ("identifiers", None), ("compensators", [{"name": "none"}]), ("identifiers.0.name", None),
        ("identifiers.0.claim", {"rmse": 1}), ("identifiers.0.claim", {"source": "x", "rmse": -1}), ("identifiers.0.rank", 1)]),
}


def changed(good, path, value):
    """The file with one entry changed; None takes it out."""
    *steps, last = (int(step) if step.isdigit() else step for step in path.split("."))
    inner = result = copy.deepcopy(good)
    for step in steps:
        inner = inner[step]
    inner[last] = value
    if value is None:
        del inner[last]
    return result


def validators():
    schemas = {path.name: json.loads(path.read_text()) for path in (ROOT / "tools/docs/schemas").glob("*.json")}
    registry = referencing.Registry().with_resources(
        [(name, referencing.Resource.from_contents(schema)) for name, schema in schemas.items()])
    for name, schema in schemas.items():
        jsonschema.Draft202012Validator.check_schema(schema)
        yield name.split(".")[0], jsonschema.Draft202012Validator(schema, registry=registry)


def kind_of(value):
    """Which schema is for a block of a page, if any is."""
    keys = {"identifiers": "suite", "compensators": "suite", "motion": "scenario", "identifier": "estimate", "status": "answer",
            "law": "friction", "friction": "friction", "summary": "robot"}
    return next((kind for key, kind in keys.items() if key in value), "map" if isinstance(value, list) else None)


def main():
    schemas, problems, counts, numbers = dict(validators()), [], {}, itertools.count()
    schemas["answer"] = schemas["estimate"].evolve(schema={**schemas["estimate"].schema, "required": ["status"]})
    schemas["map"] = schemas["friction"].evolve(
        schema={"$ref": "friction.schema.json#/$defs/friction/properties/maps"})

    def check(kind, value, what):
        counts[kind] = counts.get(kind, 0) + 1
        problems.extend(f"{what}: {error.json_path}: {error.message[:300]}" for error in schemas[kind].iter_errors(value))

    with tempfile.TemporaryDirectory() as folder:
        def call(command, text=""):
            """The status, words and output of a command with a file of that text."""
            file, out = pathlib.Path(folder) / "given.yaml", pathlib.Path(folder) / f"out{next(numbers)}"
            file.write_text(text)
            words = command.format(file=file, out=out).split()
            done = subprocess.run([sys.argv[2], *words], capture_output=True, text=True, check=False)
            return done.returncode, done.stderr, out

        # what the schema refuses, the program refuses
        for kind, (command, path, changes) in WRONG.items():
            good = yaml.safe_load((ROOT / path).read_text())
            for path, value in [("", None), *changes]:
                given = changed(good, path, value) if path else good
                taken = schemas[kind].is_valid(given)
                status, words, _ = call(command, json.dumps(given))
                if taken != (not path) or status != (2 if path else 0):
                    problems.append(f"{kind}: {path} = {value}: taken by the schema: {taken}, by the program: {status} {words}")

        # what the program writes
        log = call("simulate {file} -o {out}", (ROOT / "scenarios/templates/scenario.yaml").read_text())[2]
        check("scenario", yaml.safe_load((log / "scenario.yaml").read_text()), "scenario of simulate")
        for options in IDENTIFIED:
            status, words, estimate = call(f"identify {log}/recording.csv --identifier {options} -o {{out}}")
            assert status in (0, 3), words
            check("estimate", json.loads(estimate.read_text()), f"identify {options}")
        status, words, robot = call(f"identify-robot rotary {log}/recording.csv --map position=position,torque=torque,time=time -o {{out}}")
        assert status in (0, 3), words
        check("robot", json.loads(robot.read_text()), "identify-robot")

        # blocks of pages; the examples of the page of keys run
        for page in pages.pages(ROOT):
            for block in pages.blocks((ROOT / page).read_text()):
                value = yaml.safe_load(block.text) if block.language in ("json", "yaml") else {}
                if not (kind := kind_of(value)):
                    continue
                check(kind, value, f"{page}:{block.line}")
                run = "run {file} --jobs 1 --allow-commands -o {out}" if kind == "suite" else "simulate {file} -o {out}"
                status, words, _ = call(run, block.text) if page.parent.name == "keys" else (0, "", "")
                if status not in (0, 5):
                    problems.append(f"{page}:{block.line}: {words}")

    # what the project holds
    for path in [path for pattern in FILES for path in ROOT.glob(pattern)]:
        value = yaml.safe_load(path.read_text())
        check(kind_of(value), value, path)
    citation = (ROOT / "CITATION.cff").read_text()
    problems += [f"CITATION.cff lacks {key}" for key in ("cff-version", "message", "title", "authors", "version")
                 if not re.search(rf"^{key}: *", citation, re.MULTILINE)]
    print("\n".join(problems) or ", ".join(f"{count} of {kind}" for kind, count in counts.items()) + ": all as the schemas say")
    sys.exit(1 if problems or set(counts) != set(schemas) else 0)


main()
