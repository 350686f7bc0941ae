"""MuJoCo's own library. What a wheel holds for MuJoCo names no library, so that one build serves every patch version: it finds MuJoCo's functions
among those of the process."""

from __future__ import annotations

import contextlib
import ctypes
import importlib.util
import os
import pathlib
from collections.abc import Iterator

from warmjoint._core import BadInput
from warmjoint.values import one_line


@contextlib.contextmanager
def refusing(what: str) -> Iterator[None]:
    """What MuJoCo raises within is a BadInput that begins with `what`."""
    import mujoco

    try:
        yield
    except (ValueError, mujoco.FatalError) as refusal:  # a BadInput, too, which older versions of MuJoCo take for theirs
        raise BadInput(f"{what}: {one_line(refusal)}") from None


def library(version: str = "") -> pathlib.Path | None:
    """libmujoco.so of the package mujoco, of a version that begins so; None where there is none."""
    found = importlib.util.find_spec("mujoco")
    for folder in (found and found.submodule_search_locations) or []:
        for path in sorted(pathlib.Path(folder).glob(f"libmujoco.so.{version}*")):
            return path
    return None


def others() -> list[str]:
    """The paths of further libraries of MuJoCo in this process, of which a plugin could not say which it serves."""
    own = library()
    with contextlib.suppress(OSError):
        mapped = {line.split(maxsplit=5)[-1].strip() for line in pathlib.Path("/proc/self/maps").read_text(errors="replace").splitlines() if "libmujoco.so" in line}
        return sorted(path for path in mapped if own is None or os.path.realpath(path) != os.path.realpath(own))
    return []


def share() -> None:
    """Makes its functions those of the whole process, so that plugin and engine find them."""
    path = library()
    if path is not None:
        ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
