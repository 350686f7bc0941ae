"""tools/mutations on a project of two functions, of which one is tested: the places that it makes wrong there are killed, those of
the other survive, each is put back, and a run that is repeated makes none again. Where a test fails anyway, nothing is made
wrong. Argument: the project's folder."""
import csv
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TESTED = """// 1 < 2 stands in a comment
bool IsBelow(int a) {
  return a < 3;
}
"""
UNTESTED = """bool IsAbove(int a) {
  return a > 3;
}
"""
PROGRAM = """bool IsBelow(int);
int main() { return IsBelow(2) && !IsBelow(3) ? 0 : 1; }
"""
BUILD = """cmake_minimum_required(VERSION 3.25)
project(two LANGUAGES CXX)
enable_testing()
add_executable(program main.cc models/tested.cc models/untested.cc)
add_test(NAME program COMMAND program)
"""


def main():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "tools").mkdir()
        (root / "models").mkdir()
        shutil.copy(Path(sys.argv[1]) / "tools/mutations", root / "tools")
        (root / "models/tested.cc").write_text(TESTED)
        (root / "models/untested.cc").write_text(UNTESTED)
        (root / "main.cc").write_text(PROGRAM)
        (root / "CMakeLists.txt").write_text(BUILD)
        subprocess.run(["cmake", "-S", root, "-B", root / "build"], check=True, stdout=subprocess.DEVNULL)
        run = [root / "tools/mutations", root / "build", root / "out.csv", "--count", "8", "--rooms", "models", "--", "-j1"]
        first = subprocess.run(run, check=True, capture_output=True, text=True).stdout
        rows = list(csv.reader((root / "out.csv").open()))

        assert len(rows) == 8
        for _, _, file, line, before, after, result in rows:
            assert (file, line) in (("models/tested.cc", "3"), ("models/untested.cc", "2")), file + line
            assert before != after
            assert result == ("killed" if file == "models/tested.cc" else "survived"), after
        assert {row[2] for row in rows} == {"models/tested.cc", "models/untested.cc"}, "the seed draws both"
        assert (root / "models/tested.cc").read_text() == TESTED
        assert (root / "models/untested.cc").read_text() == UNTESTED
        killed = sum(row[-1] == "killed" for row in rows)
        assert f"{killed} of 8 killed" in first, first

        again = subprocess.run(run, check=True, capture_output=True, text=True).stdout
        assert again == first.splitlines(keepends=True)[-1], again
        assert len(list(csv.reader((root / "out.csv").open()))) == 8

        (root / "main.cc").write_text("int main() { return 1; }\n")
        failing = subprocess.run([*run[:2], root / "none.csv", *run[3:]], capture_output=True, text=True)
        assert failing.returncode != 0 and "does not pass" in failing.stderr, failing.stderr
        assert not (root / "none.csv").exists()


main()
