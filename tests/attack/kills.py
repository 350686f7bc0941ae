#!/usr/bin/env python3
"""Kills, signals and full disks: whatever ends a run, the same command goes on, and every file of the run directory but its
database becomes what an undisturbed run makes. kills.py WARMJOINT [KILLS SIGNALS DISKS OUTPUTS]      default: 100 30 10 60

The suite has an identifier from outside, none of whose processes and directories may outlive the run. The undisturbed run is
Of commands with several outputs, killed anywhere, each output is whole or absent, and no child lives on. The undisturbed run is
made on 1, 2 and 8 threads, in three shards that are merged, and in a run that is killed ten times. Full disks are small file
systems in memory, which only root can make; without root they are limits on the size of files."""

import filecmp
import os
import random
import shutil
import signal
import subprocess
import sys
import time

from attack import Attack, children, processes, suite
from robots import LOG, URDF

MARK = f"8{os.getpid()}"
IDENTIFIER = f"""#!/bin/sh
sh -c 'sleep {MARK}' &
sleep 0.02
echo '{{"status": "ok", "parameters": {{"viscous": {{"value": 5, "unit": "N.m.s/rad"}}}}}}' > estimate.json
"""


def files_of(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*")
                  if path.is_file() and not path.name.startswith(("results.sqlite", ".lock")))


def differences(attack, folder, other):
    """Names of the files in which two run directories differ."""
    a, b = attack.work / folder, attack.work / other
    names = files_of(a)
    if names != files_of(b):
        return sorted(set(names) ^ set(files_of(b)))
    return [name for name in names if not filecmp.cmp(a / name, b / name, shallow=False)]


def command(folder, jobs):
    return ["run", "t.yaml", "-o", folder, "--jobs", str(jobs), "--allow-commands", "--keep-recordings"]


def nothing_left(attack, name):
    for _ in range(100):
        if not processes(MARK) and not os.listdir(attack.temporary):
            return
        time.sleep(0.05)
    attack.fault(name, f"left processes {processes(MARK)}, directories {os.listdir(attack.temporary)}")


def make(attack):
    (attack.work / "id.sh").write_text(IDENTIFIER)
    os.chmod(attack.work / "id.sh", 0o755)
    line = f"{attack.work}/id.sh {{recording}} {{estimate}}"
    attack.file("t.yaml", suite(f"[{{name: nominal-ls}}, {{name: energy-ml}}, {{name: external, label: o, options: {{command: '{line}'}}}}]", 24))
    for jobs in (1, 2, 8):
        answer = attack.run(command(f"WHOLE{jobs}", jobs), 300)
        if answer.returncode != 0:
            sys.exit(f"the undisturbed run failed: {answer.stderr.decode()}")
        attack.count += 1
        if jobs > 1 and (found := differences(attack, "WHOLE1", f"WHOLE{jobs}")):
            attack.fault(f"{jobs} threads", f"other bytes in {found}")
    for i in (1, 2, 3):
        attack.run([*command(f"S{i}", 2), "--shard", f"{i}/3"], 300)
    attack.run(["merge", "S3", "S1", "S2", "-o", "MERGED"], 300)
    attack.count += 1
    # recordings stay with their shards
    found = [name for name in differences(attack, "WHOLE1", "MERGED") if not name.startswith("recordings/")]
    if found:
        attack.fault("merged shards", f"other bytes in {found}")


def stopped(attack, how, after, jobs):
    """Starts or goes on with R and stops it; False where it ended by itself before."""
    run = subprocess.Popen([attack.program, *command("R", jobs)], cwd=attack.work, env=attack.environment,
                           stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(after)
    run.send_signal(how)
    return run.wait(60) != 0


def finished(attack, name, jobs):
    answer = attack.run(command("R", jobs), 300)
    if answer.returncode != 0:
        return attack.fault(name, f"does not go on: {answer.returncode} {answer.stderr[:300]!r}")
    if found := differences(attack, "WHOLE1", "R"):
        attack.fault(name, f"other bytes in {found}")
    return None


def kills(attack, count, signals, name, draws):
    done = 0
    while done < count:
        shutil.rmtree(attack.work / "R", ignore_errors=True)
        jobs = draws.choice((1, 2))
        for _ in range(draws.choice((1, 1, 2, 4))):
            if done < count and stopped(attack, draws.choice(signals), draws.uniform(0.01, 0.7), jobs):
                done += 1
                attack.count += 1
                nothing_left(attack, f"{name} {done}")
        finished(attack, f"{name} {done}", jobs)
    print(f"{name}: {done}", flush=True)


def ten_kills(attack, draws):
    """One run that is killed ten times; with shorter lives where it ends before."""
    for longest in (0.6, 0.4, 0.2, 0.1):
        shutil.rmtree(attack.work / "R", ignore_errors=True)
        done = 0
        while done < 10 and stopped(attack, signal.SIGKILL, draws.uniform(0.3, 1) * longest, 2):
            done += 1
            nothing_left(attack, f"kill {done} of ten")
        if done == 10:
            attack.count += 1
            finished(attack, "ten kills", 2)
            return print("ten kills of one run, each after", longest, "s at most", flush=True)
    return attack.fault("ten kills", "the run ends before")


def full_disks(attack, count, draws):
    needed = sum(path.stat().st_size for path in (attack.work / "WHOLE1").rglob("*") if path.is_file())
    place = attack.work / "R"
    for i in range(count):
        shutil.rmtree(place, ignore_errors=True)
        attack.count += 1
        size = draws.randrange(4096, needed)
        if os.getuid() == 0:
            place.mkdir()
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", place], check=True)
            try:
                answer = attack.run(command("R", 2), 300)
                subprocess.run(["mount", "-o", "remount,size=100m", place], check=True)
                if answer.returncode == 4:
                    finished(attack, f"full disk {i}", 2)
            finally:
                subprocess.run(["umount", place], check=True)
        else:
            limited = ["bash", "-c", f"ulimit -f {max(1, size // 8192)}; exec \"$@\"", "bash", attack.program, *command("R", 2)]
            answer = subprocess.run(limited, cwd=attack.work, env=attack.environment, capture_output=True, timeout=300)
            if answer.returncode == 4:
                finished(attack, f"full disk {i}", 2)
        lines = [line for line in answer.stderr.decode().splitlines() if line.startswith("error")]
        if answer.returncode != 4 or len(lines) != 1 or "could not be written" not in lines[0]:
            attack.fault(f"full disk {i} of {size} of {needed} bytes", f"status {answer.returncode}: {answer.stderr[:300]!r}")
        nothing_left(attack, f"full disk {i}")
    print(f"full disks: {count}", flush=True)


def outputs(attack, count, draws):
    """Kills identify-robot with all of its outputs, and report, which have a Python draw."""
    attack.file("r.urdf", URDF)
    attack.file("log.csv", LOG)
    attack.run(["identify-robot", "r.urdf", "log.csv", "-o", "good.json"])
    commands = [["identify-robot", "r.urdf", "log.csv", "-o", "o.json", "--mjcf", "m.xml", "--plot", "pictures"], ["report", "good.json", "-o", "page.html"]]
    seconds = []
    for one in commands:
        begin = time.monotonic()
        attack.run(one, 300)
        seconds.append(time.monotonic() - begin)
    attack.clear([name for name in attack.state() if name in ("r.urdf", "log.csv", "good.json")])
    before = attack.state()
    for i in range(count):
        which = draws.randrange(len(commands))
        run = subprocess.Popen([attack.program, *commands[which]], cwd=attack.work, env=attack.environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        # most at the end, where outputs are made
        time.sleep(seconds[which] * draws.choice((draws.uniform(0, 1), draws.uniform(0.8, 1.02))))
        run.send_signal(signal.SIGKILL)
        run.wait(60)
        attack.count += 1
        for _ in range(40):
            if not (alive := children(attack)):
                break
            time.sleep(0.05)
        if alive:
            attack.fault(f"kill {i} of {commands[which][0]}", f"processes live on: {alive}")
        attack.expect_files(f"kill {i} of {commands[which][0]}", before)
        attack.clear(before)
    print(f"outputs: {count}", flush=True)


def main():
    counts = [int(argument) for argument in sys.argv[2:]] or [100, 30, 10, 60]
    draws = random.Random(16)
    with Attack(sys.argv[1], sum(counts)) as attack:
        if len(counts) > 3:
            outputs(attack, counts[3], draws)
            attack.clear([])
        if not any(counts[:3]):
            return
        make(attack)
        ten_kills(attack, draws)
        kills(attack, counts[0], [signal.SIGKILL], "kill -9", draws)
        kills(attack, counts[1], [signal.SIGTERM, signal.SIGINT], "SIGTERM and SIGINT", draws)
        full_disks(attack, counts[2], draws)


if __name__ == "__main__":
    main()
