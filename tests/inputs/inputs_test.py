"""Small inputs in the shapes that people have, through the program: what each must give stands in table.json.

usage: inputs_test.py WARMJOINT SHARED [KIND...]

SHARED (or the variable WARMJOINT_SHARED) holds findings/inputs; what the table makes itself (made.py) needs NumPy, and h5py and SciPy for
{containers}. A row whose folder is not there is skipped. A row has
  run       arguments of the program; {inputs} the folder of inputs, {shared} SHARED, {made} and {containers} those of made.py, {out} one
            of the row's own; with {identifier} the row stands once for each identifier that the program lists, with {each} once for each text of `each`
  then      arguments of a second run, which must end with 0; what it says counts, too
  exit      its status (default 0), or a list of those that may be
  says      regular expressions that its output must match, on what is named: a column, a factor, an option
  silent    regular expressions that it must not match
  status    of {out}/estimate.json, where `run` writes it
  holds     {parameter: truth}: its interval holds the truth
  near      {parameter: [truth, tolerance]}: its value
  narrower  {parameter: width}: its interval is no wider, in the parameter's unit
  has       members of the estimate that are not null
  at_speeds [[speed, truth]]: the interval of the row nearest to the speed, below 0 backwards, holds the truth
  lines     {file: lines that it has}
"""

import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SKIPPED = 77  # ctest's status for a test that was not made
HERE = pathlib.Path(__file__).resolve().parent
NEVER = re.compile(r"internal error|\b-?nan\b|\b-?inf\b", re.IGNORECASE)  # in what the program says


def faults(row, program, places):
    """What a row must give and does not: a list of sentences."""
    with tempfile.TemporaryDirectory() as folder:
        places = {**places, "out": folder}
        arguments = [word.format(**places) for word in shlex.split(row["run"])]
        done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=100)
        said = done.stdout + done.stderr
        found = []
        if "then" in row:
            again = [word.format(**places) for word in shlex.split(row["then"])]
            then = subprocess.run([program, *again], capture_output=True, text=True, timeout=100)
            said += then.stdout + then.stderr
            found += [f"then status {then.returncode}"] * (then.returncode != 0)
        for name, lines in row.get("lines", {}).items():
            path = pathlib.Path(name.format(**places))
            has = len(path.read_text().splitlines()) if path.exists() else 0
            found += [f"{name} has {has} lines, not {lines}"] * (has != lines)
        may_be = row.get("exit", 0)
        if done.returncode not in (may_be if isinstance(may_be, list) else [may_be]):
            found.append(f"status {done.returncode}, not {may_be}")
        found += [f"does not say {words!r}" for words in row.get("says", []) if not re.search(words, said)]
        found += [f"says {words!r}" for words in row.get("silent", []) if re.search(words, said)]
        if NEVER.search(said):
            found.append(f"says {NEVER.search(said).group()!r}")
        estimate = pathlib.Path(folder, "estimate.json")
        if estimate.exists():
            found += faults_of_estimate(row, json.loads(estimate.read_text()))
        elif {"status", "holds", "near", "narrower"} & row.keys():
            found.append("wrote no estimate.json")
        return [*found, f"it said:\n{said}"] if found else []


def faults_of_estimate(row, estimate):
    """The same of an estimate file's content."""
    found, parameters = [], estimate["parameters"]
    if "status" in row and estimate["status"] != row["status"]:
        found.append(f"status {estimate['status']}, not {row['status']}: {estimate['message']}")
    if estimate["status"] == "ok" and not estimate.get("friction"):
        found.append("is ok and holds no friction")
    found += [f"{name} is null" for name in row.get("has", []) if not estimate.get(name)]
    for speed, truth in row.get("at_speeds", []):
        rows = estimate.get("friction_at_speeds") or [{"speed": 1e9, "interval95": [0, 0]}]
        at = min(rows, key=lambda one: abs(one["speed"] - speed))
        if not at["interval95"][0] <= truth <= at["interval95"][1]:
            found.append(f"friction at {at['speed']} {at['interval95']} does not hold {truth}")
    for name in {*row.get("holds", {}), *row.get("near", {}), *row.get("narrower", {})} - parameters.keys():
        return [*found, f"has no parameter {name}"]
    for name, truth in row.get("holds", {}).items():
        interval = parameters[name].get("interval95")
        if not interval or not interval[0] <= truth <= interval[1]:
            found.append(f"{name} {interval} does not hold {truth}")
    for name, (truth, tolerance) in row.get("near", {}).items():
        if not abs(parameters[name]["value"] - truth) <= tolerance:
            found.append(f"{name} {parameters[name]['value']} is not {truth} +- {tolerance}")
    for name, width in row.get("narrower", {}).items():
        interval = parameters[name].get("interval95")
        if not interval or not interval[1] - interval[0] <= width:
            found.append(f"{name} {interval} is wider than {width}")
    return found


def each(rows, program):
    """The rows, one with {identifier} or {each} in it once for each."""
    listed = subprocess.run([program, "list", "identifiers", "--format", "json"], capture_output=True, check=True)
    names = [one["name"] for one in json.loads(listed.stdout)]
    for row in rows:
        for one in row.get("each", [""]):
            run = row["run"].replace("{each}", one)
            for name in names if "{identifier}" in run else [""]:
                yield {**row, "run": run.replace("{identifier}", name)}


def main():
    program, kinds = sys.argv[1], sys.argv[3:]
    shared = pathlib.Path(os.environ.get("WARMJOINT_SHARED") or sys.argv[2])
    inputs = shared / "findings/inputs"
    try:
        import made
    except ImportError as error:
        print(f"not made: {error}")
        return SKIPPED
    table = json.loads((HERE / "table.json").read_text())
    failed, done, skipped = 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        made.write(pathlib.Path(folder))
        places = {"inputs": inputs, "shared": shared, "made": pathlib.Path(folder), "containers": pathlib.Path(folder, "containers")}
        for kind, rows in table.items():
            for row in each(rows, program) if not kinds or kind in kinds else []:
                if not all(place.is_dir() for name, place in places.items() if f"{{{name}}}" in row["run"]):
                    skipped += 1
                    continue
                done += 1
                found = faults(row, program, places)
                failed += bool(found)
                if found:
                    print(f"{kind}: warmjoint {row['run']}\n  " + "\n  ".join(found))
    print(f"{done} rows, {failed} failed, {skipped} without {inputs} (WARMJOINT_SHARED), or h5py and SciPy (tools/convert --setup)" if skipped
          else f"{done} rows, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
