"""One file, two ways: `identify FILE`, and `convert FILE` with `identify` of what it writes, give the same estimate or the same refusal.

usage: two_ways_test.py WARMJOINT SHARED

Over every table of text that table.json names or made.py writes (decimal marks, dates, units, namesakes among them), with the options of their rows. Of the
estimates only `recording`, which names the files and their options, may differ; of refusals only the place.
"""

import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import inputs_test

LAYOUT = {"--map", "--unit", "--scale", "--columns", "--rate", "--wrap", "--joint", "--gear", "--torque-constant"}
NO_TABLE = (".h5", ".mat", ".xml", ".urdf", ".json", ".jsonl", ".yaml", ".gz", ".bz2", ".zip", ".xls", ".xlsx", ".mcap", ".db3", ".bag", ".parquet", ".pkl", ".feather", ".nc")
NOMINAL = ["--identifier", "nominal-ls"]


def logs(places):
    """(file, layout options) of each table of text, once."""
    table = json.loads((inputs_test.HERE / "table.json").read_text())
    found = {}
    for rows in table.values():
        for row in rows:
            for one in row.get("each", [""]):
                words = shlex.split(row["run"].replace("{each}", one).replace("{identifier}", "nominal-ls"))
                if words[0] not in ("identify", "check"):
                    continue
                file = words[1].format(**places)
                options = [word for k, word in enumerate(words) if word in LAYOUT or (words[k - 1] in LAYOUT and k > 1)]
                if pathlib.Path(file).is_file() and not file.lower().endswith(NO_TABLE):
                    found[(file, *options)] = None
    for path in sorted((places["made"] / "tables").iterdir()):
        found[(str(path),)] = None
    return list(found)


def refusal_of(done):
    """The last line on standard error without its place, or the status where there is none."""
    lines = done.stderr.strip().splitlines()
    return re.sub(r"^error: [^ ]*: ", "", lines[-1]) if lines else f"status {done.returncode}"


def answer(program, words, folder):
    """The estimate without what names its files, or the refusal without its place."""
    estimate = folder / "estimate.json"
    estimate.unlink(missing_ok=True)
    done = subprocess.run([program, *words, *NOMINAL, "-o", estimate], capture_output=True, text=True, timeout=100)
    if not estimate.exists():
        return refusal_of(done)
    found = json.loads(estimate.read_text())
    found.pop("recording", None)
    return json.dumps(found).replace(words[1], "LOG").replace(pathlib.Path(words[1]).name, "LOG")


def main():
    program = sys.argv[1]
    shared = pathlib.Path(os.environ.get("WARMJOINT_SHARED") or sys.argv[2])
    try:
        import made
    except ImportError as error:
        print(f"not made: {error}")
        return inputs_test.SKIPPED
    failed, refused = [], 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        made.write(folder)
        places = {"inputs": shared / "findings/inputs", "shared": shared, "made": folder, "containers": folder / "containers", "out": folder}
        all_logs = logs(places)
        for file, *options in all_logs:
            first = answer(program, ["identify", file, *options], folder)
            log = folder / "log.h5"
            log.unlink(missing_ok=True)
            done = subprocess.run([program, "convert", file, *options, "-o", log], capture_output=True, text=True, timeout=100)
            second = (answer(program, ["identify", str(log)], folder) if done.returncode == 0
                      else refusal_of(done))
            refused += done.returncode == 2
            if first != second:
                at = next((k for k, (a, b) in enumerate(zip(first, second)) if a != b), 0)
                failed.append(f"{' '.join([file, *options])}\n  at once:    ...{first[max(0, at - 60):at + 200]}\n  by convert: ...{second[max(0, at - 60):at + 200]}")
            if first.startswith("status"):
                failed.append(f"{' '.join([file, *options])}: {first}")
    print("\n".join(failed))
    print(f"{len(all_logs)} logs, {refused} refused, {len(failed)} with two answers")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
