"""Columns of a log in another format: a child process, with limits of its own, of `warmjoint convert` and of warmjoint.read.

    python3 formats '{"file": "drive.mcap", "topic": "", "joint": "elbow", "map": {}}'

On standard output: a line of JSON, {columns[{name, unit, count}], notes[]} with the numbers as float64 behind it, {text, notes[]} with a table
of text behind it, which the program's reader reads, or {error}.
"""

import importlib
import json
import pathlib
import resource
import signal
import stat
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))

MEMORY = 8 << 30  # bytes of address space, as readers of HDF5 in the program have
PATIENCE = 60  # s, and one more for each MB: a bag of messages is decoded in Python
READERS = {".parquet": "read_parquet", ".npz": "read_numpy", ".npy": "read_numpy",
           **dict.fromkeys((".db3", ".mcap", ".bag"), "read_bag"), **dict.fromkeys((".mat", ".h5", ".hdf5"), "read_arrays"),
           **dict.fromkeys((".xlsx", ".xlsm"), "read_sheet"), **dict.fromkeys((".json", ".jsonl", ".ndjson"), "read_json")}
PACKAGES = {"h5py": "h5py", "scipy": "scipy", "pyarrow": "pyarrow", "rosbags": "rosbags", "openpyxl": "openpyxl", "numpy": "numpy"}


def size_of(path):
    """Bytes of a file, or of the files in a folder. Refuses what is neither: a pipe would never end."""
    from columns import Refusal

    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        raise Refusal(f"{path}: does not exist") from None
    except OSError as error:
        raise Refusal(f"{path}: cannot be read: {error.strerror}") from None
    if stat.S_ISDIR(mode):
        return sum(one.stat().st_size for one in list(path.iterdir())[:10_000] if one.is_file())
    if not stat.S_ISREG(mode):
        raise Refusal(f"{path}: is neither a file nor a folder")
    return path.stat().st_size


def limit(size):
    """Bounds on memory and time, which end this process: its parent says so."""
    seconds = PATIENCE + size // 1_000_000
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.alarm(2 * seconds)  # of wall time


def reader_of(path):
    """The module that reads a file, by its name; a folder holds a rosbag2 or Parquet files."""
    from columns import Refusal

    if path.is_dir():
        return "read_parquet" if any(path.rglob("*.parquet")) else "read_bag"
    kind = path.suffix.lower()
    if kind not in READERS:
        raise Refusal(f"{path}: '{kind}' is none of {', '.join(READERS)}; a folder is read as rosbag2 or as Parquet files")
    return READERS[kind]


def read(request):
    """(columns {name: (unit, [N])}, notes), or (text, notes)."""
    from columns import Refusal, pick, require_one_length

    path = pathlib.Path(request["file"])
    limit(size_of(path))
    name = reader_of(path)
    if name != "read_bag" and (request.get("topic") or request.get("joint")):
        raise Refusal(f"{path}: --topic and --joint are for bags; name columns with --map")
    notes = []
    reader = importlib.import_module(name)
    fields = request.get("map") or {}
    if name == "read_bag":
        columns = reader.columns(path, request.get("topic"), request.get("joint"), fields, notes)
    else:
        tree = reader.tree(path, notes)
        if isinstance(tree, str):
            return tree, notes
        columns = pick(path, tree, fields, notes)
    require_one_length(path, columns)
    return columns, notes


def answer(request):
    """The bytes that go to standard output."""
    from columns import Refusal

    try:
        found, notes = read(request)
    except Refusal as refusal:
        return json.dumps({"error": str(refusal)}).encode() + b"\n"
    except ModuleNotFoundError as missing:
        package = PACKAGES.get((missing.name or "").partition(".")[0])
        if not package:
            raise
        words = f"{request['file']}: needs the Python package {package}: pip install {package}, or pip install 'warmjoint[convert]'"
        return json.dumps({"error": words}).encode() + b"\n"
    except MemoryError:
        return json.dumps({"error": f"{request['file']}: needs more than {MEMORY >> 30} GiB of memory; take a part of it"}).encode() + b"\n"
    except OSError as error:
        return json.dumps({"error": f"{request['file']}: cannot be read: {error.strerror or error}"}).encode() + b"\n"
    if isinstance(found, str):
        return json.dumps({"text": True, "notes": notes}).encode() + b"\n" + found.encode("utf-8", "replace")
    head = {"columns": [{"name": name, "unit": unit, "count": len(values)} for name, (unit, values) in found.items()], "notes": notes}
    return json.dumps(head).encode("utf-8", "replace") + b"\n" + b"".join(values.tobytes() for _, values in found.values())


if __name__ == "__main__":
    sys.stdout.buffer.write(answer(json.loads(sys.argv[1])))
