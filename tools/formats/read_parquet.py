"""What Parquet files hold, as LeRobot and pandas write them."""

import numpy
import pyarrow
import pyarrow.parquet
from columns import Refusal


def column(path, table, name):
    """[N] or [N x M] of a column; stamps in s from the first."""
    values = table.column(name).combine_chunks()
    if pyarrow.types.is_timestamp(values.type) or pyarrow.types.is_duration(values.type):
        stamps = values.cast(pyarrow.int64()).to_numpy(zero_copy_only=False)
        return (stamps - stamps[0]) / {"s": 1, "ms": 1e3, "us": 1e6, "ns": 1e9}[values.type.unit]
    array = numpy.asarray(values.to_numpy(zero_copy_only=False))
    lists = array.dtype == object and len(array) and all(isinstance(one, numpy.ndarray) for one in array)
    return numpy.stack(array) if lists and len({len(one) for one in array}) == 1 else array


def tree(path):
    try:
        table = pyarrow.parquet.read_table(path)
    except pyarrow.ArrowException as error:
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise Refusal(f"{path}: cannot be read as Parquet: {words}") from None
    return {name: column(path, table, name) for name in table.column_names}
