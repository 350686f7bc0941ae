#!/usr/bin/env python3
"""Whether 95 % intervals hold the truth in 95 of 100 logs: each cell of a run by an exact binomial test.

    tests/studies/coverage.py RUN [VARIANT:IDENTIFIER...]

RUN: a folder that `warmjoint run` made. A cell is one parameter of one identifier in one variant; with arguments only
those named. Prints for each identifier of each variant the answers that are ok, and for each parameter the mean error
and its rms over the Cramer-Rao bound and the coverage with its standard error; then the mean coverage over variants, the
worst cell, and the cells that differ from 95 % at a family error of 1 % (Holm, A simple sequentially rejective
multiple test procedure, 1979). Exit status 1 where there is one.
"""
import csv
import math
import sys
from pathlib import Path

LEVEL = 0.95
DERIVED = ("thermal_gain_discrete", "thermal_pole")  # of the gain and the time constant: no cells of their own
FAMILY_ERROR = 0.01


def log_probability(k, n):
    """Of k successes in n, binomial with LEVEL."""
    return (math.lgamma(n + 1) - math.lgamma(k + 1) - math.lgamma(n - k + 1) + k * math.log(LEVEL) +
            (n - k) * math.log(1 - LEVEL))


def two_sided(k, n):
    """Exact: the probability of all counts that are no likelier than k."""
    limit = log_probability(k, n) + 1e-9
    return min(1.0, sum(math.exp(p) for p in (log_probability(i, n) for i in range(n + 1)) if p <= limit))


class Cell:
    def __init__(self):
        self.errors, self.covered = [], []

    def add(self, row, name):
        if row.get(name + "_covered"):
            self.covered.append(int(row[name + "_covered"]))
        if row.get(name) and row.get(name + "_bound"):
            self.errors.append((float(row[name]) - float(row[name + "_truth"])) / float(row[name + "_bound"]))

    def text(self):
        parts = []
        if self.errors:
            mean = sum(self.errors) / len(self.errors)
            rms = math.sqrt(sum(e * e for e in self.errors) / len(self.errors))
            parts.append(f"{mean:+.2f} {rms:.2f}")
        if self.covered:
            n, share = len(self.covered), sum(self.covered) / len(self.covered)
            parts.append(f"{100 * share:.1f} +- {100 * math.sqrt(share * (1 - share) / n):.1f} %")
        return " ".join(parts)


def read(run, wanted):
    """{(variant, identifier): (answers ok, answers, {parameter: Cell})}"""
    groups = {}
    with (Path(run) / "results.csv").open() as file:
        for row in csv.DictReader(file):
            key = (row.get("variant", "-"), row["identifier"])
            if wanted and ":".join(key) not in wanted:
                continue
            ok, count, cells = groups.get(key, (0, 0, {}))
            for name in (column[:-len("_covered")] for column in row if column.endswith("_covered")):
                if name in DERIVED:
                    continue
                cells.setdefault(name, Cell()).add(row, name)
            groups[key] = ok + (row["status"] == "ok"), count + 1, cells
    return groups


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    groups = read(sys.argv[1], set(sys.argv[2:]))
    tested = []
    for (variant, identifier), (ok, count, cells) in groups.items():
        print(f"{variant} {identifier}: {ok} of {count} ok")
        for name, cell in cells.items():
            if not cell.covered:
                continue
            p = two_sided(sum(cell.covered), len(cell.covered))
            tested.append((p, variant, identifier, name, cell))
            print(f"    {name:28} {cell.text()}  p {p:.2g}")

    tested.sort(key=lambda one: one[0])
    shares = [sum(cell.covered) / len(cell.covered) for *_, cell in tested]
    print(f"\nmean coverage {100 * sum(shares) / len(shares):.2f} % over {len(tested)} cells; worst first:")
    differing = 0
    for rank, (p, variant, identifier, name, cell) in enumerate(tested):
        adjusted = p * (len(tested) - rank)
        if rank < 5 or (differing == rank and adjusted < FAMILY_ERROR):
            print(f"    {variant} {identifier} {name} {cell.text()}  p {p:.2g}, adjusted {min(adjusted, 1):.2g}")
        differing += differing == rank and adjusted < FAMILY_ERROR
    print(f"{differing} cells differ from {100 * LEVEL:.0f} % at a family error of {100 * FAMILY_ERROR:.0f} %")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
