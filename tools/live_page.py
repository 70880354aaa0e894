# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/live.md: the pose as published beside the map as published."""

import math

import benchmark_page as page

NONE = "–"
HEADINGS = ["rms, m:", "p95:", "max:", "over 0.3 m:", "across, p95:", "along, p95:", "contacts:", "off:",
            "below 0.2 m after, s:", "jumps:", "greatest, m:", "2 m away:", "5 m:", "10 m:"]


def number(value, form=".2f"):
    return NONE if value is None else format(value, form)


def percent(share):
    return NONE if share is None else f"{100 * share:.1f} %"


def cells(live):
    if live["moments"] == 0:
        return [NONE] * len(HEADINGS)
    return [number(live["rms_m"], ".3f"), number(live["p95_m"]), number(live["max_m"]), percent(live["share_off"]),
            number(live["across_p95_m"]), number(live["along_p95_m"]), str(live["contacts"]),
            str(live["contacts_off"]), number(live["settled_p50_s"], ".1f"), str(live["jumps"]),
            number(live["greatest_jump_m"]), *(number(off) for off in live["map_rms_m"])]


def _pooled(lives, key, moments):
    known = [(live[key], count) for live, count in zip(lives, moments) if live[key] is not None]
    if not known:
        return None
    return math.sqrt(sum(value ** 2 * count for value, count in known) / sum(count for _, count in known))


def _quantile(values, share):
    return page.quantile(values, share) if values else None


def combined(lives):
    """The figures of several flights as those of one, that of the map by the flights' moments."""
    lives = [live for live in lives if live["moments"]]
    if not lives:
        return {"moments": 0}
    moments = [live["moments"] for live in lives]

    def values(key):
        return [value for live in lives for value in live[key]]

    return {"moments": sum(moments),
            "rms_m": _pooled(lives, "rms_m", moments),
            "p95_m": _quantile([error_m for _, error_m in values("errors_m")], 0.95),
            "across_p95_m": _quantile(values("across_m"), 0.95),
            "along_p95_m": _quantile(values("along_m"), 0.95),
            "max_m": max(live["max_m"] for live in lives),
            "share_off": sum(live["share_off"] * count for live, count in zip(lives, moments)) / sum(moments),
            **{key: sum(live[key] for live in lives) for key in ("contacts", "contacts_off", "jumps")},
            "settled_p50_s": _quantile(values("settled_s"), 0.5),
            "greatest_jump_m": max(live["greatest_jump_m"] for live in lives),
            "map_rms_m": [_pooled([{"off": live["map_rms_m"][i]} for live in lives], "off", moments)
                          for i in range(3)]}


def worlds_table(rows):
    worlds = dict.fromkeys(row["world"] for row in rows)
    return page.table(["flights", *HEADINGS],
                      [[world, *cells(combined([row["live"] for row in rows if row["world"] == world]))]
                       for world in worlds])


def flights_table(rows):
    return page.table(["flight", *HEADINGS], [[f"`{row['input']}`", *cells(row["live"])] for row in rows])


def batch_of(rows):
    """The figures of several flights as those of one."""
    batches = [row["batch"] for row in rows if row["batch"]["moments"]]
    moments = [batch["moments"] for batch in batches]
    shares = {key: sum(batch[key] * count for batch, count in zip(batches, moments)) / sum(moments) if moments else None
              for key in ("share_off", "live_share_off")}
    return {"moments": sum(moments), **shares,
            **{key: _pooled(batches, key, moments) for key in ("rms_m", "live_rms_m")}}


def batch_table(rows):
    def texts(world):
        batch = batch_of([row for row in rows if row["world"] == world])
        return [world, str(batch["moments"]), number(batch["live_rms_m"], ".3f"), percent(batch["live_share_off"]),
                number(batch["rms_m"], ".3f"), percent(batch["share_off"])]

    return page.table(["flights", "moments:", "live, rms, m:", "over 0.3 m:", "batch, rms, m:", "over 0.3 m:"],
                      [texts(world) for world in dict.fromkeys(row["world"] for row in rows)])


def tables(report):
    """All tables, for stdout and for the page."""
    return f"""## Flights together

{worlds_table(report['rows'])}

## The batch at the same moment

Runs that end at some of these moments, each with its final pass: what the same data can give there. It takes dead
reckoning for the map where the ranges do not tell that a correction is right.

{batch_table(report['rows'])}

## Each simulated flight

{flights_table([row for row in report['rows'] if not row['is_recorded']])}
"""


def document(report):
    return f"""{page.head("Right while flying", "benchmark-live", report)}{page.left_out(report["missing"])}
The known-place error: the published pose against the older map within 3 m (ground flown more than 20 m of travel ago)
as it stood at that moment, aligned locally to the truth; of recorded flights to their own final path. "Over 0.3 m" is a
share of the time. "Across" and "along" are the parts of the error to the nearest wall. "Off" are contacts with old
ground that begin with more than 0.2 m; the time is that until below, half of them. "Jumps" are corrections of the
published pose by more than 0.3 m. The last columns: how far off old ground lies 2, 5 and 10 m away, as seen from the
pose. [evaluation.md](../evaluation.md#known-places) defines the figures. Of flights together they are of all their
moments and contacts; in the last columns each flight counts by its moments.
{page.EASIER_SENSOR}

{tables(report)}"""
