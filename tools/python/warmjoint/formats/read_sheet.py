"""The sheet of an Excel file that holds a log, as a table of text, which the program's reader reads."""

import datetime

import openpyxl
from columns import MOST_NUMBERS
from refusal import Refusal, first_line

MOST_CELLS = MOST_NUMBERS // 10  # of a sheet, which takes long to decode


def cell_of(value):
    """As a table of text has it, without a tab."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, datetime.timedelta):
        return f"{value.total_seconds()!r} s"
    if isinstance(value, (datetime.datetime, datetime.date, datetime.time)):
        return value.isoformat()
    return " ".join(str(value).replace('"', "'").split())


def rows_of(sheet, left):
    """(the lines of a sheet, how many of them have two numbers or more, as samples have)."""
    lines, samples = [], 0
    for row in sheet.iter_rows(values_only=True):
        left -= len(row)
        if left < 0:
            return None, 0
        lines.append("\t".join(map(cell_of, row)))
        samples += sum(isinstance(value, (int, float)) and not isinstance(value, bool) for value in row) > 1
    return lines, samples


def tree(path, notes):
    found, best, of_sheets = [], -1, {}
    try:
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
        left = MOST_CELLS
        for sheet in book.worksheets:
            lines, samples = rows_of(sheet, left)
            if lines is None:
                raise Refusal(f"{path}: holds more than {MOST_CELLS} cells; export the log's columns as .csv")
            left -= sum(line.count("\t") + 1 for line in lines)
            of_sheets[sheet.title] = samples
            if samples > best:
                found, best = lines, samples
    except (Refusal, MemoryError):
        raise
    except Exception as error:  # of a damaged file
        raise Refusal(f"{path}: cannot be read as Excel's: {first_line(error)}") from None
    if best < 1:
        raise Refusal(f"{path}: no sheet holds rows of numbers; it has: {', '.join(of_sheets) or 'none'}")
    taken = max(of_sheets, key=of_sheets.get)
    others = [title for title in of_sheets if title != taken]
    if others:
        notes.append(f"sheet '{taken}' is read, which holds most rows of numbers; left out: {', '.join(others)}")
    return "\n".join(found) + "\n"
