"""The certified problems: two independent programs agree on their answers, and `validate` counts digits."""

import json
import math
import os
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

import certified  # noqa: E402

PROBLEMS = json.loads((certified.FOLDER / "problems.json").read_text())
CONFIRMED = 8.0  # digits


@pytest.mark.parametrize("name", certified.PROBLEMS)
def test_numpy_finds_the_answer_from_both_starts(name):
    names, found, squares = certified.answer(name)
    answer = PROBLEMS[name]["answer"]
    assert list(answer) == names
    for one, value in zip(names, found):
        assert value == pytest.approx(answer[one]["value"], rel=certified.AGREE)
    assert squares == pytest.approx(PROBLEMS[name]["squares"], rel=1e-12)


def test_a_prior_of_another_strength_has_another_answer(monkeypatch):
    monkeypatch.setitem(certified.MAP_SETTINGS, "strength", 2.001)
    names, found, _ = certified.answer("map")
    assert max(abs(value / PROBLEMS["map"]["answer"][one]["value"] - 1) for one, value in zip(names, found)) > 1e-6


def test_the_identifiers_find_the_same():
    asked = {name: [*options.split(" "), "--force"] for name, (_, _, options) in certified.PROBLEMS.items()}
    for name, found in certified.digits(os.environ["WARMJOINT_PROGRAM"], asked).items():
        assert found >= CONFIRMED, name


def test_validate_counts_digits_and_names_what_it_does_not_know(program):
    answer = {name: one["value"] for name, one in PROBLEMS["heat_viscous"]["answer"].items()}
    answer["viscous"] *= 1 + 1e-4
    (program.folder / "answers.json").write_text(json.dumps({"heat_viscous": answer, "coulomb": {}}))
    rows = {row["problem"]: row for row in json.loads(program("validate", "answers.json", "--format", "json"))}
    assert set(rows) == set(PROBLEMS)
    assert rows["heat_viscous"]["digits"] == pytest.approx(-math.log10(1e-4), abs=1e-6)
    assert rows["heat_viscous"]["parameters"]["coulomb"]["digits"] == 10
    assert rows["coulomb"]["digits"] == 0  # without a number
    assert "heat_viscous" in program("validate")

    (program.folder / "answers.json").write_text(json.dumps({"heat_viscos": answer}))
    refused = subprocess.run([program.path, "validate", "answers.json"], cwd=program.folder, capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert "heat_viscous" in refused.stderr
