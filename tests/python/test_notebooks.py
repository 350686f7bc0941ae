"""The notebooks are as their readers need them, and their cells run; notebooks.py runs them in kernels, and with a wheel."""

import base64
import json
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((ROOT / "tools/notebooks").glob("*.ipynb"))


def test_there_is_one_for_a_log_a_warm_robot_and_a_whole_robot():
    assert [path.stem for path in NOTEBOOKS] == ["log_to_friction", "warm_robot_in_mujoco", "whole_robot_from_a_log"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_holds_what_its_cells_show(path):
    notebook = json.loads(path.read_text())
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    cells = notebook["cells"]
    assert len({cell["id"] for cell in cells}) == len(cells)
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))  # of one run, in order
    outputs = [output for cell in code for output in cell["outputs"]]
    assert not [output for output in outputs if output["output_type"] == "error"]
    pictures = [output["data"]["image/png"] for output in outputs if "image/png" in output.get("data", {})]
    assert pictures
    assert all(base64.b64decode(picture).startswith(b"\x89PNG") for picture in pictures)
    assert path.stat().st_size < 1e6  # bytes; what a browser shows at once


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_its_links_lead_somewhere(path):
    for cell in json.loads(path.read_text())["cells"]:
        for target in re.findall(r"\]\(([^):]+)\)", "".join(cell["source"])):
            assert (path.parent / target).exists(), target


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_its_cells_run(path, tmp_path):
    for needed in ("mujoco", "matplotlib"):
        pytest.importorskip(needed)
    code = ["".join(cell["source"]) for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]
    done = subprocess.run([sys.executable, "-c", "\n".join(code)], cwd=tmp_path, env={**os.environ, "MPLBACKEND": "Agg"}, timeout=120,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
