# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The errors on changed copies of the logs: they distinguish the method's error from luck with one log."""

import accuracy_runs as runs
import benchmark_page as page

BREAK_OUT = 1.5  # times the error on the unchanged log


def columns(get):
    """Logs and beams with at least one run, each with its results by change (None: the unchanged log)."""
    for log in runs.LASER_LOGS:
        for beams in runs.CHANGED_BEAMS:
            made = {change: get(runs.Run(log, beams=beams, change=change)) for change in (None, *runs.CHANGES)}
            made = {change: result for change, result in made.items() if result is not None}
            if made:
                yield log, beams, made


def error_m(result):
    return result["final"]["all"]["translation_m"]["mean"]


def break_outs(made):
    """The changes whose error exceeds that of the unchanged log by far."""
    if None not in made:
        return []
    return [change for change in made if error_m(made[change]) > BREAK_OUT * error_m(made[None])]


def table(get):
    there = list(columns(get))

    def cell(made, change):
        if change not in made:
            return ""
        text = f"{error_m(made[change]):.4f} / {made[change]['final']['all']['rotation_deg']['mean']:.2f}"
        return f"**{text}**" if change in break_outs(made) else text

    return page.table(["m / deg", *(f"{log.name}, {beams}:" for log, beams, _ in there)],
                      [["as it is" if change is None else change.name, *(cell(made, change) for _, _, made in there)]
                       for change in (None, *runs.CHANGES)])


def text(get):
    """The section below its heading; empty where there is no run."""
    there = list(columns(get))
    if not there:
        return ""
    copies = sum(len(made) - (None in made) for *_, made in there)
    out = sum(len(break_outs(made)) for *_, made in there)
    return f"""Copies in which the robot drives the same paths in another manner, or its wheels have larger errors.
"Backwards" is the log played from its end: the robot drives in reverse. "Random turns" never happened, one every 20 m.
All errors come on top of the log's own. Final trajectories, with refinement. **Bold**, over {BREAK_OUT:g} times the
error on the unchanged log: {out} of {copies}.

{table(get)}"""
