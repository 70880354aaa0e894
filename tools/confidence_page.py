# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/confidence.md: what the program says of its own poses, against the truth."""

import collections
import math
import statistics

import benchmark_page as page
import confidence_runs

DISTANCES_M = [10, 20, 60]
NEES_95 = 7.815  # chi-square of three degrees of freedom
SOON_S = 5.0
NONE = "–"
HEALTHY_KINDS = ("building", "healthy")


def rms(values):
    return math.sqrt(statistics.mean(value * value for value in values))


def nees_cells(rows):
    """`rows`: of consistency after one distance."""
    if not rows:
        return ["0"] + [NONE] * 6
    nees = [row["nees"] for row in rows]
    return [str(len(rows)), f"{statistics.mean(nees):.2f}", f"{statistics.median(nees):.2f}",
            f"{100 * statistics.mean(value < NEES_95 for value in nees):.0f} %",
            *(f"{rms([row[key] for row in rows]):.2f}" for key in ("error_m", "sigma_m")),
            f"{rms([row['error_yaw_rad'] for row in rows]):.3f} / {rms([row['sigma_yaw_rad'] for row in rows]):.3f}"]


def after(result, distance_m):
    """Of a result the row after this distance, as a list; rows are in order of distance."""
    index = DISTANCES_M.index(distance_m)
    return result["after"][index:index + 1]


def nees_table(rows):
    kinds = {"buildings": lambda run: run.kind == "building",
             "Vicon flights": lambda run: run.log.name in confidence_runs.FLIGHTS,
             "office, maze, corridors, loop, wings": lambda run: run.kind == "healthy"}
    lines = []
    for name, belongs in kinds.items():
        for distance_m in DISTANCES_M:
            found = [row for run, result in rows if run.threshold is None and belongs(run)
                     for row in after(result, distance_m)]
            lines.append([name, f"{distance_m} m", *nees_cells(found)])
    return page.table(["runs", "after", "runs:", "NEES mean:", "median:", "in the 95 % ellipsoid:", "error rms, m:",
                       "sigma rms, m:", "yaw, rad:"], lines)


def sums(results):
    return {key: sum(result[key] for result in results)
            for key in ("seconds", "seconds_doubted", "alarms", "false_alarms", "unjudged_alarms", "times_off")}


def noticed_cells(results):
    off = sum(result["times_off"] for result in results)
    noticed = sorted(seconds for result in results for seconds in result["noticed_s"])
    if off == 0:
        return ["0", NONE, NONE]
    return [str(off), f"{100 * len(noticed) / off:.0f} %", f"{100 * sum(s <= SOON_S for s in noticed) / off:.0f} %"]


def groups_of(rows):
    """{name: results} of the flights without a fault, with the default threshold; the last are all of them."""
    healthy = [(run, result) for run, result in rows if run.threshold is None]
    groups = {"buildings": [r for run, r in healthy if run.kind == "building"]}
    for world in confidence_runs.HEALTHY_WORLDS:
        groups[world] = [r for run, r in healthy if run.kind == "healthy" and run.log.name == world]
    for name in confidence_runs.UNTRUE_FLIGHTS:
        groups[name] = [r for run, r in healthy if run.log.name == name]
    groups["all of them"] = [result for results in list(groups.values()) for result in results]
    return groups


def an_hour(total, *keys):
    return f"{sum(total[key] for key in keys) / total['seconds'] * 3600:.2f}"


def alarm_table(rows):
    lines = []
    for name, results in groups_of(rows).items():
        if not results:
            continue
        total = sums(results)
        lines.append([name, f"{total['seconds'] / 3600:.1f}",
                      *(str(total[key]) for key in ("alarms", "false_alarms", "unjudged_alarms")),
                      an_hour(total, "false_alarms"), f"{100 * total['seconds_doubted'] / total['seconds']:.1f} %",
                      *noticed_cells(results)])
    return page.table(["flights", "hours:", "alarms:", "false:", "not known:", "false an hour:", "time in doubt:",
                       "times off by 1 m:", "noticed:", f"within {SOON_S:g} s:"], lines)


def alarm_summary(rows):
    groups = groups_of(rows)
    everything, buildings = sums(groups["all of them"]), sums(groups["buildings"])
    least, most = ([an_hour(total, *keys) for total in (everything, buildings)]
                   for keys in (["false_alarms"], ["false_alarms", "unjudged_alarms"]))
    return (f"False alarms an hour: {least[0]} of all flights, {least[1]} of buildings alone; at most {most[0]} and "
            f"{most[1]}\nif all that are not known were false.")


def fault_table(rows):
    lines = []
    for fault in confidence_runs.FAULTS:
        for world in dict.fromkeys(run.log.name for run, _ in rows if run.kind == fault.text()):
            results = [r for run, r in rows
                       if run.threshold is None and run.kind == fault.text() and run.log.name == world]
            lines.append([f"`{fault.text()}`", world, str(len(results)), *noticed_cells(results)])
    return page.table(["fault", "world", "flights:", "times off by 1 m:", "noticed:", f"within {SOON_S:g} s:"], lines)


def roc_rows(rows):
    """Those of the inputs that were run with other thresholds than the default, too."""
    names = {"building", "healthy", *(fault.text() for fault in confidence_runs.FAULTS)}
    inputs = {run.log.source for run, _ in rows if run.threshold is not None}
    return [(run, result) for run, result in rows if run.kind in names and run.log.source in inputs]


def roc_summary(rows):
    runs = [run for run, _ in roc_rows(rows) if run.threshold is None]
    healthy = collections.Counter(run.log.name for run in runs if run.kind in HEALTHY_KINDS)
    worlds = ", ".join(f"{world}: {count}" for world, count in healthy.items())
    return (f'"False an hour" is of flights without a fault ({worlds}), the rest of those with one above '
            f"({len(runs) - healthy.total()}).")


def roc_table(rows, default):
    lines = []
    for threshold in sorted({run.threshold if run.threshold is not None else default for run, _ in rows}):
        found = [(run, r) for run, r in roc_rows(rows)
                 if (run.threshold if run.threshold is not None else default) == threshold]
        healthy = sums([r for run, r in found if run.kind in HEALTHY_KINDS])
        faulty = [r for run, r in found if run.kind not in HEALTHY_KINDS]
        lines.append([f"{threshold:g}", an_hour(healthy, "false_alarms"), *noticed_cells(faulty)])
    return page.table([f"`{confidence_runs.ALARM}`", "false an hour:", "times off by 1 m:", "noticed:",
                       f"within {SOON_S:g} s:"], lines)


def tables(report):
    """All tables, for stdout and for the page."""
    rows = report["rows"]
    return f"""## Covariances

{nees_table(rows)}

## Alarms in flights without a fault

{alarm_summary(rows)}

{alarm_table(rows)}

## Faults that nothing tells of

{fault_table(rows)}

## The threshold

{roc_summary(rows)}

{roc_table(rows, report['default'])}
"""


def document(report):
    return f"""{page.head("Confidence", "benchmark-confidence", report)}{page.left_out(report["missing"])}
What `pose_t` says of the live pose ([lcm](../lcm.md#how-far-a-pose-can-be-relied-on)), held against the truth:
`swiftlet map 'sim://building?seed=1' -o out` has it in `report.json`, `swiftlet eval --consistency FLIGHT TRUTH` prints it
for a recording. NEES is the normalised estimation error squared of (x, y, yaw) relative to the start: 3 on average where
the covariance is right, below {NEES_95} in 95 % of the cases. Buildings are seeds {confidence_runs.BUILDINGS[0]} to {confidence_runs.BUILDINGS[-1]};
what is added to each motion for slips was set on seeds 0 to 299.

An alarm is a stretch in which the state is not `TRACKING_GOOD`. It is false if the pose was within 0.5 m of the older
map around it all the time and for 5 s before; "not known" are those with no known place then. A pose is noticed to be
off if an alarm begins before its error at a known place falls below 0.5 m again. Flights without truth (Olsson, Rice) are
held against their own final path. {page.EASIER_SENSOR}

{tables(report)}
"""
