"""The program `warmjoint` of an installed package."""

import os
import pathlib
import sys

from warmjoint import mujoco_library


def environment(package: pathlib.Path) -> dict[str, str]:
    """Of the program: the package's robots and suites, this Python for pictures, and MuJoCo 4.0; where that is not installed, what stands in for it
    and says so when something is simulated."""
    known = {**os.environ}
    known.setdefault("WARMJOINT_DATA", os.fspath(package / "data"))
    known.setdefault("WARMJOINT_PYTHON", sys.executable)
    absent = package / "bin/libmujoco_absent.so"
    if absent.exists():  # in a wheel: in a source tree the program names its MuJoCo
        engine = mujoco_library.library("4.0.") or absent
        known["LD_PRELOAD"] = engine.name
        known["LD_LIBRARY_PATH"] = os.pathsep.join(filter(None, (os.fspath(engine.parent), known.get("LD_LIBRARY_PATH"))))
    return known


def main() -> None:
    """Runs it in place of this process."""
    package = pathlib.Path(__file__).parent
    os.execve(package / "bin/warmjoint", ["warmjoint", *sys.argv[1:]], environment(package))
