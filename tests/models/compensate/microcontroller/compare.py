"""<warmjoint/compensate.h> on a Cortex-M4F in QEMU against the host: friction in double within 2 units of the last place where there are no maps, in
float within 1e-5 of the largest; prints the instructions a step takes. Exit status 77 where the cross-compiler or QEMU is not there.

    python3 compare.py CASES_FOLDER BUILD_FOLDER
"""

import pathlib
import shutil
import struct
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
INCLUDE = HERE.parents[3] / "models/include"
TOOLS = {"arm-none-eabi-gcc": "gcc-arm-none-eabi libnewlib-arm-none-eabi", "qemu-system-arm": "qemu-system-arm"}
CORTEX_M4F = ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "--specs=rdimon.specs", "-T", str(HERE / "mps2.ld")]
OPTIONS = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Wdouble-promotion", "-Werror", f"-I{INCLUDE}"]
QEMU = ["qemu-system-arm", "-M", "mps2-an386", "-nographic", "-semihosting-config", "enable=on,target=native", "-icount", "shift=0", "-kernel"]
SKIPPED = 77


def compiled(compiler, real, folder):
    """The program in that real, without contraction, which the host does not do either."""
    options = [*OPTIONS, "-ffp-contract=off", f"-I{folder}", *(["-DWJ_FLOAT"] if real == "float" else [])]
    program = pathlib.Path(folder, f"steps_{compiler[0]}_{real}")
    subprocess.run([*compiler, *options, str(HERE / "steps.c"), "-o", str(program), "-lm"], check=True)
    return str(program)


def printed(command):
    """{case: (maps, bits of each sample)}, {what: instructions a step}."""
    cases, instructions, samples = {}, {}, []
    for line in subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout.splitlines():
        words = line.split()
        if words[0] == "instructions":
            instructions[words[1]] = int(words[2])
        elif len(words) == 3:
            samples = []
            cases[words[0]] = (int(words[1]), samples)
        else:
            samples.append(int(words[0], 16))
    return cases, instructions


def number(bits):
    return struct.unpack(">d", bits.to_bytes(8, "big"))[0]


def main(cases_folder, folder):
    missing = [package for tool, package in TOOLS.items() if not shutil.which(tool)]
    if missing:
        print(f"skipped: sudo apt install {' '.join(missing)}")
        return SKIPPED
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    shutil.copy(pathlib.Path(cases_folder, "cases.h"), folder)
    host, _ = printed([compiled(["cc"], "double", folder)])
    failed = len(host) < 7  # every law, and one with all else
    for real in ("double", "float"):
        cases, instructions = printed([*QEMU, compiled(["arm-none-eabi-gcc", *CORTEX_M4F], real, folder)])
        for name, (maps, bits) in host.items():
            there = cases[name][1]
            assert len(there) == len(bits) > 0
            largest = max(abs(number(one)) for one in bits)
            # numbers of one sign are ordered as their bits are
            places = max(abs(a - b) for a, b in zip(bits, there, strict=True))
            error = max(abs(number(a) - number(b)) for a, b in zip(bits, there, strict=True)) / largest
            # of maps only that they are near: their kernels are sums of exponentials of two libraries
            failed |= error > 1e-5 if real == "float" or maps else places > 2
            print(f"{real} {name}: {error:.2g} of the largest" + (f", {places} units of the last place" if real == "double" else ""))
        for what, count in instructions.items():
            print(f"{real}: {count} instructions a step, {what}")
            failed |= not 0 < count < 50000
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
