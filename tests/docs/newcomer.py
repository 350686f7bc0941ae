"""Does the tutorial as a newcomer would: in the project's folder, block after block, after tools/demo and the line that it prints.

    newcomer.py ROOT

Prints for each part the seconds that its commands took, those of reading (200 words a minute) and pasting (10 s a block), and
the minutes that its heading promises. Exits 1 where a command fails or a part takes longer than promised. Best run on a bare
system, in a fresh clone:  tools/demo && python3 tests/docs/newcomer.py .
"""

import os
import pathlib
import re
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages  # noqa: E402

PAGE = "tools/docs/tutorial.md"
PART = re.compile(r"^## (\d+\. .+) \((\d+) minutes?\)$", re.M)
READING = 60 / 200  # s a word
PASTING = 10  # s a block


def parts(text):
    """(title, minutes, text) of each part."""
    split = PART.split(text)
    return [(title, int(minutes), body) for title, minutes, body in zip(split[1::3], split[2::3], split[3::3])]


def commands(body):
    return [block for block in pages.blocks(body) if block.language == "sh" and "not run" not in block.marks]


def carry_out(block, root):
    """Seconds of a block in a shell as the demo's last line leaves it."""
    values = dict(os.environ, PATH=f"{root / 'build'}:{os.environ['PATH']}")
    start = time.monotonic()
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", block.text], cwd=root, env=values, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    wanted = int(block.marks.get("ends with", ("0",))[0])
    if done.returncode != wanted:
        sys.exit(f"ended with {done.returncode}, not {wanted}:\n{block.text}\n{done.stdout}")
    return time.monotonic() - start


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1]).resolve()
    print(f"{'part':58} {'commands':>9} {'reading':>8} {'promised':>9}")
    late = []
    for title, minutes, body in parts((root / PAGE).read_text()):
        ran = commands(body)
        seconds = sum(carry_out(block, root) for block in ran)
        reading = READING * len(" ".join(pages.prose(body)).split()) + PASTING * len(ran)
        print(f"{title[:58]:58} {seconds:7.1f} s {reading:6.0f} s {minutes:5} min", flush=True)
        if seconds + reading > 60 * minutes:
            late.append(title)
    if late:
        sys.exit("longer than promised: " + ", ".join(late))


main()
