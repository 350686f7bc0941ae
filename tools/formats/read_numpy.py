"""What NumPy's .npz and .npy hold. Objects are never unpickled."""

import zipfile

import numpy
from columns import Refusal


def tree(path):
    try:
        data = numpy.load(path, allow_pickle=False)
        if isinstance(data, numpy.ndarray):
            if data.dtype.names is None:
                raise Refusal(f"{path}: is one array without names; save it with names, numpy.savez(FILE, time=..., position=...)")
            return {name: data[name] for name in data.dtype.names}
        with data:
            arrays = {name: data[name] for name in data.files}
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise Refusal(f"{path}: cannot be read as NumPy's: {error}") from None
    # an array of records holds columns
    return {name: {one: array[one] for one in array.dtype.names} if array.dtype.names else array for name, array in arrays.items()}
