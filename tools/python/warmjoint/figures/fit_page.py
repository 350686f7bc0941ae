"""The story of one recording on one page: verdict, parameters, data with fit, the law, and what the residuals show."""

from __future__ import annotations

from typing import Any

from . import along_log, friction, residuals
from . import sheet as draw
from .numerals import range_text, significant, to_digits_of, unit_text
from .sheet import PAGE, Sheet
from .view import VERDICTS, Answer, View

MEMORY = 0.3  # correlation that is worth a word


def warnings_of(view: View) -> list[str]:
    """What a reader must know before using numbers that passed; empty where the verdict is a failure, which says it all."""
    if not view.passed:
        return []
    found = list(view.facts["warnings"])
    alike = residuals.correlation(view, 1) if view.has_fit else 0
    if alike > MEMORY:
        found.append(f"residuals are alike from one sample to the next (correlation {alike:.2f}): something in the torque is not in the model")
    return found


def verdict(view: View) -> str:
    """In one sentence, without its stop."""
    count = len(warnings_of(view))
    beside = "" if not count else ", with a warning" if count == 1 else f", with {count} warnings"
    return f"{view.identifier}: {VERDICTS[view.status]}{beside}"


def sentence(text: str) -> str:
    """With a capital and a stop."""
    return (text[:1].upper() + text[1:]).replace("N.m", "N·m").rstrip(".") + "."


def _agreement(metrics: dict[str, Any], unit: str) -> str:
    return f"Fit {metrics['fit']:.1f} %, RMSE {significant(metrics['rmse'])} {unit}, MAE {significant(metrics['mae'])} {unit}, {metrics['n']} samples."


def verdict_words(view: View) -> list[tuple[str, str, bool]]:
    """(text, hue, bold): verdict, what to beware of, why, agreement, data used."""
    warnings, facts = warnings_of(view), view.facts
    hue = "vermilion" if not view.passed else "caution" if warnings else "green"
    words = [(verdict(view) + ".", hue, True), *((f"Warning: {sentence(one)}", "caution", False) for one in warnings)]
    if facts["message"]:
        words.append((sentence(facts["message"]), "text", False))
    for name, key in (("", "metrics"), ("Held out: ", "holdout")):
        if facts[key]:
            words.append((name + _agreement(facts[key], view.torque_unit), "text", False))
    if facts["without_holdout"]:
        words.append((f"No held-out figures: {sentence(facts['without_holdout'])}", "text", False))
    moves = "move clearly" if view.any_motion else "move at a constant speed"
    words.append((f"{100 * view.count / view.time.size:.0f} % of the {view.time.size} samples {moves} and are kept.", "text", False))
    if view.taken_off:
        words.append((f"The torque that is shown is less {view.taken_off}.", "text", False))
    return words


def parameter_rows(answer: Answer, symbols: bool = True) -> list[list[str]]:
    """parameter, value, 95 % interval, unit; without a head."""
    rows = []
    for row in answer.facts["shown"]:
        interval = row.get("interval95")
        ends = " … ".join(to_digits_of(end, row.get("std")) for end in interval) if interval else "–"
        value = range_text(row["value"], interval) or to_digits_of(row["value"], row.get("std"))
        rows.append([answer.symbols.with_name(row["name"]) if symbols else row["name"], value, ends, unit_text(row["unit"])])
    return rows


def fit(view: View) -> Sheet:
    """Without a fit: what the data look like and why there is none."""
    found = verdict(view)
    if view.facts["metrics"]:
        found += f"; fit {view.facts['metrics']['fit']:.1f} %, RMSE {significant(view.facts['metrics']['rmse'])} {view.torque_unit}"
    fig = Sheet("fit", view.source, f"identified by {view.identifier}" if view.identifier else "", found + ".")
    words, rows = verdict_words(view), parameter_rows(view)
    share = PAGE / 2 if rows else PAGE
    head = max(draw.words_height(words, share), 30 + draw.TABLE_ROW * (len(rows) + 1) if rows else 0)
    layout: list[tuple[float, list[float]]] = [(head, [1, 1] if rows else [1]), (225, [1]), (215, [1, 1]), (240, [1, 1] if view.warms else [1])]
    evidence = _evidence(view) if view.has_fit else []
    if evidence:
        layout += [(210, [1, 1]), (210, [1] * sum(what in ("position", "velocity", "energy") for what, _ in evidence))]
        layout += [(210, [1])] * any(what == "motor_angle" for what, _ in evidence)
    axes = iter(fig.panels(*layout))

    draw.words(next(axes), "Verdict", words)
    if rows:
        draw.table(next(axes), "Parameters (void)" if view.void else "Parameters", [["parameter", "value", "95 % interval", "unit"], *rows])
    along_log.level_over_time(next(axes), view, "Level of friction over time" if view.has_fit else "Torque in the direction of motion")
    parts = along_log.window(view, "first"), along_log.window(view, "last")
    limits = along_log.torque_limits(view, *parts)
    for part, name in zip(parts, ("first segments", "last segments") if view.segments else ("beginning", "end")):
        along_log.close_up(next(axes), view, part, limits, f"The {name}")
    friction.over_velocity(next(axes), view, "Friction over velocity")
    if view.warms:
        friction.while_warming(next(axes), view, "Warm-up")
    for what, title in evidence:
        ax = next(axes)
        if what == "memory":
            residuals.memory(ax, view, title)
            continue
        residuals.over(ax, view, what, title)
        if "decided by" in title:
            for spine in ax.spines.values():
                spine.set(visible=True, color=draw.colour("vermilion"), linewidth=2 * draw.look()["scale"])
    return fig


def _evidence(view: View) -> list[tuple[str, str]]:
    """(over what, title) of panels of residuals; the one in which a test found the most says that it decided."""
    found = [test for test in view.facts["tests"] if test["rejected"]]
    strongest = max(found, key=lambda test: test["effect"])["over"] if found else ""
    titles = [("time", "Residuals over time, with their median"), ("memory", "Correlation of residuals over lag; within the dashed lines if white"),
              ("position", "Residuals over position"), ("velocity", "Residuals over velocity")]
    titles += [("energy", "Residuals over warmth")] * view.warms
    if view.motor_angle is not None and any(test["over"] == "motor_angle" for test in found):
        titles.append(("motor_angle", "Residuals over motor angle"))
    named = []
    for what, title in titles:
        tests = ", ".join(test["test"].replace("_", " ") for test in found if test["over"] == what)
        decided = what == strongest and not view.passed
        named.append((what, f"{title}: {'decided by' if decided else 'shows'} {tests}" if tests else title))
    return named
