"""Columns of Parquet files, as LeRobot and pandas write them."""

import numpy
import pyarrow
import pyarrow.parquet
from columns import Refusal, pick


def columns(path, fields):
    try:
        table = pyarrow.parquet.read_table(path)
    except pyarrow.ArrowException as error:
        raise Refusal(f"{path}: cannot be read as Parquet: {str(error).splitlines()[0]}") from None

    def take(name):
        column = table.column(name).combine_chunks()
        if pyarrow.types.is_timestamp(column.type) or pyarrow.types.is_duration(column.type):
            stamps = column.cast(pyarrow.int64()).to_numpy(zero_copy_only=False)
            return (stamps - stamps[0]) / {"s": 1, "ms": 1e3, "us": 1e6, "ns": 1e9}[column.type.unit]
        return numpy.asarray(column.to_numpy(zero_copy_only=False))

    return pick(path, table.column_names, fields, take)
