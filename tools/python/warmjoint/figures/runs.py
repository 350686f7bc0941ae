"""Figures of a run of a suite: who finds the truth, how, and how sure."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import sheet as draw
from .numerals import hue_of, look_of, plain_number, significant, unit_text
from .run_view import Column, Row, Run
from .sheet import Sheet
from .view import quantiles, quartiles

FEW = 12  # traces that are drawn one by one
BESIDE = 5  # rows in two panels side by side
REACH95 = float(np.sqrt(-2 * np.log(0.05)))  # half axes of the ellipse that holds 95 % of a plane normal, in standard deviations


def _known(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]


def _median(values: np.ndarray) -> float:
    known = _known(np.asarray(values, float))
    return float(np.median(known)) if known.size else np.nan


def _rms(values: np.ndarray) -> float:
    known = _known(values)
    return float(np.sqrt(np.mean(known**2))) if known.size else np.nan


def npe_boxes(run: Run) -> Sheet | None:
    """Parameter error of each identifier as box plots beside the Cramér-Rao bound, a panel for each variant."""
    rungs = [rung for rung in run.rungs if any(_known(row.at(row.npe, rung)).size for row in run.rows)]
    if not rungs:
        return None
    clauses = []
    for rung in run.rungs:
        said = []
        for row in run.rows:
            failed = f" with {row.failed} of {row.runs} failed" if row.failed and rung is None else ""
            known = _known(row.at(row.npe, rung))
            said.append(f"{row.label} {significant(100 * np.median(known)) + ' %' if known.size else 'none'}{failed}")
        clauses.append((f"with {run.name_of(rung)} " if rung is not None else "") + ", ".join(said))
    found = ""
    whole = run.bound_npe(None)
    if len(run.rungs) == 1 and whole:
        found = f" The Cramér-Rao bound is {significant(100 * whole)} % rms."
    several = max(_known(row.at(row.npe, rung)).size for row in run.rows for rung in rungs) > 1
    found = f"{'Median NPE' if several else 'NPE'}: {'; '.join(clauses)}.{found}"
    fig = Sheet("npe_boxes", "Parameter error of each identifier",
                run.about("boxes hold the middle half and its median, whiskers 90 %" if several else "each is one number", each=True), found)
    for ax, rung in zip(fig.panels(*[(210 if rung is not None else 360, [1]) for rung in rungs]), rungs):
        shown, places, means = [], [], []
        for place, row in enumerate(run.rows):
            known = 100 * _known(row.at(row.npe, rung))
            if known.size:  # who gave no numbers keeps the place
                draw.box(ax, place, known, hue_of(row.method))
                shown.append(known)
                places.append(place)
                means.append(_rms(known))
        draw.dots(ax, places, means, "root mean square", "text", 4.0, "diamond")
        bound = run.bound_npe(rung)
        if bound:
            draw.level(ax, 100 * bound, "Cramér-Rao bound (rms)")
            shown.append(np.array([90 * bound, 110 * bound]))
        draw.magnitudes(ax, shown)
        draw.categories(ax, [row.label if rung is not None else _with_failures(row) for row in run.rows])
        draw.finish(ax, "", "NPE, continuous (%)", run.name_of(rung))
    return fig


def _with_failures(row: Row) -> str:
    return "\n".join([row.label, *(f"{count} of {row.runs} {status.replace('_', ' ')}" for status, count in sorted(row.failures.items()))])


def _variable(name: str) -> str:
    """ "torque noise" for noise.torque, "controller bandwidth" for controller.bandwidth."""
    name = f"{name.removeprefix('noise.')} noise" if name.startswith("noise.") else name
    return name.replace(".", " ").replace("_", " ")


def ladder(run: Run) -> Sheet | None:
    """Rms parameter error against what the suite's ladder climbs."""
    names = run.facts["rungs"]["names"]
    if run.values.size < 2 or not run.rows:
        return None
    errors = [np.array([100 * _rms(row.at(row.npe, rung)) for rung in run.rungs]) for row in run.rows]
    if not any(np.isfinite(one).any() for one in errors):
        return None
    variable = _variable(run.facts["rungs"]["variable"])
    silent = [rung for rung in run.rungs if not any(np.isfinite(one[rung]) for one in errors)]
    said = ", ".join(_range_text(row.label, one, names) for row, one in zip(run.rows, errors))
    found = (f"Rms NPE in the best and the worst variant: {said}." if names else f"Rms NPE from the first rung of {variable} to the last: {said}.")
    found += "".join(f" No identifier gives numbers in {names[rung] if names else significant(float(run.values[rung]))}." for rung in silent)
    fig = Sheet("ladder", "Parameter error in each variant" if names else f"Parameter error against {variable}",
                f"{run.suite}: root mean squares of {run.finished // run.values.size} realizations at each", found)
    ax = fig.panels((370, [1]))[0]
    methods = [row.method for row in run.rows]
    for i, (row, one) in enumerate(zip(run.rows, errors)):
        hue, dash, marker = look_of(methods, i)
        draw.line(ax, run.values, one, row.label, hue, 1.8, dash)
        draw.dots(ax, run.values, one, "", hue, 3.0, marker)
    shown = list(errors)
    bound = _bound_by_rung(run)
    if np.isfinite(bound).any():
        draw.line(ax, run.values, bound, "Cramér-Rao bound (rms)", "text", 1.2, "dashed")
        shown.append(bound)
    draw.magnitudes(ax, shown)
    for rung in silent:
        ax.text(run.values[rung], 0.5, "no numbers", transform=ax.get_xaxis_transform(), ha="center", va="center")
    if names:
        draw.categories(ax, names)
    elif run.values.min() > 0 and run.values.max() > 10 * run.values.min():
        draw.logarithmic(ax, "x")
    unit = unit_text(run.facts["rungs"]["unit"])
    draw.finish(ax, "" if names else variable + (f" ({unit})" if unit else ""), "rms NPE, continuous (%)")
    return fig


def _range_text(label: str, errors: np.ndarray, names: list[str]) -> str:
    if not names:
        return f"{label} {significant(errors[0])} to {significant(errors[-1])} %"
    if not np.isfinite(errors).any():
        return f"{label} none"
    best, worst = int(np.nanargmin(errors)), int(np.nanargmax(errors))
    return f"{label} {significant(errors[best])} % ({names[best]}) to {significant(errors[worst])} % ({names[worst]})"


def _bound_by_rung(run: Run) -> np.ndarray:
    """The rms NPE at the bound of each rung, per cent, over the realizations where it is known; NaN where it never is."""
    row = run.rows[0]
    if not row.parameters:
        return np.full(run.values.size, np.nan)
    squares = sum((100 * column.bound / column.truth) ** 2 for column in row.parameters)
    return np.array([_rms(np.sqrt(row.at(squares, rung))) for rung in run.rungs])


def error_by_iteration(run: Run) -> Sheet | None:
    """NPE and RMSE by iteration, as in the paper's Fig. 6; identifiers that do not iterate as levels."""
    iterating = [row for row in run.rows if row.trace.iteration.size > 1]
    if not iterating:
        return None
    # medians are compared with a median; variants have a bound each
    bound = _median_norm(run.covariance) if run.covariance is not None and run.values.size < 2 else None
    ends = []
    for row in run.rows:
        traces = row.trace.values.get("npe_continuous")
        last = _median(traces[:, -1] if traces is not None else row.npe)
        if np.isfinite(last):
            ends.append(f"{row.label} {significant(100 * last)} %")
    if bound:
        ends.append(f"median at the Cramér-Rao bound {significant(bound)} %")
    one = run.finished == 1
    fig = Sheet("error_by_iteration", "Parameter error and fit by iteration",
                f"{run.suite}: {run.finished} realization{'' if one else 's; lines are medians, bands reach from quartile to quartile'}",
                f"{'NPE' if one else 'Median NPE'} after the last iteration: {', '.join(ends)}.")
    left, right = fig.panels((365, [1, 1]))
    span = min(row.trace.iteration[0] for row in iterating), max(row.trace.iteration[-1] for row in iterating)
    _traces(left, run, "npe_continuous", lambda row: row.npe, 100, span, (bound, "median at the Cramér-Rao bound"))
    draw.finish(left, "iteration", "NPE, continuous (%)", "Normalised parameter error")
    _traces(right, run, "rmse", lambda row: row.rmse, 1, span, (run.noise, "noise"))
    draw.finish(right, "iteration", f"RMSE ({run.torque_unit})", "Root mean square error of the fit")
    return fig


def _traces(ax: Any, run: Run, name: str, finals: Any, factor: float, span: tuple[float, float], mark: tuple[float | None, str]) -> None:
    shown, methods = [], [row.method for row in run.rows]
    lines = []
    for i, row in enumerate(run.rows):
        if row.trace.iteration.size > 1:
            x, (low, middle, high) = row.trace.iteration, quartiles(factor * row.trace.values[name])
        else:
            own = row.trace.values[name][:, 0] if row.trace.iteration.size else finals(row)
            if not np.isfinite(own).any():
                continue
            x = np.array(span)
            low, middle, high = (np.full(2, value) for value in quartiles(factor * own))
        hue, dash, _ = look_of(methods, i)
        if (high > low).any():
            draw.band(ax, x, low, high, "", hue)
        lines.append((x, middle, row.label, hue, dash))
        inside = (x >= max(1, span[0])) if span[1] > 100 else np.ones(x.size, bool)
        shown += [low[inside], high[inside]]
    for x, middle, label, hue, dash in lines:
        draw.line(ax, x, middle, label, hue, 1.8, dash)
    if mark[0]:
        draw.level(ax, mark[0], mark[1])
        shown.append(np.array([mark[0] / 1.2, mark[0] * 1.1]))
    draw.magnitudes(ax, shown)
    draw.whole_numbers(ax)


def _median_norm(covariance: np.ndarray) -> float:
    """Median of |x| of a normal x with that covariance, by 20001 draws that are always the same: known to 1 %. Where it is the bound of relative
    errors, the median NPE of an estimator that stands at it."""
    normal = np.random.default_rng(1).standard_normal((20001, len(covariance)))
    return float(np.median(np.linalg.norm(normal @ np.linalg.cholesky(covariance).T, axis=1)))


def parameters_by_iteration(run: Run) -> Sheet | None:
    """Parameters of all realizations by iteration, as in the paper's Fig. 5, of the row with the longest trace."""
    row = max(run.rows, key=lambda one: one.trace.iteration.size, default=None)
    if row is None or row.trace.iteration.size < 2:
        return None
    columns = [column for column in row.parameters if np.isfinite(row.trace.values.get(column.name, np.nan)).any()]
    if not columns:
        return None
    count = len(row.trace.values["rmse"])
    said = ", ".join(f"{column.name} {significant(_median(row.trace.values[column.name][:, -1]))} (truth {significant(_median(column.truth))})"
                     for column in columns)
    drawn = "one trace" if count == 1 else "bands hold most of their traces" if count > FEW else "each thin line is one"
    fig = Sheet("parameters_by_iteration", f"Parameters by iteration: {row.label}", run.about(drawn),
                f"{'Values' if count == 1 else 'Medians'} after the last iteration: {said}.")
    # the last stands alone in its row where their number is odd
    axes = fig.panels(*[(255.0, [1.0] * min(2, len(columns) - at)) for at in range(0, len(columns), 2)])
    for ax, column in zip(axes, columns):
        _parameter(ax, row, column, row.trace.values[column.name])
        draw.finish(ax, "iteration", run.symbols.of(column.name) + (f" ({column.unit})" if column.unit else ""), run.symbols.with_name(column.name))
    return fig


def _parameter(ax: Any, row: Row, column: Column, values: np.ndarray) -> None:
    x, count = row.trace.iteration, len(values)
    if count > FEW:
        for outer, label, opacity in ((0.1, "middle 80 %", 0.15), (0.25, "middle half", 0.5)):
            low, high = quantiles(values, (outer, 1 - outer))
            draw.band(ax, x, low, high, label, "grey", opacity)
    elif count > 1:
        gaps = np.full((count, 1), np.nan)
        draw.line(ax, np.tile(np.append(x, np.nan), count), np.hstack([values, gaps]).ravel(), "realizations", "grey", 0.7)
    draw.line(ax, x, quartiles(values)[1], "median" if count > 1 else row.label, hue_of(row.method), 2.2)
    draw.level(ax, _median(column.truth), "truth")
    draw.whole_numbers(ax)
    # single wild ones leave the panel
    inside = values[:, x >= ax.get_xlim()[0]]
    low, high = quantiles(inside, (0.1, 0.9))
    ends = min(np.nanmin(low), np.nanmin(column.truth)), max(np.nanmax(high), np.nanmax(column.truth))
    spare = 0.05 * (ends[1] - ends[0]) or 0.1 * abs(ends[0]) or 1
    ax.set_ylim(ends[0] - spare, ends[1] + spare)


def agreement(run: Run) -> Sheet | None:
    """Fit, FPE, RMSE and MAE of each identifier, as in the paper's Figs. 11 and 12. Of each variant Fit and RMSE."""
    rows = [row for row in run.rows if np.isfinite(row.rmse).any()]
    if not rows:
        return None
    one = run.finished == len(run.rungs)
    clauses = []
    for rung in run.rungs:
        said = ", ".join(f"{row.label} fits {_median(row.at(row.fit, rung)):.1f} % with RMSE {significant(_median(row.at(row.rmse, rung)))} "
                         f"{run.torque_unit}" for row in rows)
        clauses.append((f"with {run.name_of(rung)} " if rung is not None else "") + said)
    fig = Sheet("agreement", "Agreement with the data", run.about("bars are its numbers" if one else "bars are medians, dark lines reach from "
                "quartile to quartile", each=True), f"{'' if one else 'Medians: '}{'; '.join(clauses)}.")
    square = "N²·m²" if run.torque_unit == "N·m" else run.torque_unit + "²"
    panels = []
    for rung in run.rungs:
        name = f"{run.name_of(rung)}: " if rung is not None else ""
        panels.append((rung, "fit", f"{name}Fit", "Fit (%)"))
        panels += [(rung, "fpe", "Final prediction error", f"FPE ({square})")] * (rung is None)
        panels.append((rung, "rmse", f"{name}Root mean square error", f"RMSE ({run.torque_unit})"))
        # what FPE and MAE say, Fit and RMSE of many rungs have said
        panels += [(rung, "mae", "Mean absolute error", f"MAE ({run.torque_unit})")] * (rung is None)
    across = 1 if len(rows) > BESIDE else 2
    axes = fig.panels(*[(245.0, [1.0] * across)] * (len(panels) // across))
    for ax, (rung, key, title, name) in zip(axes, panels):
        _bars(ax, rows, [row.at(getattr(row, key), rung) for row in rows])
        draw.finish(ax, "", name, title)
    return fig


def _bars(ax: Any, rows: list[Row], values: list[np.ndarray]) -> None:
    tops = []
    for place, (row, own) in enumerate(zip(rows, values)):
        known = _known(own)
        if not known.size:
            continue
        low, middle, high = quartiles(known)
        # bars of one identifier are told apart by how faint they are
        draw.bar(ax, place, float(middle), "", hue_of(row.method), 0.6 ** sum(one.method == row.method for one in rows[:place]))
        if known.size > 1:
            draw.line(ax, [place, place], [low, high], "", "text", 1.4)
        tops.append(float(max(middle, high)))
        ax.annotate(plain_number(float(middle), 4), (place, max(middle, high, 0)), (0, 4), textcoords="offset points", ha="center",
                    fontsize=draw.look()["scale"] * draw.TICK)
    ax.set_ylim(0, 1.16 * max([*tops, 1e-300]))
    draw.categories(ax, [row.label for row in rows])


def _share_interval(hits: int, tries: int) -> tuple[float, float]:
    """95 % interval of a share (Wilson 1927), per cent."""
    z, share = 1.96, hits / tries
    centre = (share + z * z / (2 * tries)) / (1 + z * z / tries)
    reach = z * np.sqrt(share * (1 - share) / tries + z * z / (4 * tries * tries)) / (1 + z * z / tries)
    return 100 * max(0.0, centre - reach), 100 * min(1.0, centre + reach)


def coverage(run: Run) -> Sheet | None:
    """How often 95 % intervals hold the truth."""
    rows = [row for row in run.rows if any(column.intervals for column in row.parameters)]
    names = list(dict.fromkeys(column.name for row in rows for column in row.parameters if column.intervals))
    if not rows:
        return None
    said = []
    for row in rows:
        shares = [100 * column.covered / column.intervals for column in row.parameters if column.intervals]
        said.append(f"those of {row.label} hold the truth in {min(shares):.0f} to {max(shares):.0f} % of the runs, by parameter")
    fig = Sheet("coverage", "Do 95 % intervals hold the truth?",
                run.about("dots: share of intervals that contain the truth; bars: 95 % interval of that share"), f"95 % intervals: {', '.join(said)}.")
    ax = fig.panels((360, [1]))[0]
    methods, lowest = [row.method for row in rows], 90.0
    for i, row in enumerate(rows):
        hue, _, marker = look_of(methods, i)
        given = [column for column in row.parameters if column.intervals]
        x = [names.index(column.name) + 0.16 * (i - (len(rows) - 1) / 2) for column in given]
        for at, column in zip(x, given):
            ends = _share_interval(column.covered, column.intervals)
            draw.line(ax, [at, at], ends, "", hue, 1.5)
            lowest = min(lowest, ends[0])
        draw.dots(ax, x, [100 * column.covered / column.intervals for column in given], row.label, hue, 4.0, marker)
    draw.level(ax, 95, "95 %")
    ax.set_ylim(max(0.0, lowest - 4), 100)
    for drawn in ax.lines:  # marks at 100 stand whole
        drawn.set_clip_on(drawn.get_marker() == "None" or not len(drawn.get_xdata()))
    draw.categories(ax, [draw.math_text(run.symbols.of(name)) for name in names])
    draw.finish(ax, "parameter", "intervals that hold the truth (%)")
    return fig


def parameter_pairs(run: Run) -> Sheet | None:
    """Errors of pairs of parameters with their 95 % ellipses and that of the Cramér-Rao bound, of the row with the lowest median error that
    estimates all."""
    complete = [(row, errors) for row in run.rows if len(row.parameters) > 1 and len(errors := _errors(row)) >= 5]
    if not complete:
        return None
    row, errors = min(complete, key=lambda one: _median(one[0].npe))
    covariance = np.cov(errors, rowvar=False)
    together = covariance / np.sqrt(np.outer(np.diag(covariance), np.diag(covariance)))
    pairs = [(a, b) for a in range(errors.shape[1]) for b in range(a + 1, errors.shape[1])]
    a, b = max(pairs, key=lambda pair: abs(together[pair]))
    fig = Sheet("parameter_pairs", f"Errors of pairs of parameters: {row.label}", run.about("each dot is one of them"),
                f"Errors of {row.parameters[a].name} and {row.parameters[b].name} go together most: correlation {significant(together[a, b], 2)}.")
    across = 3 if len(pairs) > 2 else 1
    axes = fig.panels(*[(320.0, [1.0] * min(across, len(pairs) - at)) for at in range(0, len(pairs), across)])
    reach = np.abs(errors).max()
    for k, (ax, (a, b)) in enumerate(zip(axes, pairs)):
        named = (lambda label: label) if k == 0 else (lambda label: "")  # the first panel has the legend of all
        own = covariance[np.ix_((a, b), (a, b))]
        draw.dots(ax, errors[:, a], errors[:, b], named("realizations"), hue_of(row.method), 2.2)
        ellipse = _ellipse(errors[:, (a, b)].mean(axis=0), own)
        draw.line(ax, ellipse[0], ellipse[1], named("their 95 % ellipse"), hue_of(row.method), 1.6)
        reach = max(reach, np.abs(ellipse).max())
        if run.covariance is not None and len(run.covariance) == errors.shape[1]:
            bound = _ellipse(np.zeros(2), run.covariance[np.ix_((a, b), (a, b))])
            draw.line(ax, bound[0], bound[1], named("Cramér-Rao bound"), "text", 1.6, "dashed")
            reach = max(reach, np.abs(bound).max())
        draw.finish(ax, f"error of {run.symbols.of(row.parameters[a].name)} (%)", f"error of {run.symbols.of(row.parameters[b].name)} (%)")
    for ax in axes:  # one scale for all, so that their ellipses compare
        ax.set(xlim=(-1.04 * reach, 1.04 * reach), ylim=(-1.04 * reach, 1.04 * reach))
    return fig


def _errors(row: Row) -> np.ndarray:
    """Relative errors per cent, of realizations with all parameters. [n, d]"""
    errors = np.column_stack([100 * (column.estimate - column.truth) / np.abs(column.truth) for column in row.parameters])
    return errors[np.isfinite(errors).all(axis=1)]


def _ellipse(centre: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Outline of the 95 % ellipse, [2, 121]."""
    turn = np.linspace(0, 2 * np.pi, 121)
    return centre[:, np.newaxis] + REACH95 * np.linalg.cholesky(covariance) @ np.array([np.cos(turn), np.sin(turn)])
