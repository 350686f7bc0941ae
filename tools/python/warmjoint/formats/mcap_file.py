"""Messages of MCAP files, as far as each of them reaches: a logger that was cut off leaves its messages up to there."""

import struct
import zlib

from refusal import Refusal

MAGIC = b"\x89MCAP0\r\n"
LARGEST = 1 << 30  # bytes of a record, and of a chunk unpacked
SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 3, 4, 5, 6, 15


class Cut(Exception):
    """A file ends within a record."""


def text_at(data, at):
    """(a text with its length in front, where it ends)."""
    (length,) = struct.unpack_from("<I", data, at)
    return bytes(data[at + 4:at + 4 + length]).decode(errors="replace"), at + 4 + length


def decompressor_of(path, kind):
    """What unpacks the bytes of a chunk, as far as they are there."""
    if kind == "lz4":
        import lz4.frame

        return lz4.frame.LZ4FrameDecompressor().decompress
    if kind == "zstd":
        from rosbags.rosbag2.storage_mcap import zstd

        return zstd.ZstdDecompressor().decompress
    if kind:
        raise Refusal(f"{path}: has chunks packed by {kind}; lz4 and zstd are read")
    return lambda packed, most: packed[:most]


def records_of_chunk(path, data):
    """The records of a chunk, which may be cut off."""
    size, crc = struct.unpack_from("<QI", data, 16)
    kind, at = text_at(data, 28)
    (length,) = struct.unpack_from("<Q", data, at)
    if size > LARGEST:
        raise Refusal(f"{path}: states a chunk of {size} bytes; {LARGEST} at most are read")
    unpack = decompressor_of(path, kind)
    try:
        records = unpack(bytes(data[at + 8:at + 8 + length]), size + 1)  # and no more, whatever the chunk holds
    except MemoryError:
        raise
    except Exception as error:  # of either library
        raise Cut from error
    if len(records) > size or (len(records) == size and crc and zlib.crc32(records) != crc):
        raise Cut
    yield from records_of(memoryview(records))
    if len(records) < size:
        raise Cut


def records_of(data):
    """(kind, content) of records one behind the other."""
    at = 0
    while at < len(data):
        if at + 9 > len(data):
            raise Cut
        kind, length = struct.unpack_from("<BQ", data, at)
        if at + 9 + length > len(data):
            raise Cut
        yield kind, data[at + 9:at + 9 + length]
        at += 9 + length


def records_in(path, file):
    """The same of a file, chunks taken apart."""
    if file.read(len(MAGIC)) != MAGIC:
        raise Refusal(f"{path}: cannot be read as MCAP: it does not begin as one")
    while head := file.read(9):
        if len(head) < 9:
            raise Cut
        kind, length = struct.unpack("<BQ", head)
        if kind == DATA_END:
            return
        if length > LARGEST:
            raise Cut
        content = file.read(length)
        if kind == CHUNK:
            yield from records_of_chunk(path, content)
        elif len(content) == length:
            yield kind, memoryview(content)
        if len(content) < length:
            raise Cut
    raise Cut  # without an end of its data


class Mcap:
    """One recording in one or several files."""

    def __init__(self, paths, notes):
        self.paths, self.notes = paths, notes
        self.cut = set()
        self.kinds = {}  # {topic: name of its messages}
        self.count = sum(1 for _ in self._messages())
        for path in sorted(self.cut):
            notes.append(f"{path} ends within a record, as a logger leaves it that was cut off: messages up to there are read")
        if self.cut and not self.count:
            raise Refusal(f"{sorted(self.cut)[0]}: ends before its first message; nothing of it can be read")

    def _messages(self):
        """(topic, (name, form, text of its schema), form of the message, ns, bytes) of all files."""
        for path in self.paths:
            schemas, channels = {}, {}
            with open(path, "rb") as file:
                try:
                    for kind, data in records_in(path, file):
                        if kind == SCHEMA:
                            (number,) = struct.unpack_from("<H", data)
                            name, at = text_at(data, 2)
                            form, at = text_at(data, at)
                            schemas[number] = name, form, text_at(data, at)[0]
                        elif kind == CHANNEL:
                            number, schema = struct.unpack_from("<HH", data)
                            topic, at = text_at(data, 4)
                            channels[number] = topic, schemas.get(schema, ("", "", "")), text_at(data, at)[0]
                            self.kinds[topic] = channels[number][1][0]
                        elif kind == MESSAGE:
                            number, _, stamp = struct.unpack_from("<HIQ", data)
                            if number in channels:
                                yield *channels[number], stamp, data[22:]
                except (Cut, struct.error):
                    self.cut.add(str(path))

    def messages(self, topic, types):
        """(ns, message) of a topic. types: Types"""
        for name, schema, form, stamp, data in self._messages():
            if name == topic:
                yield stamp, types.read(schema, form, bytes(data))
