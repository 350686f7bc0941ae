"""What HDF5 and MATLAB files hold: groups, structs, cells, arrays of structs, compounds and references."""

import h5py
import scipy.io
from columns import Refusal

DEEPEST = 16  # groups within groups, which may hold themselves


def of_hdf5(node, file, depth=0):
    """Groups as mappings; datasets stay in the file until they are asked for."""
    if depth > DEEPEST or node is None:
        return {}
    if isinstance(node, h5py.Group):
        return {name: of_hdf5(node.get(name), file, depth + 1) for name in node if not name.startswith("#")}
    if not isinstance(node, h5py.Dataset) or not node.shape:
        return {}
    if node.dtype.names:
        return {name: node[name] for name in node.dtype.names}
    if h5py.check_ref_dtype(node.dtype) is h5py.Reference:  # cells of MATLAB 7.3
        return [of_hdf5(file[one], file, depth + 1) for one in node[()].ravel(order="F") if one]
    return node


def tree(path):
    try:
        if h5py.is_hdf5(path):
            file = h5py.File(path)
            return of_hdf5(file, file)
        return {name: value for name, value in scipy.io.loadmat(path, simplify_cells=True).items() if not name.startswith("__")}
    except Exception as error:  # a damaged file breaks any part of the parsers
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise Refusal(f"{path}: cannot be read as HDF5 or MATLAB's: {words}") from None
