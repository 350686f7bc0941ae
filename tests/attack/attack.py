"""What the attacks share: a place to work in, runs of the program, and what every answer must be."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

RECORDING = "time,position,velocity,torque\n" + "".join(
    f"{i},{(i // 20 % 2 * 2 - 1) * 0.1 * i:.3f},{-1 if i // 20 % 2 else 1},{15 - 30 * (i // 20 % 2) + 0.01 * (i * 7 % 11)}\n"
    for i in range(120))

FRICTION = ('{law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}, '
            'thermal: {thermal_gain: -0.4, thermal_time_constant: 900}}')

SCENARIO = f"friction: {FRICTION}\nmotion: {{speeds: [0.5, 1], hold: 5}}\nnoise: {{torque: 0.2}}\nduration: 120\n"


def suite(identifiers="[{name: nominal-ls}, {name: energy-ml}]", realizations=3, more=""):
    inner = SCENARIO.replace("\n", "\n  ").rstrip()
    return (f"name: attacked\nquestion: Which?\nrealizations: {realizations}\nscenario:\n  {inner}\n"
            f"identifiers: {identifiers}\n{more}")


class Attack:
    """Counts attacks and what went wrong. Used as a context: leaves with status 1 where anything did."""

    def __init__(self, program, least):
        self.program, self.least = str(pathlib.Path(program).resolve()), least
        self.count, self.faults = 0, []

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="attack_"))
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.work = self.folder / "work"
        self.work.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.temporary)}
        return self

    def __exit__(self, kind, *_):
        shutil.rmtree(self.folder, ignore_errors=True)
        if kind:
            return
        print(f"{self.count} attacks, {len(self.faults)} faults")
        for fault in self.faults[:40]:
            print(" ", fault)
        if self.faults or self.count < self.least:
            sys.exit(1)

    def fault(self, name, what):
        self.faults.append(f"{name}: {what}"[:600])

    def file(self, name, content):
        path = self.work / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogateescape"))
        return name

    def run(self, arguments, timeout=60, **more):
        return subprocess.run([self.program, *arguments], cwd=self.work, env=self.environment, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=timeout, **more)

    def expect(self, name, arguments, statuses=(2,), place="", timeout=60):
        """Runs once. A refusal is one printable line that names the place, and nothing that was not there is left."""
        self.count += 1
        before = sorted(path.name for path in self.work.iterdir())
        try:
            answer = self.run(arguments, timeout)
        except subprocess.TimeoutExpired:
            return self.fault(name, f"no end within {timeout} s")
        error = answer.stderr.decode("utf-8", "replace")
        if answer.returncode not in statuses:
            return self.fault(name, f"status {answer.returncode}, not one of {statuses}: {error[:300]!r}")
        if answer.returncode != 2:
            return self.clear(before)
        lines = [line for line in error.splitlines() if not line.startswith(("notice: ", "sandbox: ", "warning: "))]
        if len(lines) != 1 or not lines[0].startswith("error: ") or not error.endswith("\n"):
            self.fault(name, f"not one line: {error[:300]!r}")
        elif len(lines[0]) > 5000 or re.search(r"[\x00-\x08\x0b-\x1f\x7f\x80-\x9f\u202a-\u202e\u2066-\u2069]", lines[0]):
            self.fault(name, f"not printable or too long: {lines[0][:300]!r}")
        elif place and place not in lines[0]:
            self.fault(name, f"does not name {place!r}: {lines[0][:300]!r}")
        left = sorted(path.name for path in self.work.iterdir())
        if left != before:
            self.fault(name, f"left {set(left) ^ set(before)}")
        self.clear(before)
        return None

    def clear(self, before):
        for path in self.work.iterdir():
            if path.name in before:
                continue
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink()


def processes(mark):
    """Processes that have `mark` among their arguments."""
    found = []
    for folder in pathlib.Path("/proc").iterdir():
        if not folder.name.isdigit() or int(folder.name) == os.getpid():
            continue
        try:
            if mark.encode() in (folder / "cmdline").read_bytes():
                found.append(int(folder.name))
        except OSError:
            pass
    return found
