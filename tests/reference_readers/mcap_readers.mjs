// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Reads a run by its index and as a stream, and compares its path: mcap_readers.mjs RUN.mcap TRAJECTORY.tum TOPICS
// TOPICS: JSON, topic to the name of its schema.

import {readFile} from "node:fs/promises";

import zstd from "@foxglove/wasm-zstd";
import {McapIndexedReader, McapStreamReader} from "@mcap/core";

import {decoder, expect, expectTopics, run, stampOf, Wrong} from "./messages.mjs";

const STAMP_LIMIT_NS = 1000n;  // the last digit of a trajectory's stamps
const POSITION_LIMIT_M = 1e-6;
const CRC_IN_CHUNK = 1 + 8 + 3 * 8;  // behind opcode, length, first and last time, size
const decompressHandlers = {zstd: (data, size) => zstd.decompress(data, Number(size))};

function channelWithSchema({topic, messageEncoding}, {name, encoding, data}) {
  return {topic, messageEncoding, schemaName: name, schemaEncoding: encoding, schema: new TextDecoder().decode(data)};
}

/** Messages of each topic, decoded, in the order that the reader gives. */
class Messages {
  byTopic = new Map();
  #decoders = new Map();

  add(channel, schema, message) {
    const key = channel.topic;
    if (!this.#decoders.has(key)) {
      this.#decoders.set(key, decoder(channelWithSchema(channel, schema)));
      this.byTopic.set(key, []);
    }
    const content = this.#decoders.get(key)(message.data);
    if (content.timestamp)
      expect(stampOf(content) === message.logTime, `${key}: stamps of message and content differ`);
    this.byTopic.get(key).push({stamp: message.logTime, content});
  }
}

function indexOf(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  return McapIndexedReader.Initialize({readable, decompressHandlers});
}

async function readByIndex(bytes, topics) {
  const reader = await indexOf(bytes);
  expectTopics([...reader.channelsById.values()].map((channel) =>
    channelWithSchema(channel, reader.schemasById.get(channel.schemaId))), topics);
  const messages = new Messages();
  for await (const message of reader.readMessages({validateCrcs: true})) {
    const channel = reader.channelsById.get(message.channelId);
    messages.add(channel, reader.schemasById.get(channel.schemaId), message);
  }
  for (const [id, count] of reader.statistics.channelMessageCounts) {
    const {topic} = reader.channelsById.get(id);
    const read = messages.byTopic.get(topic)?.length ?? 0;
    expect(BigInt(read) === count, `${topic}: ${read} messages, ${count} in the file's statistics`);
  }
  return messages.byTopic;
}

function readAsStream(bytes) {
  const reader = new McapStreamReader({validateCrcs: true, decompressHandlers});
  const [schemas, channels, messages] = [new Map(), new Map(), new Messages()];
  reader.append(bytes);
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    messages.add(channel, schemas.get(channel.schemaId), record);
  }
  expect(reader.done(), "the stream ends early");
  return messages.byTopic;
}

/** Stamp in ns, and position. */
function posesOf(tum) {
  return tum.split("\n").filter((line) => line !== "").map((line) => {
    const [stamp, x, y] = line.split(" ");
    const [seconds, fraction = ""] = stamp.split(".");
    return {stamp: BigInt(seconds + fraction.padEnd(9, "0")), x: Number(x), y: Number(y)};
  });
}

/** The largest distance along an axis. */
function expectPath(poses, lines) {
  expect(poses.length === lines.length, `/trajectory has ${poses.length} poses, the trajectory ${lines.length}`);
  return Math.max(...poses.map(({stamp, content}, i) => {
    const {x, y} = content.pose.position;
    const late = stamp - lines[i].stamp;
    expect(late <= STAMP_LIMIT_NS && -late <= STAMP_LIMIT_NS, `pose ${i} of /trajectory is ${late} ns late`);
    const away = Math.max(Math.abs(x - lines[i].x), Math.abs(y - lines[i].y));
    expect(away <= POSITION_LIMIT_M, `pose ${i} of /trajectory is off by ${away} m`);
    return away;
  }));
}

/** In whatever order the readers give messages of one stamp. */
function contentsOf(messages) {
  return messages.map(({stamp, content}) => `${stamp} ${JSON.stringify(content)}`).sort();
}

async function read(reader, ...input) {
  try {
    return await reader(...input);
  } catch (failure) {
    throw failure instanceof Wrong ? failure : new Wrong(`${reader.name}: ${failure.message}`);
  }
}

/** Whether the readers do look at checksums: that of the last chunk is made wrong. */
async function expectChecksums(bytes, topics) {
  const chunk = (await indexOf(bytes)).chunkIndexes.at(-1);
  const damaged = Uint8Array.from(bytes);
  damaged[Number(chunk.chunkStartOffset) + CRC_IN_CHUNK] ^= 1;
  for (const reader of [readByIndex, readAsStream]) {
    const complaint = await read(reader, damaged, topics).then(() => "none", ({message}) => message);
    expect(/CRC/.test(complaint), `${reader.name} overlooks a wrong checksum: ${complaint}`);
  }
}

run(async (file, trajectory, topicsText) => {
  const topics = JSON.parse(topicsText);
  await zstd.isLoaded;
  const bytes = await readFile(file);
  const indexed = await read(readByIndex, bytes, topics);
  const streamed = await read(readAsStream, bytes);
  for (const topic of Object.keys(topics)) {
    expect(indexed.has(topic), `no message of ${topic}`);
    const [one, other] = [indexed, streamed].map((messages) => contentsOf(messages.get(topic) ?? []));
    expect(one.length === other.length && one.every((text, i) => text === other[i]),
           `${topic}: index and stream give different messages`);
  }
  const lines = posesOf(await readFile(trajectory, "utf-8"));
  expect(lines.length > 0, `${trajectory} is empty`);
  const away = expectPath(indexed.get("/trajectory"), lines);
  await expectChecksums(bytes, topics);
  const count = [...indexed.values()].reduce((sum, messages) => sum + messages.length, 0);
  return `${count} messages of ${indexed.size} topics; /trajectory has the trajectory's ${lines.length} poses within ` +
      `${away.toExponential(1)} m`;
});
