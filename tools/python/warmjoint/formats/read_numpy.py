"""What NumPy's .npz and .npy hold. Objects are never unpickled."""

import tokenize
import zipfile

import numpy
from columns import MOST_NUMBERS
from refusal import Refusal

LARGEST = 8 * MOST_NUMBERS  # bytes of one array


def require_room(path, file):
    """Refuses an array by what its head states, before there is room for it."""
    version = numpy.lib.format.read_magic(file)
    reading = numpy.lib.format.read_array_header_1_0 if version == (1, 0) else numpy.lib.format.read_array_header_2_0
    shape, _, kind = reading(file)
    count = 1
    for length in shape:
        count *= length
    if count * kind.itemsize > LARGEST:
        raise Refusal(f"{path}: states an array of {' x '.join(map(str, shape))}; {LARGEST} bytes at most are read")


def tree(path, notes):
    try:
        if zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as folder:
                for one in folder.namelist():
                    with folder.open(one) as file:
                        require_room(f"{path} {one}", file)
        else:
            with open(path, "rb") as file:
                require_room(path, file)
        data = numpy.load(path, allow_pickle=False)
        if isinstance(data, numpy.ndarray):
            if data.dtype.names is None:
                raise Refusal(f"{path}: is one array without names; save it with names, numpy.savez(FILE, time=..., position=...)")
            return {name: data[name] for name in data.dtype.names}
        with data:
            arrays = {name: data[name] for name in data.files}
    except (ValueError, SyntaxError, EOFError, OSError, KeyError, NotImplementedError, tokenize.TokenError, zipfile.BadZipFile, zipfile.LargeZipFile) as error:
        raise Refusal(f"{path}: cannot be read as NumPy's: {error}") from None
    # an array of records holds columns
    return {name: {one: array[one] for one in array.dtype.names} if array.dtype.names else array for name, array in arrays.items()}
