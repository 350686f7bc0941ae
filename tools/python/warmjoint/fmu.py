"""The files of an FMU as one archive, with the library that a C compiler makes of its sources. As a script it reads {"model", "files"} in
JSON, and writes a line of JSON, {"notices"}, and the archive."""

from __future__ import annotations

import io
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping

SYSTEMS = {"Linux": ("linux", ".so"), "Darwin": ("darwin", ".dylib"), "Windows": ("windows", ".dll")}
MACHINES = {"x86_64": "x86_64", "AMD64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}
OPTIONS = ("-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-fvisibility=hidden", "-shared")
LONGEST = 120  # s, of a compiler on a few hundred lines
DATE = (1980, 1, 1, 0, 0, 0)  # the earliest of an archive, so that the same files make the same bytes


def library(model: str, files: Mapping[str, str]) -> tuple[str, bytes]:
    """The library's path in the FMU, by the platforms of FMI 3.0, and its bytes. Raises OSError where no C compiler makes it."""
    system, ending = SYSTEMS.get(platform.system(), ("", ""))
    machine = MACHINES.get(platform.machine(), "")
    words = os.environ.get("CC", "cc").split()
    compiler = shutil.which(words[0]) if words else None
    if not (system and machine):
        raise OSError(f"no name of FMI 3.0 is known for {platform.system()} on {platform.machine()}")
    if compiler is None:
        raise OSError("there is no C compiler cc: sudo apt install gcc")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        made = pathlib.Path(folder, model + ending)
        sources = pathlib.Path(folder, "sources")
        command = [compiler, *words[1:], *OPTIONS, f"-I{sources}", str(sources / "warmjoint_fmu.c"), "-o", str(made), "-lm"]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
        if ended.returncode != 0:
            raise OSError(f"the C compiler failed: {(ended.stderr.strip() or 'without a word').splitlines()[0]}")
        return f"binaries/{machine}-{system}/{model}{ending}", made.read_bytes()


def pack(model: str, files: Mapping[str, str]) -> tuple[bytes, list[str]]:
    """The archive, and what it lacks, one sentence each. model: modelIdentifier; files: text by path."""
    content = {name: text.encode() for name, text in files.items()}
    notices = []
    try:
        name, made = library(model, files)
        content[name] = made
    except (OSError, subprocess.TimeoutExpired) as failure:
        notices.append(f"the FMU holds its sources alone, which importers may have to compile: {failure}")
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for name in sorted(content):
            packed.writestr(zipfile.ZipInfo(name, DATE), content[name], zipfile.ZIP_DEFLATED)
    return archive.getvalue(), notices


def main() -> None:
    """From standard input to standard output."""
    asked = json.load(sys.stdin)
    archive, notices = pack(asked["model"], asked["files"])
    sys.stdout.buffer.write(json.dumps({"notices": notices}).encode() + b"\n" + archive)


if __name__ == "__main__":
    main()
