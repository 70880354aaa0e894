# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/faults.md: breaks of motion in simulated flights."""

import math
import statistics

import benchmark_page as page
import fault_runs

NONE = "–"
GOOD_M = 0.15
WRONG_M = fault_runs.WRONG_M
SURE_M = 1.0  # a wrong place counts as believed when a pose on it is published as good for this way
WAYS_M = 15, 20  # within which most should be back, where the input tells of the break and where it does not
HEADINGS = ["runs:", "final error p50, m:", "worst, m:", f"under {GOOD_M} m:", "before, worst, m:", "wrong place:",
            "found back:", "way p50, m:", "p90, m:", *(f"in {way_m} m:" for way_m in WAYS_M), "wrongly sure:",
            "doubted p50, s:", "in doubt:", "after p50, s:", "p90, s:"]


def percent(flags):
    return f"{100 * statistics.mean(flags):.0f} %"


def share(flags):
    """Of the runs that can tell, and how many these are."""
    return f"{percent(flags)} of {len(flags)}" if flags else NONE


def p90(values):
    return page.quantile(values, 0.9)


def reached_cells(values):
    """`values`: None where a run did not come so far. The share that did, their median and p90, and the shares of all
    that came so far within WAYS_M."""
    known = [value for value in values if value is not None]
    figures = [f"{figure(known):.1f}" for figure in (statistics.median, p90)] if known else [NONE, NONE]
    within = [percent(value is not None and value <= way_m for value in values) if values else NONE for way_m in WAYS_M]
    return [share([value is not None for value in values]), *figures, *within]


def doubt_cells(values):
    """`values`: None where a run did not doubt. The share that did, the median and p90 of all."""
    if not values:
        return [NONE] * 3
    seconds = [math.inf if value is None else value for value in values]
    figures = [figure(seconds) for figure in (statistics.median, p90)]
    return [share([value is not None for value in values]),
            *("never" if math.isinf(figure) else f"{figure:.1f}" for figure in figures)]


def believes_wrong_place(result):
    return result["wrong_way_m"] > fault_runs.WRONG_WAY_M


def cells(results):
    """Of the runs of one world and fault."""
    def having(key):
        return [result[key] for result in results if key in result]

    finals, believed = having("final_m"), having("believed_m")
    return [str(len(finals)), f"{statistics.median(finals):.3f}", f"{max(finals):.3f}",
            percent(final < GOOD_M for final in finals), f"{max(having('before_m')):.3f}",
            percent(map(believes_wrong_place, results)), *reached_cells(having("way_back_m")),
            share([way > SURE_M for way in believed]), f"{statistics.median(having('doubted_s')):.0f}",
            *doubt_cells(having("noticed_s"))]


def world_table(rows):
    faults = dict.fromkeys(run.fault for run, _ in rows)
    return page.table(["break", *HEADINGS],
                      [[f"`{fault.text()}`", *cells([result for run, result in rows if run.fault == fault])]
                       for fault in faults])


def tables(report):
    """All tables, for stdout and for the page."""
    worlds = dict.fromkeys(run.log.name for run, _ in report["rows"])
    return "\n".join(f"## {world}\n\n{world_table([row for row in report['rows'] if row[0].log.name == world])}\n"
                     for world in worlds)


def wrong_though_told(rows):
    """Markdown: the runs whose final map believes a wrong place although the input told of the break."""
    wrong = [f"- `{run.title()}`: over {result['wrong_way_m']:.0f} m" for run, result in rows
             if run.fault.is_told() and believes_wrong_place(result)]
    return "\n".join(wrong or ["- none"])


def document(report):
    at_s, early_s, near_m = fault_runs.BREAK_S, fault_runs.EARLY_S, fault_runs.NEAR_M
    return f"""{page.head("Breaks of motion", "benchmark-faults", report)}
Simulated flights whose dead reckoning breaks {at_s} s after the first sample, or {early_s} s, when most of the world is
unknown still, seeds 1 to {report['seeds']}:
`swiftlet map 'sim://office?seed=1&fault=carried@{at_s}:60' -o out`. Amounts are in seconds, of a `jump` and a
`turn` in degrees. In a `silence` nothing is received while the vehicle flies on; a `reset` restarts the estimate in
flight, a `restart` the vehicle where it is; one that was `carried` restarts where it would have been by then. A
`silence` behind that comes before the place can have been found, one before a `turn` on new ground. In a `jump` the
heading of the estimate is elsewhere within a tenth of a second, which [no vehicle can
fly](../algorithm.md#motion-and-its-error-13-14). Nothing tells of a `turn` (the same within two seconds), of a `slip`
(the estimate stays while the vehicle flies on) and of a `teleport` (it is carried and the estimate goes on). In
`{fault_runs.STOREYS}` the vehicle flies up the stairs of a house and back: the floors must not be mixed.
{page.EASIER_SENSOR}

"Final error" is the RMSE of the corrected path after the best rigid alignment of the whole. "Wrong place" are the runs
whose final map still believes one: put onto the truth by what was flown before the break, their corrected path is more
than {WRONG_M:g} m off over more than {fault_runs.WRONG_WAY_M:g} m of the way behind it. "Before" is the error of that
path up to the break, put onto the truth alone: `none` has what it is without one. "Doubted" is for how long the state was
not `{fault_runs.SURE}`, in the whole flight. The rest is of the live pose at
[known places](live.md) behind the break: where the map as it stood then has ground within 3 m that was flown long
before; errors are against that ground. Shares say of how many runs they are: some hardly meet known places there.
"Found back" are the runs whose live pose came within {near_m} m and stayed there for {fault_runs.STAYS_M:g} m, or to the
end of the run and for {fault_runs.LEAST_STAY_M:g} m at least; "way" is what these runs flew from the first known place
until then; "in {WAYS_M[0]} m" and "in {WAYS_M[1]} m" are the shares of all that did within. "Wrongly sure" are the runs
that published poses more than {WRONG_M:g} m off as `{fault_runs.SURE}` for over {SURE_M:g} m of way. "In doubt" are, of
the runs of a break that nothing tells of and whose error passed {WRONG_M:g} m, those whose state said so before the error
fell below {near_m} m again; "after": how long after it had passed, where a run that did not say so counts as longer than
any ("never").

{tables(report)}
## Known not to work

Nothing tells of turns of the estimate, slips and teleports. They are noticed where what is seen contradicts the older map
([how often](confidence.md)): not on new ground. A turn that is noticed is mostly found, a slip by the loops that are closed.
A vehicle that was carried unseen over more than 6 m, or to new ground, is drawn where its estimate has it, bent or apart,
as the final errors show; the error of a slip also holds the stretch over which the estimate stood still.

The office looks nearly the same after half a turn around its middle. A vehicle that is carried to ground that it has not
flown yet, but whose twin it has, is placed at the twin: nothing that it sees there speaks against it. So is one that
restarts where it is and goes on over new ground (`restart@{early_s}:60`): that it was not moved counts as a million times
likelier, but 20 m and more that look like known ground outweigh that.

Runs that believe a wrong place though the input told of the break, and over how much way:

{wrong_though_told(report['rows'])}
"""
