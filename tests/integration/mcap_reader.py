#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Reads MCAP files (https://mcap.dev/spec) by their index, and checks what the format asks for on the way."""

import json
import struct
import zlib

import zstandard

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
STATISTICS, SUMMARY_OFFSET, DATA_END = 0x0B, 0x0E, 0x0F


class Fields:
    """The content of a record, read from its beginning."""

    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, size):
        assert self.at + size <= len(self.content), "a field ends behind its record"
        self.at += size
        return self.content[self.at - size : self.at]

    def number(self, code):
        return struct.unpack("<" + code, self.take(struct.calcsize("<" + code)))[0]

    def text(self):
        return self.take(self.number("I")).decode()

    def pairs(self, codes):
        """A map of numbers, or an array of pairs of them."""
        content = self.take(self.number("I"))
        return list(struct.iter_unpack("<" + codes, content))

    def rest(self):
        return self.content[self.at :]


def records(content, at=0):
    """(opcode, fields, offset) of each."""
    while at < len(content):
        opcode, size = struct.unpack_from("<BQ", content, at)
        assert at + 9 + size <= len(content), "a record ends behind the file"
        yield opcode, Fields(content[at + 9 : at + 9 + size]), at
        at += 9 + size


class Mcap:
    """`messages`: topic to a list of (time in ns, JSON content), in the order of the file."""

    def __init__(self, data):
        self.data = data
        assert data[:8] == MAGIC and data[-8:] == MAGIC, "no magic"
        footer = data[-37:-8]
        opcode, size, self.summary_at, self.offsets_at, crc = struct.unpack("<BQQQI", footer)
        assert (opcode, size) == (FOOTER, 20)
        assert crc == zlib.crc32(data[self.summary_at : -12]), "the summary's checksum"
        self.read_summary()
        self.check_data_section()
        self.messages = {topic: [] for topic, _ in self.channels.values()}
        for chunk in self.chunks:
            self.read_chunk(*chunk)
        counts = {channel: len(self.messages[topic]) for channel, (topic, _) in self.channels.items()}
        assert {channel: count for channel, count in counts.items() if count} == self.counts, "counts of messages"

    def read_summary(self):
        self.schemas, self.channels, self.chunks, self.counts = {}, {}, [], {}
        groups = {}
        for opcode, fields, at in records(self.data[: self.offsets_at], self.summary_at):
            groups.setdefault(opcode, [at, 0])[1] += 9 + len(fields.content)
            if opcode == SCHEMA:
                number, name, encoding = fields.number("H"), fields.text(), fields.text()
                assert encoding == "jsonschema"
                self.schemas[number] = (name, json.loads(fields.text()))
            elif opcode == CHANNEL:
                number, schema, topic = fields.number("H"), fields.number("H"), fields.text()
                assert fields.text() == "json"
                self.channels[number] = (topic, schema)
            elif opcode == STATISTICS:
                self.count, schemas, channels = fields.number("Q"), fields.number("H"), fields.number("I")
                attachments, metadata, chunks = fields.number("I"), fields.number("I"), fields.number("I")
                self.first_ns, self.last_ns = fields.number("Q"), fields.number("Q")
                self.counts = dict(fields.pairs("HQ"))
                assert (attachments, metadata) == (0, 0)
            elif opcode == CHUNK_INDEX:
                first, last, at, size = (fields.number("Q") for _ in range(4))
                self.chunks.append((first, last, at, size, dict(fields.pairs("HQ"))))
                self.check_chunk_sizes(fields, at, size)
        assert (schemas, channels, chunks) == (len(self.schemas), len(self.channels), len(self.chunks))
        assert self.count == sum(self.counts.values())
        offsets = {f.number("B"): [f.number("Q"), f.number("Q")]
                   for opcode, f, _ in records(self.data[:-37], self.offsets_at) if opcode == SUMMARY_OFFSET}
        assert offsets == groups, "offsets of the summary"

    def check_chunk_sizes(self, index, at, size):
        """Those of the index, behind its offsets, are those of the chunk."""
        _, chunk, _ = next(records(self.data[: at + size], at))
        chunk.take(16)
        length, _, compression, packed = chunk.number("Q"), chunk.number("I"), chunk.text(), chunk.number("Q")
        index.number("Q")
        assert (index.text(), index.number("Q"), index.number("Q")) == (compression, packed, length)

    def check_data_section(self):
        in_order = list(records(self.data[: self.summary_at], 8))
        assert in_order[0][0] == HEADER and in_order[-1][0] == DATA_END
        crc = in_order[-1][1].number("I")
        assert crc == zlib.crc32(self.data[: in_order[-1][2]]), "the data section's checksum"
        assert [at for opcode, _, at in in_order if opcode == CHUNK] == [chunk[2] for chunk in self.chunks]

    def read_chunk(self, first, last, at, size, indices):
        (opcode, fields, _), *_ = records(self.data[: at + size], at)
        assert opcode == CHUNK and (fields.number("Q"), fields.number("Q")) == (first, last)
        length, crc = fields.number("Q"), fields.number("I")
        assert fields.text() == "zstd" and fields.number("Q") == len(fields.rest())
        content = zstandard.decompress(fields.rest())
        assert len(content) == length and zlib.crc32(content) == crc, "a chunk's checksum"
        messages = {offset: message for _, message, offset in records(content)}
        for channel, index_at in indices.items():
            opcode, fields, _ = next(records(self.data, index_at))
            assert opcode == MESSAGE_INDEX and fields.number("H") == channel
            for time_ns, offset in fields.pairs("QQ"):
                message = messages.pop(offset)
                assert message.number("H") == channel
                message.number("I")
                assert (message.number("Q"), message.number("Q")) == (time_ns, time_ns)
                assert max(first, self.first_ns) <= time_ns <= min(last, self.last_ns)
                self.messages[self.channels[channel][0]].append((time_ns, json.loads(message.rest())))
        assert not messages, "messages that no index names"


def conforms(value, schema):
    """Whether a message is what its JSON schema says, all its members given."""
    kind = schema["type"]
    if kind == "object":
        members = schema.get("properties", {})
        return isinstance(value, dict) and set(value) == set(members) and all(
            conforms(value[name], member) for name, member in members.items())
    if kind == "array":
        return isinstance(value, list) and all(conforms(item, schema["items"]) for item in value)
    python = {"number": (int, float), "integer": int, "string": str, "boolean": bool}[kind]
    return isinstance(value, python) and (kind == "boolean" or not isinstance(value, bool))
