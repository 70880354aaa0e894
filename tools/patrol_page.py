# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""A patrol of hours, the same room round after round: measurement and page of `tools/benchmark-speed --patrol`."""

import benchmark_page as page
import whole_runs

LAPS = {1: 78, 3: 235, 6: 470, 12: 940}  # by hours; a round takes 46 s
COLUMNS = [("samples", "samples"), ("scans pruned", "scans_pruned"), ("kept", "scans_kept"),
           ("keyframes", "keyframes"), ("mean per scan", "mean_per_scan_ms"), ("frontend p99", "frontend_p99_ms"),
           ("max", "frontend_max_ms"), ("backend p99", "backend_p99_ms"), ("max", "backend_max_ms"),
           ("pruning max", "pruning_max_ms"), ("final pass", "final_pass_ms"), ("map", "map_ms"),
           ("memory", "run_peak_memory_mb")]


def measure(swiftlet, output, say):
    """One row for each length, shortest first; `say` is called with the length that begins. Raises as whole_runs.run()
    does."""
    rows = []
    for hours, laps in LAPS.items():
        say(f"patrol of {hours} h")
        report = whole_runs.run(swiftlet, [f"sim://patrol?seed=1&laps={laps}"], output)
        backend = report["backend"]
        rows.append({"input": f"patrol of {hours} h", "hours": report["trajectory"]["duration_s"] / 3600, "laps": laps,
                     "scans_pruned": backend["scans_pruned"],
                     "scans_kept": backend["scans"] - backend["scans_pruned"],
                     "error_m": report["absolute_trajectory_error"]["corrected"]["rmse_m"],
                     **whole_runs.figures_of(report)})
    return rows


def patrol_table(rows, number):
    """`number`: formats a figure."""
    return page.table(["hours:", "rounds:", *(f"{heading}:" for heading, _ in COLUMNS), "error, m:"],
                      [[f"{row['hours']:.1f}", str(row["laps"]), *(number(row[key]) for _, key in COLUMNS),
                        f"{row['error_m']:.3f}"] for row in rows])


def document(report, number):
    over = "".join(f"- {line}\n" for line in report["over_limits"]) or "- none\n"
    return f"""{page.head("A patrol of hours", "benchmark-speed --patrol", report)}
`swiftlet map 'sim://patrol?seed=1&laps=940' -o out` and shorter: a simulated vehicle flies round one room of 8 m x 6 m
for hours, a round in 46 s, mapped at full speed with the default settings. Times are in ms, memory in MiB; each length
is run once. The map is drawn once, after the final pass. "Memory" is the maximum before the outputs are written: of it
some 300 bytes a sample are the poses and doubts that were published, which `swiftlet map` keeps for a simulation's
report and `swiftletd` does not. "Kept" are the scans in the backend at the end, "pruned" those it removed because others
cover the same space; both are in the trajectories. "Error" is the RMSE of the corrected path.

{patrol_table(report['patrol'], number)}

Over the limits (no call of the frontend over {whole_runs.FRONTEND_MAX_MS:g} ms, none of the backend and no \
pruning over {whole_runs.BACKEND_MAX_MS:g} ms):

{over}"""
