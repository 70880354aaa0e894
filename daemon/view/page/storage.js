// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// What the user has chosen, kept by browsers that may; others throw.

/// null: nothing is kept.
export function readStored(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

export function store(name, text) {
  try {
    localStorage.setItem(name, text);
  } catch {  // forgotten with the page
  }
}
