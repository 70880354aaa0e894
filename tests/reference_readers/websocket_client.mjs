// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Watches a whole run: websocket_client.mjs URL SUBPROTOCOL TOPICS
// URL: ws://HOST:PORT of a recording that is played to its end; TOPICS: JSON, topic to the name of its schema.

import protocol from "@foxglove/ws-protocol";
import {WebSocket} from "ws";

import {decoder, expect, expectTopics, run, stampOf, Wrong} from "./messages.mjs";

const PATIENCE_MS = 120_000;

run((url, subprotocol, topicsText) => new Promise((resolve, reject) => {
  const topics = JSON.parse(topicsText);
  const socket = new WebSocket(url, [subprotocol]);
  const client = new protocol.FoxgloveClient({ws: socket});
  const channels = new Map();  // by subscription
  const counts = Object.fromEntries(Object.keys(topics).map((topic) => [topic, 0]));
  const silent = () => Object.keys(counts).filter((topic) => counts[topic] === 0);
  const guarded = (take) => (event) => {
    try {
      take(event);
    } catch (failure) {
      reject(failure);
    }
  };
  setTimeout(() => reject(new Wrong(`no end of the run after ${PATIENCE_MS / 1000} s, nor any ${silent().join(", ")}`)),
             PATIENCE_MS);
  client.on("error", (failure) => reject(new Wrong(`${url}: ${failure.message}`)));
  client.on("close", () => reject(new Wrong(`${url}: the connection was closed`)));
  client.on("status", ({message}) => reject(new Wrong(`the server complains: ${message}`)));
  client.on("advertise", guarded((advertised) => {
    expect(socket.protocol === subprotocol, `the subprotocol is ${socket.protocol}, not ${subprotocol}`);
    expectTopics(advertised, topics);
    for (const channel of advertised) {
      const decode = decoder({...channel, messageEncoding: channel.encoding});
      channels.set(client.subscribe(channel.id), {topic: channel.topic, decode});
    }
  }));
  client.on("message", guarded(({subscriptionId, timestamp, data}) => {
    const {topic, decode} = channels.get(subscriptionId);
    const message = decode(data);
    ++counts[topic];
    if (message.timestamp)
      expect(stampOf(message) === timestamp, `${topic}: stamps of message and content differ`);
    if (topic !== "/status" || !message.message.startsWith("finished: ")) return;
    expect(silent().length === 0, `no message of ${silent().join(", ")}`);
    resolve(`${subprotocol}: ${Object.entries(counts).map(([name, count]) => `${name} ${count}`).join(", ")}`);
  }));
}));
