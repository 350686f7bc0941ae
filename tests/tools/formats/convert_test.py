"""`warmjoint convert` on small logs of every format, written here with the formats' own libraries.

    convert_test.py WARMJOINT     PYTHONPATH: the packages of tools/python/warmjoint/formats/requirements.txt

Each HDF5 that comes out is also read by `warmjoint check`. Exits 77 where the packages are not there.
"""

import bz2
import datetime
import gzip
import json
import lzma
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

try:
    import h5py
    import numpy
    import openpyxl
    import pyarrow
    import pyarrow.feather
    import pyarrow.parquet
    import scipy.io
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore
except ImportError as error:
    print(f"skipped: {error}; tools/convert fetches the packages")
    sys.exit(77)

PROGRAM = sys.argv.pop(1)
COUNT = 200
TIME = numpy.arange(COUNT) * 0.05  # s
SPEED = numpy.where(numpy.arange(COUNT) // 40 % 2 == 0, 0.5, -0.5)  # rad/s
POSITION = numpy.concatenate([[0], numpy.cumsum(SPEED[:-1] * 0.05)])  # rad
TORQUE = 3 * numpy.sign(SPEED) + 0.1 * numpy.sin(numpy.arange(COUNT))  # N.m
STORE = get_typestore(Stores.ROS2_HUMBLE)
EPOCH = 1_700_000_000


def convert(log, output, *options):
    return subprocess.run([PROGRAM, "convert", log, "-o", output, *options], capture_output=True, text=True, check=False,
                          env={**os.environ, "WARMJOINT_PYTHON": sys.executable})


def stamp(i):
    return STORE.types["builtin_interfaces/msg/Time"](sec=EPOCH + int(TIME[i]), nanosec=round(TIME[i] % 1 * 1e9))


def joint_state(i, names=("shoulder", "elbow")):
    """The elbow is the last of the names; the others stand still."""
    kind, still = STORE.types["sensor_msgs/msg/JointState"], [0.0] * (len(names) - 1)
    header = STORE.types["std_msgs/msg/Header"](stamp=stamp(i), frame_id="")
    return kind(header=header, name=list(names), position=numpy.array([*still, POSITION[i]]),
                velocity=numpy.array([*still, SPEED[i]]), effort=numpy.array([*still, TORQUE[i]]))


def wrench(i):
    types = STORE.types
    vector = types["geometry_msgs/msg/Vector3"]
    header = types["std_msgs/msg/Header"](stamp=stamp(i), frame_id="")
    return types["geometry_msgs/msg/WrenchStamped"](
        header=header, wrench=types["geometry_msgs/msg/Wrench"](force=vector(x=POSITION[i], y=0.0, z=0.0), torque=vector(x=0.0, y=0.0, z=TORQUE[i])))


def write_bag(folder, plugin, order=range(COUNT)):
    with Writer(folder, version=9, storage_plugin=plugin) as writer:
        states = writer.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=STORE)
        wrenches = writer.add_connection("/wrench", "geometry_msgs/msg/WrenchStamped", typestore=STORE)
        for i in order:
            when = EPOCH * 10**9 + round(TIME[i] * 1e9)
            writer.write(states, when, STORE.serialize_cdr(joint_state(i), "sensor_msgs/msg/JointState"))
            writer.write(wrenches, when, STORE.serialize_cdr(wrench(i), "geometry_msgs/msg/WrenchStamped"))


def write_json_mcap(path, cut=0):
    """Messages of JSON in no chunks, as a program writes them that knows no ROS."""
    text = lambda content: struct.pack("<I", len(content)) + content
    record = lambda kind, content: bytes([kind]) + struct.pack("<Q", len(content)) + content
    parts = [b"\x89MCAP0\r\n", record(1, text(b"") + text(b"own")), record(3, struct.pack("<H", 1) + text(b"drive") + text(b"jsonschema") + text(b"{}")),
             record(4, struct.pack("<HH", 1, 1) + text(b"/drive") + text(b"json") + struct.pack("<I", 0))]
    for i in range(COUNT):
        when = EPOCH * 10**9 + round(TIME[i] * 1e9)
        parts.append(record(5, struct.pack("<HIQQ", 1, i, when, when) + json.dumps({"position": POSITION[i], "torque": TORQUE[i]}).encode()))
    end = [record(15, struct.pack("<I", 0)), record(2, struct.pack("<QQI", 0, 0, 0)), b"\x89MCAP0\r\n"]
    whole = b"".join(parts)
    path.write_bytes(whole[:-cut] if cut else whole + b"".join(end))


class Convert(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.output = self.folder / "log.h5"

    def columns(self, log, *options):
        done = convert(log, self.output, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        checked = subprocess.run([PROGRAM, "check", self.output], capture_output=True, text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        with h5py.File(self.output) as file:
            return {name: file[name][:] for name in file}

    def refusal(self, log, *options, output=None):
        done = convert(log, output or self.output, *options)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertFalse(self.output.exists())
        self.assertFalse(list(self.folder.glob(".warmjoint*")))
        return done.stderr

    def is_the_log(self, found, names=("time", "position", "velocity", "torque")):
        self.assertEqual(set(found), set(names))
        wanted = {"time": TIME, "position": POSITION, "velocity": SPEED, "torque": TORQUE}
        for name in names:
            # stamps are whole nanoseconds
            numpy.testing.assert_allclose(found[name], wanted[name], rtol=0, atol=2e-9 if name == "time" else 0)

    def test_bags_of_both_storages(self):
        for plugin in (StoragePlugin.SQLITE3, StoragePlugin.MCAP):
            bag = self.folder / plugin.name.lower()
            write_bag(bag, plugin)
            self.is_the_log(self.columns(bag, "--joint", "elbow"))
            lone = next(path for path in bag.iterdir() if path.suffix in {".db3", ".mcap"})
            self.is_the_log(self.columns(lone, "--joint", "elbow"))
            found = self.columns(bag, "--topic", "/wrench", "--map", "position=wrench.force.x,torque=wrench.torque.z")
            self.is_the_log(found, ("time", "position", "torque"))

    def test_all_joints_of_a_bag_in_one_table(self):
        """Each with its own columns; messages that leave a joint out are no numbers of it. The folder may end in .bag."""
        for plugin in (StoragePlugin.SQLITE3, StoragePlugin.MCAP):
            bag = self.folder / f"{plugin.name.lower()}.bag"
            write_bag(bag, plugin)
            done = convert(bag, self.output)
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(self.output) as file:
                self.assertEqual(set(file), {"time", *(f"{joint}.{name}" for joint in ("shoulder", "elbow") for name in ("position", "velocity", "effort"))})
                numpy.testing.assert_array_equal(file["elbow.effort"], TORQUE)
                numpy.testing.assert_array_equal(file["shoulder.effort"], 0 * TORQUE)

    def test_fields_of_a_bag_by_any_names(self):
        write_bag(self.folder / "bag", StoragePlugin.MCAP)
        done = convert(self.folder / "bag", self.output, "--topic", "/joint_states", "--map", "q1=position[0],q2=position[1],tau2=effort[1]")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.output) as file:
            self.assertEqual(set(file), {"time", "q1", "q2", "tau2"})
            numpy.testing.assert_array_equal(file["tau2"], TORQUE)

    def test_a_cut_mcap_is_read_as_far_as_it_reaches(self):
        write_bag(self.folder / "bag", StoragePlugin.MCAP)
        cut = self.folder / "cut.mcap"
        whole = next((self.folder / "bag").glob("*.mcap")).read_bytes()
        cut.write_bytes(whole[:len(whole) // 2])
        done = convert(cut, self.output, "--joint", "elbow")
        if done.returncode == 0:  # chunks that were whole
            self.assertIn("ends within a record", done.stderr)
            with h5py.File(self.output) as file:
                count = len(file["time"])
                self.assertTrue(3 <= count < COUNT)
                numpy.testing.assert_array_equal(file["torque"], TORQUE[:count])
        else:
            self.assertIn("ends before its first message", done.stderr)
        write_json_mcap(self.folder / "drive.mcap", cut=40)
        self.assertEqual(len(self.columns(self.folder / "drive.mcap")["time"]), COUNT - 1)
        self.assertIn("ends within a record", self.said)

    def test_json_messages_in_an_mcap(self):
        write_json_mcap(self.folder / "drive.mcap")
        found = self.columns(self.folder / "drive.mcap")
        self.assertEqual(set(found), {"time", "position", "torque"})
        numpy.testing.assert_array_equal(found["torque"], TORQUE)
        numpy.testing.assert_allclose(found["time"], TIME, atol=1e-6)
        found = self.columns(self.folder / "drive.mcap", "--map", "position=position,torque=torque")
        numpy.testing.assert_array_equal(found["position"], POSITION)

    def test_packed_files(self):
        """Tables of text, whatever their characters, and other formats."""
        rows = ["time,position,torque", *(f"{t!r},{q!r},{x!r}" for t, q, x in zip(TIME.tolist(), POSITION.tolist(), TORQUE.tolist(), strict=True)), ""]
        text = "\n".join(rows)
        numpy.savez(self.folder / "inside.npz", time=TIME, position=POSITION, torque=TORQUE)
        packed = {"a.csv.gz": gzip.compress(text.encode()), "A.TXT.BZ2": bz2.compress(text.encode("utf-16")), "a.csv.xz": lzma.compress(text.encode()),
                  "a.npz.gz": gzip.compress((self.folder / "inside.npz").read_bytes())}
        for name, content in packed.items():
            (self.folder / name).write_bytes(content)
        with zipfile.ZipFile(self.folder / "a.zip", "w") as archive:
            archive.writestr("../../up/log.csv", text)
        for name in (*packed, "a.zip"):
            with self.subTest(name):
                self.is_the_log(self.columns(self.folder / name), ("time", "position", "torque"))
        self.output.unlink()
        (self.folder / "cut.csv.gz").write_bytes(packed["a.csv.gz"][:200])
        self.assertIn("cannot be unpacked", self.refusal(self.folder / "cut.csv.gz"))
        with zipfile.ZipFile(self.folder / "two.zip", "w") as archive:
            archive.writestr("a.csv", text)
            archive.writestr("b.csv", text)
        self.assertIn("holds 2 files", self.refusal(self.folder / "two.zip"))
        (self.folder / "again.gz.gz").write_bytes(gzip.compress(packed["a.csv.gz"]))
        self.assertIn("packed again", self.refusal(self.folder / "again.gz.gz"))

    def test_feather_and_netcdf(self):
        pyarrow.feather.write_feather(pyarrow.table({"time": TIME, "position": POSITION, "torque": TORQUE}), self.folder / "log.feather")
        self.is_the_log(self.columns(self.folder / "log.feather"), ("time", "position", "torque"))
        with scipy.io.netcdf_file(self.folder / "log.nc", "w") as file:
            file.createDimension("n", COUNT)
            for name, values in {"time": TIME, "position": numpy.degrees(POSITION), "torque": TORQUE}.items():
                file.createVariable(name, "d", ("n",))[:] = values
            file.variables["position"].units, file.variables["time"].units = "deg", "seconds since 2026-01-01"
        found = self.columns(self.folder / "log.nc")
        with h5py.File(self.output) as file:
            self.assertEqual(file["position"].attrs["unit"], "deg")
        numpy.testing.assert_array_equal(found["torque"], TORQUE)
        with h5py.File(self.folder / "four.nc", "w") as file:  # netCDF-4 is HDF5
            file["time"], file["position"], file["torque"] = TIME, POSITION, TORQUE
        self.is_the_log(self.columns(self.folder / "four.nc"), ("time", "position", "torque"))

    def test_what_no_one_reads_has_a_remedy_that_works(self):
        for name, words in (("log.xls", "save it as .xlsx"), ("LOG.PKL", "is not opened here"), ("log.pickle", "is not opened here")):
            (self.folder / name).write_bytes(b"\x80\x04}")
            said = self.refusal(self.folder / name)
            self.assertIn(words, said)
            self.assertNotIn("warmjoint convert", said)

    def test_endings_are_one_list(self):
        """The reader of each ending is there, and help and page name it."""
        formats = pathlib.Path(__file__).resolve().parents[3] / "tools/python/warmjoint/formats"
        page = (formats.parents[2] / "docs/formats.md").read_text()
        shown = subprocess.run([PROGRAM, "convert", "--help"], capture_output=True, text=True, check=True).stdout
        endings = set(re.findall(r"\.[a-z0-9]+", " ".join(shown.split("LOG REQUIRED")[1].split("-o,--output")[0].split())))
        self.assertGreater(len(endings), 15)
        for ending in endings:
            self.assertRegex(page, rf"(?<![\w]){re.escape(ending)}\b")
        for ending in endings - {".csv"}:
            (self.folder / f"log{ending}").write_bytes(b"nothing of the kind")
            self.assertNotIn("is none of", convert(self.folder / f"log{ending}", self.output).stderr)

    def test_a_missing_package_is_named_with_its_remedy(self):
        (self.folder / "log.json").write_text(json.dumps({"time": [0, 1, 2]}))
        done = subprocess.run([PROGRAM, "convert", self.folder / "log.json", "-o", self.output], capture_output=True, text=True, check=False,
                              env={**{name: value for name, value in os.environ.items() if name != "PYTHONPATH"}, "WARMJOINT_PYTHON": sys.executable,
                                   "PYTHONNOUSERSITE": "1"})
        if done.returncode:  # a Python of the system may have NumPy
            self.assertEqual(done.returncode, 2)
            for words in ("numpy", "warmjoint[convert]", "WARMJOINT_PYTHON"):
                self.assertIn(words, done.stderr)

    def test_a_lone_mcap_without_its_folder(self):
        write_bag(self.folder / "bag", StoragePlugin.MCAP)
        alone = self.folder / "drive.mcap"
        next((self.folder / "bag").glob("*.mcap")).rename(alone)
        self.is_the_log(self.columns(alone, "--joint", "elbow"))

    def test_messages_in_any_order(self):
        write_bag(self.folder / "bag", StoragePlugin.SQLITE3, [*range(100, COUNT), *range(100)])
        self.is_the_log(self.columns(self.folder / "bag", "--joint", "elbow"))

    def test_what_a_bag_lacks_is_named(self):
        bag = self.folder / "bag"
        write_bag(bag, StoragePlugin.SQLITE3)
        self.assertIn("did you mean 'elbow'?", self.refusal(bag, "--joint", "elbo"))
        self.assertIn("did you mean '/wrench'?", self.refusal(bag, "--topic", "/wrenc"))
        self.assertIn("give --map", self.refusal(bag, "--topic", "/wrench"))
        self.assertIn("did you mean 'torque'?", self.refusal(bag, "--topic", "/wrench", "--map", "torque=wrench.torqe.z"))
        self.assertIn("is no number", self.refusal(bag, "--topic", "/wrench", "--map", "torque=wrench"))

    def test_parquet(self):
        log = self.folder / "log.parquet"
        state = pyarrow.array(numpy.stack([0 * POSITION, POSITION], axis=1).tolist(), pyarrow.list_(pyarrow.float64()))
        pyarrow.parquet.write_table(pyarrow.table({"timestamp": TIME, "state": state, "tau": TORQUE}), log)
        found = self.columns(log, "--map", "time=timestamp,position=state[1],torque=tau")
        self.is_the_log(found, ("time", "position", "torque"))
        self.output.unlink()
        self.assertIn("an index is at most 1", self.refusal(log, "--map", "position=state[2]"))
        self.assertIn("did you mean 'tau'?", self.refusal(log, "--map", "torque=taus"))

        # stamps as times
        stamps = pyarrow.array(EPOCH * 10**9 + numpy.round(TIME * 1e9).astype(numpy.int64), pyarrow.timestamp("ns"))
        pyarrow.parquet.write_table(pyarrow.table({"time": stamps, "position": POSITION, "torque": TORQUE}), log)
        found = self.columns(log, "--map", "time=time,position=position,torque=torque")
        self.is_the_log(found, ("time", "position", "torque"))

    def test_numpy(self):
        log = self.folder / "log.npz"
        numpy.savez(log, time=TIME, position=POSITION, torque=TORQUE, q=numpy.stack([POSITION, SPEED], axis=1))
        self.assertEqual(set(self.columns(log)), {"time", "position", "torque", "q[0]", "q[1]"})
        found = self.columns(log, "--map", "time=time,position=q[0],velocity=q[1],torque=torque")
        self.is_the_log(found)
        table = numpy.zeros(COUNT, dtype=[("time", float), ("position", float), ("torque", "f4")])
        table["time"], table["position"], table["torque"] = TIME, POSITION, 1 + TIME
        numpy.save(self.folder / "log.npy", table)
        self.assertEqual(self.columns(self.folder / "log.npy")["torque"][0], 1)

    def test_what_matlab_and_hdf5_hold(self):
        """Each path of each file gives the log, and a path that is not there names the nearest."""
        wide = numpy.stack([0 * TIME, TIME, POSITION, SPEED, TORQUE])
        struct = {"time": TIME, "position": POSITION, "velocity": SPEED, "torque": TORQUE}
        scipy.io.savemat(self.folder / "cells.mat", {"c": numpy.array([wide, wide.T], object), "s": [{"time": 0}, struct]})
        with h5py.File(self.folder / "rows.h5", "w") as file:
            records = numpy.rec.fromarrays(list(struct.values()), names=list(struct))
            file["log"], file["robot/wide"] = records, wide
            file["robot/again"] = file["robot"]
            cells = file.create_dataset("cells", (1, 2), h5py.ref_dtype)  # as MATLAB 7.3 has them
            cells[0, 0], cells[0, 1] = file["log"].ref, file["robot/wide"].ref
        columns = ("time", "position", "velocity", "torque")
        for name, paths in {"cells.mat": [f"c{{0}}[{i}]" for i in range(1, 5)], "cells.mat ": [f"c[1][{i}]" for i in range(1, 5)],
                            " cells.mat": [f"s[1].{name}" for name in columns], "rows.h5": [f"log.{name}" for name in columns],
                            "rows.h5 ": [f"/robot/wide[{i}]" for i in range(1, 5)],
                            " rows.h5": [f"cells[1][{i}]" for i in range(1, 5)]}.items():
            with self.subTest(paths[0]):
                found = self.columns(self.folder / name.strip(), "--map", ",".join(map("=".join, zip(columns, paths, strict=True))))
                self.is_the_log(found)
        self.output.unlink()
        refusal = self.refusal(self.folder / "rows.h5", "--map", "torque=log.torqe")
        self.assertIn("did you mean 'log.torque'? it has: cells[0].position (200)", refusal)
        self.assertIn("an index is at most 4", self.refusal(self.folder / "rows.h5", "--map", "torque=robot/wide[5]"))

    def test_tables_of_instruments(self):
        """TwinCAT, LabVIEW, National Instruments and Excel: where the table begins, its names, and a clock for each column."""
        late = TIME + 0.01

        def table(name, head, columns, separator=";", decimal=".", end="", encoding="utf-8"):
            rows = [separator.join(f"{value:.9f}" for value in row).replace(".", decimal) + end for row in zip(*columns, strict=True)]
            (self.folder / name).write_text("\n".join([*head, *rows, ""]), encoding=encoding)

        table("scope.csv", ["Name;Scope YT", "File;C:\\x.svdx", "", "Name;position;Name;torque", "SymbolComment;;", "SampleTime[ms];50;SampleTime[ms];50"],
              [TIME, POSITION, late, TORQUE])
        table("german.csv", ["Bericht", "Name;position;Name;torque"], [TIME, POSITION, late, TORQUE], decimal=",", encoding="utf-16")
        table("multi.lvm", ["LabVIEW Measurement\t", "X_Columns\tMulti", "***End_of_Header***\t", "Samples\t200\t200\t", "Delta_X\t0.05\t0.05\t",
                            "***End_of_Header***\t\t", "X_Value\tposition\tX_Value\ttorque\tComment"], [TIME, POSITION, late, TORQUE], "\t", end="\t")
        table("ni.csv", ["Time - a,position,Time - b,torque"], [TIME, POSITION, late, TORQUE], ",")
        table("units.txt", ["Drive log 2026", "time\tposition\ttorque", "[s]\t[deg]\t[Nm]"], [TIME, POSITION, TORQUE], "\t")
        book = openpyxl.Workbook()
        for row in ([], ["Drive log"], [], ["time", "position", "torque", "remark"]):
            book.active.append(row)
        for time, position, torque in zip(TIME, POSITION, TORQUE, strict=True):
            book.active.append([datetime.datetime(2026, 11, 26) + datetime.timedelta(seconds=time), position, torque, "fine"])
        book.create_sheet("notes")
        about = book.create_sheet("about", 0)
        about.append(["operator", "supply V"])
        about.append(["A", 48])
        book.save(self.folder / "log.xlsx")
        for name in ("scope.csv", "german.csv", "multi.lvm", "ni.csv", "log.xlsx", "units.txt"):
            with self.subTest(name):
                found = self.columns(self.folder / name)
                found["time"] -= found["time"][0] if name == "log.xlsx" else 0
                # as far as both clocks reach; a step between two samples is a line
                inside = (0.01 if "torque" in found and len(found["time"]) < COUNT else 0) <= TIME
                numpy.testing.assert_allclose(found["time"], TIME[inside], atol=2e-6)
                position = POSITION * numpy.pi / 180 if name == "units.txt" else POSITION
                numpy.testing.assert_allclose(found["position"], position[inside], atol=1e-8)
                shift = 0 if name in {"log.xlsx", "units.txt"} else 0.01
                numpy.testing.assert_allclose(found["torque"], numpy.interp(TIME[inside] - shift, TIME, TORQUE), atol=1e-5)
        self.output.unlink()
        (self.folder / "words.csv").write_text("hello\nworld\n")
        self.assertIn("has no column 'time'", self.refusal(self.folder / "words.csv"))

    def test_what_is_left_out_is_said(self):
        """Sheets and columns of texts, complex numbers and what is no column."""
        book = openpyxl.Workbook()
        book.active.append(["time", "position", "torque", "state"])
        for i in range(5):
            book.active.append([0.1 * i, POSITION[i], TORQUE[i], "OVF" if i == 3 else i])
        book.create_sheet("second")
        book.save(self.folder / "log.xlsx")
        self.columns(self.folder / "log.xlsx")
        for words in ("second", "column 'state'", "'OVF'"):
            self.assertIn(words, self.said)
        numpy.savez(self.folder / "log.npz", time=TIME, position=POSITION, torque=TORQUE, phase=1j * TIME, note=numpy.array(["a"] * COUNT), other=TIME[:9])
        self.output.unlink()  # of the sheets
        self.assertIn("position has 9", self.refusal(self.folder / "log.npz", "--map", "time=time,position=other,torque=torque"))

    def test_numbers_as_text_follow_the_rule_of_tables(self):
        book = openpyxl.Workbook()
        book.active.append(["time", "position", "torque"])
        for i in range(5):
            book.active.append([0.1 * i, POSITION[i], f"16,{250 + i}"])
        book.save(self.folder / "log.xlsx")
        done = convert(self.folder / "log.xlsx", self.output)
        self.assertIn("column 'torque' is left out", done.stderr)

    def test_json(self):
        """Records, one a line or in a list, and an object of arrays; a field that a record lacks is an empty cell."""
        records = [{"t": TIME[i], "q": [0.0, POSITION[i]], "drive": {"tau": TORQUE[i]}} for i in range(COUNT)]
        lines, whole, arrays = (self.folder / name for name in ("log.jsonl", "log.json", "arrays.json"))
        lines.write_text("\n".join(map(json.dumps, records)))
        whole.write_text(json.dumps({"robot": "arm", "entries": records}))
        arrays.write_text(json.dumps({"t": TIME.tolist(), "q": [[0.0, one] for one in POSITION], "drive": {"tau": TORQUE.tolist()}}))
        for log in (lines, whole, arrays):
            found = self.columns(log, "--map", "time=t,position=q[1],torque=drive.tau")
            self.is_the_log(found, ("time", "position", "torque"))
        self.output.unlink()
        lines.write_text(json.dumps(records[0]) + "\n{")
        self.assertIn("log.jsonl:2: is no record", self.refusal(lines))
        self.assertIn("did you mean 'drive.tau'?", self.refusal(whole, "--map", "torque=drive.tua"))

    def test_a_folder_of_parquet_is_a_set_of_episodes(self):
        (self.folder / "set").mkdir()
        for k in range(3):
            pyarrow.parquet.write_table(pyarrow.table({"time": TIME, "position": POSITION, "torque": TORQUE}), self.folder / f"set/{k}.parquet")
        done = convert(self.folder / "set", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        checked = subprocess.run([PROGRAM, "identify", self.output, "-o", self.folder / "e.json"], capture_output=True, text=True, check=False)
        self.assertIn("3 episodes", checked.stdout + checked.stderr)

    def test_bags_whose_publishers_differ(self):
        """A gripper's message first, and a publisher without velocity and effort."""
        kind = "sensor_msgs/msg/JointState"
        state, header = STORE.types[kind], STORE.types["std_msgs/msg/Header"]
        with Writer(self.folder / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            topic = writer.add_connection("/joint_states", kind, typestore=STORE)
            empty = numpy.array([])
            for i in range(COUNT):
                when = EPOCH * 10**9 + round(TIME[i] * 1e9)
                gripper = state(header=header(stamp=stamp(i), frame_id=""), name=["finger"], position=numpy.array([0.1]), velocity=empty, effort=empty)
                bare = state(header=header(stamp=stamp(i), frame_id=""), name=["elbow"], position=numpy.array([0.1]), velocity=empty, effort=empty)
                for message in (gripper, joint_state(i), bare):
                    writer.write(topic, when, STORE.serialize_cdr(message, kind))
        self.is_the_log(self.columns(self.folder / "bag", "--joint", "elbow"))
        self.assertIn("200 of 400 messages of elbow", self.said)
        self.output.unlink()
        self.assertIn("no effort of finger", self.refusal(self.folder / "bag", "--joint", "finger"))

    def test_hostile_files(self):
        """Sizes that a head states, groups that hold themselves, other files, pipes, and names that act on a terminal."""
        head = b"{'descr': [('time','<f8')], 'fortran_order': False, 'shape': (1000000000000,), }".ljust(117) + b"\n"
        (self.folder / "big.npy").write_bytes(b"\x93NUMPY\x01\x00v\x00" + head)
        self.assertIn("states an array", self.refusal(self.folder / "big.npy"))
        # a type whose count is no number of Python's
        head = b"{'descr': '(08,)f8', 'fortran_order': False, 'shape': (8,), }".ljust(117) + b"\n"
        (self.folder / "header.npy").write_bytes(b"\x93NUMPY\x01\x00v\x00" + head + bytes(64))
        self.assertIn("cannot be read as NumPy's", self.refusal(self.folder / "header.npy"))
        (self.folder / "folder").mkdir()
        os.mkfifo(self.folder / "folder/0.parquet")
        self.assertIn("0.parquet: is neither a file nor a folder", self.refusal(self.folder / "folder"))
        os.mkfifo(self.folder / "pipe.npz")
        self.assertIn("neither a file nor a folder", self.refusal(self.folder / "pipe.npz"))
        with h5py.File(self.folder / "self.h5", "w") as file:
            file["log"] = numpy.rec.fromarrays([TIME, POSITION, TORQUE], names=["time", "position", "torque"])
            for k in range(10):
                file[f"again{k}"] = file["/"]
        self.is_the_log(self.columns(self.folder / "self.h5"), ("time", "position", "torque"))
        self.output.unlink()
        with h5py.File(self.folder / "outside.h5", "w") as file:
            file.create_dataset("position", (8,), dtype="f8", external=[("/etc/passwd", 0, 64)])
        self.assertIn("in another file", self.refusal(self.folder / "outside.h5"))
        with h5py.File(self.folder / "link.h5", "w") as file:
            file["time"] = h5py.ExternalLink("outside.h5", "position")
        self.assertIn("link to another file", self.refusal(self.folder / "link.h5"))
        numpy.savez(self.folder / "names.npz", **{"\x1b[31mred": numpy.array(["a", "b"]), "time": TIME})
        said = convert(self.folder / "names.npz", self.output)
        self.assertNotIn("\x1b", said.stdout + said.stderr)

    def test_objects_are_not_unpickled(self):
        log = self.folder / "log.npz"
        numpy.savez(log, time=numpy.array([print, print, print], dtype=object))
        self.assertIn("cannot be read as NumPy's", self.refusal(log))

    def test_damaged_files_and_wrong_names(self):
        for name in ("a.parquet", "a.npz", "a.npy", "a.mcap", "a.db3", "a.bag", "a.mat", "a.h5", "a.xlsx"):
            (self.folder / name).write_bytes(b"\x93NUMPY nothing of the kind")
            self.assertIn(name, self.refusal(self.folder / name, *(["--joint", "elbow"] if name[2:] in {"mcap", "db3", "bag"} else [])))
        self.assertIn("does not exist", self.refusal(self.folder / "none.npz"))
        numpy.savez(self.folder / "log.npz", time=TIME, position=POSITION[:9])
        self.assertIn("position has 9 samples where time has 200", self.refusal(self.folder / "log.npz"))
        numpy.savez(self.folder / "good.npz", time=TIME)
        self.assertIn("choose one of them", self.refusal(self.folder / "good.npz", output=self.folder / "log.xlsx"))

    def test_csv_reads_back_bit_for_bit(self):
        numpy.savez(self.folder / "log.npz", time=TIME, torque=TORQUE)
        done = convert(self.folder / "log.npz", self.folder / "log.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        read = numpy.loadtxt(self.folder / "log.csv", delimiter=",", skiprows=1)
        numpy.testing.assert_array_equal(read[:, 1], TORQUE)


unittest.main(verbosity=1)
