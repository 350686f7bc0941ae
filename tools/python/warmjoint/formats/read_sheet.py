"""The first sheet of an Excel file as a table of text, which the program's reader reads."""

import datetime

import openpyxl
from columns import MOST_NUMBERS, Refusal, first_line

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


def tree(path, notes):
    lines, cells = [], 0
    try:
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
        for row in book.worksheets[0].iter_rows(values_only=True):
            cells += len(row)
            if cells > MOST_CELLS:
                raise Refusal(f"{path}: holds more than {MOST_CELLS} cells; export the log's columns as .csv")
            lines.append("\t".join(map(cell_of, row)))
        others = [sheet.title for sheet in book.worksheets[1:]]
    except (Refusal, MemoryError):
        raise
    except Exception as error:  # of a damaged file
        raise Refusal(f"{path}: cannot be read as Excel's: {first_line(error)}") from None
    if others:
        notes.append(f"the first sheet is read; left out: {', '.join(others)}")
    return "\n".join(lines) + "\n"
