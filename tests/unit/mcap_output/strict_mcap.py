#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A strict reader of MCAP files and ROS 2 messages, by the specifications alone; shares nothing with edgevo.

  strict_mcap.py check FILE    every rule of a finished file; prints what it holds
  strict_mcap.py cut FILE N    cuts the file at N places: every chunk before the cut must be readable
  strict_mcap.py begun FILE    a file without its end: prints how many whole chunks and messages it holds
  strict_mcap.py table FILE TOPIC FIELD...   values of fields, one line for each message
  strict_mcap.py cloud FILE TOPIC            the values of each point of its clouds

Standard library, and libzstd by ctypes. Exit code 1 with the first rule that is broken."""
import ctypes
import random
import struct
import sys
import zlib
from collections import Counter, defaultdict

MAGIC = b"\x89MCAP0\r\n"
(HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX, ATTACHMENT, ATTACHMENT_INDEX,
 STATISTICS, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END) = range(1, 16)


class Broken(Exception):
    pass


def require(condition, rule):
    if not condition:
        raise Broken(rule)


class Fields:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        size = struct.calcsize(form)
        require(self.at + size <= len(self.data), "a record ends within a field")
        (value,) = struct.unpack_from(form, self.data, self.at)
        self.at += size
        return value

    def u8(self): return self.take("<B")
    def u16(self): return self.take("<H")
    def u32(self): return self.take("<I")
    def u64(self): return self.take("<Q")

    def raw(self, size):
        require(self.at + size <= len(self.data), "a record ends within its bytes")
        self.at += size
        return self.data[self.at - size:self.at]

    def blob(self): return self.raw(self.u32())
    def text(self): return self.blob().decode("utf-8")
    def rest(self): return self.raw(len(self.data) - self.at)

    def pairs(self):
        inner, result = Fields(self.blob()), {}
        while inner.at < len(inner.data):
            key = inner.text()
            require(key not in result, "a key stands twice in a map")
            result[key] = inner.text()
        return result

    def numbers(self):
        inner, result = Fields(self.blob()), {}
        while inner.at < len(inner.data):
            key = inner.u16()
            require(key not in result, "a channel stands twice in a map")
            result[key] = inner.u64()
        return result

    def end(self):
        require(self.at == len(self.data), "a record is longer than its fields")


def unzstd(data, size):
    lib = ctypes.CDLL("libzstd.so.1")
    lib.ZSTD_decompress.restype = ctypes.c_size_t
    buffer = ctypes.create_string_buffer(max(size, 1))
    got = lib.ZSTD_decompress(buffer, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data)))
    require(got == size, "a chunk does not unpack to its size")
    return buffer.raw[:size]


# ---- definitions of messages ----

PRIMITIVE = {"bool": "?", "byte": "B", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
             "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


def parse_definition(text):
    fields = []
    for line in text.splitlines():
        line = line.split("#")[0].strip()
        if not line or "=" in line.split()[1]:
            continue  # a constant
        kind, name = line.split()
        count = None
        if kind.endswith("]"):
            kind, inside = kind[:-1].split("[")
            count = int(inside) if inside else -1
        fields.append((kind, count, name))
    return fields


def parse_schema(name, text):
    """Definitions by type; requires that each nested one is there, once, and that none is superfluous."""
    parts = text.split("=" * 80 + "\n")
    types = {name.replace("/msg/", "/"): parse_definition(parts[0])}
    for part in parts[1:]:
        head, _, body = part.partition("\n")
        require(head.startswith("MSG: "), "a nested definition without its name in " + name)
        require(head[5:] not in types, head[5:] + " is defined twice in " + name)
        types[head[5:]] = parse_definition(body)
    used = {name.replace("/msg/", "/")}
    for fields in types.values():
        require(fields, "a definition without fields in " + name)
        for kind, _, _ in fields:
            if kind not in PRIMITIVE and kind != "string":
                require(kind in types, f"{kind} is not defined in the schema {name}")
                used.add(kind)
    require(used == set(types), "definitions that nothing uses in " + name)
    return types


class Cdr:
    def __init__(self, data, types):
        require(data[:4] == b"\0\1\0\0", "a message is not CDR, little endian")
        self.data, self.at, self.types = data, 4, types

    def number(self, form):
        size = struct.calcsize("<" + form)
        start = 4 + (self.at - 4 + size - 1) // size * size
        require(not any(self.data[self.at:start]), "bytes between fields that are not zero")
        require(start + size <= len(self.data), "a message ends within a field")
        self.at = start + size
        return struct.unpack_from("<" + form, self.data, start)[0]

    def one(self, kind):
        if kind in PRIMITIVE:
            return self.number(PRIMITIVE[kind])
        if kind == "string":
            size = self.number("I")
            raw = self.data[self.at:self.at + size]
            require(size >= 1 and len(raw) == size and raw[-1] == 0, "a string without its closing zero")
            self.at += size
            return raw[:-1].decode("utf-8")
        return self.message(kind)

    def message(self, kind):
        result = {}
        for inner, count, name in self.types[kind]:
            if count is None:
                result[name] = self.one(inner)
                continue
            if count < 0:
                count = self.number("I")
            if inner in ("uint8", "int8") and count:
                result[name] = self.data[self.at:self.at + count]
                require(len(result[name]) == count, "a message ends within its bytes")
                self.at += count
            else:
                result[name] = [self.one(inner) for _ in range(count)]
        return result


def decode(schema, data):
    cdr = Cdr(data, schema["types"])
    result = cdr.message(schema["name"].replace("/msg/", "/"))
    require(cdr.at == len(data), f"a {schema['name']} is longer than its fields")
    return result


# ---- the file ----

class Reader:
    def __init__(self, data):
        self.data, self.schemas, self.channels = data, {}, {}
        self.messages, self.chunks, self.metadata = [], [], {}

    def records(self, start, end):
        """(offset, opcode, content) of whole records; stops before one that is cut off."""
        self.whole_until = start
        while start + 9 <= end:
            opcode, size = struct.unpack_from("<BQ", self.data, start)
            if start + 9 + size > end:
                return
            yield start, opcode, self.data[start + 9:start + 9 + size]
            start += 9 + size
            self.whole_until = start

    def add_schema(self, content):
        f = Fields(content)
        number, name, encoding, text = f.u16(), f.text(), f.text(), f.text()
        f.end()
        require(number > 0 and encoding == "ros2msg", "a schema is not ros2msg")
        schema = {"name": name, "text": text, "types": parse_schema(name, text)}
        require(self.schemas.get(number, schema) == schema, "two schemas have one number")
        self.schemas[number] = schema

    def add_channel(self, content):
        f = Fields(content)
        number, schema, topic, encoding, metadata = f.u16(), f.u16(), f.text(), f.text(), f.pairs()
        f.end()
        require(encoding == "cdr", "a channel is not cdr")
        require(schema in self.schemas, "a channel stands before its schema")
        channel = {"schema": schema, "topic": topic, "metadata": metadata}
        require(self.channels.get(number, channel) == channel, "two channels have one number")
        self.channels[number] = channel

    def add_message(self, content):
        f = Fields(content)
        channel, sequence, log_time, publish_time = f.u16(), f.u32(), f.u64(), f.u64()
        require(channel in self.channels, "a message stands before its channel")
        schema = self.schemas[self.channels[channel]["schema"]]
        self.messages.append({"channel": channel, "topic": self.channels[channel]["topic"],
                              "sequence": sequence, "time": log_time, "publish_time": publish_time,
                              "data": decode(schema, f.rest())})
        return channel, log_time

    def add_chunk(self, offset, content):
        f = Fields(content)
        start, end, size, crc, compression = f.u64(), f.u64(), f.u64(), f.u32(), f.text()
        packed = f.raw(f.u64())
        f.end()
        records = {"": lambda: packed, "zstd": lambda: unzstd(packed, size)}[compression]()
        require(len(records) == size, "a chunk has another size than it says")
        require(zlib.crc32(records) == crc, "the checksum of a chunk is wrong")
        inner, index, times = Reader(records), defaultdict(list), []
        inner.schemas, inner.channels, inner.messages = self.schemas, self.channels, self.messages
        for place, opcode, body in inner.records(0, size):
            if opcode == SCHEMA:
                self.add_schema(body)
            elif opcode == CHANNEL:
                self.add_channel(body)
            else:
                require(opcode == MESSAGE, "a chunk holds another record than messages")
                channel, time = inner.add_message(body)
                index[channel].append((time, place))
                times.append(time)
        require(inner.whole_until == size, "a chunk ends within a record")
        require(start == min(times) and end == max(times), "a chunk has other times than it says")
        self.chunks.append({"offset": offset, "length": 9 + len(content), "index": index, "start": start,
                            "end": end, "indices": {}, "compression": compression, "packed": len(packed),
                            "size": size})

    def add_message_index(self, offset, content):
        f = Fields(content)
        channel, inner, entries = f.u16(), Fields(f.blob()), []
        f.end()
        while inner.at < len(inner.data):
            entries.append((inner.u64(), inner.u64()))
        chunk = self.chunks[-1]
        require(entries == chunk["index"][channel], "an index of messages is not that of its chunk")
        chunk["indices"][channel] = offset

    def read_data(self, end):
        """Header and data section up to `end`; returns the offset after the DataEnd, or None."""
        require(self.data[:8] == MAGIC, "the file does not begin as MCAP")
        first = True
        for offset, opcode, content in self.records(8, end):
            require(first == (opcode == HEADER), "the header is not the first record")
            first = False
            if opcode == HEADER:
                f = Fields(content)
                self.profile, self.library = f.text(), f.text()
                f.end()
                require(self.profile == "ros2", "the profile is not ros2")
            elif opcode == CHUNK:
                self.add_chunk(offset, content)
            elif opcode == MESSAGE_INDEX:
                self.add_message_index(offset, content)
            elif opcode == METADATA:
                f = Fields(content)
                name, pairs = f.text(), f.pairs()
                f.end()
                self.metadata[name] = (pairs, offset, 9 + len(content))
            elif opcode == DATA_END:
                require(struct.unpack("<I", content)[0] == zlib.crc32(self.data[:offset]),
                        "the checksum of the data is wrong")
                return offset + 9 + len(content)
            else:
                raise Broken(f"record {opcode} in the data")
        return None

    def check_chunk_index(self, content, chunk):
        f = Fields(content)
        got = (f.u64(), f.u64(), f.u64(), f.u64(), f.numbers(), f.u64(), f.text(), f.u64(), f.u64())
        f.end()
        require(set(chunk["indices"]) == set(chunk["index"]), "a channel of a chunk has no index")
        length = got[5]
        want = (chunk["start"], chunk["end"], chunk["offset"], chunk["length"], chunk["indices"], length,
                chunk["compression"], chunk["packed"], chunk["size"])
        require(got == want, f"an index of chunks is wrong: {got}, not {want}")
        after = chunk["offset"] + chunk["length"]
        ends = [o + 9 + struct.unpack_from("<Q", self.data, o + 1)[0] for o in chunk["indices"].values()]
        require(min(chunk["indices"].values()) == after and max(ends) == after + length,
                "the indices of messages do not follow their chunk")

    def check_statistics(self, content):
        f = Fields(content)
        counts = Counter(m["channel"] for m in self.messages)
        times = [m["time"] for m in self.messages]
        want = (len(self.messages), len(self.schemas), len(self.channels), 0, len(self.metadata),
                len(self.chunks), min(times, default=0), max(times, default=0), dict(counts))
        got = (f.u64(), f.u16(), f.u32(), f.u32(), f.u32(), f.u32(), f.u64(), f.u64(), f.numbers())
        f.end()
        require(got == want, f"the statistics are wrong: {got}, not {want}")

    def check_metadata_index(self, content):
        f = Fields(content)
        offset, length, name = f.u64(), f.u64(), f.text()
        f.end()
        require(self.metadata[name][1:] == (offset, length), "an index of metadata is wrong")

    def check_summary(self, start):
        schemas, channels = dict(self.schemas), dict(self.channels)
        groups, offsets, chunks, found_footer = {}, {}, iter(self.chunks), False
        seen_schemas, seen_channels = 0, 0
        for offset, opcode, content in self.records(start, len(self.data) - 8):
            require(not found_footer, "records after the footer")
            if opcode not in (SUMMARY_OFFSET, FOOTER):
                begin, _ = groups.get(opcode, (offset, 0))
                groups[opcode] = (begin, offset + 9 + len(content) - begin)
            if opcode == SCHEMA:
                seen_schemas += 1
                self.add_schema(content)
            elif opcode == CHANNEL:
                seen_channels += 1
                self.add_channel(content)
            elif opcode == CHUNK_INDEX:
                self.check_chunk_index(content, next(chunks))
            elif opcode == STATISTICS:
                self.check_statistics(content)
            elif opcode == METADATA_INDEX:
                self.check_metadata_index(content)
            elif opcode == SUMMARY_OFFSET:
                f = Fields(content)
                offsets.setdefault("first", offset)
                group = f.u8()
                require(group not in offsets, "two offsets of one group")
                offsets[group] = (f.u64(), f.u64())
                f.end()
            else:
                require(opcode == FOOTER, f"record {opcode} in the summary")
                f = Fields(content)
                got, crc = (f.u64(), f.u64()), f.u32()
                f.end()
                require(got == (start, offsets.pop("first")), "the footer points elsewhere")
                require(crc == zlib.crc32(self.data[start:offset + 9 + 16]), "the checksum of the summary is wrong")
                found_footer = True
        require(found_footer and self.whole_until == len(self.data) - 8, "the file has no footer at its end")
        require(next(chunks, None) is None, "chunks without an index")
        require(offsets == groups, f"offsets of the summary are wrong: {offsets}, not {groups}")
        require((schemas, channels) == (self.schemas, self.channels), "the summary knows other channels")
        require((seen_schemas, seen_channels) == (len(schemas), len(channels)), "the summary lacks channels")


def read_strictly(path):
    reader = Reader(open(path, "rb").read())
    require(reader.data[-8:] == MAGIC, "the file does not end as MCAP")
    start = reader.read_data(len(reader.data))
    require(start is not None, "the data has no end")
    reader.check_summary(start)
    return reader


def check(path):
    reader = read_strictly(path)
    print(f"{len(reader.data)} bytes, {len(reader.chunks)} chunks, {len(reader.messages)} messages")
    for name, (pairs, _, _) in reader.metadata.items():
        print(f"metadata {name}: {pairs}")
    counts = Counter(m["topic"] for m in reader.messages)
    for channel in reader.channels.values():
        topic = channel["topic"]
        print(f"{counts[topic]:6d} {topic} {reader.schemas[channel['schema']]['name']}")


def cut(path, times):
    whole = read_strictly(path)
    random.seed(1)
    for place in [random.randrange(8, len(whole.data)) for _ in range(int(times))]:
        reader = Reader(whole.data[:place])
        reader.read_data(place)
        want = [c for c in whole.chunks if c["offset"] + c["length"] <= place]
        require(len(reader.chunks) == len(want), f"cut at {place}: {len(reader.chunks)} of {len(want)} chunks")
        require(reader.messages == whole.messages[:len(reader.messages)], f"cut at {place}: other messages")
    print(f"{times} cuts, each with all chunks before it")


def begun(path):
    reader = Reader(open(path, "rb").read())
    require(reader.read_data(len(reader.data)) is None, "the file has its end")
    print(f"{len(reader.chunks)} chunks, {len(reader.messages)} messages")


def field_of(message, path):
    for step in path.split("."):
        message = message[int(step)] if step.isdigit() else message[step]
    return message


def table(path, topic, *fields):
    for message in read_strictly(path).messages:
        if message["topic"] == topic:
            print(" ".join(repr(field_of(message["data"], f)) for f in fields))


def cloud(path, topic):
    for message in read_strictly(path).messages:
        if message["topic"] != topic:
            continue
        m = message["data"]
        require(m["row_step"] * m["height"] == len(m["data"]), "a cloud has another size than it says")
        require(all(f["datatype"] == 7 and f["count"] == 1 for f in m["fields"]), "a field is no float32")
        for at in range(0, len(m["data"]), m["point_step"]):
            print(*(struct.unpack_from("<f", m["data"], at + f["offset"])[0] for f in m["fields"]))


if __name__ == "__main__":
    try:
        {"check": check, "cut": cut, "begun": begun, "table": table, "cloud": cloud}[sys.argv[1]](*sys.argv[2:])
    except Broken as rule:
        sys.exit(f"{sys.argv[2]}: {rule}")
    except BrokenPipeError:
        pass
