// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import foxglove from "@foxglove/schemas/jsonschema.js";
import Ajv from "ajv";

const NS_IN_S = 1_000_000_000n;

/** What is wrong, in one line: the process ends with exit code 1. */
export class Wrong extends Error {}

export function expect(condition, complaint) {
  if (!condition) throw new Wrong(complaint);
}

/** A script's main function: one line on stdout, or one on stderr and exit code 1. */
export async function run(main) {
  try {
    console.log(await main(...process.argv.slice(2)));
    process.exit(0);
  } catch (failure) {
    console.error(failure instanceof Wrong ? failure.message : (failure.stack ?? failure));
    process.exit(1);
  }
}

/** The schema of messages that have all of its members and no others. */
function closed(schema) {
  if (schema.type === "array") return {...schema, items: closed(schema.items)};
  if (schema.type !== "object" || !schema.properties) return schema;
  const members = Object.entries(schema.properties);
  const properties = Object.fromEntries(members.map(([name, member]) => [name, closed(member)]));
  return {...schema, properties, required: Object.keys(properties), additionalProperties: false};
}

function parsed(bytes, topic) {
  try {
    return JSON.parse(new TextDecoder("utf-8", {fatal: true}).decode(bytes));
  } catch (failure) {
    throw new Wrong(`${topic} is not in JSON: ${failure.message}`);
  }
}

/** Decodes the messages of a channel. They must be as its schema says, and as Foxglove's own of that name does. */
export function decoder({topic, messageEncoding, schemaName, schemaEncoding, schema}) {
  expect(messageEncoding === "json" && schemaEncoding === "jsonschema",
         `${topic} is in ${messageEncoding} by ${schemaEncoding}`);
  const theirs = Object.values(foxglove).find(({title}) => title === schemaName);
  expect(theirs, `${topic}: ${schemaName} is no schema of Foxglove's`);
  const ajv = new Ajv({strict: false, formats: {}});
  const checks = [closed(JSON.parse(schema)), theirs].map((one) => ajv.compile(one));
  return (bytes) => {
    const message = parsed(bytes, topic);
    for (const check of checks)
      expect(check(message), `${topic}: ${ajv.errorsText(check.errors, {dataVar: schemaName})}`);
    return message;
  };
}

/** Nanoseconds since 1970. */
export function stampOf({timestamp}) {
  return BigInt(timestamp.sec) * NS_IN_S + BigInt(timestamp.nsec);
}

/** Compares what there is with what docs/foxglove.md says: objects from topic to the schema's name. */
export function expectTopics(channels, topics) {
  const found = Object.fromEntries(channels.map(({topic, schemaName}) => [topic, schemaName]));
  for (const topic of new Set([...Object.keys(found), ...Object.keys(topics)]))
    expect(found[topic] === topics[topic],
           `${topic}: the schema is ${found[topic] ?? "missing"}, documented is ${topics[topic] ?? "no such topic"}`);
}
