# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The pictures of `tools/plot-doubt`, as PNG. Needs Debian's python3-matplotlib and python3-numpy."""

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

TRUE, LIVE, LOST = "#228833", "#4477aa", "#cc3311"
BANDS = {"tracking": ("#ffffff", "good"), "uncertain": ("#f6e3a1", "uncertain"), "lost": ("#f4b6a8", "lost"),
         "relocalizing": ("#cfc3e8", "relocalizing")}
AFTER_S = 15.0  # drawn behind the moment when it found back
GAP_S = 1.0  # without a sample
NOTHING = "#dddddd"
LEAST_M = 0.03  # of an error, on the logarithmic scale


def save(figure, file):
    """The same figures give the same bytes."""
    figure.savefig(file, dpi=110, metadata={"Software": None})
    plt.close(figure)


def mark(axes, position, text, offset, color):
    axes.annotate(text, (position.real, position.imag), xytext=offset, textcoords="offset points", fontsize=9,
                  color=color, ha="center", va="center", zorder=6,
                  bbox={"boxstyle": "round,pad=0.2", "fc": "white", "ec": color, "lw": 0.8},
                  arrowprops={"arrowstyle": "-", "color": color, "lw": 0.8})
    axes.plot(position.real, position.imag, "o", color=color, markersize=5, zorder=6)


def line(axes, positions, *style, **options):
    axes.plot([p.real for p in positions], [p.imag for p in positions], *style, **options)


def draw_walls(axes, walls):
    line(axes, walls, "s", color="#555555", markersize=1.8, markeredgewidth=0)
    axes.set_aspect("equal")
    axes.set_xlabel("x, m")
    axes.set_ylabel("y, m")
    axes.margins(0.03)


def arrow(axes, begin, end, color):
    axes.annotate("", xy=(end.real, end.imag), xytext=(begin.real, begin.imag), zorder=5,
                  arrowprops={"arrowstyle": "-|>", "color": color, "linestyle": "--", "lw": 1.2})


def draw_carried(of, fault_s, end_s, file):
    """Where it flew and where it was published to be, from before it was carried until it has found back."""
    begin = of.index_at(fault_s)
    end = of.index_at(end_s)
    back = of.found_back()
    figure, axes = plt.subplots(figsize=(8, 5.6))
    draw_walls(axes, of.walls)
    line(axes, of.true[:begin], color="#bbbbbb", linewidth=1, label="before it was carried")
    last = of.index_at(of.time_s[back] + AFTER_S)
    line(axes, of.true[end:last], color=TRUE, linewidth=4, alpha=0.45, label="flown since, in truth")
    line(axes, of.live[end:back], color=LOST, linewidth=1.6, label="published before it found back")
    line(axes, of.live[back:last], color=LIVE, linewidth=1.6, label="published since")
    arrow(axes, of.true[begin - 1], of.true[end], "#777777")
    arrow(axes, of.live[back - 1], of.live[back], LIVE)
    mark(axes, of.true[end], "carried to here", (0, -24), TRUE)
    mark(axes, of.live[end], "taken to be\nwhere it was", (0, -28), LOST)
    mark(axes, of.live[back - 1], f"{of.time_s[back] - end_s:.0f} s later", (34, -24), LOST)
    mark(axes, of.live[back], "found back", (38, -16), LIVE)
    figure.legend(loc="lower center", ncol=2, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    save(figure, file)


def draw_time_line(axes, of, title):
    for state, first, end in of.stretches():
        last = of.time_s[end] if end < len(of.time_s) else of.time_s[-1]
        axes.axvspan(of.time_s[first], last, color=BANDS[state][0], linewidth=0)
    for before, after in zip(of.time_s, of.time_s[1:]):
        if after - before > GAP_S:
            axes.axvspan(before, after, color=NOTHING, linewidth=0)
    seen = np.diff(of.time_s, prepend=of.time_s[0]) <= GAP_S
    axes.plot(of.time_s, np.where(seen, np.maximum(of.errors_m(), LEAST_M), np.nan), color="#222222", linewidth=1,
              label="true error")
    axes.plot(of.time_s, np.where(seen, of.radius_95_m, np.nan), color=LIVE, linewidth=1.2, linestyle="--",
              label="published: 95 % within")
    axes.set_yscale("log")
    axes.set_ylim(LEAST_M, 50)
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_ylabel("position, m")
    axes.set_xlim(of.time_s[0], of.time_s[-1])
    axes.grid(axis="y", alpha=0.3)
    axes.set_title(title, fontsize=10, loc="left")


def draw_doubt(flights, file):
    """`flights`: titles with flights, one above the other."""
    figure, grid = plt.subplots(len(flights), 1, figsize=(8, 2.5 * len(flights) + 0.5), squeeze=False)
    for axes, (title, of) in zip(grid.flat, flights):
        draw_time_line(axes, of, title)
    grid.flat[-1].set_xlabel("s after the first sample")
    handles, names = grid.flat[0].get_legend_handles_labels()
    for color, name in [(NOTHING, "no data"), *((color, f"state {name}") for color, name in BANDS.values())]:
        handles.append(plt.Rectangle((0, 0), 1, 1, facecolor=color, edgecolor="#bbbbbb"))
        names.append(name)
    figure.legend(handles, names, loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.1 if len(flights) > 1 else 0.2, 1, 1))
    save(figure, file)
