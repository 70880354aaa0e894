# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The plots of docs/results/accuracy.md, as SVG. Needs Debian's python3-matplotlib."""

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

import accuracy_page  # noqa: E402
import accuracy_runs as runs  # noqa: E402
import accuracy_sweeps as sweeps  # noqa: E402

PLAIN, REFINED, THEIRS = "#4477aa", "#cc6633", "#555555"
BREAK_OUT = 5.0  # of the greatest error over the least
DASHES = {None: "-", 11: "-", 4: "--"}
KINDS = [("translation_m", "translation, m", 0), ("rotation_deg", "rotation, deg", 1)]
FRONTEND_THEIRS_MAX_MS = {"ACES": 17, "Intel": 16, "Killian": 29}  # the paper's code at 11 beams
BACKEND_THEIRS_MAX_MS = {"ACES": 690, "Intel": 1212, "Killian": 2440}
PERCENTILES = [("p50", "p50_ms", "#99bbdd"), ("p99", "p99_ms", "#4477aa"), ("max", "max_ms", "#223355")]


def add_legend(figure, grid):
    """One for all axes, below them."""
    handles, names = max((axes.get_legend_handles_labels() for axes in grid), key=lambda legend: len(legend[0]))
    figure.legend(handles, names, loc="lower center", ncol=len(names), frameon=False, fontsize=9)


def save(figure, file):
    """The same figures give the same bytes."""
    figure.savefig(file, metadata={"Date": None})
    plt.close(figure)


def draw_theirs(axes, sweep, log, index):
    """The paper's code at its two numbers of beams."""
    if sweep.part == "beams":
        points = [(sweep.values.index(beams), accuracy_page.PAPER[log.name, beams][index]) for beams in (4, 11)]
        axes.plot(*zip(*points), "x", color=THEIRS, label="paper's code")


def draw_curves(axes, sweep, get, log, kind):
    for swept_log, beams, refine, results in sweeps.curves(sweep, get):
        if swept_log is not log:
            continue
        errors = sweeps.errors_of(results, kind)
        name = ("refined" if refine else "not refined") + ("" if beams is None else f", {beams} beams")
        axes.plot([sweep.values.index(value) for value in errors], list(errors.values()), DASHES[beams], marker="o",
                  markersize=3, color=REFINED if refine else PLAIN, label=name)


def scale_errors(axes):
    """From 0 upwards; logarithmic where an outlier would flatten the rest."""
    errors = [error for line in axes.get_lines() for error in line.get_ydata()]
    if errors and max(errors) > BREAK_OUT * min(errors):
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    else:
        axes.set_ylim(bottom=0)
    axes.grid(axis="y", alpha=0.3)


def draw_sweep(sweep, get, file):
    figure, grid = plt.subplots(len(runs.SWEPT_LOGS), len(KINDS), figsize=(8, 5.4), sharex=True, squeeze=False)
    for log, row in zip(runs.SWEPT_LOGS, grid):
        for (kind, label, index), axes in zip(KINDS, row):
            draw_curves(axes, sweep, get, log, kind)
            draw_theirs(axes, sweep, log, index)
            axes.set_title(f"{log.name}: {label}", fontsize=10)
            scale_errors(axes)
    for axes in grid[-1]:
        axes.set_xticks(range(len(sweep.values)), [str(value) for value in sweep.values])
        axes.set_xlabel(sweep.axis)
    add_legend(figure, grid.flat)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    save(figure, file)


def draw_stage(axes, stage, there, theirs_max_ms):
    """Bars of percentiles for each log, and the maximum of the paper's code."""
    for i, (name, key, color) in enumerate(PERCENTILES):
        heights = [max(result["report"]["stage_times"][stage][key], 1e-4) for _, result in there]
        bars = axes.bar([x + 0.25 * (i - 1) for x in range(len(there))], heights, 0.23, color=color, label=name)
        axes.bar_label(bars, [accuracy_page.milliseconds(height) for height in heights], fontsize=7)
    for x, (run, _) in enumerate(there):
        axes.plot([x - 0.4, x + 0.4], [theirs_max_ms[run.log.name]] * 2, color=THEIRS, linestyle=":",
                  label="paper's code, max" if x == 0 else None)
    axes.set_yscale("log")
    axes.set_xticks(range(len(there)), [run.log.name for run, _ in there])
    axes.set_title(f"{stage}: ms a call", fontsize=10)


def draw_times(there, file):
    """`there`: runs with their results."""
    figure, grid = plt.subplots(1, 2, figsize=(8, 3.4))
    draw_stage(grid[0], "frontend", there, FRONTEND_THEIRS_MAX_MS)
    draw_stage(grid[1], "backend", there, BACKEND_THEIRS_MAX_MS)
    add_legend(figure, grid)
    figure.tight_layout(rect=(0, 0.07, 1, 1))
    save(figure, file)


def draw_all(get, folder):
    """One file for each part but the table, from the existing runs. `get`: the result of a run, None where there is
    none."""
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "swiftlet", "font.size": 9,
                                "axes.spines.top": False, "axes.spines.right": False})
    folder.mkdir(parents=True, exist_ok=True)
    for sweep in sweeps.SWEEPS:
        if any(sweeps.curves(sweep, get)):
            draw_sweep(sweep, get, folder / f"{sweep.part}.svg")
    if there := accuracy_page.made("times", get):
        draw_times(there, folder / "times.svg")
