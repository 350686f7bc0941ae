"""The page of keys tells what the program reads: the same keys, examples that run, the same defaults.

    check_keys.py PAGE WARMJOINT

The program says which keys a map may have where it is given a word instead; so nothing here repeats the list.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages  # noqa: E402


IDEAL = """
friction:
  law: viscous_coulomb
  parameters: {viscous: 5, coulomb: 15}
  thermal: {thermal_gain: -1, thermal_time_constant: 600}
  level_per_temperature: -0.05
motion: {speeds: [0.1, 1], hold: 20}
duration: 30
"""
ENGINE = IDEAL + "plant: mujoco\nrobot: rotary\njoint: hinge\n"

SUITE = {
    "question": "one?",
    "scenario": "{friction: {law: coulomb, parameters: {coulomb: 2}}, motion: {speeds: [0.1, 1], hold: 5}, duration: 60}",
    "identifiers": "[{name: nominal-ls}]",
}
# what stands beside a key that cannot stand alone: its map as a whole, the example in place of %s
BESIDE = {
    "motion.travel": "motion={speeds: [0.1, 1], travel: %s}",
    "motion.phases": "motion={phases: %s}",
    "motion.corners": "motion={corners: %s}",
    "motion.start": "motion={corners: [[0, 0], [1, 0.5]], start: %s}",
    "motion.fourier": "motion={fourier: %s}",
    "motion.moves": "motion={moves: %s}",
    "motion.fourier.period": "motion={fourier: {period: %s, harmonics: 2, speed: 1}}",
    "motion.fourier.harmonics": "motion={fourier: {period: 5, harmonics: %s, speed: 1}}",
    "motion.fourier.speed": "motion={fourier: {period: 5, harmonics: 2, speed: %s}}",
    "motion.moves.between": "motion={moves: {between: %s, speed: 1, acceleration: 5}}",
    "motion.moves.speed": "motion={moves: {between: [-1, 1], speed: %s, acceleration: 5}}",
    "motion.moves.acceleration": "motion={moves: {between: [-1, 1], speed: 1, acceleration: %s}}",
    "motion.moves.pause": "motion={moves: {between: [-1, 1], speed: 1, acceleration: 5, pause: %s}}",
    "motion.rests.run": "motion.rests={run: %s, rest: 1}",
    "motion.rests.rest": "motion.rests={run: 1, rest: %s}",
    "motion.phases.rest": "motion={phases: [{rest: %s}, {duration: 9, speeds: [1], hold: 2}]}",
    "motion.phases.duration": "motion={phases: [{duration: %s, speeds: [1], hold: 2}]}",
    "motion.phases.speeds": "motion={phases: [{duration: 9, speeds: %s, hold: 2}]}",
    "motion.phases.hold": "motion={phases: [{duration: 9, speeds: [1], hold: %s}]}",
    "motion.phases.order": "motion={phases: [{duration: 9, speeds: [1], hold: 2, order: %s}]}",
    "motion.phases.rests": "motion={phases: [{duration: 9, speeds: [1], hold: 2, rests: %s}]}",
    "suite.ladder.variable": "{variable: %s, values: [1, 2]}",
    "suite.ladder.unit": "{variable: noise.torque, values: [1, 2], unit: %s}",
    "suite.ladder.values": "{variable: noise.torque, values: %s}",
    "suite.ladder.variants": "{variants: %s}",
}


def tables(text):
    """{section: [(key, default, example), ...]}; sections in lower case, '' for a whole."""
    found, section = {}, None
    for line in pages.prose(text):
        heading = re.match(r"^##+ (.+)$", line)
        if heading:
            section = heading.group(1).lower().replace("scenario: the whole", "").replace(": the whole", "")
        row = re.match(r"^\| `([^`]+)` \| (.+?) \| `([^`]*)` \| ", line)
        if row:
            found.setdefault(section, []).append(row.groups())
    return found


class Program:
    def __init__(self, program, folder):
        self.program, self.folder, self.count = program, pathlib.Path(folder), 0

    def __call__(self, text, *arguments):
        """Writes the text as a file and gives it to the program; the exit status and all its words."""
        self.count += 1
        (self.folder / "given.yaml").write_text(text)
        done = subprocess.run([self.program, arguments[0], "given.yaml", *arguments[1:], "-o", f"out{self.count}"],
                              cwd=self.folder, capture_output=True, text=True, check=False)
        return done.returncode, done.stderr

    def scenario(self, *settings):
        """0 where the ideal plant or the engine takes the settings."""
        for base in (IDEAL, ENGINE):
            status, words = self(base, "simulate", *(f"--set={one}" for one in settings))
            if status == 0:
                return 0, ""
        return status, words

    def suite(self, **entries):
        text = "".join(f"{key}: {value}\n" for key, value in {**SUITE, **entries}.items())
        return self(text, "run", "--jobs", "1", "--allow-commands")

    def keys(self, section):
        """The keys that the program knows of a map, from its refusal of a word."""
        if section == "":
            words = self("word", "simulate")[1]
        elif section == "suite":
            words = self("word", "run")[1]
        elif section == "suite.ladder":
            words = self.suite(ladder="word")[1]
        elif section == "suite.identifiers":
            words = self.suite(identifiers="[word]")[1]
        elif section == "suite.claim":
            words = self.suite(identifiers="[{name: nominal-ls, claim: word}]")[1]
        elif section == "motion.phases":
            words = self(IDEAL, "simulate", "--set=motion={phases: [word]}")[1]
        elif section in ("motion.fourier", "motion.moves"):
            words = self(IDEAL, "simulate", "--set=motion={%s: word}" % section.split(".")[1])[1]
        else:
            words = self(IDEAL, "simulate", f"--set={section}=word")[1]
        known = re.search(r"a map with entries among: ([\w, ]*)", words.replace("\n", " "))
        return {name.strip() for name in known.group(1).split(",") if name.strip()} if known else words

    def takes(self, section, key, example):
        path = f"{section}.{key}".lstrip(".")
        if section == "suite":
            return self.suite(**{key: example})
        if section == "suite.ladder":
            return self.suite(ladder=BESIDE[path] % example)
        if section == "suite.identifiers":
            beside = "" if key == "name" else "name: nominal-ls, "
            return self.suite(identifiers="[{%s%s: %s}]" % (beside, key, example))
        if section == "suite.claim":
            beside = "" if key == "source" else "source: x, "
            return self.suite(identifiers="[{name: nominal-ls, claim: {%s%s: \"%s\"}}]" % (beside, key, example))
        return self.scenario(BESIDE[path] % example if path in BESIDE else f"{path}={example}")

    def defaults(self):
        """The resolved scenario, as the program writes it."""
        status, words = self(IDEAL, "simulate")
        assert status == 0, words
        return (self.folder / f"out{self.count}" / "scenario.yaml").read_text()


def default_of(resolved, section, key):
    """The text of a scalar at the top or within a map of one line."""
    line = re.search(rf"^{section or key}: (.*)$", resolved, re.M)
    if not line:
        return None
    if not section:
        return line.group(1)
    inner = re.search(rf"\b{key}: ([^,}}]+)", line.group(1))
    return inner and inner.group(1)


def check_section(program, documented, section, resolved):
    problems = []
    known = program.keys(section)
    if isinstance(known, str):
        return [f"{section}: the program lists no keys: {known}"]
    names = {key for key, _, _ in documented.get(section, [])}
    if names != known:
        problems.append(f"'{section}': documented and unknown {sorted(names - known)}, known and not documented "
                        f"{sorted(known - names)}")
    for key, default, example in documented.get(section, []):
        beside = [f"{section}.{other}={value}" for other, _, value in documented[section]]
        if section.startswith("disturbances."):  # entries of a disturbance stand together
            status, words = program.scenario(*beside)
        else:
            status, words = program.takes(section, key, example)
        if status not in (0, 5):
            problems.append(f"{section}.{key}: the example {example} ends with {status}: {words}")
        written = re.fullmatch(r"`([^`]+)`", default)
        actual = default_of(resolved, section, key)
        if written and actual is not None and written.group(1) != actual:
            problems.append(f"{section}.{key}: the default is {actual}, not {written.group(1)}")
    return problems


def main():
    documented = tables(pathlib.Path(sys.argv[1]).read_text())
    with tempfile.TemporaryDirectory() as folder:
        program = Program(sys.argv[2], folder)
        resolved = program.defaults()
        # the sections that there must be: the wholes, and every map that one of them holds
        wanted = ["", "motion", "motion.rests", "motion.phases", "motion.fourier", "motion.moves", "controller", "noise",
                  "sampling", "disturbances", "suite", "suite.ladder", "suite.identifiers", "suite.claim"]
        parts = program.keys("disturbances")
        wanted += [f"disturbances.{part}" for part in sorted(parts) if program.keys(f"disturbances.{part}")]
        problems = [f"there is no section {section}" for section in documented.keys() - set(wanted)]
        for section in wanted:
            problems += check_section(program, documented, section, resolved)
    print("\n".join(problems) or f"{sum(map(len, documented.values()))} keys in {len(wanted)} maps are as the program has them")
    sys.exit(1 if problems else 0)


main()
