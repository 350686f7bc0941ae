"""Columns of one topic of a rosbag or MCAP: joints of sensor_msgs/JointState, fields of any message, all fields of JSON."""

import contextlib
import json
import pathlib
import tempfile
from collections.abc import Mapping

import numpy
from columns import MOST_NUMBERS, nearest, split
from mcap_file import Mcap
from read_json import table_of
from refusal import Refusal, first_line
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

JOINT_STATES = ("sensor_msgs/msg/JointState", "sensor_msgs/JointState")


class Types:
    """Reads messages by the schemas that their file holds."""

    def __init__(self, place):
        self.place, self.stores = place, {}
        self.latest = get_typestore(Stores.LATEST)

    def read(self, schema, form, data):
        if form == "json":
            return json.loads(data)
        if form not in ("cdr", "ros1"):
            raise Refusal(f"{self.place}: its messages are written as {form or 'something that it does not name'}; cdr, ros1 and json are read")
        store, name = self.store_of(schema)
        return store.deserialize_cdr(data, name) if form == "cdr" else store.deserialize_ros1(data, name)

    def store_of(self, schema):
        """(types, the name of the schema's message in them)."""
        name, form, text = schema
        if name.count("/") == 1:
            name = name.replace("/", "/msg/")
        if not text.strip():
            return self.latest, name
        if schema not in self.stores:
            store = get_typestore(Stores.EMPTY)
            store.register(get_types_from_idl(text) if form.endswith("idl") else get_types_from_msg(text, name))
            self.stores[schema] = store
        return self.stores[schema], name


class Bag:
    """A rosbag of another storage than MCAP."""

    def __init__(self, reader):
        self.reader = reader
        self.kinds = {one.topic: one.msgtype for one in reader.connections}

    def messages(self, topic, types):
        connections = [one for one in self.reader.connections if one.topic == topic]
        for one, stamp, raw in self.reader.messages(connections):
            yield stamp, self.reader.deserialize(raw, one.msgtype)


@contextlib.contextmanager
def opened(path, notes):
    """A Bag or Mcap."""
    folder = path if path.is_dir() else path.parent if path.suffix.lower() != ".bag" and (path.parent / "metadata.yaml").exists() else None
    files = sorted(folder.glob("*.mcap")) if folder else [path] if path.suffix.lower() == ".mcap" else []
    if files:
        yield Mcap(files, notes)
        return
    with tempfile.TemporaryDirectory() as other:
        # the library goes by names: a folder is no rosbag1, whatever its name ends in, and endings are in small letters
        place = folder or path
        if folder or place.suffix != place.suffix.lower():
            link = pathlib.Path(other) / f"log{'' if folder else place.suffix.lower()}"
            link.symlink_to(place.resolve())
            place = link
        with AnyReader([place], default_typestore=get_typestore(Stores.LATEST)) as reader:
            yield Bag(reader)


def topic_of(path, bag, topic, fields):
    """The topic that is asked for; else the only one of joints, or the only one."""
    kinds = bag.kinds
    fitting = sorted(name for name, kind in kinds.items() if kind in JOINT_STATES)
    if not topic and not fields and len(fitting) == 1:
        return fitting[0]
    if not topic and len(kinds) == 1:
        return next(iter(kinds))
    if not topic:
        reason = "--map needs one" if fields else f"{len(fitting)} topics are of {JOINT_STATES[0]}"
        raise Refusal(f"{path}: give --topic, since {reason}; {nearest('', kinds)}")
    if topic not in kinds:
        raise Refusal(f"{path}: has no topic '{topic}'; {nearest(topic, kinds)}")
    return topic


def member(value, name, otherwise=None):
    """A part of a message, of ROS or of JSON."""
    return value.get(name, otherwise) if isinstance(value, Mapping) else getattr(value, name, otherwise)


def names_in(value):
    return list(value) if isinstance(value, Mapping) else [one for one in getattr(value, "__dataclass_fields__", {}) if not one.startswith("__")]


def nanoseconds_of(message, stamp):
    """ns since the epoch: by the message's header, or by the bag."""
    inside = member(member(message, "header"), "stamp")
    second, rest = member(inside, "sec", 0), member(inside, "nanosec", member(inside, "nsec", 0))
    whole = isinstance(second, int) and isinstance(rest, int) and (second or rest)
    return second * 10**9 + rest if whole else stamp


def field_of(place, message, field):
    """A number of a message by a dotted path, whose parts may have an index: "wrench.torque.z", "q[3]"."""
    value = message
    for part in field.split("."):
        name, index = split(part)
        known = names_in(value)
        if name not in known:
            raise Refusal(f"{place}: a message has no '{name}' in {field}; {nearest(name, known)}")
        value = member(value, name)
        if index is not None:
            if index >= len(value):
                raise Refusal(f"{place}: {name} has {len(value)} entries; an index is at most {len(value) - 1}")
            value = value[index]
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Refusal(f"{place}: {field} is no number; give an index or a field of it") from None


def counted(place, messages):
    """Messages one by one; refuses more than a log may have."""
    for count, message in enumerate(messages, 1):
        if count > MOST_NUMBERS // 8:
            raise Refusal(f"{place}: holds more than {count - 1} messages; cut the bag")
        yield message


def rows_of_joints(messages):
    """{joint: rows of (ns, position, velocity, effort)}; NaN where a message lacks one."""
    rows = {}
    for stamp, message in messages:
        lists = [member(message, name, ()) for name in ("position", "velocity", "effort")]
        for i, name in enumerate(member(message, "name", ())):
            rows.setdefault(str(name), []).append((stamp, *(values[i] if len(values) > i else numpy.nan for values in lists)))
    return rows


def of_one_joint(place, joint, rows, notes):
    """time, position, velocity and torque of one joint.

    Messages that leave the joint out, as a gripper's, are skipped, and so are those of a publisher without efforts. Of a velocity that some
    lack nothing is kept: positions tell it.
    """
    stamps = numpy.array([row[0] for row in rows], dtype=numpy.int64)
    values = {name: numpy.array([row[k] for row in rows], dtype=float) for k, name in enumerate(("position", "velocity", "torque"), 1)}
    there = {name: numpy.isfinite(one) for name, one in values.items()}
    if not there["torque"].any():
        raise Refusal(f"{place}: its JointState has no effort of {joint}; take a topic that has it, with --topic and --map")
    whole = there["torque"] & (there["position"] if there["position"].any() else there["velocity"])
    if not whole.any():
        raise Refusal(f"{place}: no message has both an effort and a position of {joint}; take topics apart, with --topic and --map")
    if not whole.all():
        notes.append(f"{int((~whole).sum())} of {len(whole)} messages of {joint} lack its effort or position and are left out")
    found = {"time": (stamps[whole] - stamps[whole][0]) * 1e-9}
    for name, one in values.items():
        if there[name][whole].all():
            found[name] = one[whole]
        elif there[name].any():
            notes.append(f"the {name} is left out: {int((~there[name][whole]).sum())} of {int(whole.sum())} messages lack it")
    return found


def of_all_joints(place, rows):
    """time, and "JOINT.position", "JOINT.velocity" and "JOINT.effort" of all; NaN where a message lacks one."""
    stamps = numpy.unique(numpy.array([row[0] for one in rows.values() for row in one], dtype=numpy.int64))
    if len(stamps) * 3 * len(rows) > MOST_NUMBERS:
        raise Refusal(f"{place}: holds {len(stamps)} messages of {len(rows)} joints; choose one with --joint, or cut the bag")
    found = {"time": (stamps - stamps[0]) * 1e-9}
    for joint, of_joint in rows.items():
        at = numpy.searchsorted(stamps, numpy.array([row[0] for row in of_joint], dtype=numpy.int64))
        for k, name in enumerate(("position", "velocity", "effort"), 1):
            column, values = numpy.full(len(stamps), numpy.nan), numpy.array([row[k] for row in of_joint], dtype=float)
            there = numpy.isfinite(values)
            column[at[there]] = values[there]
            if there.any():
                found[f"{joint}.{name}"] = column
    return found


def of_joint_states(place, messages, request, notes):
    rows = rows_of_joints(messages)
    joint = request.get("joint")
    if joint and joint not in rows:
        raise Refusal(f"{place}: has no joint '{joint}'; {nearest(joint, rows)}")
    if joint or len(rows) == 1:
        joint = joint or next(iter(rows))
        return of_one_joint(place, joint, rows[joint], notes)
    if rows and request.get("joints") != "all":
        raise Refusal(f"{place}: give --joint, one of {', '.join(rows)}")
    return of_all_joints(place, rows) if rows else {}


def of_fields(place, messages, fields):
    rows = {name: [] for name in fields}
    stamps = []
    for stamp, message in messages:
        stamps.append(stamp)
        for name, field in fields.items():
            rows[name].append(field_of(place, message, field))
    stamps = numpy.array(stamps, dtype=numpy.int64)
    found = {} if "time" in fields else {"time": (stamps - stamps[0]) * 1e-9 if len(stamps) else stamps}
    return {**found, **{name: numpy.array(values) for name, values in rows.items()}}


def records_of(messages):
    """JSON, each message with the time of the log where it has none of its own."""
    first = None
    for stamp, message in messages:
        if not isinstance(message, dict):
            raise Refusal("a message of JSON is no object {...}")
        first = stamp if first is None else first
        yield message if "time" in message else {"time": (stamp - first) * 1e-9, **message}


def read(path, bag, request, notes):
    """{column: [N]}, or a table of text."""
    fields = {ours: field for ours, field in (request.get("map") or {}).items() if field}
    topic = topic_of(path, bag, request.get("topic"), fields)
    place, kind = f"{path}: {topic}", bag.kinds[topic]
    messages = counted(place, bag.messages(topic, Types(place)))
    timed = ((nanoseconds_of(message, stamp), message) for stamp, message in messages)
    if fields:
        return of_fields(place, timed, fields)
    if kind in JOINT_STATES:
        return of_joint_states(place, timed, request, notes)
    first = next(timed, None)
    if first and not isinstance(first[1], dict):
        raise Refusal(f"{path}: {topic} is of {kind}; give --map COLUMN=FIELD for its fields")
    return table_of(place, records_of(sorted([first, *timed], key=lambda one: one[0]))) if first else {}


def columns(path, request, notes):
    """{column: (unit, [N])} in order of time, or a table of text."""
    if request.get("joint") and request.get("map"):
        raise Refusal(f"{path}: give --joint or --map, not both")
    try:
        with opened(path, notes) as bag:
            found = read(path, bag, request, notes)
    except (Refusal, MemoryError, ModuleNotFoundError):
        raise
    except Exception as error:  # a damaged file breaks any part of the parsers
        raise Refusal(f"{path}: cannot be read as a rosbag: {first_line(error)}") from None
    if isinstance(found, str):
        return found
    if not found:
        raise Refusal(f"{path}: its topic holds no message")
    order = numpy.argsort(found["time"], kind="stable")
    return {name: ("s" if name == "time" else "", numpy.ascontiguousarray(values[order], dtype=float)) for name, values in found.items()}
