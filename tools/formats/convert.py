"""Makes a log that warmjoint reads of logs in other formats: see tools/convert."""

import argparse
import importlib
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from columns import Refusal, pick, require_one_length

EXAMPLES = """examples:
  tools/convert drive.mcap -o elbow.h5 --joint elbow            # one joint of sensor_msgs/JointState
  tools/convert bag/ -o log.csv --topic /motor --map position=q,torque=wrench.torque.z
  tools/convert episode.parquet -o log.h5 --map time=timestamp,position=observation.state[3],torque=effort[3]
  tools/convert run.npz -o log.h5                               # all columns under their own names
  tools/convert drive.mat -o log.h5 --map time=log[0].t,position=log[0].q[2],torque=log[0].tau[2]
  tools/convert scope.csv -o log.h5                             # TwinCAT, LabVIEW, Excel: a clock for each column
"""


def read_map(words):
    """{column: field} of COLUMN=FIELD,... as in `identify --map`."""
    fields = {}
    for word in ",".join(words).split(",") if words else []:
        column, equals, field = word.partition("=")
        if not (column and equals and field):
            raise Refusal(f"--map: '{word}' is not of the form COLUMN=FIELD")
        if column in fields:
            raise Refusal(f"--map: {column} is given twice; leave one")
        fields[column] = field
    return fields


READERS = {".parquet": "read_parquet", ".npz": "read_numpy", ".npy": "read_numpy",
           **dict.fromkeys((".mat", ".h5", ".hdf5"), "read_arrays"),
           **dict.fromkeys((".csv", ".txt", ".tsv", ".lvm", ".xlsx", ".xls", ".xlsm"), "read_table")}


def read(path, topic, joint, fields):
    """The columns of a log, {name: vector}. Readers are loaded when they are needed."""
    if not path.exists():
        raise Refusal(f"{path}: does not exist")
    kind = path.suffix.lower()
    bag = path.is_dir() or kind in {".db3", ".mcap", ".bag"}
    if not bag and (topic or joint):
        raise Refusal(f"{path}: --topic and --joint are for bags; name columns with --map")
    if bag:
        import read_bag

        return read_bag.columns(path, topic, joint, fields)
    if kind not in READERS:
        raise Refusal(f"{path}: '{kind}' is none of {', '.join(['.mcap', '.db3', '.bag', *READERS])}; a folder is read as rosbag2")
    return pick(path, importlib.import_module(READERS[kind]).tree(path), fields)


def main():
    parser = argparse.ArgumentParser(prog="tools/convert", description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("log", type=pathlib.Path, help=f"rosbag2 folder, .db3, .mcap, .bag, {', '.join(READERS)}")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help=".h5 or .csv")
    parser.add_argument("--topic", help="of a bag; default: the only one of sensor_msgs/JointState")
    parser.add_argument("--joint", help="of JointState messages; default: the only one")
    parser.add_argument("--map", action="append", metavar="COLUMN=FIELD",
                        help="fields of other messages, columns or arrays, as position=q[3],torque=wrench.torque.z")
    given = parser.parse_args()
    try:
        from write_log import write

        columns = read(given.log, given.topic, given.joint, read_map(given.map))
        require_one_length(given.log, columns)
        if given.output.exists() and given.output.samefile(given.log):
            raise Refusal(f"{given.output}: is the input, which would be lost; choose another output")
        write(columns, given.output)
    except Refusal as refusal:
        print(f"error: {refusal}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"error: {error.filename or given.output}: {error.strerror or error}", file=sys.stderr)
        return 4
    first = next(iter(columns.values()))
    print(f"{given.output}: {len(first)} samples of {', '.join(columns)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
