#!/usr/bin/env python3
"""The public names: of the command line, JSON, Python, C++ headers and plugin attributes (tools/docs/stability.md).

    public_names.py --record PROGRAM VERSION [ROOT]     writes tests/names/VERSION.json of what is there
    public_names.py --check PROGRAM                     every recorded name is there, or warns that it is deprecated

ROOT is the sources, this project where it is not given. PROGRAM is a warmjoint, whose --help has the options.
"""

import ast
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def of_command_line(program):
    """identify, identify --map, identify -o, ..."""
    def shown(*words):
        return subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout

    names = set()
    for command in re.findall(r"^  ([a-z][a-z-]+)  ", shown(), re.M):
        names.add(command)
        for options in re.findall(r"^  (-[^\n ]+)", shown(command), re.M):
            names.update(f"{command} {option}" for option in options.split(","))
    return names


def of_json(root):
    """estimate.friction.law, scenario.motion.speeds, ...: the keys of the schemas of files."""
    names = set()

    def walk(schema, place):
        if isinstance(schema, list):
            for entry in schema:
                walk(entry, place)
        elif isinstance(schema, dict):
            for key, entry in schema.items():
                if key == "properties":
                    for name, inner in entry.items():
                        names.add(f"{place}.{name}")
                        walk(inner, f"{place}.{name}")
                else:
                    walk(entry, place)

    for path in (root / "tools/docs/schemas").glob("*.schema.json"):
        walk(json.loads(path.read_text()), path.name.split(".")[0])
    return names


def of_python(root):
    """identify, identify(method), Estimate.plot, Estimate.plot(figure), ...: of `__all__`, public members and arguments."""
    package, definitions, names = root / "tools/python/warmjoint", {}, set()
    for path in package.glob("*.py"):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                definitions.setdefault(node.name, []).append(node)

    def arguments(function, place):
        given = function.args
        for one in [*given.posonlyargs, *given.args, *given.kwonlyargs]:
            if one.arg != "self" and not one.arg.startswith("_"):
                names.add(f"{place}({one.arg})")

    exported = next(node.value for node in ast.parse((package / "__init__.py").read_text()).body
                    if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__")
    for name in ast.literal_eval(exported):
        names.add(name)
        for node in definitions.get(name, ()):
            if isinstance(node, ast.FunctionDef):
                arguments(node, name)
                continue
            for member in node.body:
                if isinstance(member, ast.FunctionDef) and (not member.name.startswith("_") or member.name == "__init__"):
                    place = name if member.name == "__init__" else f"{name}.{member.name}"
                    names.add(place)
                    arguments(member, place)
                elif isinstance(member, ast.AnnAssign) and not member.target.id.startswith("_"):
                    names.add(f"{name}.{member.target.id}")
    return names


def of_headers(root):
    """friction.h, friction.h Friction, ...: headers, and the types and functions that they declare."""
    names = set()
    for path in root.glob("*/include/warmjoint/*.h"):
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.S)
        names.add(path.name)
        names.update(f"{path.name} {name}" for name in re.findall(r"^(?:struct|class|enum class|enum) (\w+)[^;\n]*\{", text, re.M))
        names.update(f"{path.name} {name}" for name in re.findall(r"^(?:[\w:<>,&* ]+ )?[*&]?(\w+)\([^;{]*\);", text, re.M))
    return names


def of_plugin(root):
    """The rows of the table of attributes."""
    return set(re.findall(r"^\| `([\w.\[\]]+)` \|", (root / "sim/plugin/attributes.md").read_text(), re.M))


def names_of(program, root):
    return {"command line": of_command_line(program), "json": of_json(root), "python": of_python(root), "headers": of_headers(root),
            "plugin": of_plugin(root)}


def warns(program, kind, name):
    """Whether a name that is not listed any more is taken with a warning."""
    if kind != "command line":
        return False
    said = subprocess.run([program, *name.split(" ")], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL).stderr
    return "deprecated" in said


def main():
    what, program = sys.argv[1:3]
    if what == "--record":
        root = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else HERE.parent
        names = {kind: sorted(found) for kind, found in names_of(program, root).items()}
        assert all(names.values()), {kind: len(found) for kind, found in names.items()}
        (HERE / "names" / f"{sys.argv[3]}.json").write_text(json.dumps(names, indent=1) + "\n")
        return
    now, lacking, count = names_of(program, HERE.parent), [], 0
    for path in sorted((HERE / "names").glob("*.json")):
        for kind, names in json.loads(path.read_text()).items():
            count += len(names)
            lacking += [f"{path.stem}, {kind}: {name}" for name in names if name not in now[kind] and not warns(program, kind, name)]
    print("\n".join(lacking) or f"{count} recorded names are there")
    if lacking:
        sys.exit("These names are public (tools/docs/stability.md): let them work with a warning for two minor versions")


main()
