"""The index of the suites is what tools/results makes of their boards, and every board names an existing suite.

    check_boards.py ROOT
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    suites = root / "scenarios/suites"
    known = {path.stem for path in suites.glob("*.yaml")} | {"peers"}
    problems = [f"{board} belongs to no suite" for board in (suites / "boards").glob("*.md") if board.stem not in known]
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        shutil.copytree(suites, copy / "scenarios/suites")
        (copy / "tools").mkdir()
        shutil.copy2(root / "tools/results", copy / "tools/results")
        subprocess.run([sys.executable, copy / "tools/results", "--index"], check=True)
        if (copy / "scenarios/suites/README.md").read_text() != (suites / "README.md").read_text():
            problems.append("scenarios/suites/README.md is older than its boards or preface.md: tools/results --index")
    print("\n".join(problems) or "the index is that of the boards")
    sys.exit(1 if problems else 0)


main()
