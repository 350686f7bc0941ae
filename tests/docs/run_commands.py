"""Runs every `sh` block of a page, in order, in a scratch copy of the sources. pages.py says how blocks are marked.

    run_commands.py ROOT PAGE BUILD [--draw]

The copy holds BUILD as build/, so that the program and the plugin are those that were built; tools/build does nothing
there (WARMJOINT_BUILT). Pictures of the page must be those that its commands made; --draw puts these in their place.
Exits 77 where every block was skipped, and 1 with the block's words where one fails.
"""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages

COMMANDS = ("warmjoint ", "tools/", "build/", "ctest ", "cmake ", "python3 ", "WARMJOINT_", "peers/", "tests/", "export ")
LIMIT = 600  # s, of one block


def copy_sources(root, build, target):
    def leave_out(folder, names):
        top = pathlib.Path(folder) == root
        return [name for name in names if name == "__pycache__" or (top and pages.is_output(name))]

    shutil.copytree(root, target, ignore=leave_out, symlinks=True)
    (target / "build").symlink_to(build)


def environment(build):
    values = dict(os.environ, WARMJOINT_BUILT="1", NO_COLOR="1")
    # the system's Python, which the sandbox of identifiers of others lets through, before others
    values["PATH"] = f"{build}:/usr/bin:/bin:{values['PATH']}"
    # the Python package as if it were installed
    values["PYTHONPATH"] = ":".join(str(build / folder) for folder in ("python", "deps/python", "deps/mujoco"))
    return values


def bring(names, target):
    """Lays shared files into the copy; False where one is absent."""
    shared = os.environ.get("WARMJOINT_SHARED") or os.environ.get("WARMJOINT_SHARED_DEFAULT") or "/nowhere"
    sources = [pathlib.Path(shared) / name for name in names.split()]
    if not all(source.is_file() for source in sources):
        return False
    for source in sources:
        link = target / source.name
        link.exists() or link.symlink_to(source)
    return True


def run(block, target, values):
    """Runs one block; returns what is wrong, or nothing."""
    wanted = int(block.marks.get("ends with", ("0",))[0])
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", block.text], cwd=target, env=values, text=True, timeout=LIMIT,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode == wanted:
        return ""
    return f"ended with {done.returncode}, not {wanted}:\n{block.text}\n{done.stdout[-4000:]}"


def unmarked(text):
    """Lines of indented blocks that are commands, which nothing would run."""
    return [number for number, line in enumerate(pages.prose(text), 1)
            if line.startswith("    ") and line.strip().startswith(COMMANDS)]


def words(path):
    """Width and height of a PNG as its bytes, and what it says of itself: title, finding, and a line for each series."""
    data, at, said = path.read_bytes(), 8, {}
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"iTXt":
            key, text = data[at + 8 : at + 8 + length].split(b"\0\0\0\0\0", 1)
            said[key.decode()] = text.decode()
        at += 12 + length
    return data[16:24], said


def stale(shown, made):
    """Why a picture is not the one that was made, by the data of its figure; empty where it is. Numbers count as equal within 1 %."""
    number = re.compile(r"[-\u2212]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
    (size, said), (new_size, new_said) = words(shown), words(made)
    if size != new_size:
        return "has another size"
    if "Data" not in new_said:
        return "says nothing of its data"
    for key, now in new_said.items():
        before = said.get(key, "")
        if number.sub("#", before) != number.sub("#", now):
            return f"has another {key.lower()}: {before!r}, now {now!r}"
        for one, other in zip(number.findall(before), number.findall(now)):
            old, new = (float(text.replace("\u2212", "-")) for text in (one, other))
            if abs(old - new) > 0.01 * max(abs(old), abs(new)):
                return f"has another {key.lower()}: {one} in {before!r}, now {other}"
    return ""


def check_pictures(root, page, text, target, draw):
    for line, shown, made in pages.made_pictures(text):
        shown = (root / page).parent / shown
        if draw:
            shutil.copyfile(target / made, shown)
            continue
        wrong = stale(shown, target / made)
        if wrong:
            sys.exit(f"{page}:{line}: {shown.name} {wrong}; draw it anew: tests/docs/run_commands.py . {page} build --draw")
        print(f"{page}:{line}: {shown.name} is current")


def main():
    root, page, build = (pathlib.Path(given).resolve() if i != 1 else given for i, given in enumerate(sys.argv[1:4]))
    text = (root / page).read_text()
    if unmarked(text):
        sys.exit(f"{page}:{unmarked(text)[0]}: a command in an indented block; put it between ```sh and ```")
    blocks = [block for block in pages.blocks(text) if block.language == "sh"]

    ran = 0
    with tempfile.TemporaryDirectory(prefix="warmjoint_docs_") as folder:
        target = pathlib.Path(folder) / "warmjoint"
        copy_sources(root, build, target)
        values = environment(build)
        for block in blocks:
            where = f"{page}:{block.line}"
            if "not run" in block.marks:
                print(f"{where}: not run: {block.marks['not run'][1]}")
                continue
            if "needs" in block.marks and not bring(block.marks["needs"][0], target):
                print(f"{where}: skipped: {block.marks['needs'][0]} is not there ({block.marks['needs'][1]})")
                continue
            start = time.monotonic()
            wrong = run(block, target, values)
            if wrong:
                sys.exit(f"{where}: {wrong}")
            ran += 1
            print(f"{where}: {time.monotonic() - start:.1f} s", flush=True)
        check_pictures(root, page, text, target, "--draw" in sys.argv)
    print(f"{page}: ran {ran} of {len(blocks)} blocks")
    sys.exit(0 if ran or not blocks else 77)


main()
