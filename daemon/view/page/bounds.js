// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

/// The rectangle {low: [x, y], high: [x, y]} widened by a point; null: of no extent yet.
export function boundsWith(bounds, [x, y]) {
  if (bounds === null) return {low: [x, y], high: [x, y]};
  const {low, high} = bounds;
  return {low: [Math.min(low[0], x), Math.min(low[1], y)], high: [Math.max(high[0], x), Math.max(high[1], y)]};
}
