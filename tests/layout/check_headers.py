"""Compiles each header of the product by itself, which fails where one leans on what others include before it.

    check_headers.py PROJECT BUILD [HEADER]...

BUILD holds compile_commands.json, from which the compiler, the folders and the definitions of the libraries come. Without
headers, all of the rooms. Checks syntax and types alone (-fsyntax-only), as many at once as there are cores.
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOMS = ["models", "scenarios", "sim", "identification", "tools"]


def command_of(root, build):
    """Compiler, standard and every folder and definition that some file of the product is compiled with."""
    flags, compiler = {}, "c++"
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        words = shlex.split(entry["command"])
        # groups of files lie in the build's folder of their room; the plugin alone takes fmt as headers
        if not any(file.is_relative_to(top / room) for top in (root, build) for room in ROOMS) or "-DFMT_HEADER_ONLY=1" in words:
            continue
        compiler = next(word for word in words if os.path.basename(word) in ("c++", "g++", "clang++"))
        for i, word in enumerate(words):
            if word == "-isystem":
                flags[f"-isystem {words[i + 1]}"] = ["-isystem", words[i + 1]]
            elif word.startswith(("-I", "-D", "-std=")):
                flags[word] = [word]
    return [compiler, "-fsyntax-only", "-x", "c++"] + [word for words in flags.values() for word in words]


def main(project, build, *headers):
    root = pathlib.Path(project).resolve()
    command = command_of(root, pathlib.Path(build).resolve())
    headers = [pathlib.Path(header) for header in headers] or sorted(
        path for room in ROOMS for path in (root / room).rglob("*.h"))

    def check(header):
        # #pragma once in a main file is a warning of its own
        done = subprocess.run([*command, "-"], input=f'#include "{header.resolve()}"\n', capture_output=True, text=True,
                              check=False)
        return header, done.returncode, done.stderr

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = [(header, error) for header, status, error in pool.map(check, headers) if status]
    for header, error in failed:
        print(f"{header} does not compile by itself:\n{error}")
    print(f"{len(headers) - len(failed)} of {len(headers)} headers compile by themselves")
    return 1 if failed or not headers else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
