# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""What changed copies of the logs show: whether an error is that of the method or luck with one log."""

import accuracy_runs as runs
import benchmark_page as page

BREAK_OUT = 1.5  # times the error on the log as it is


def columns(get):
    """Logs and beams of which a run is made, each with its results by change (None: the log as it is)."""
    for log in runs.LASER_LOGS:
        for beams in runs.CHANGED_BEAMS:
            made = {change: get(runs.Run(log, beams=beams, change=change)) for change in (None, *runs.CHANGES)}
            made = {change: result for change, result in made.items() if result is not None}
            if made:
                yield log, beams, made


def error_m(result):
    return result["final"]["all"]["translation_m"]["mean"]


def break_outs(made):
    """The changes whose error stands out from that of the log as it is."""
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
    """The section below its heading, or nothing where no run is made."""
    there = list(columns(get))
    if not there:
        return ""
    copies = sum(len(made) - (None in made) for *_, made in there)
    out = sum(len(break_outs(made)) for *_, made in there)
    return f"""Copies in which the robot goes the same ways in another manner, or its wheels err more. "Backwards" is the
log played from its end: the robot drives in reverse. "Random turns" never happened, one every 20 m. All errors come on
top of the log's own. Final, with refinement. Over {BREAK_OUT:g} times the error on the log as it is, **bold**: {out} of
{copies}.

{table(get)}"""
