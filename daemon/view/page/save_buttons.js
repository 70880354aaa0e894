// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

export class SaveButtons {
  constructor(root, page) {
    Object.assign(this, {root, page});
  }
}
