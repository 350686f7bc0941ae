#!/usr/bin/env python3
"""Some 250 stores that were changed after their run, in rows, schema and bytes. stores.py WARMJOINT

Each is read by compare and taken further by merge or run. Nothing may crash or hang, every refusal is one line that names the
store, and what a command refuses it leaves as it was. A value that was edited is not noticed."""

import os
import shutil
import sqlite3
import sys

from attack import Attack, suite

TABLES = {
    "suite": ["yaml"], "version": ["name", "value"], "realization": ["variant", "realization", "seconds"],
    "result": ["variant", "realization", "identifier", "status", "message", "seconds", "n", "parameters", "effective_parameters",
               "rmse", "mae", "fit", "fpe", "npe_continuous", "npe_discrete", "bound_npe_continuous", "bound_npe_discrete"],
    "parameter": ["variant", "realization", "identifier", "discrete", "position", "name", "truth", "estimate", "estimated",
                  "covered", "bound"],
    "trace": ["columns", "float32"],
}
VALUES = ["NULL", "-1", "1000", "2147483648", "-9223372036854775808", "0.5", "1e308", "9e999", "''", "'x'", "x'00ff'",
          "'&a [*a]'", "char(27) || '[31m'", "zeroblob(100000)", "'=1+1'"]
STATEMENTS = [
    *(f"DELETE FROM {table}" for table in TABLES), *(f"DROP TABLE {table}" for table in TABLES),
    *(f"ALTER TABLE {table} ADD COLUMN more" for table in TABLES), *(f"ALTER TABLE {table} RENAME TO other" for table in TABLES),
    "CREATE VIEW v AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT x FROM c",
    "DROP TABLE trace; CREATE VIEW trace AS SELECT 1", "CREATE TRIGGER t AFTER INSERT ON result BEGIN DELETE FROM result; END",
    "CREATE TABLE more(a)", "CREATE INDEX i ON result(rmse)", "PRAGMA user_version = 1", "PRAGMA user_version = 99",
    "PRAGMA application_id = 7", "PRAGMA journal_mode = WAL", "PRAGMA writable_schema = 1; UPDATE sqlite_schema SET sql = 'x'",
    "DELETE FROM parameter WHERE realization = 1", "DELETE FROM realization WHERE realization = 1",
    "INSERT INTO realization VALUES (0, 500, 1)", "UPDATE realization SET realization = realization + 10",
]


def make(attack):
    attack.file("t.yaml", suite("[{name: nominal-ls}, {name: energy-als, options: {iterations: 3}}]"))
    for i in (1, 2):
        attack.run(["run", "t.yaml", "-o", f"S{i}", "--shard", f"{i}/2"])
    attack.run(["merge", "S1", "S2", "-o", "GOOD"])
    if not (attack.work / "GOOD" / "results.sqlite").exists():
        sys.exit("the run to attack could not be made")


def tampered(attack, statement):
    """Whether the statement changed the store R, a fresh copy; what the tables' own types refuse is no attack."""
    shutil.rmtree(attack.work / "R", ignore_errors=True)
    shutil.copytree(attack.work / "GOOD", attack.work / "R")
    database = sqlite3.connect(attack.work / "R" / "results.sqlite")
    try:
        before = list(database.iterdump())
        database.executescript(statement)
        database.commit()
        return list(database.iterdump()) != before or "PRAGMA" in statement or "VIEW" in statement
    except (sqlite3.Error, OverflowError):
        return "writable_schema" in statement
    finally:
        database.close()


def judge(attack, name):
    listing = sorted(os.listdir(attack.work / "R"))
    attack.expect(f"compare: {name}", ["compare", "R"], (0, 2), "R")
    attack.count -= 2  # one attack, seen by three commands
    attack.expect(f"merge: {name}", ["merge", "R", "-o", "M"], (0, 2, 5), "R")
    attack.expect(f"run: {name}", ["run", "t.yaml", "-o", "R"], (0, 2, 5), "R")
    if sorted(os.listdir(attack.work / "R")) != listing:
        attack.fault(name, f"the run left {os.listdir(attack.work / 'R')}")


def rows(attack):
    for table, columns in TABLES.items():
        for column in columns:
            for value in VALUES:
                statement = f"UPDATE {table} SET {column} = {value}"
                if tampered(attack, statement):
                    judge(attack, statement)
    for statement in STATEMENTS:
        if tampered(attack, statement):
            judge(attack, statement)


def bytes_of_files(attack):
    good = (attack.work / "GOOD" / "results.sqlite").read_bytes()
    for size in (0, 1, 15, 16, 100, 1000, 4096, 5000, len(good) - 1):
        tampered(attack, "")
        (attack.work / "R" / "results.sqlite").write_bytes(good[:size])
        judge(attack, f"cut to {size}")
    for text in (b"hello", bytes(100_000), good[::-1], b"SQLite format 3\x00" + bytes(5000)):
        tampered(attack, "")
        (attack.work / "R" / "results.sqlite").write_bytes(text)
        judge(attack, f"it is {text[:8]!r}")
    for i in range(30):
        # a page's bytes turned round, at places spread over the file
        at = (i * 7919) % len(good)
        tampered(attack, "")
        (attack.work / "R" / "results.sqlite").write_bytes(good[:at] + bytes(255 - b for b in good[at:at + 8]) + good[at + 8:])
        judge(attack, f"bytes at {at}")


def main():
    with Attack(sys.argv[1], 250) as attack:
        make(attack)
        rows(attack)
        bytes_of_files(attack)


if __name__ == "__main__":
    main()
