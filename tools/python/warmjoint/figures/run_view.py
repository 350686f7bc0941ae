"""A run of a suite, read from its database: plain numbers, one row an identifier."""

from __future__ import annotations

import dataclasses
import sqlite3
from typing import Any

import numpy as np

from .numerals import Symbols, unit_text

MOST_DRAWN = 20000  # realizations that pictures are drawn of; of a longer run, every second, third, ...
MOST_TRACES = 2000  # realizations whose trace is drawn, the first ones
MOST_LISTED, MOST_FAILURES = 2000, 500  # answers that a page lists, and failures besides


@dataclasses.dataclass
class Column:
    """One parameter of the truth and what one identifier made of it, [R]; NaN where there is no answer."""

    name: str
    unit: str
    estimate: np.ndarray  # NaN where it was not estimated
    truth: np.ndarray
    bound: np.ndarray  # Cramér-Rao standard deviation
    intervals: int = 0  # of all realizations: 95 % intervals that were given
    covered: int = 0  # and those of them that hold the truth


@dataclasses.dataclass
class Trace:
    """Of an identifier that iterates: K iterations of R realizations. One that stopped early keeps its last values."""

    iteration: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(0))  # [K]
    values: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)  # [R, K]: npe_continuous, rmse, parameters


@dataclasses.dataclass
class Row:
    """One identifier. Columns are [R], by realization that is drawn."""

    label: str
    method: str
    runs: int  # all, drawn or not
    failures: dict[str, int]
    variant: np.ndarray
    npe: np.ndarray  # 0.01 is 1 %
    rmse: np.ndarray
    fit: np.ndarray
    fpe: np.ndarray
    mae: np.ndarray
    parameters: list[Column]
    trace: Trace
    by_minute: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros((0, 0)))  # [R, K] of a compensator, per cent

    @property
    def failed(self) -> int:
        return sum(self.failures.values())

    def at(self, values: np.ndarray, rung: int | None) -> np.ndarray:
        """NaN but at a variant's realizations."""
        return values if rung is None else np.where(self.variant == rung, values, np.nan)


class Run:
    """facts: of RunFacts (tools/shown/run/run_data.h)."""

    def __init__(self, facts: dict[str, Any], rows: list[Row] | None = None, most_drawn: int = MOST_DRAWN) -> None:
        self.facts, self.suite = facts, facts["suite"]
        self.parameters = facts["parameters"]
        self.symbols = Symbols([(name, symbol) for name, (symbol, _) in self.parameters.items()])
        self.torque_unit = unit_text(facts["torque_unit"])
        self.board = facts["board"]
        self.finished = self.board["realizations"]
        self.compensates = any(row.get("measures") for row in self.board.get("rows", ()))
        self.values = np.array(facts["rungs"]["values"], float)
        self.noise = facts["noise"]
        units = facts["realizations"] * max(1, self.values.size)
        self.every = _prime_distance(units, most_drawn)
        self.rows = _rows_of(self) if rows is None else rows
        bound = facts["bound"]
        complete = next((row for row in self.rows if row.parameters), None)
        self.covariance = _relative(bound, complete.parameters) if complete else None

    @property
    def rungs(self) -> list[int | None]:
        """The suite's variants where it has several, none alone where it has not: what is measured under different noise is not put together."""
        return list(range(self.values.size)) if self.values.size > 1 else [None]

    def name_of(self, rung: int | None) -> str:
        names, ladder = self.facts["rungs"]["names"], self.facts["rungs"]
        if rung is None:
            return ""
        return names[rung] if names else f"{ladder['variable']} {self.values[rung]:g} {unit_text(ladder['unit'])}"

    def bound_npe(self, rung: int | None) -> float | None:
        """rms continuous NPE at the Cramér-Rao bound, 0.01 is 1 %."""
        part = self.board if rung is None else self.board["groups"][rung] if rung < len(self.board.get("groups", ())) else {}
        return ((part.get("bound_npe") or {}).get("continuous") or {}).get("rms")

    def about(self, more: str, each: bool = False) -> str:
        """For a subtitle. each: the figure shows every variant by itself."""
        count = len(self.rungs)
        if each and count > 1:
            return f"{self.suite}: {self.finished // count} realizations of each variant; {more}"
        return (f"{self.suite}: {self.finished} realization{'' if self.finished == 1 else 's'}"
                f"{f' of all {count} variants together' if count > 1 else ''}{f', one in {self.every} drawn' if self.every > 1 else ''}; {more}")


def _prime_distance(units: int, most: int) -> int:
    """The smallest distance, 1 or a prime, at which at most about `most` are taken: realizations so far apart share no period of a run."""
    distance = max(1, -(-units // most))
    while any(distance % d == 0 for d in range(2, int(distance**0.5) + 1)):
        distance += 1
    return distance


def _relative(bound: np.ndarray, columns: list[Column]) -> np.ndarray | None:
    """Covariance of the relative errors in per cent: sizes are those of the bounds of all realizations, correlations those of `bound`."""
    if bound.shape != (len(columns), len(columns)) or not len(columns):
        return None
    truths = np.array([column.truth for column in columns])
    sizes = 100 * np.sqrt([np.mean(column.bound**2) / np.mean(column.truth**2) for column in columns])
    if not np.isfinite(sizes).all() or not (np.abs(truths) > 0).all():
        return None
    scale = sizes / np.sqrt(np.diag(bound))
    return bound * np.outer(scale, scale)


def open_database(path: str) -> sqlite3.Connection:
    """To read it; nothing of the file's own schema acts."""
    from urllib.parse import quote

    database = sqlite3.connect(f"file:{quote(path)}?mode=ro", uri=True)
    database.execute("PRAGMA trusted_schema = OFF")
    return database


def _rows_of(run: Run) -> list[Row]:
    database = open_database(run.facts["database"])
    try:
        return [_row_of(database, run, i, one) for i, one in enumerate(run.facts["identifiers"])]
    finally:
        database.close()


def _numbers(rows: list[tuple[Any, ...]], width: int) -> np.ndarray:
    return np.array([[np.nan if value is None else value for value in row] for row in rows], float).reshape(-1, width)


def _row_of(database: sqlite3.Connection, run: Run, identifier: int, named: dict[str, str]) -> Row:
    failures = dict(database.execute("SELECT status, count(*) FROM result WHERE identifier = ? AND status != 'ok' GROUP BY status", (identifier,)))
    runs = database.execute("SELECT count(*) FROM result WHERE identifier = ?", (identifier,)).fetchone()[0]
    drawn = _numbers(database.execute(
        "SELECT variant, realization, npe_continuous, rmse, fit, fpe, mae FROM result WHERE identifier = ? AND realization % ? = 0 "
        "ORDER BY variant, realization", (identifier, run.every)).fetchall(), 7)
    places = {(int(variant), int(realization)): i for i, (variant, realization) in enumerate(drawn[:, :2])}
    columns: dict[str, Column] = {}
    counts = database.execute("SELECT name, count(covered), sum(covered) FROM parameter WHERE identifier = ? AND discrete = 0 GROUP BY name "
                              "ORDER BY min(position)", (identifier,))
    for name, intervals, covered in counts.fetchall():
        estimate, truth, bound = np.full((3, len(drawn)), np.nan)
        columns[name] = Column(name, unit_text(run.parameters.get(name, ("", ""))[1]), estimate, truth, bound, intervals, covered or 0)
    for name, variant, realization, truth, estimate, estimated, bound in database.execute(
            "SELECT name, variant, realization, truth, estimate, estimated, bound FROM parameter WHERE identifier = ? AND discrete = 0 AND "
            "realization % ? = 0", (identifier, run.every)):
        at, column = places[variant, realization], columns[name]
        column.truth[at], column.bound[at] = (np.nan if value is None else value for value in (truth, bound))
        if estimated and estimate is not None:
            column.estimate[at] = estimate
    tables = _tables_of(database, identifier, list(places)[:MOST_TRACES])
    trace, by_minute = (Trace(), _minutes_of(tables)) if run.compensates else (_trace_of(tables), np.zeros((0, 0)))
    npe, rmse, fit, fpe, mae = drawn[:, 2:].T.copy()
    return Row(named["label"], named["method"], runs, failures, drawn[:, 0].astype(int), npe, rmse, fit, fpe, mae, list(columns.values()), trace, by_minute)


Tables = list[tuple[list[str], np.ndarray]]


def _tables_of(database: sqlite3.Connection, identifier: int, units: list[tuple[int, int]]) -> Tables:
    """The columns of each realization and their numbers, [K, columns]."""
    tables = []
    for variant, realization in units:
        found = database.execute("SELECT columns, float32 FROM trace WHERE variant = ? AND realization = ? AND identifier = ?",
                                 (variant, realization, identifier)).fetchone()
        names = found[0].split(",") if found else []
        tables.append((names, np.frombuffer(found[1], "<f4").reshape(-1, len(names)).astype(float) if found else np.zeros((0, 0))))
    return tables


def _minutes_of(tables: Tables) -> np.ndarray:
    """[R, K]; NaN of one that has no numbers."""
    found = np.full((len(tables), max((len(table) for _, table in tables), default=0)), np.nan)
    for i, (names, table) in enumerate(tables):
        if len(table):
            found[i, :len(table)] = table[:, names.index("residual")]
    return found


def _trace_of(tables: Tables) -> Trace:
    longest_names, longest = max(tables, key=lambda table: len(table[1]), default=([], np.zeros((0, 0))))
    if not len(longest):
        return Trace()
    values = {name: np.full((len(tables), len(longest)), np.nan) for name in longest_names if name != "iteration"}
    for i, (names, table) in enumerate(tables):
        for name in names if len(table) else ():
            if name in values:  # one that stopped keeps its last values
                values[name][i] = np.concatenate([table[:, names.index(name)], np.full(len(longest) - len(table), table[-1, names.index(name)])])
    return Trace(longest[:, longest_names.index("iteration")], values)


def listing_of(run: Run) -> tuple[int, list[dict[str, Any]]]:
    """Every answer of a short run; of a longer one realizations 0, n, 2 n, ... and the first failures besides. (n, answers)"""
    count = len(run.facts["identifiers"])
    every = _prime_distance(run.facts["realizations"] * max(1, run.values.size) * count, MOST_LISTED)
    answers, failures = [], 0
    database = open_database(run.facts["database"])
    try:
        for variant, realization, identifier, status, npe, rmse, fit in database.execute(
                "SELECT variant, realization, identifier, status, npe_continuous, rmse, fit FROM result ORDER BY variant, realization, identifier"):
            in_turn = realization % every == 0
            failures += not in_turn and status != "ok"
            if in_turn or (status != "ok" and failures <= MOST_FAILURES):
                answers.append({"variant": variant, "realization": realization, "identifier": identifier, "status": status, "npe": npe, "rmse": rmse,
                                "fit": fit})
    finally:
        database.close()
    return every, answers
