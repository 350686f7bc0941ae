"""What the page of a log and its estimate shows: verdict, what to do next, parameters, the recording, pictures, tests, assumptions."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import along_log, friction, residuals
from .fit_page import parameter_rows, verdict
from .numerals import significant, unit_text
from .sheet import Sheet
from .view import View

PARTS = 2500  # of a recording whose extremes the page's charts show
NOUGHT = 0.05  # per cent of a parameter that an assumption may move unsaid
MOST = 100.0  # per cent: by more a parameter is only said to move

TERMS = (
    ("friction", "The torque that motion costs, against its direction. It falls as grease warms."),
    ("viscous, coulomb", "Friction that grows with speed (N·m for each rad/s), and that which does not (N·m)."),
    ("thermal_gain, thermal_time_constant", "By how much each watt of the joint's own heat changes friction, and how long that takes. E is the change "
     "that is reached; no thermometer is needed."),
    ("kept samples", "Samples at a constant speed: there the torque is friction, and gravity where it acts."),
    ("residual", "Measured torque less fitted torque."),
    ("95 % interval", "A range that holds the true value in 95 of 100 such logs, if the model is right."),
    ("Fit, RMSE, MAE", "1 − norm of the residual over norm of the torque's variation, in per cent; root of the mean square error; mean absolute error."),
    ("void", "A number of a fit that failed a test. It may look precise and be wrong."),
)


def data_of(content: dict[str, Any]) -> dict[str, Any]:
    """What the template log.html shows. content: {fit, check, commands}."""
    view, facts = View(content["fit"]), content["fit"]
    samples = samples_of(view)
    rows = parameter_rows(view, symbols=False)
    caption = "Parameters of the friction" if view.passed else "Void: parameters of a fit that failed"
    return {"source": view.source, "identifier": view.identifier, "passed": view.passed, "verdict": verdict(view), "remarks": facts["remarks"],
            "agreement": _agreement(view), "next": next_steps(view, content["check"]),
            "parameters": _table(caption, ["parameter", "value", "95 % interval", "unit"], rows), "tests": _tests(view),
            "assumptions": assumptions(view), "attachable": view.passed and facts["has_friction"], "terms": TERMS, "commands": content["commands"],
            "thinned": len(samples) < view.time.size, "samples": samples,
            "charts": [view.position_name, view.speed_name, view.torque_name("torque")], "figures": _figures(view)}


def _agreement(view: View) -> list[str]:
    """How well the fit describes the samples that it saw, and others."""
    metrics, holdout = view.facts["metrics"], view.facts["holdout"]
    said = []
    if metrics:
        said.append(f"Fit {metrics['fit']:.1f} % (1 − norm of the residual over norm of the torque's variation); RMSE {significant(metrics['rmse'])} "
                    f"{view.torque_unit}, the root of the mean square error, over {metrics['n']} samples.")
    if holdout:
        said.append(f"On samples that were held out of a second fit, the RMSE is {significant(holdout['rmse'])} {view.torque_unit}.")
    return said


def next_steps(view: View, check: dict[str, Any]) -> list[str]:
    """What a reader does now: how to use numbers that passed, or what to record and try."""
    steps = [f"The log: {fault}." for fault in check["faults"]]
    if view.passed:
        steps.append("Use the numbers with their intervals; keep the assumptions below in mind.")
    else:
        steps += [test["advice"] for test in view.facts["tests"] if test["rejected"]]
    return steps + [f"To identify {one['what']}: {one['reason']}" for one in check["excitation"] if not one["sufficient"]]


def _table(caption: str, header: list[str], rows: list[list[str]]) -> dict[str, Any] | None:
    return {"caption": caption, "header": header, "rows": rows} if rows else None


def _tests(view: View) -> dict[str, Any] | None:
    """A line for each question: its answer, how much it explains, how often chance does as much."""
    rows = []
    for test in view.facts["tests"]:
        made = test["made"]
        answer = ("yes" if test["rejected"] else "no") if made else "not asked: " + test["reason"]
        rows.append([test["question"], answer, f"{significant(test['effect'], 2)} {unit_text(test['effect_unit'])}" if made else "–",
                     f"{test['p_adjusted']:.2g}" if made and test["p_adjusted"] is not None else "–"])
    return _table("What the residual still shows", ["question", "answer", "size", "p"], rows)


def assumptions(view: View) -> dict[str, Any] | None:
    """A row for each assumption that moves something, a column for each parameter that one moves."""
    shown = {row["name"]: row["value"] for row in view.facts["shown"]}

    def move(one: dict[str, Any], name: str) -> float:
        return 100 * one["moves"].get(name, 0) / shown[name] if shown[name] else 0.0

    found = view.facts["assumptions"]
    moved = [name for name in shown if any(abs(move(one, name)) >= NOUGHT for one in found)]
    rows = [[one["sentence"], *(_per_cent(move(one, name)) for name in moved)] for one in found
            if any(abs(move(one, name)) >= NOUGHT for name in moved)]
    return _table("Change of each parameter, per cent of its value, were that not so", ["taken for granted", *moved], rows)


def _per_cent(change: float) -> str:
    if abs(change) < NOUGHT:
        return "–"
    sign = "+" if change > 0 else ""
    if abs(change) > MOST:
        return f"more than {sign or '−'}{MOST:.0f} %"
    return f"{sign}{significant(change, 2)} %"


def samples_of(view: View) -> list[list[float | None]]:
    """time, position, velocity, torque as it was logged, fit and whether it is kept; of long logs those that show every extreme of every column."""
    torque = view.torque + view.rigid
    fit = np.where(view.keep, view.fitted + view.rigid, np.nan) if view.has_fit else np.full(view.time.size, np.nan)
    chosen = thinned([view.position, view.velocity, torque], PARTS)
    columns = [np.char.mod("%.7g", view.time[chosen]).astype(float)]
    columns += [np.char.mod("%.5g", column[chosen]).astype(float) for column in (view.position, view.velocity, torque, fit)]
    rows = np.column_stack(columns)
    known = [[value if np.isfinite(value) else None for value in row] for row in rows.tolist()]
    return [[*row, int(kept)] for row, kept in zip(known, view.keep[chosen])]


def thinned(columns: list[np.ndarray], parts: int) -> np.ndarray:
    """Of each part of equal length the first, lowest, highest and last sample of each column; all of a log with few samples."""
    n = columns[0].size
    if n < 4 * parts:
        return np.arange(n)
    edges = np.linspace(0, n, parts + 1).astype(int)
    marks = [edges[:-1], edges[1:] - 1]
    for column in columns:
        for filled, extreme in ((np.inf, np.argmin), (-np.inf, np.argmax)):
            known = np.where(np.isfinite(column), column, filled)
            marks.append(np.array([begin + extreme(known[begin:end]) for begin, end in zip(edges[:-1], edges[1:])]))
    return np.unique(np.concatenate(marks))


def _figures(view: View) -> list[Any]:
    """The pictures, the ones that decide first."""
    made: list[Any] = [lambda: along_log.log(view)]
    if not view.count:
        return made
    void = " (void)" if view.void else ""
    made.append(lambda: _single("level", f"Level of friction over time{void}", "Torque in the direction of motion, measured and fitted.", view,
                                along_log.level_over_time))
    made.append(lambda: _single("friction_curve", f"Friction over velocity{void}", "Each dot is a kept sample; lines are the fitted law.", view,
                                friction.over_velocity))
    if view.warms:
        made.append(lambda: friction.warm_up(view))
    if view.has_fit:
        made += [lambda: residuals.panels_of(view), lambda: residuals.predicted(view)]
    return made


def _single(name: str, title: str, finding: str, view: View, panel: Any) -> Sheet:
    fig = Sheet(name, title, "", finding)
    panel(fig.panels((390, [1]))[0], view)
    return fig


