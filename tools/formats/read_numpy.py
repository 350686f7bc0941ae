"""Columns of NumPy's .npz and .npy. Objects are never unpickled."""

import zipfile

import numpy
from columns import Refusal, pick


def columns(path, fields):
    try:
        data = numpy.load(path, allow_pickle=False)
        if isinstance(data, numpy.ndarray):
            if data.dtype.names is None:
                raise Refusal(f"{path}: is one array without names; save it with names, numpy.savez(FILE, time=..., position=...)")
            return pick(path, data.dtype.names, fields, lambda name: data[name])
        with data:
            return pick(path, data.files, fields, lambda name: data[name])
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise Refusal(f"{path}: cannot be read as NumPy's: {error}") from None
