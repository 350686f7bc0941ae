"""Columns of one topic of a rosbag: a joint of sensor_msgs/JointState, or fields of any message."""

import numpy
from columns import Refusal, nearest, split
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


def joint_index(place, message, joint):
    if not joint and len(message.name) != 1:
        raise Refusal(f"{place}: give --joint, one of {', '.join(message.name)}")
    if joint and joint not in message.name:
        raise Refusal(f"{place}: has no joint '{joint}'; {nearest(joint, message.name)}")
    return list(message.name).index(joint) if joint else 0


def of_joint_state(place, messages, joint):
    """time, position, velocity and torque of one joint; messages that leave the joint out are skipped."""
    rows = []
    for stamp, message in messages:
        if joint and rows and joint not in message.name:
            continue
        i = joint_index(place, message, joint)
        lists = (message.position, message.velocity, message.effort)
        rows.append((stamp, *(values[i] if len(values) > i else numpy.nan for values in lists)))
    if not rows:
        return {}
    stamps = numpy.array([row[0] for row in rows], dtype=numpy.int64)
    found = {"time": (stamps - stamps[0]) * 1e-9}
    for k, name in enumerate(("position", "velocity", "torque"), 1):
        values = numpy.array([row[k] for row in rows])
        if numpy.isfinite(values).all():
            found[name] = values
        elif numpy.isfinite(values).any():
            raise Refusal(f"{place}: {name} of the joint is missing in {int((~numpy.isfinite(values)).sum())} messages")
    if "torque" not in found:
        raise Refusal(f"{place}: its JointState has no effort; take a topic that has it, with --topic and --map")
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


def columns(path, topic, joint, fields):
    if joint and fields:
        raise Refusal(f"{path}: give --joint or --map, not both")
    try:
        with AnyReader([bag_of(path)], default_typestore=get_typestore(Stores.LATEST)) as reader:
            connections = topic_of(path, reader, topic, fields)
            place = f"{path}: {connections[0].topic}"
            messages = ((stamp, reader.deserialize(raw, one.msgtype)) for one, stamp, raw in reader.messages(connections))
            timed = ((seconds_of(message, stamp), message) for stamp, message in messages)
            found = of_fields(place, timed, fields) if fields else of_joint_state(place, timed, joint)
    except Refusal:
        raise
    except Exception as error:  # a damaged file breaks any part of the parsers
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise Refusal(f"{path}: cannot be read as a rosbag: {words}") from None
    if not found:
        raise Refusal(f"{path}: its topic holds no message")
    order = numpy.argsort(found["time"], kind="stable")
    return {name: values[order] for name, values in found.items()}
