"""What the page of a run shows: question, verdict, what was simulated, boards, realizations, pictures, failures, terms."""

from __future__ import annotations

from typing import Any

from . import along_log
from .families import Source
from .numerals import unit_text
from .run_view import listing_of

TERMS = (
    ("realization", "One simulated log: its noise, and where the suite says so its truth and motion, are drawn anew."),
    ("identifier", "A method that finds the friction's parameters in a log."),
    ("NPE", "Normalised parameter error: the length of the vector of relative errors of all parameters, against the known truth. 1 % is one part in a "
     "hundred. The discrete NPE is that of the two parameters of the sampled warming, as in the paper."),
    ("Cramér-Rao bound", "The error that no unbiased method can undercut on such logs, by their noise and length. An rms NPE of 1.0 times the bound "
     "cannot be bettered."),
    ("NPE above best", "How much larger an identifier's NPE is than the best one's on the same realization, median with a 95 % interval; where it holds 0 "
     "the two are tied."),
    ("RMSE, MAE", "Root mean square error and mean absolute error of the fitted torque."),
    ("Fit", "1 − norm of the residual over norm of the torque's variation, in per cent."),
    ("FPE", "Final prediction error: the mean square error, raised for each parameter fitted."),
    ("interval holds the truth", "Share of 95 % intervals that contain the true value; 95 % is right."),
    ("failure", "A realization for which the identifier gave no numbers, or called its numbers void."),
)


def data_of(content: dict[str, Any]) -> dict[str, Any]:
    """What the template run.html shows. content: of RunPageFacts (tools/shown/run/run_data.h)."""
    source = Source({**content, "kind": "run"})
    assert source.run is not None
    every, answers = listing_of(source.run)
    extremes = content["extremes"]
    board = content["board"]
    return {"suite": board["suite"], "question": board["question"], "verdict": content["verdict"], "simulated": [one.replace("N.m", "N·m") for one in content["simulated"]],
            "identifiers": content["entries"], "boards": content["boards"], "extremes": (lambda: along_log.extremes(extremes)) if extremes else None,
            "without_extremes": content["without_extremes"], "every": every, "realizations": realizations(content, answers),
            "figures": [make for make, _ in source.figures().values()], "notes": content["notes"], "terms": TERMS, "run": content["run"],
            "finished": board["realizations"], "all": content["realizations"] * max(1, len(content["variants"])), "versions": content["versions"],
            "suite_yaml": content["suite_yaml"], "board": board}


def realizations(content: dict[str, Any], answers: list[dict[str, Any]]) -> dict[str, Any]:
    """Each answer with how well it did, and how to make its log again."""
    variants = content["variants"]
    header = ["realization", *["variant"] * bool(variants), "identifier", "answer", "NPE", f"RMSE ({unit_text(content['torque_unit'])})", "Fit (%)",
              "simulate it again"]
    rows = []
    for one in answers:
        command = content["replay"][one["variant"]].replace("--realization 0 ", f"--realization {one['realization']} ")
        rows.append([str(one["realization"]), *([variants[one["variant"]]] if variants else []), content["identifiers"][one["identifier"]]["label"],
                     one["status"], "-" if one["npe"] is None else f"{100 * one['npe']:.3g} %", _number(one["rmse"]), _number(one["fit"]), command])
    return {"caption": "Every answer; a click on a heading sorts", "header": header, "rows": rows}


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}"
