"""What HDF5, MATLAB and netCDF files hold: groups, structs, cells, arrays of structs, compounds and references. Links lead to no other file."""

import h5py
import numpy
import scipy.io
from columns import MOST_PATHS
from refusal import Refusal, first_line

DEEPEST = 16  # groups within groups


class Told(numpy.ndarray):
    """An array that may have attributes, in `attrs`, as the datasets of HDF5 have."""


def told(variable):
    """A variable of a netCDF file. Its numbers are big-endian there."""
    array = numpy.array(variable.data, dtype=variable.data.dtype.newbyteorder("=")).view(Told)
    array.attrs = {"units": variable.units} if hasattr(variable, "units") else {}
    return array


class Looking:
    """Looks at each object of a file once."""

    def __init__(self, path):
        self.path, self.file = path, h5py.File(path)
        self.seen, self.left = set(), MOST_PATHS

    def refuse(self, name, what):
        raise Refusal(f"{self.path}: {name} {what}; a recording is one file: copy its datasets into it")

    def member(self, group, name, depth):
        """What a group holds under a name."""
        link = group.get(name, getlink=True)
        if isinstance(link, h5py.ExternalLink):
            self.refuse(name, "is a link to another file")
        return self.at(group.get(name), depth)

    def at(self, node, depth):
        """Groups as mappings; datasets stay in the file until they are asked for."""
        self.left -= 1
        if depth > DEEPEST or node is None or self.left < 0:
            return {}
        if isinstance(node, h5py.Group):
            where = h5py.h5o.get_info(node.id).addr
            if where in self.seen:  # it holds itself, or stands twice
                return {}
            self.seen.add(where)
            return {name: self.member(node, name, depth + 1) for name in node if not name.startswith("#")}
        if not isinstance(node, h5py.Dataset) or not node.shape:
            return {}
        if node.external:
            self.refuse(node.name, "has its numbers in another file")
        if node.is_virtual:
            self.refuse(node.name, "is made of other datasets")
        if node.dtype.names:
            return {name: node[name] for name in node.dtype.names}
        if h5py.check_ref_dtype(node.dtype) is h5py.Reference:  # cells of MATLAB 7.3
            return [self.at(self.file[one], depth + 1) for one in node[()].ravel(order="F")[:MOST_PATHS] if one]
        return node


def tree(path, notes):
    try:
        if h5py.is_hdf5(path):
            looking = Looking(path)
            return looking.at(looking.file, 0)
        if path.suffix.lower() == ".nc":  # of version 3; 4 is HDF5
            with scipy.io.netcdf_file(path, mmap=False) as file:
                return {name: told(one) for name, one in file.variables.items()}
        return {name: value for name, value in scipy.io.loadmat(path, simplify_cells=True).items() if not name.startswith("__")}
    except (Refusal, MemoryError):
        raise
    except Exception as error:  # a damaged file breaks any part of the parsers
        raise Refusal(f"{path}: cannot be read as HDF5, MATLAB's or netCDF: {first_line(error)}") from None
