"""The program `warmjoint` of an installed package."""

import os
import pathlib
import sys

from warmjoint.engine import require_mujoco


def main() -> None:
    """Runs it with the package's robots and suites, and this Python for pictures."""
    package = pathlib.Path(__file__).parent
    try:
        require_mujoco()
    except ImportError as missing:
        sys.exit(f"error: {missing}")
    os.environ.setdefault("WARMJOINT_DATA", os.fspath(package / "data"))
    os.environ.setdefault("WARMJOINT_PYTHON", sys.executable)
    os.execv(package / "bin/warmjoint", ["warmjoint", *sys.argv[1:]])
