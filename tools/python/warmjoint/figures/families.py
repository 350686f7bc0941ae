"""All figures by the kind of their source: a new one is a function and a line here."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from typing import Any

from . import along_log, compensation, designed, fit_page, friction, motor, residuals, robots, runs, steps
from .run_view import Run
from .sheet import Sheet
from .view import Answer, View


class Source:
    """What one source gives: facts of {kind, place, ...} (tools/cli/pictures.h), with views that figures share."""

    def __init__(self, facts: dict[str, Any]) -> None:
        self.kind, self.place, self.facts = facts["kind"], str(facts.get("place", "")), facts
        self.view = View(facts["fit"]) if facts.get("fit") else None
        self.held_out = View(facts["held_out"]) if facts.get("held_out") else None
        self.answer = Answer(facts["answer"]) if facts.get("answer") else None
        self.run = Run(facts) if self.kind == "run" else None

    def figures(self) -> dict[str, tuple[Callable[[], Sheet | None], str]]:
        """{name: (function, what a source without it lacks)}"""
        return {"estimate": _of_estimate, "simulation": _of_simulation, "run": _of_run, "kernels": _of_kernels, "robot": _of_robot, "design": _of_design}[self.kind](self)


Family = dict[str, tuple[Callable[[], "Sheet | None"], str]]


def _of(view: View | None, make: Callable[[View], Sheet | None]) -> Callable[[], Sheet | None]:
    return lambda: make(view) if view is not None else None


def _of_estimate(one: Source) -> Family:
    view, answer = one.view, one.answer
    steady = lambda: steps.envelope(view, one.facts["guess"]) if view else None
    return {
        "fit": (_of(view, fit_page.fit), "its recording"),
        "log": (_of(view, along_log.log), "its recording"),
        "predicted": (_of(view, residuals.predicted), "a fit"),
        "held_out": (_of(one.held_out, residuals.held_out), "figures on held-out samples of its own recording"),
        "friction_curve": (_of(view, friction.friction_curve), "a fit"),
        "hysteresis": (_of(view, along_log.hysteresis), "segments in both directions"),
        "warm_up": (_of(view, friction.warm_up), "a fit that warms"),
        "friction_over_place": (lambda: friction.friction_over_place(one.facts.get("places", {}), view.torque_unit) if view else None, "a friction that differs by place"),
        "trace": (lambda: steps.trace(answer, view.source if view else "") if answer else None, "an identifier that iterates"),
        "envelope": (steady, "a fit that warms, at constant speeds, without maps or gravity"),
        "motor_angle": (_of(view, motor.motor_angle), "a gear or the column motor_position"),
        "motor_map": (_of(view, motor.motor_map), "a map over the motor's angle"),
        "motor_fit": (_of(view, motor.motor_fit), "a map over the motor's angle"),
        "friction_map": (_of(view, motor.friction_map), "a map over position or the motor's angle"),
    }


def _of_simulation(one: Source) -> Family:
    view, scene = one.view, one.facts.get("robot")
    assert view is not None
    return {
        "envelope": (lambda: steps.envelope(view, one.facts["guess"], one.facts["name"]),
                     "friction that warms, at constant speeds, without maps or gravity"),
        "motor_angle": (_of(view, motor.motor_angle), "a gear"),
        "friction_map": (_of(view, motor.friction_map), "a map over position or the motor's angle"),
        "warm_robot": (lambda: robots.warm_robot(view, scene, one.facts["name"]) if scene else None, "a robot whose joint warms"),
    }


def _of_run(one: Source) -> Family:
    def made(function: Callable[[Run], Sheet | None]) -> Callable[[], Sheet | None]:
        return lambda: function(one.run) if one.run is not None else None

    if one.run is not None and one.run.compensates:
        return {"residual_by_minute": (made(compensation.residual_by_minute), "compensators")}
    return {
        "npe_boxes": (made(runs.npe_boxes), "answers with parameters"),
        "ladder": (made(runs.ladder), "a suite with a ladder"),
        "error_by_iteration": (made(runs.error_by_iteration), "an identifier that iterates"),
        "parameters_by_iteration": (made(runs.parameters_by_iteration), "an identifier that iterates"),
        "agreement": (made(runs.agreement), "answers"),
        "coverage": (made(runs.coverage), "answers with intervals"),
        "parameter_pairs": (made(runs.parameter_pairs), "an identifier whose errors are near the bound"),
    }


def _of_kernels(one: Source) -> Family:
    return {"kernels": (lambda: steps.kernels(one.facts), "")}


def _of_design(one: Source) -> Family:
    return {joint["file"]: (functools.partial(designed.design, joint), "") for joint in one.facts["joints"]}


def _of_robot(one: Source) -> Family:
    joints = one.facts["joints"]
    drawn: Family = {joint["file"]: (functools.partial(robots.joint, joint), "a fit") for joint in joints}
    # one sheet of all, unless a joint has its name
    if len(joints) > 1 and "all_joints" not in drawn:
        drawn["all_joints"] = (functools.partial(robots.all_joints, one.facts["robot"], joints), "fits")
    return drawn


# those of one panel, which can be drawn into axes of another figure
PANELS: dict[str, Callable[[Any, View], None]] = {"friction_curve": friction.over_velocity, "warm_up": friction.while_warming}

# a figure of the paper: ours that repeat it, and what they are drawn of
PAPER = {
    "3": (("kernels",), "`kernels`"), "4": (("envelope",), "an estimate or a simulation of a log that warms"),
    "5": (("parameters_by_iteration",), "a run of an identifier that iterates"),
    "6": (("error_by_iteration",), "a run of an identifier that iterates"),
    "7": (("motor_angle",), "an estimate of a log with a motor angle or a gear"),
    "8": (("parameters_by_iteration", "trace"), "a run, or an estimate, that iterates"),
    "9": (("motor_fit",), "an estimate with a map over the motor's angle"),
    "10": (("motor_map",), "an estimate with a map over the motor's angle"),
    "11": (("agreement",), "a run"), "12": (("agreement",), "a run"),
}


class Refusal(ValueError):
    """A figure that was asked for by name and cannot be had. place: of what."""

    def __init__(self, place: str, why: str) -> None:
        super().__init__(why)
        self.place = place


def chosen(source: Source, wanted: list[str]) -> Iterator[Sheet]:
    """The figures that are wanted by name or the paper's number, in the family's own order, each once. Raises Refusal."""
    family = source.figures()
    made: dict[str, Sheet | None] = {}
    names: set[str] = set()

    def there(name: str) -> bool:
        if name in family and name not in made:
            made[name] = family[name][0]()
        return made.get(name) is not None

    for one in wanted:
        own, of = PAPER.get(one, ((one,), ""))
        if not any([there(name) for name in own]):
            if one in PAPER:
                why = f"figure {one} of the paper ({' or '.join(own)}) needs {of}"
            else:
                why = f"{one} needs {family[one][1]}" if one in family else f"there is no figure '{one}'"
            has = [name for name in family if there(name)]
            raise Refusal(source.place, f"{why}; this source gives: {', '.join(has) or 'none'}")
        names |= set(own)
    for name in family:
        if name in names and (sheet := made.get(name)) is not None:
            yield sheet


def left_out(source: Source, lacking: list[str]) -> str:
    """Which figures of its family a source does not give, and why: those that need the same together."""
    family = source.figures()
    by_need: dict[str, list[str]] = {}
    for name in lacking:
        by_need.setdefault(family[name][1], []).append(name)
    return "; ".join(f"{', '.join(names)} ({'needs' if len(names) == 1 else 'need'} {need})" for need, names in sorted(by_need.items()))
