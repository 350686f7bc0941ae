"""Columns of one topic of a rosbag: a joint of sensor_msgs/JointState, or fields of any message."""

import numpy
from columns import MOST_NUMBERS, Refusal, first_line, nearest, split
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

JOINT_STATE = "sensor_msgs/msg/JointState"


def bag_of(path):
    """The folder of a rosbag2 that a file of it was given for; a .bag or a lone file as it is."""
    lone = path.is_dir() or path.suffix == ".bag" or not (path.parent / "metadata.yaml").exists()
    return path if lone else path.parent


def topic_of(path, reader, topic, fields):
    """The connections of the topic."""
    topics = {one.topic: one.msgtype for one in reader.connections}
    if not topic:
        fitting = sorted(name for name, kind in topics.items() if kind == JOINT_STATE)
        if fields or len(fitting) != 1:
            reason = "--map needs one" if fields else f"{len(fitting)} topics are of {JOINT_STATE}"
            raise Refusal(f"{path}: give --topic, since {reason}; {nearest('', topics)}")
        topic = fitting[0]
    if topic not in topics:
        raise Refusal(f"{path}: has no topic '{topic}'; {nearest(topic, topics)}")
    if not fields and topics[topic] != JOINT_STATE:
        raise Refusal(f"{path}: {topic} is of {topics[topic]}; give --map COLUMN=FIELD for its fields")
    return [one for one in reader.connections if one.topic == topic]


def seconds_of(message, stamp):
    """s since the epoch, whole and nanoseconds: by the message's header, or by the bag."""
    header = getattr(message, "header", None)
    if header is not None and (header.stamp.sec or header.stamp.nanosec):
        return header.stamp.sec * 10**9 + header.stamp.nanosec
    return stamp


def field_of(place, message, field):
    """A number of a message by a dotted path, whose parts may have an index: "wrench.torque.z", "q[3]"."""
    value = message
    for part in field.split("."):
        name, index = split(part)
        known = [one for one in getattr(value, "__dataclass_fields__", {}) if not one.startswith("__")]
        if name not in known:
            raise Refusal(f"{place}: a message has no '{name}' in {field}; {nearest(name, known)}")
        value = getattr(value, name)
        if index is not None:
            if index >= len(value):
                raise Refusal(f"{place}: {name} has {len(value)} entries; an index is at most {len(value) - 1}")
            value = value[index]
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Refusal(f"{place}: {field} is no number; give an index or a field of it") from None


def joint_of(place, names, joint):
    """The joint that is asked for; the only one where none is. names: {joint: messages that hold it}"""
    if joint and joint not in names:
        raise Refusal(f"{place}: has no joint '{joint}'; {nearest(joint, names)}")
    if not joint and len(names) != 1:
        raise Refusal(f"{place}: give --joint, one of {', '.join(names)}")
    return joint or next(iter(names))


def require_count(place, messages):
    """Messages one by one; refuses more than a log may have."""
    for count, message in enumerate(messages, 1):
        if count > MOST_NUMBERS // 8:
            raise Refusal(f"{place}: holds more than {count - 1} messages; cut the bag")
        yield message


def of_joint_state(place, messages, joint, notes):
    """time, position, velocity and torque of one joint.

    Messages that leave the joint out, as a gripper's, are skipped, and so are those of a publisher without efforts. Of a velocity that some
    lack nothing is kept: positions tell it.
    """
    rows, names = [], {}
    for stamp, message in messages:
        for i, name in enumerate(message.name):
            names[name] = names.get(name, 0) + 1
            if joint and name != joint:
                continue
            lists = (message.position, message.velocity, message.effort)
            rows.append((name, stamp, *(values[i] if len(values) > i else numpy.nan for values in lists)))
    if not names:
        return {}
    joint = joint_of(place, names, joint)
    stamps = numpy.array([row[1] for row in rows], dtype=numpy.int64)
    values = {name: numpy.array([row[k] for row in rows]) for k, name in enumerate(("position", "velocity", "torque"), 2)}
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


def columns(path, topic, joint, fields, notes):
    """{column: (unit, [N])} in order of time."""
    if joint and fields:
        raise Refusal(f"{path}: give --joint or --map, not both")
    try:
        with AnyReader([bag_of(path)], default_typestore=get_typestore(Stores.LATEST)) as reader:
            connections = topic_of(path, reader, topic, fields)
            place = f"{path}: {connections[0].topic}"
            messages = ((stamp, reader.deserialize(raw, one.msgtype)) for one, stamp, raw in reader.messages(connections))
            timed = ((seconds_of(message, stamp), message) for stamp, message in require_count(place, messages))
            found = of_fields(place, timed, fields) if fields else of_joint_state(place, timed, joint, notes)
    except (Refusal, MemoryError):
        raise
    except Exception as error:  # a damaged file breaks any part of the parsers
        raise Refusal(f"{path}: cannot be read as a rosbag: {first_line(error)}") from None
    if not found:
        raise Refusal(f"{path}: its topic holds no message")
    order = numpy.argsort(found["time"], kind="stable")
    return {name: ("s" if name == "time" else "", numpy.ascontiguousarray(values[order], dtype=float)) for name, values in found.items()}
