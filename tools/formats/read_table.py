"""Tables of text and Excel as instruments export them: lines before the table, rows of units, a clock for each column."""

import io
import re
import sys

import numpy
import pandas
from columns import Refusal

PEEK = 400  # lines in which the table must begin
IN_A_ROW = 3  # rows of numbers that make a table
NUMBER = re.compile(r"[-+]?(\d+[.,]?\d*|[.,]\d+)([eE][-+]?\d+)?$")
UNIT = re.compile(r"[\[(]?[A-Za-z%°µ.*/^0-9·-]{1,8}[\])]?$")
CLOCK = re.compile(r"(time|zeit|x_value|x-value|timestamp|t)\b|name$", re.IGNORECASE)


def text_of(path):
    """Decoded by its mark, else as UTF-8, else as Windows has it."""
    data = path.read_bytes()
    for encoding in ("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig", "cp1252"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise Refusal(f"{path}: is no text; give .csv, .txt or .xlsx")


def is_number(cell):
    if isinstance(cell, str):
        return bool(NUMBER.match(cell.strip()))
    return isinstance(cell, (int, float, numpy.number)) and cell == cell


def is_empty(cell):
    return cell is None or cell != cell or (isinstance(cell, str) and not cell.strip())


def holds_samples(row):
    """Whether a row is of the table: a number or a stamp, and numbers behind it."""
    numbers, filled = sum(map(is_number, row)), sum(not is_empty(cell) for cell in row)
    return numbers >= 2 and numbers >= filled - 1 and not re.match(r"\s*[^-+.,\d\s]", str(row[0]))


def first_row(rows, place):
    """Index of the first of IN_A_ROW rows of samples with as many cells."""
    for i in range(len(rows) - IN_A_ROW + 1):
        block = rows[i:i + IN_A_ROW]
        if all(map(holds_samples, block)) and len({len(row) for row in block}) == 1:
            return i
    raise Refusal(f"{place}: holds no table of numbers in its first {PEEK} lines")


def names_of(rows, width):
    """A name for each column, by the rows above the table: with the unit of a row of units, as "pos [deg]"."""
    rows = [[str(cell).strip() if not is_empty(cell) else "" for cell in row] for row in rows]
    rows = [(row + [""] * width)[:width] for row in rows if sum(map(bool, row)) >= 2]
    if not rows:
        return [f"column[{i}]" for i in range(width)]
    named = next((row for row in reversed(rows) if row[0].lower() == "name"), None)  # channel by channel, as TwinCAT has it
    if named:
        return named
    last = rows[-1]
    units = len(rows) > 1 and all(UNIT.match(cell) for cell in last if cell) and sum(map(bool, rows[-2])) >= sum(map(bool, last))
    bracketed = all(cell[0] in "[(" for cell in last if cell)
    if not units or not (bracketed or any(cell in {"s", "ms", "us", "sec"} for cell in last)):
        return last
    return [f"{name} [{unit.strip('[]()')}]" if unit else name for name, unit in zip(rows[-2], last, strict=True)]


def numbers_of(column):
    """[N] of a column; stamps in s from the first; nothing where it holds neither."""
    values = pandas.to_numeric(column, errors="coerce")
    if values.notna().sum() >= column.notna().sum() > 0:
        return values.to_numpy(float)
    stamps = pandas.to_datetime(column.astype(str), errors="coerce", format="mixed")
    if stamps.notna().all():
        return (stamps - stamps.iloc[0]).dt.total_seconds().to_numpy()
    return None


def on_one_clock(place, columns):
    """Columns behind a second clock, put on the first by straight lines between samples, as far as all clocks reach."""
    clocks = [i for i, (name, values) in enumerate(columns) if CLOCK.match(name) and (numpy.diff(values[~numpy.isnan(values)]) > 0).all()]
    if len(clocks) < 2:
        return dict(columns)
    channels, clock = [], None
    for i, (name, values) in enumerate(columns):
        if i in clocks:
            clock = values
        elif clock is not None:
            there = ~(numpy.isnan(clock) | numpy.isnan(values))
            channels.append((name, clock[there], values[there]))
    channels = [one for one in channels if len(one[1]) >= 2]
    if not channels:
        raise Refusal(f"{place}: has {len(clocks)} clocks and no column behind them")
    lower, upper = max(one[1][0] for one in channels), min(one[1][-1] for one in channels)
    first = channels[0][1]
    time = first[(first >= lower) & (first <= upper)]
    return {"time": time, **{name: numpy.interp(time, clock, values) for name, clock, values in channels}}


def cells_of(path):
    """(rows of the first lines, a function that reads the table from a row on)."""
    if path.suffix.lower() in {".xlsx", ".xls", ".xlsm"}:
        sheet = pandas.read_excel(path, header=None)
        return sheet.head(PEEK).to_numpy(object).tolist(), lambda first: sheet.iloc[first:]
    text = text_of(path)
    lines = text.splitlines()
    head = lines[:PEEK]
    separator = max("\t;,", key=lambda one: sum(line.count(one) for line in head[len(head) // 2:]) * (2 if one != "," else 1))
    decimal = "," if separator != "," and re.search(r"\d,\d", "\n".join(head[len(head) // 2:])) else "."
    rows = [line.rstrip("\r").removesuffix(separator).split(separator) for line in head]

    def read(first):
        width = len(rows[first])
        table = io.StringIO("\n".join(line.rstrip("\r").removesuffix(separator) for line in lines[first:]))
        return pandas.read_csv(table, sep=separator, decimal=decimal, header=None, names=range(width), index_col=False,
                               skipinitialspace=True, low_memory=False, on_bad_lines="error")

    return rows, read


def tree(path):
    try:
        rows, read = cells_of(path)
        first = first_row(rows, path)
        table = read(first)
    except Refusal:
        raise
    except Exception as error:  # of pandas and of what it reads with
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise Refusal(f"{path}: cannot be read as a table: {words}") from None
    width = table.shape[1]
    names = names_of(rows[:first], width)
    columns = [(name or f"column[{i}]", numbers_of(table.iloc[:, i])) for i, name in enumerate(names)]
    # what is mostly empty is no column of the log; a row that lacks a number is no sample
    filled = [(name, values) for name, values in columns if values is not None and numpy.isnan(values).mean() < 0.5]
    columns = on_one_clock(path, filled)
    whole = ~numpy.isnan(numpy.column_stack(list(columns.values()))).any(axis=1)
    if not whole.all():
        print(f"{path}: {(~whole).sum()} of {len(whole)} rows lack a number and are left out", file=sys.stderr)
    return {name: values[whole] for name, values in columns.items()}
