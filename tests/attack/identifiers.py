#!/usr/bin/env python3
"""Some 60 commands that misbehave as identifiers: they crash, hang, fork, link, flood and cheat. identifiers.py WARMJOINT

Each runs in a suite of its own beside an honest identifier. The run must end in time with status 0, the honest answers must
be those of a run without the other, the other's rows must say what it did, and neither a process nor a directory may be left."""

import csv
import json
import os
import shlex
import sys
import time

from attack import Attack, processes, suite

MARK = f"7{os.getpid()}"  # seconds that nobody else sleeps for
GOOD = '{"status": "ok", "parameters": {"viscous": {"value": 5, "unit": "N.m.s/rad"}}}'

# what the row's status has to be, one of several where time decides; {E}: the estimate
CASES = {
    "crash": ("kill -SEGV $$", "crashed"), "abort": ("kill -ABRT $$", "crashed"), "kill": ("kill -9 $$", "crashed"),
    "exit 1": ("exit 1", "crashed"), "exit 255": ("exit 255", "crashed"), "exit 2": ("echo no >&2; exit 2", "crashed"),
    "nothing": ("true", "bad_answer"), "absent": ("/no/such/program", "crashed"), "not executable": ("/etc/passwd", "crashed"),
    "hang": (f"sleep {MARK}", "timeout"), "spin": ("while :; do :; done", "timeout"), "stop": ("kill -STOP $$", "timeout"),
    "deaf": (f"trap '' TERM INT HUP QUIT; while :; do sleep {MARK}; done", "timeout"),
    "input": (f"read x; sleep {MARK}", "timeout"), "no directory": ("rm -rf $PWD", "crashed bad_answer"), "no recording": ("rm -f recording.csv", "bad_answer"),
    "orphan": (f"(setsid sleep {MARK} &) ; exit 3", "crashed"), "orphans": (f"for i in 1 2 3 4 5 6 7 8; do (setsid setsid sleep {MARK} &) ; done; exit 3", "crashed"),
    "orphan of an answer": (f"(setsid sleep {MARK} >/dev/null 2>&1 &) ; echo '{GOOD}' > {{E}}", "ok"),
    "orphan with output": (f"(setsid sleep {MARK} &) ; echo '{GOOD}' > {{E}}", "ok"),
    "nohup": (f"nohup sleep {MARK} > /dev/null & exit 3", "crashed"), "fork bomb": ("b() { b | b & }; b; sleep 9", "crashed"),
    "many children": (f"i=0; while [ $i -lt 200 ]; do sleep {MARK} & i=$((i+1)); done; wait", "crashed"),
    "grandchildren": (f"sh -c 'sh -c \"sh -c \\\"sleep {MARK}\\\" & wait\" & wait' & wait", "timeout"),
    "fifo": ("mkfifo {E}", "bad_answer"), "fifo for output": ("rm -f output.txt; mkfifo output.txt", "bad_answer"),
    "folder": ("mkdir {E}", "bad_answer"), "link to zero": ("ln -s /dev/zero {E}", "bad_answer"), "link to null": ("ln -s /dev/null {E}", "bad_answer"),
    "link to tty": ("ln -s /dev/tty {E}", "bad_answer"), "link to itself": ("ln -s {E} {E}", "bad_answer"), "dangling link": ("ln -s nope {E}", "bad_answer"),
    "link to a file": ("ln -s /etc/passwd {E}", "bad_answer"), "link to memory": ("ln -s /proc/self/mem {E}", "bad_answer"),
    "socket": ("/usr/bin/python3 -c \"import socket; socket.socket(socket.AF_UNIX).bind('estimate.json')\"", "bad_answer"),
    "hard link": ("ln recording.csv {E}", "bad_answer"), "unreadable": ("echo '{{}}' > {E}; chmod 0 {E}", "bad_answer"),
    "empty": (": > {E}", "bad_answer"), "text": ("echo hello > {E}", "bad_answer"), "list": ("echo '[]' > {E}", "bad_answer"),
    "no parameters": ("echo '{\"status\": \"ok\"}' > {E}", "bad_answer"), "overflow": ("echo '{\"status\": \"ok\", \"parameters\": {\"viscous\": {\"value\": 1e999, \"unit\": \"1\"}}}' > {E}", "bad_answer"),
    "not a number": ("echo '{\"status\": \"ok\", \"parameters\": {\"viscous\": {\"value\": NaN, \"unit\": \"1\"}}}' > {E}", "bad_answer"),
    "wrong type": ("echo '{\"status\": \"ok\", \"parameters\": {\"viscous\": 5}}' > {E}", "bad_answer"),
    "unknown status": ("echo '{\"status\": \"great\", \"parameters\": {}}' > {E}", "bad_answer"),
    "deep": ("/usr/bin/python3 -c \"print('{\\\"status\\\":\\\"ok\\\",\\\"parameters\\\":{\\\"viscous\\\":' + '[' * 300000)\" > {E}", "bad_answer"),
    "deep and whole": ("/usr/bin/python3 -c \"print('{\\\"a\\\":' + '[' * 300000 + ']' * 300000 + '}')\" > {E}", "bad_answer"),
    "latin": ("printf '{\"status\": \"\\344\"}' > {E}", "bad_answer"), "zeros": ("head -c 100000 /dev/zero > {E}", "bad_answer"),
    "large": ("head -c 100000000 /dev/zero | tr '\\0' ' ' > {E}", "bad_answer"), "too large": ("head -c 400000000 /dev/zero > {E}", "crashed"),
    "long line": ("head -c 300000000 /dev/zero | tr '\\0' x; exit 4", "crashed timeout"), "long line on stderr": ("head -c 300000000 /dev/zero | tr '\\0' x >&2; exit 4", "crashed timeout"),
    "lines": ("yes | head -c 100000000; exit 4", "crashed"), "escapes": ("printf '\\033[31m\\n\\033]0;x\\007'; exit 4", "crashed"),
    "formula": ("echo '=cmd|/c calc!A0'; exit 4", "crashed"), "script": ("echo '<script>alert(1)</script>'; exit 4", "crashed"),
    "memory": ("/usr/bin/python3 -c \"x = bytearray(6 << 30)\"", "crashed"), "files": ("/usr/bin/python3 -c \"f = [open('/dev/null') for _ in range(5000)]\"", "crashed"),
    "many files": ("i=0; while [ $i -lt 3000 ]; do : > f$i; i=$((i+1)); done; exit 4", "crashed timeout"),
    "read only": ("mkdir d; : > d/f; chmod 0 d; exit 4", "crashed"), "signal the program": ("kill -9 $PPID; kill -TERM -1; sleep 9; exit 4", "timeout"),
    "cheat by the suite": ("cat $OLDPWD/t.yaml @WORK/t.yaml > {E}", "crashed"), "cheat by the run": ("cat @WORK/R/suite.yaml > {E}", "crashed"),
    "cheat by the store": ("cp @WORK/R/results.sqlite {E}", "crashed"), "cheat by processes": ("cat /proc/[0-9]*/cmdline > {E}", "crashed"),
    "spoil the others": ("for f in @TMP/warmjoint_*/recording.csv; do : > $f; done; exit 4", "crashed"),
    "spoil the store": (": > @WORK/R/results.sqlite; exit 4", "crashed"), "spoil the suite": ("rm -rf @WORK/R; exit 4", "crashed"),
}


def rows(attack):
    with open(attack.work / "R" / "results.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def honest_only(attack):
    attack.file("t.yaml", suite("[{name: nominal-ls}]", 2))
    attack.run(["run", "t.yaml", "-o", "R", "--jobs", "1"])
    answers = [{key: row[key] for key in ("realization", "viscous", "rmse")} for row in rows(attack)]
    attack.clear([])
    return answers


def judge(attack, name, line, wanted, honest):
    attack.count += 1
    line = line.replace("{E}", "estimate.json").replace("@WORK", str(attack.work)).replace("@TMP", str(attack.temporary))
    command = json.dumps("/bin/sh -c " + shlex.quote(f"{line} # {{recording}} {{estimate}}"))
    external = f"{{name: external, label: other, options: {{command: {command}, time_limit: 2}}}}"
    attack.file("t.yaml", suite(f"[{{name: nominal-ls}}, {external}]", 2))
    before = time.monotonic()
    try:
        answer = attack.run(["run", "t.yaml", "-o", "R", "--jobs", "2", "--allow-commands"], 90)
    except Exception as error:
        return attack.fault(name, str(error))
    if answer.returncode not in (0, 5):
        return attack.fault(name, f"status {answer.returncode}: {answer.stderr[:300]!r}")
    seconds = time.monotonic() - before
    if seconds > 60:
        attack.fault(name, f"took {seconds:.0f} s")
    found = rows(attack)
    statuses = {row["status"] for row in found if row["identifier"] == "other"}
    if not statuses or not statuses <= set(wanted.split()):
        attack.fault(name, f"status {statuses}, not {wanted}: {[row['message'][:100] for row in found]}")
    mine = [{key: row[key] for key in ("realization", "viscous", "rmse")} for row in found if row["identifier"] == "nominal-ls"]
    if mine != honest:
        attack.fault(name, "the honest identifier's answers changed")
    if os.path.getsize(attack.work / "R" / "results.csv") > 100_000:
        attack.fault(name, "results.csv grew")
    alive = processes(MARK)
    if alive:
        attack.fault(name, f"processes live on: {alive}")
    left = os.listdir(attack.temporary)
    if left:
        attack.fault(name, f"left {left}")
    attack.clear([])
    return None


def main():
    with Attack(sys.argv[1], 60) as attack:
        honest = honest_only(attack)
        for name, (line, wanted) in CASES.items():
            judge(attack, name, line, wanted, honest)


if __name__ == "__main__":
    main()
