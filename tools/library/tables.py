"""The files of a recipe: taken from clones at their commits, pasted to tables where the program does not read them as they are, and cut in halves."""

import io
import pathlib
import shlex
import subprocess
from xml.etree import ElementTree

import numpy as np


def place(sources, source):
    """The folder of a clone of github.com/OWNER/NAME, or of plain files where the source has no commits; None where it is not there."""
    base = pathlib.Path(sources, source["repository"].removeprefix("github.com/").replace("/", "+"))
    if not source["commit"]:
        return base if base.is_dir() else None
    for folder in (base, base / "repo", base / "repo/.git"):
        if subprocess.run(["git", "-C", folder, "rev-parse", "--git-dir"], capture_output=True, check=False).returncode == 0:
            return folder
    return None


def content(sources, source, path):
    """The bytes of a file at the commit that the recipe names; of a source without commits those of a folder."""
    folder = place(sources, source)
    if not source["commit"]:
        return (folder / path).read_bytes()
    return subprocess.run(["git", "-C", folder, "show", f"{source['commit']}:{path}"], capture_output=True, check=True).stdout


def absent(recipe, sources):
    """What of a recipe's sources is not there, as words; "" where all are."""
    for source in recipe["source"]:
        folder = place(sources, source)
        if folder is None:
            return source["repository"]
        for path in source["files"].values() if source["commit"] else ():
            done = subprocess.run(["git", "-C", folder, "cat-file", "-e", f"{source['commit']}:{path}"], capture_output=True, check=False)
            if done.returncode:
                return f"{source['repository']} @ {source['commit']}: {path}"
    return ""


def gather(recipe, sources, folder, program):
    """All files of a recipe in `folder`: those of its sources under their short names, and the tables that are made of them."""
    for source in recipe["source"]:
        for name, path in source["files"].items():
            (folder / name).write_bytes(content(sources, source, path))
            if name in source.get("strip", []):
                strip(folder / name)
    for one in recipe.get("convert", []):
        subprocess.run([program, "convert", one["log"], "-o", one["name"]], cwd=folder, check=True, capture_output=True)
    for table in recipe.get("table", []):
        paste(table, folder)


def strip(file):
    """An MJCF without its shapes, whose meshes are not fetched; bodies, joints and inertials stay."""
    tree = ElementTree.parse(file)
    for parent in list(tree.iter()):
        for child in [one for one in parent if one.tag in ("geom", "asset", "site", "actuator", "keyframe", "contact", "sensor", "tendon", "equality")]:
            parent.remove(child)
    tree.write(file)


def paste(table, folder):
    """A table of the columns of several files, side by side. Each part: file, and names of its columns; one of values_per_row has one number a line."""
    columns, names = [], []
    for part in table["parts"]:
        values = numbers(part, folder)
        columns.append(values)
        names += part["names"]
    rows = min(len(one) for one in columns)
    whole = np.column_stack([one[:rows] for one in columns])
    np.savetxt(folder / table["name"], whole, delimiter=",", comments="", header=",".join(names), fmt="%.9g")


def numbers(part, folder):
    """[rows, columns] of one part of a table."""
    file = folder / part["file"]
    if file.suffix == ".mat":
        return variables(part, file)
    text = file.read_text(encoding="utf-8", errors="replace")
    values = np.loadtxt(io.StringIO(text), delimiter=part.get("delimiter"), skiprows=part.get("skip", 0), ndmin=2)
    if "values_per_row" in part:
        values = values.reshape(-1, part["values_per_row"])
    return values[:, part.get("from", 0):part.get("from", 0) + len(part["names"])]


def variables(part, file):
    """Variables of a MATLAB file, each a vector or a matrix with one column of the table in each row or column."""
    from scipy.io import loadmat

    read = loadmat(file, struct_as_record=False, squeeze_me=True)
    columns = []
    for path in part["variables"]:
        value = read
        for key in path.split("."):
            value = value[key] if isinstance(value, dict) else getattr(value, key)
        value = np.atleast_2d(np.asarray(value, float))
        columns.append(value.T if value.shape[0] < value.shape[1] else value)
    return np.column_stack(columns)[:, :len(part["names"])]


def half_of(run, folder, part):
    """The run on the first or the second half of the rows of each of its logs."""
    command = shlex.split(run["command"])
    for log in run["logs"]:
        cut = f"{part}_{log}"
        halve(pathlib.Path(folder, log), pathlib.Path(folder, cut), part)
        command = [cut if word == log else word for word in command]
    return {**run, "command": shlex.join(command)}


def halve(log, out, part):
    """One half of a table of text; its header is kept."""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines(keepends=True)
    head = 0 if lines and is_row(lines[0]) else 1
    middle = head + (len(lines) - head) // 2
    kept = lines[head:middle] if part == "first" else lines[middle:]
    out.write_text("".join(lines[:head] + kept), encoding="utf-8")


def is_row(line):
    """Whether a line of a table holds numbers."""
    first = line.replace(";", ",").replace("\t", ",").replace(" ", ",").split(",")[0]
    try:
        float(first)
    except ValueError:
        return False
    return True
