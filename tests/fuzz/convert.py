"""Fuzzes the readers of `warmjoint convert` (tools/python/warmjoint/formats): small files of every format with bytes changed, cut, doubled and put
in. Each must give columns, a text or a refusal of one line, within bounds of time and memory, and no exception.

    tests/fuzz/convert.py [--seconds N] [--seed S] [FOLDER]     PYTHONPATH: the packages of formats/requirements.txt

FOLDER gets the inputs that broke a reader, and makes the status 1. Exits 77 where the packages are not there.
"""

import argparse
import bz2
import gzip
import json
import lzma
import os
import pathlib
import random
import select
import signal
import sys
import tempfile
import time
import zipfile

FORMATS = pathlib.Path(__file__).resolve().parents[2] / "tools/python/warmjoint/formats"
sys.path.insert(0, str(FORMATS))
try:
    import h5py
    import numpy
    import openpyxl
    import pyarrow
    import pyarrow.feather
    import pyarrow.parquet
    import read_arrays
    import read_bag
    import read_json
    import read_numpy
    import read_packed
    import read_parquet
    import read_sheet
    import scipy.io
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore
except ImportError as error:
    print(f"skipped: {error}; tools/convert --setup fetches the packages")
    sys.exit(77)
# imported once, before each input forks; of the endings of the seeds
READERS = {".mat": read_arrays, ".h5": read_arrays, ".nc": read_arrays, ".mcap": read_bag, ".db3": read_bag, ".json": read_json, ".jsonl": read_json,
           ".npz": read_numpy, ".npy": read_numpy, ".parquet": read_parquet, ".feather": read_parquet, ".xlsx": read_sheet,
           **dict.fromkeys((".gz", ".bz2", ".xz", ".zip"), read_packed)}
REQUEST = {"map": {}, "joint": "", "topic": "", "joints": "all", "readers": {ending: reader.__name__ for ending, reader in READERS.items()}}
SLOWEST = 20  # s of one input: files are of some kB


def seeds(folder):
    """Small files, one of each format at least."""
    time_, torque = numpy.arange(20) * 0.1, numpy.sin(numpy.arange(20))
    columns = {"time": time_, "position": time_, "torque": torque}
    numpy.savez(folder / "a.npz", **columns)
    numpy.save(folder / "a.npy", numpy.rec.fromarrays(list(columns.values()), names=list(columns)))
    scipy.io.savemat(folder / "a.mat", {"s": [columns, columns], "c": numpy.array([time_, torque], object)})
    with h5py.File(folder / "a.h5", "w") as file:
        file["log"], file["g/q"] = numpy.rec.fromarrays(list(columns.values()), names=list(columns)), numpy.stack([time_, torque])
    pyarrow.parquet.write_table(pyarrow.table({**columns, "q": [[1.0, 2.0]] * 20}), folder / "a.parquet")
    rows = [{"t": float(t), "q": [1, float(t)], "d": {"tau": float(x)}} for t, x in zip(time_, torque, strict=True)]
    (folder / "a.jsonl").write_text("\n".join(map(json.dumps, rows)))
    (folder / "a.json").write_text(json.dumps({"entries": rows}))
    (folder / "b.json").write_text(json.dumps({name: values.tolist() for name, values in columns.items()}))
    book = openpyxl.Workbook()
    for row in [list(columns), *zip(*(values.tolist() for values in columns.values()), strict=True)]:
        book.active.append(row)
    book.save(folder / "a.xlsx")
    store = get_typestore(Stores.ROS2_HUMBLE)
    kind = "sensor_msgs/msg/JointState"
    state, header, stamp = store.types[kind], store.types["std_msgs/msg/Header"], store.types["builtin_interfaces/msg/Time"]
    for plugin, end in ((StoragePlugin.MCAP, "mcap"), (StoragePlugin.SQLITE3, "db3")):
        with Writer(folder / f"bag{end}", version=9, storage_plugin=plugin) as writer:
            topic = writer.add_connection("/joint_states", kind, typestore=store)
            for t, x in zip(time_, torque, strict=True):
                one = numpy.array([x])
                message = state(header=header(stamp=stamp(sec=int(t), nanosec=round(t % 1 * 1e9)), frame_id=""), name=["j"], position=one, velocity=one, effort=one)
                writer.write(topic, round(t * 1e9), store.serialize_cdr(message, kind))
        next((folder / f"bag{end}").glob(f"*.{end}")).rename(folder / f"a.{end}")
    pyarrow.feather.write_feather(pyarrow.table(columns), folder / "a.feather")
    with scipy.io.netcdf_file(folder / "a.nc", "w") as file:
        file.createDimension("n", len(time_))
        for name, values in columns.items():
            file.createVariable(name, "d", ("n",))[:] = values
    text = b"time,position,torque\n" + b"".join(b"%f,%f,%f\n" % (t, t, x) for t, x in zip(time_, torque, strict=True))
    for ending, packed in ((".gz", gzip.compress(text)), (".bz2", bz2.compress(text)), (".xz", lzma.compress(text))):
        (folder / f"a.csv{ending}").write_bytes(packed)
    with zipfile.ZipFile(folder / "a.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("log.csv", text)
    return [path for path in sorted(folder.iterdir()) if path.is_file()]


def changed(data, rng):
    """The bytes with one to four changes."""
    data = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        if not data:
            break
        at, length = rng.randrange(len(data)), rng.choice((1, 2, 4, 8, 64))
        kind = rng.randrange(6)
        if kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[at:at + length] = rng.choice((b"\xff", b"\x00", b"\x7f")) * length
        elif kind == 2:
            del data[at:at + length]
        elif kind == 3:
            data[at:at] = data[at:at + length]
        elif kind == 4:
            del data[at:]
        else:
            data[at:at + 1] = str(rng.choice((0, -1, 2**31, 2**63, 10**30, 1e308))).encode()
    return bytes(data)


def fault_of(path):
    """What is wrong with the answer to a file; empty where nothing is."""
    out, into = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(out)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        try:
            import importlib
            answer = importlib.import_module("__main__formats").answer({"file": str(path), **REQUEST})
            os.write(into, answer.partition(b"\n")[0][:60_000])
        except BaseException as error:
            os.write(into, f"raised {type(error).__name__}: {error}".encode("utf-8", "replace")[:2000])
        os._exit(0)
    os.close(into)
    head, end = b"", time.monotonic() + SLOWEST
    while select.select([out], [], [], max(0, end - time.monotonic()))[0]:
        block = os.read(out, 65536)
        if not block:
            break
        head += block
    else:
        os.kill(child, signal.SIGKILL)
    os.close(out)
    status = os.waitpid(child, 0)[1]
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        # its parent says that the library crashed; that it takes long is a fault
        return f"took more than {SLOWEST} s" if number == signal.SIGKILL else ""
    try:
        said = json.loads(head)
    except ValueError:
        return head.decode(errors="replace") or "said nothing"
    return "" if "columns" in said or "text" in said or ("error" in said and "\n" not in said["error"]) else f"said {said}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("folder", nargs="?", type=pathlib.Path)
    given = parser.parse_args()
    # the script by a name that can be imported
    import importlib.util
    spec = importlib.util.spec_from_file_location("__main__formats", FORMATS / "__main__.py")
    sys.modules["__main__formats"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sys.modules["__main__formats"])
    rng, count, found = random.Random(given.seed), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        files = [(path, path.read_bytes()) for path in seeds(folder)]
        for path, _ in files:
            fault = fault_of(path)
            if fault:
                print(f"{path.name} as it was written: {fault}")
                return 1
        end = time.monotonic() + given.seconds
        while time.monotonic() < end:
            path, data = rng.choice(files)
            tried = folder / f"tried{path.suffix}"
            tried.write_bytes(changed(data, rng))
            fault = fault_of(tried)
            count += 1
            if fault:
                found += 1
                print(f"{path.suffix}: {fault}")
                if given.folder:
                    given.folder.mkdir(parents=True, exist_ok=True)
                    tried.rename(given.folder / f"{found}{path.suffix}")
    print(f"{count} inputs from {len(files)} files, {found} broke a reader")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
