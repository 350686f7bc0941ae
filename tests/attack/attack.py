"""What the attacks share: a place to work in, runs of the program, and what every answer must be."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

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


# characters on which a terminal acts, and errors that are not the user's
UNPRINTABLE = "[\x00-\x08\x0b-\x1f\x7f\x80-\x9f\u202a-\u202e\u2066-\u2069]"
INSIDE = r"\b(Index|Value|Type|Key|Attribute|Overflow|Recursion|Runtime|Syntax|Unicode\w+|Assertion|ZeroDivision|FloatingPoint|NotImplemented)Error\b|json\.exception|Traceback|std::|\.warmjoint\.part"


def broken(path):
    """Why a file that the program wrote is none of its kind; nothing where it is."""
    data = path.read_bytes()
    try:
        if path.suffix in (".json", ".xml", ".elements", ".svg", ".html", ".py", ".csv", ".yaml"):
            text = data.decode()
            if found := re.search(UNPRINTABLE, text):
                return f"holds {found[0]!r}"
        if path.suffix == ".json":
            json.loads(text)
        elif path.suffix in (".xml", ".svg"):
            xml.etree.ElementTree.fromstring(text)
        elif path.suffix == ".elements":  # to be pasted into a document
            xml.etree.ElementTree.fromstring(f"<all>{text}</all>")
        elif path.suffix == ".html" and not text.rstrip().endswith("</html>"):
            return "has no end"
        elif path.suffix == ".png" and not (data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB`\x82")):
            return "is no picture"
    except ValueError as error:
        return str(error)
    except xml.etree.ElementTree.ParseError as error:
        return str(error)
    return None


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
        """Runs once. Whatever the status: what is printed is printable, files that were there are as they were, and what is new is whole and
        has a name of its own. A refusal is one line that names the place and no error of the inside, and leaves nothing."""
        self.count += 1
        before = self.state()
        try:
            answer = self.run(arguments, timeout)
        except subprocess.TimeoutExpired:
            return self.fault(name, f"no end within {timeout} s")
        error = answer.stderr.decode("utf-8", "replace")
        if answer.returncode not in statuses:
            self.fault(name, f"status {answer.returncode}, not one of {statuses}: {error[:300]!r}")
        for stream in (answer.stdout, answer.stderr):
            text = stream.decode("utf-8", "replace")
            if found := re.search(UNPRINTABLE, text):
                self.fault(name, f"prints {found[0]!r}: {text[max(0, found.start() - 100) : found.end() + 100]!r}")
        self.expect_files(name, before)
        if answer.returncode in (2, 4):
            self.expect_refusal(name, error, place, set(self.state()) - set(before))
        self.clear(before)
        return answer

    def expect_refusal(self, name, error, place, left):
        lines = [line for line in error.splitlines() if not line.startswith(("notice: ", "sandbox: ", "warning: "))]
        if len(lines) != 1 or not lines[0].startswith("error: ") or not error.endswith("\n"):
            self.fault(name, f"not one line: {error[:300]!r}")
        elif len(lines[0]) > 5000 or re.search(INSIDE, lines[0]):
            self.fault(name, f"too long, or of the inside: {lines[0][:300]!r}")
        elif place and place not in lines[0]:
            self.fault(name, f"does not name {place!r}: {lines[0][:300]!r}")
        if left:
            self.fault(name, f"left {left}")

    def expect_files(self, name, before):
        """Files of before are as they were, new ones are whole."""
        now = self.state()
        for file, what in before.items():
            if now.get(file) != what:
                self.fault(name, f"changed or removed {file}")
        for file in set(now) - set(before):
            path = self.work / file
            if path.name.startswith(".warmjoint.part"):
                self.fault(name, f"left {file}")
            if path.is_file() and (why := broken(path)):
                self.fault(name, f"{file} is not whole: {why}")

    def state(self):
        """All files below the folder: what they hold, or that they are none."""
        found = {}
        for path in self.work.rglob("*"):
            if path.is_file() and not path.is_symlink():
                found[str(path.relative_to(self.work))] = hashlib.sha256(path.read_bytes()).hexdigest() if path.stat().st_size < 1 << 24 else path.stat().st_mtime
            elif not path.is_dir():
                found[str(path.relative_to(self.work))] = "no file"
        return found

    def remove(self, *names):
        for name in names:
            (self.work / name).unlink()

    def clear(self, before):
        for path in self.work.iterdir():
            if any(name.split("/")[0] == path.name for name in before):
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


def children(attack):
    """Processes that have the attack's folder for temporary files among their variables: the program and all that it started."""
    found = []
    for folder in pathlib.Path("/proc").iterdir():
        if not folder.name.isdigit() or int(folder.name) == os.getpid():
            continue
        try:
            if str(attack.temporary).encode() in (folder / "environ").read_bytes():
                found.append(int(folder.name))
        except OSError:
            pass
    return found
