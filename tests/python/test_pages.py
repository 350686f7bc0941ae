"""The Python of the pages runs as it stands there."""

import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("page", ["README.md", "tools/python/README.md", "tools/docs/mujoco.md", "tools/docs/training.md"])
def test_the_python_of_a_page_runs(page, recording, tmp_path):
    for needed in ("mujoco.batch", "matplotlib", "jinja2"):
        pytest.importorskip(needed)
    (tmp_path / "models").symlink_to(ROOT / "models")
    (tmp_path / "runs/warm").mkdir(parents=True)
    for place in ("log.csv", "runs/warm/recording.csv"):
        (tmp_path / place).symlink_to(recording)
    code = "\n".join(re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S))
    assert code
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
