"""JSON: objects of arrays, and records, one a line or in a list, as a table of text, which the program's reader reads."""

import json
import math

import numpy
from columns import MOST_NUMBERS
from refusal import Refusal

MOST_COLUMNS = 1000  # of records


def no_constant(word):
    return math.nan if word == "NaN" else float(word)


def flat(value, path, into):
    """A record's numbers and texts by their paths: "joint.q", "position[1]"."""
    todo = [(path, value)]
    while todo:
        path, value = todo.pop()
        if isinstance(value, dict):
            todo += [(f"{path}.{name}" if path else str(name), one) for name, one in reversed(value.items())]
        elif isinstance(value, list):
            todo += [(f"{path}[{i}]", one) for i, one in reversed(list(enumerate(value)))]
        else:
            into[path] = value


def cell_of(value):
    if value is None:
        return ""
    if isinstance(value, str):
        return " ".join(value.replace('"', "'").split())
    return repr(value)


def table_of(path, records):
    """A table with a row for each record; a field that a record lacks is an empty cell."""
    rows, names = [], {}
    for record in records:
        row = {}
        flat(record, "", row)
        rows.append(row)
        names.update(dict.fromkeys(row))
        if len(names) > MOST_COLUMNS or len(names) * len(rows) > MOST_NUMBERS // 10:
            raise Refusal(f"{path}: its records have {len(names)} fields so far; {MOST_COLUMNS} fields and {MOST_NUMBERS // 10} numbers at most are read")
    head = "\t".join(f'"{" ".join(name.replace(chr(34), chr(39)).split())}"' for name in names)
    return "\n".join([head, *("\t".join(cell_of(row.get(name)) for name in names) for row in rows), ""])


def arrays_in(value):
    """Lists of numbers as arrays; what else there is as it is."""
    if isinstance(value, dict):
        return {name: arrays_in(one) for name, one in value.items()}
    if isinstance(value, list) and value:
        if all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in value):
            return numpy.array(value, float)
        if all(isinstance(one, list) and len(one) == len(value[0]) for one in value):
            rows = [arrays_in(one) for one in value]
            return numpy.stack(rows) if all(isinstance(one, numpy.ndarray) and one.ndim == 1 for one in rows) else rows
        return [arrays_in(one) for one in value]
    return value


def lines_of(path, text):
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            continue
        try:
            record = json.loads(line, parse_constant=no_constant)
        except (ValueError, RecursionError) as error:
            why = "its levels lie too deep within each other" if isinstance(error, RecursionError) else error
            raise Refusal(f"{path}:{number}: is no record of JSON: {why}") from None
        if not isinstance(record, dict):
            raise Refusal(f"{path}:{number}: is no object {{...}}; each line is one sample")
        yield record


def tree(path, notes):
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    try:
        document = json.loads(text, parse_constant=no_constant)
    except (ValueError, RecursionError):
        return table_of(path, lines_of(path, text))
    if isinstance(document, list) and document and all(isinstance(one, dict) for one in document):
        return table_of(path, document)
    if not isinstance(document, dict):
        raise Refusal(f"{path}: holds neither an object of arrays nor records {{...}}")
    # a log in an object, as {"entries": [{...}, ...]}
    lists = [one for one in document.values() if isinstance(one, list) and len(one) > 2 and all(isinstance(entry, dict) for entry in one)]
    if len(lists) == 1:
        rest = [name for name, one in document.items() if one is not lists[0]]
        if rest:
            notes.append(f"left out: {', '.join(map(repr, rest[:20]))}")
        return table_of(path, lists[0])
    return arrays_in(document)
