"""MuJoCo's own library. What a wheel holds for MuJoCo names no library, so that one build serves every patch version: it finds MuJoCo's functions
among those of the process."""

from __future__ import annotations

import ctypes
import importlib.util
import pathlib


def library(version: str = "") -> pathlib.Path | None:
    """libmujoco.so of the package mujoco, of a version that begins so; None where there is none."""
    found = importlib.util.find_spec("mujoco")
    for folder in (found and found.submodule_search_locations) or []:
        for path in sorted(pathlib.Path(folder).glob(f"libmujoco.so.{version}*")):
            return path
    return None


def share() -> None:
    """Makes its functions those of the whole process, so that plugin and engine find them."""
    path = library()
    if path is not None:
        ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
