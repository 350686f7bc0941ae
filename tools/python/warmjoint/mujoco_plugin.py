"""The MuJoCo plugin `warmjoint.friction` for the MuJoCo of this Python, loaded when this module is imported, which `import warmjoint` does.

Each minor version of MuJoCo has a library of its own: VERSION/libwarmjoint_friction.so in the package's folder `plugins`, in
build/plugins of a source tree, or in the folder that WARMJOINT_PLUGINS names.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import pathlib
from collections.abc import Iterator
from typing import Any

import mujoco

from warmjoint import mujoco_library
from warmjoint._core import BadInput, in_python, to_json

_HERE = pathlib.Path(__file__).resolve().parent
_NAME = "libwarmjoint_friction.so"


def _minor(version: str) -> str:
    return ".".join(version.split(".")[:2])


def library_path(version: str) -> pathlib.Path:
    """The plugin's library for a version of MuJoCo, "4.0.1": that of its minor version. Raises ImportError where there is none."""
    given = os.environ.get("WARMJOINT_PLUGINS")
    folders = [pathlib.Path(given)] if given else [_HERE / "plugins", *(up / "build/plugins" for up in _HERE.parents[2:3])]
    built = {_minor(path.parent.name): path for folder in reversed(folders) for path in sorted(folder.glob(f"*/{_NAME}"))}
    if _minor(version) in built:
        return built[_minor(version)]
    if not built:
        raise ImportError(f"there is no {_NAME} in {' or '.join(map(str, folders))}; in a source tree build it: tools/build")
    known = sorted(built, key=lambda minor: [int(part) for part in minor.split(".")])
    raise ImportError(f"warmjoint's friction works with MuJoCo {', '.join(known)}, and this Python has {version}: pip install 'mujoco=={known[-1]}.*'; "
                      f'in a source tree another version is built by tools/build -DWARMJOINT_PLUGIN_MUJOCOS="{version}"')


def _load() -> ctypes.CDLL:
    path = library_path(mujoco.__version__)
    if others := mujoco_library.others():
        raise ImportError(f"this process holds another MuJoCo, {', '.join(others)}, beside that of the package mujoco; run it with one")
    # MuJoCo loads it, which registers the plugin; then its functions are at hand
    mujoco_library.share()
    mujoco.mj_loadPluginLibrary(str(path))
    library = ctypes.CDLL(str(path))
    for function, takes in (
        ("warmjoint_attach", [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_char_p]),
        ("warmjoint_joints", [ctypes.c_void_p]),
        ("warmjoint_remove", [ctypes.c_void_p]),
    ):
        getattr(library, function).argtypes = takes
        getattr(library, function).restype = ctypes.c_char_p
    pointer = ctypes.c_void_p
    library.warmjoint_warm_springs.argtypes = [pointer, pointer, pointer, ctypes.c_int, pointer, ctypes.c_int]
    library.warmjoint_warm_springs.restype = None
    library.warmjoint_step_springs.argtypes = library.warmjoint_warm_springs.argtypes
    library.warmjoint_step_springs.restype = ctypes.c_char_p
    return library


_library = _load()


def _call(function: str, *arguments: Any) -> Any:
    answer = json.loads(getattr(_library, function)(*arguments))
    if "error" in answer:
        raise BadInput(in_python(answer["error"]))
    return answer


@contextlib.contextmanager
def _files(assets: dict[str, bytes]) -> Iterator[ctypes.c_void_p | None]:
    """Meshes and textures in memory, as MuJoCo's compiler takes them: a mjVFS, which is one pointer."""
    if not assets:
        yield None
        return
    vfs = ctypes.c_void_p()
    address = ctypes.c_void_p(ctypes.addressof(vfs))
    _library.mj_defaultVFS(address)
    for name, content in assets.items():
        data = content.encode() if isinstance(content, str) else bytes(content)
        _library.mj_addBufferVFS(address, name.encode(), data, len(data))
    try:
        yield address
    finally:
        _library.mj_deleteVFS(address)


def attach_to_spec(spec: mujoco.MjSpec, request: dict[str, Any]) -> Any:
    """Puts friction on joints of a spec; one that is refused stays as it was. request and answer: sim/library/calls.cc.

    Raises BadInput with the text of the command line, in which options are arguments.
    """
    with _files(dict(spec.assets)) as files:
        answer = _call("warmjoint_attach", spec._address, files, to_json(request, "attach").encode())
    answer["notices"] = [in_python(notice) for notice in answer["notices"]]
    return answer


def remove_from_spec(spec: mujoco.MjSpec) -> None:
    """Takes all friction of the plugin out of a spec."""
    _call("warmjoint_remove", spec._address)


warm_springs = _library.warmjoint_warm_springs
"""Heat and yields of springs that hold friction, by addresses (sim/library/drive_springs.cc)."""
step_springs = _library.warmjoint_step_springs
"""Steps of MuJoCo with these after each; an error of the engine, or None."""


def joints_of(model: mujoco.MjModel) -> list[dict[str, Any]]:
    """The joints with friction of a model, each with the places of its numbers (sim/library/calls.cc)."""
    joints: list[dict[str, Any]] = _call("warmjoint_joints", model._address)["joints"]
    return joints
