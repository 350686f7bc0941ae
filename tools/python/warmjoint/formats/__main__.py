"""Columns of a log in another format: a child process, with limits of its own, of `warmjoint convert` and of warmjoint.read.

    python3 formats '{"file": "drive.mcap", "readers": {".mcap": "read_bag"}, "topic": "", "joint": "elbow", "map": {}, "joints": "all"}'

readers: the module that reads a file, by the ending of its name (models/recording/log_formats.cc). joints: "all" of a bag, where none is
named, or "one". On standard output: a line of JSON, {columns[{name, unit, count}], notes[]} with the numbers as float64 behind it,
{text, notes[]} with a table of text behind it, which the program's reader reads, or {error}.
"""

import ctypes
import importlib
import json
import pathlib
import resource
import signal
import stat
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from refusal import Refusal, first_line, sentence

PR_SET_PDEATHSIG = 1  # of Linux, the only system that this package is for
MEMORY = 8 << 30  # bytes of address space, as readers of HDF5 in the program have
PATIENCE = 60  # s, and one more for each MB: a bag of messages is decoded in Python
MOST_FILES = 10_000  # of a folder
PACKAGES = ("h5py", "scipy", "pyarrow", "rosbags", "openpyxl", "numpy", "lz4")


def size_of(path):
    """Bytes of a file, or of the files in a folder. Refuses what is neither, in a folder, too: a pipe would never end."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        raise Refusal(f"{path}: does not exist") from None
    except OSError as error:
        raise Refusal(f"{path}: cannot be read: {error.strerror}") from None
    if stat.S_ISREG(mode):
        return path.stat().st_size
    if not stat.S_ISDIR(mode):
        raise Refusal(f"{path}: is neither a file nor a folder")
    size = 0
    for count, one in enumerate(path.rglob("*"), 1):
        if count > MOST_FILES:
            raise Refusal(f"{path}: holds more than {MOST_FILES} files; give the folder of one log")
        mode = one.stat().st_mode if one.exists() else 0
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise Refusal(f"{one}: is neither a file nor a folder; take it out of the log's folder")
        size += one.stat().st_size
    return size


def limit(size):
    """Bounds on memory and time, which end this process: its parent says so. It ends with its parent, too."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    seconds = PATIENCE + size // 1_000_000
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.alarm(2 * seconds)  # of wall time


def reader_of(path, readers):
    """The module that reads a file, by its name; a folder holds a rosbag2 or Parquet files."""
    if path.is_dir():
        return "read_parquet" if any(path.rglob("*.parquet")) else "read_bag"
    fitting = [ending for ending in readers if path.name.lower().endswith(ending)]
    if not fitting:
        raise Refusal(f"{path}: '{path.suffix}' is none of {', '.join(readers)}; a folder is read as rosbag2 or as Parquet files")
    return readers[max(fitting, key=len)]


def read(request, path):
    """(columns {name: (unit, [N])}, notes), or (text, notes)."""
    name = reader_of(path, request["readers"])
    of_bag = request.get("topic") or request.get("joint")
    if name == "read_packed":
        import read_packed

        return read_packed.unpacked(path, lambda inside: read(request, inside), request["readers"])
    if name != "read_bag" and of_bag:
        raise Refusal(f"{path}: --topic and --joint are for bags; name columns with --map")
    notes = []
    reader = importlib.import_module(name)
    from columns import pick, require_one_length

    found = reader.columns(path, request, notes) if name == "read_bag" else reader.tree(path, notes)
    if isinstance(found, str):
        return found, notes
    columns = found if name == "read_bag" else pick(path, found, request.get("map") or {}, notes)
    require_one_length(path, columns)
    return columns, notes


def refused(request):
    """(what `read` gives, nothing) or (nothing, why it gives nothing)."""
    file = request["file"]
    try:
        path = pathlib.Path(file)
        limit(size_of(path))
        return read(request, path), ""
    except Refusal as refusal:
        return None, str(refusal)
    except ModuleNotFoundError as missing:
        package = (missing.name or "").partition(".")[0]
        if package not in PACKAGES:
            raise
        return None, (f"{file}: is read by the Python package {package}, which {sys.executable or 'this Python'} lacks: pip install 'warmjoint[convert]', or "
                      "let WARMJOINT_PYTHON name a Python that has it")
    except MemoryError:
        return None, f"{file}: needs more than {MEMORY >> 30} GiB of memory; take a part of it"
    except OSError as error:
        return None, f"{file}: cannot be read: {error.strerror or first_line(error)}"
    except Exception as error:  # a damaged file breaks any part of the parsers
        return None, f"{file}: cannot be read: {first_line(error)}"


def answer(request):
    """The bytes that go to standard output."""
    found, why = refused(request)
    if found is None:
        return json.dumps({"error": sentence(why)}).encode() + b"\n"
    content, notes = found
    notes = [sentence(note) for note in notes]
    if isinstance(content, (str, bytes)):
        text = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
        return json.dumps({"text": True, "notes": notes}).encode() + b"\n" + text
    head = {"columns": [{"name": name, "unit": unit, "count": len(values)} for name, (unit, values) in content.items()], "notes": notes}
    return json.dumps(head).encode("utf-8", "replace") + b"\n" + b"".join(values.tobytes() for _, values in content.values())


if __name__ == "__main__":
    sys.stdout.buffer.write(answer(json.loads(sys.argv[1])))
