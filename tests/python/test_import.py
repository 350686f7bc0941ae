"""What `import warmjoint` does: it loads the plugin where one fits, and is silent where none does."""

import os
import pathlib
import pickle
import subprocess
import sys

import pytest

mujoco = pytest.importorskip("mujoco")

from test_attach import FRICTIONS, ROBOT  # noqa: E402
from warmjoint import attach  # noqa: E402

WORKER = """
import os, sys, warmjoint
import mujoco, pickle
model = pickle.load(open(sys.argv[1], "rb")) if sys.argv[1].endswith("pickle") else getattr(mujoco.MjModel, sys.argv[2])(sys.argv[1])
data = mujoco.MjData(model)
mujoco.mj_step(model, data)
print("stepped")
"""


def run_python(code, *arguments, cwd=None, **environment):
    return subprocess.run([sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=cwd,
                          env={**os.environ, **environment})


def test_what_tries_a_wheel_takes_the_package_that_is_installed(tmp_path):
    script = pathlib.Path(__file__).with_name("try_wheel.py")
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (0, "status of a simulated log: ok\n"), done.stderr


def test_a_process_that_imports_the_package_takes_models_with_friction(tmp_path):
    attached = attach(ROBOT, FRICTIONS)
    model = attached.spec.compile()
    (tmp_path / "model.pickle").write_bytes(pickle.dumps(model))
    mujoco.mj_saveModel(model, str(tmp_path / "model.mjb"))
    (tmp_path / "model.xml").write_text(attached.xml)
    for name, read in (("model.pickle", ""), ("model.mjb", "from_binary_path"), ("model.xml", "from_xml_path")):
        done = run_python(WORKER, tmp_path / name, read)
        assert (done.returncode, done.stdout, done.stderr) == (0, "stepped\n", ""), name


def test_the_package_is_imported_where_no_plugin_fits(tmp_path):
    code = """
import warmjoint as wj
assert wj.Friction("coulomb", coulomb=2)(1.0) == 2
try:
    wj.attach
except ImportError as refusal:
    assert "libwarmjoint_friction.so" in str(refusal), refusal
else:
    raise SystemExit("attached")
"""
    done = run_python(code, WARMJOINT_PLUGINS=str(tmp_path))
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    # a package mujoco that does not work
    (tmp_path / "mujoco").mkdir()
    (tmp_path / "mujoco/__init__.py").write_text("raise RuntimeError('no display')")
    path = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])])
    done = run_python("import warmjoint as wj\nassert wj.Friction('coulomb', coulomb=2)(1.0) == 2", PYTHONPATH=path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
