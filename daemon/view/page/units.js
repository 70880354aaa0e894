// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

/// The smallest of 1, 2, 5 times a power of ten that is at least so much.
export function gridStep_m(least_m) {
  const power = 10 ** Math.floor(Math.log10(least_m));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= least_m * 0.9999);
}

/// A length that is a multiple of `step_m`, without more digits than that needs.
export function lengthText(length_m, step_m) {
  const digits = Math.max(0, -Math.floor(Math.log10(step_m) + 1e-9));
  return length_m.toFixed(digits).replace("-", "−");
}

/// 1:02:03 or 2:03, with tenths where asked for.
export function durationText(seconds, hasTenths = false) {
  const tenths = Math.max(0, Math.floor(seconds * 10 + 1e-6));
  const whole = Math.floor(tenths / 10);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const two = (n) => String(n).padStart(2, "0");
  const text = h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
  return hasTenths ? `${text}.${tenths % 10}` : text;
}
