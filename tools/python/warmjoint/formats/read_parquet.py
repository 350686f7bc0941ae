"""What Parquet, Feather and Arrow files hold, as LeRobot and pandas write them; a folder of Parquet files is a set of episodes."""

import numpy
import pyarrow
import pyarrow.feather
import pyarrow.parquet
from columns import MOST_NUMBERS
from refusal import Refusal, first_line

MOST_SAMPLES = 50_000_000  # as the program reads


def column(values):
    """[N] or [N x M] of a column."""
    kind = values.type
    if pyarrow.types.is_decimal(kind):
        values = values.cast(pyarrow.float64())
    if pyarrow.types.is_dictionary(kind):
        values = values.dictionary_decode()
    if pyarrow.types.is_timestamp(kind) or pyarrow.types.is_duration(kind):
        as_integers = values.cast(pyarrow.int64()).to_numpy(zero_copy_only=False)
        return as_integers.astype(f"{'M' if pyarrow.types.is_timestamp(kind) else 'm'}8[{kind.unit}]")
    array = numpy.asarray(values.to_numpy(zero_copy_only=False))
    if array.dtype != object or not len(array):
        return array
    lists = all(isinstance(one, numpy.ndarray) for one in array)
    return numpy.stack(array) if lists and len({len(one) for one in array}) == 1 else array


def table_of(path):
    """One file. Refuses it by what its head states."""
    try:
        if path.suffix.lower() != ".parquet":
            table = pyarrow.feather.read_table(path, memory_map=False)
            if table.num_rows > MOST_SAMPLES or table.num_rows * table.num_columns > MOST_NUMBERS:
                raise Refusal(f"{path}: holds {table.num_rows} rows of {table.num_columns} columns; {MOST_SAMPLES} rows and {MOST_NUMBERS} numbers at most are read")
            return table
        file = pyarrow.parquet.ParquetFile(path)
        rows, columns = file.metadata.num_rows, len(file.schema_arrow.names)
        if rows > MOST_SAMPLES or rows * columns > MOST_NUMBERS:
            raise Refusal(f"{path}: states {rows} rows of {columns} columns; {MOST_SAMPLES} rows and {MOST_NUMBERS} numbers at most are read")
        return file.read()
    except (pyarrow.ArrowException, OSError) as error:
        raise Refusal(f"{path}: cannot be read as Parquet or Feather: {first_line(error)}") from None


def tree(path, notes):
    if not path.is_dir():
        table = table_of(path)
        return {name: column(table.column(name).combine_chunks()) for name in table.column_names}
    files = sorted(path.rglob("*.parquet"))
    tables = [table_of(one) for one in files]
    names = [name for name in tables[0].column_names if all(name in one.column_names for one in tables)]
    notes.append(f"{len(files)} Parquet files, each an episode")
    whole = {name: numpy.concatenate([column(one.column(name).combine_chunks()) for one in tables]) for name in names}
    return {**whole, "episode": numpy.repeat(numpy.arange(len(tables)), [one.num_rows for one in tables])}
