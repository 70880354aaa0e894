# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The report.json of a program that stands in for swiftlet."""

STAGES = {name: {"count": 10, "mean_ms": 0.1, "p50_ms": 0.1, "p99_ms": 0.2, "max_ms": 0.3}
          for name in ("frontend", "backend", "pruning", "final_pass", "map")}
REPORT = {"stage_times": STAGES, "backend": {"scans": 10, "keyframes": 2, "closures": {"accepted": 1}},
          "input": {"notes": ["a note", "kind of building: maze"]}, "map": {"tiles": 1}, "run_peak_memory_mb": 20.0, "peak_memory_mb": 25.0}
