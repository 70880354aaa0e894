// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {decodeMessage, momentRequest} from "./messages.js";

const RETRY_MS = 1000;

/// The WebSocket to the server, opened again whenever it is lost.
export class Connection {
  /// onMessage takes decoded messages, onState whether the server is there.
  constructor(onMessage, onState) {
    this.onMessage = onMessage;
    this.onState = onState;
    this.open();
  }

  open() {
    this.socket = new WebSocket(`ws://${location.host}/live`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => this.onState(true);
    this.socket.onmessage = (event) => this.onMessage(decodeMessage(event.data));
    this.socket.onclose = () => {
      this.onState(false);
      setTimeout(() => this.open(), RETRY_MS);
    };
  }

  /// null: the newest. Lost without a connection: a new one begins with the run, on which the player asks again.
  lookAt(at_us) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(momentRequest(at_us));
  }
}
