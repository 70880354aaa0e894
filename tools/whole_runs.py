# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs of `swiftlet map` over whole inputs, and the figures of speed and memory in their reports."""

import gzip
import json
import statistics
import subprocess
from pathlib import Path

FRONTEND_MAX_MS = 2.0
BACKEND_MAX_MS = 150.0
SHARE_OF_THEIRS = 0.25  # of the mean per scan of the paper's code


def run(swiftlet, arguments, output):
    """report.json of one run, as a dictionary. Raises OSError, or subprocess.CalledProcessError with the stderr of
    swiftlet."""
    command = [str(swiftlet), "map", *arguments, "-o", str(output)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return json.loads(Path(output, "report.json").read_text(encoding="utf-8"))


def figures_of(report):
    """The figures of one run, times in ms, memory in MiB."""
    stages = report["stage_times"]
    samples = report["backend"]["scans"]

    def per_scan(*names):
        return sum(stages[name]["count"] * stages[name]["mean_ms"] for name in names) / samples

    figures = {"samples": samples, "keyframes": report["backend"]["keyframes"], "tiles": report["map"]["tiles"],
               "mean_per_scan_ms": per_scan(*stages),
               "slam_per_scan_ms": per_scan("frontend", "backend", "pruning", "final_pass"),
               "pruning_max_ms": stages["pruning"]["max_ms"],
               "final_pass_ms": stages["final_pass"]["mean_ms"], "map_ms": stages["map"]["mean_ms"],
               "run_peak_memory_mb": report["run_peak_memory_mb"], "peak_memory_mb": report["peak_memory_mb"]}
    for stage in ("frontend", "backend"):
        for figure in ("p50_ms", "p99_ms", "max_ms"):
            figures[f"{stage}_{figure}"] = stages[stage][figure]
    return figures


def combined(runs):
    """One set of figures from several runs of the same input. Of maxima it is the smallest, because the runs do the
    same work and the rest is the machine's; of all others the median."""
    return {key: (min if key.endswith("_max_ms") else statistics.median)([figures[key] for figures in runs])
            for key in runs[0]}


def over_limits(name, figures, their_mean_ms=None):
    """One line for each limit that the figures exceed."""
    limits = [("frontend_max_ms", "longest call of the frontend", FRONTEND_MAX_MS),
              ("backend_max_ms", "longest call of the backend", BACKEND_MAX_MS),
              ("pruning_max_ms", "longest pruning", BACKEND_MAX_MS)]
    if their_mean_ms is not None:
        limits.append(("mean_per_scan_ms", "mean per scan", SHARE_OF_THEIRS * their_mean_ms))
    return [f"{name}: {what} {figures[key]:.3g} ms, limit {limit:.3g} ms"
            for key, what, limit in limits if figures[key] > limit]


def cut_laser_log(log, share, target):
    """Writes the first lines of a gzipped CARMEN log, up to and including that share of its scans. Raises OSError or
    EOFError where the log cannot be read, ValueError where it holds no scan."""
    with gzip.open(log, "rt", encoding="latin-1") as file:
        lines = file.readlines()
    scans = [i for i, line in enumerate(lines) if line.startswith("FLASER ")]
    if not scans:
        raise ValueError(f"{log}: holds no scan")
    last = scans[max(round(share * len(scans)), 1) - 1]
    Path(target).write_text("".join(lines[: last + 1]), encoding="latin-1")
