# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/accuracy.md: figures beside those of the paper's code and the limits, and the sweeps. `get` everywhere:
the result of a run, None where there is none."""

import textwrap

import accuracy_changes as changes
import accuracy_runs as runs
import accuracy_sweeps as sweeps
import benchmark_page as page
import mapped_runs

# Mean error of translation (m) and rotation (deg) of the paper's code on two such cores, with its own settings for
# each log; of Killian the paper's figure, because there it depends on rounding (0.16 to 1.43 m measured).
PAPER = {("ACES", 11): (0.0454, 1.131), ("ACES", 4): (0.0440, 1.013), ("Intel", 11): (0.0901, 2.363),
         ("Intel", 4): (0.1193, 2.623), ("Killian", 11): (0.0718, 2.065)}
REFINED_LIMITS = {("ACES", 11): (0.036, 0.50), ("ACES", 4): (0.037, 0.52), ("Intel", 11): (0.047, 1.6),
                  ("Intel", 4): (0.063, 1.95), ("Killian", 11): (0.06, 1.3), ("Killian", 4): (0.15, None),
                  ("FR079", 11): (0.055, 1.0), ("FR079", 4): (0.080, 1.3)}
CELLS = {"Olsson Hall": (2398, 1800), "Rice Hall": (2015, 1720)}  # 0.2 m: the paper's code, limit
NONE = "–"
WIDTH = 120  # of a line of text
NOT_MADE = "There is no run of this part with this build."


def limits_of(run):
    key = run.log.name, run.beams
    return (REFINED_LIMITS if run.refine else PAPER).get(key, (None, None))


def relation_row(run, result):
    return {"run": run, "result": result, "theirs": PAPER.get((run.log.name, run.beams), (None, None)),
            "limits": limits_of(run)}


def made(part, get):
    """The existing runs of a part, with their results."""
    return [(run, result) for run in runs.PARTS[part] if (result := get(run)) is not None]


def rows_of(get):
    """The existing results of the first part: rows of laser logs, flights and simulated flights."""
    there = made("table", get)
    return {"laser": [relation_row(run, result) for run, result in there if run.log in runs.LASER_LOGS],
            "flights": [(run, result) for run, result in there if run.log in runs.FLIGHTS],
            "offices": [(run, result) for run, result in there if run.log in runs.OFFICES]}


def mean(judged, kind):
    """`judged`: relations, or None."""
    return None if judged is None else judged["all"][kind]["mean"]


def errors(row):
    """Mean translation and rotation of the final trajectory."""
    return [mean(row["result"]["final"], kind) for kind in ("translation_m", "rotation_deg")]


def verdict(value, limit):
    if limit is None:
        return ""
    return "met" if value <= limit else "**missed**"


def missed(rows):
    """One line for each limit that is missed."""
    lines = []
    for row in rows["laser"]:
        how = "refined" if row["run"].refine else "not refined"
        for value, limit, unit in zip(errors(row), row["limits"], ("m", "deg")):
            if limit is not None and value > limit:
                lines.append(f"{row['run'].log.name}, {row['run'].beams} beams, {how}: {value:.4g} {unit}, limit "
                             f"{limit:g} {unit}")
    for run, result in rows["flights"]:
        cells, limit = result["final"]["cells_20_cm"], CELLS[run.log.name][1]
        if cells > limit:
            lines.append(f"{run.log.name}: {cells} cells, limit {limit}")
    return lines


def limits_count(rows):
    return sum(limit is not None for row in rows["laser"] for limit in row["limits"]) + len(rows["flights"])


def spread(judged, kind, digits):
    figures = judged["all"][kind]
    return f"{figures['mean']:.{digits}f} ± {figures['std']:.{digits}f}"


def pair(judged):
    if judged is None:
        return NONE
    return f"{mean(judged, 'translation_m'):.4f} / {mean(judged, 'rotation_deg'):.3f}"


def numbers(values, digits=(4, 3)):
    texts = [NONE if value is None else f"{value:.{n}f}" for value, n in zip(values, digits)]
    return NONE if values == (None, None) else " / ".join(texts)


def laser_table(rows):
    def cells(row):
        result, limits = row["result"], row["limits"]
        verdicts = [verdict(value, limit) for value, limit in zip(errors(row), limits)]
        return [f"{row['run'].log.name}, {row['run'].beams}", numbers(row["theirs"]), numbers(limits),
                spread(result["final"], "translation_m", 4), verdicts[0], spread(result["final"], "rotation_deg", 3),
                verdicts[1], pair(result["live"]), pair(result["odometry"])]

    return page.table(["log, beams", "paper's code, m / deg:", "limit, m / deg:", "final, m:", "", "final, deg:", "",
                       "live, m / deg:", "odometry, m / deg:"], [cells(row) for row in rows])


def band_table(rows):
    def cells(row):
        final, closures = row["result"]["final"], row["result"]["report"]["backend"]["closures"]
        bands = [f"{final[key]['translation_m']['mean']:.4f} / {final[key]['rotation_deg']['mean']:.3f}"
                 if final[key]["count"] else NONE for _, key in sweeps.BANDS]
        return [f"{row['run'].log.name}, {row['run'].beams}", "yes" if row["run"].refine else "no", *bands,
                f"{final['all']['translation_m']['max']:.2f}", f"{final['relations']}", f"{final['missed']}",
                f"{closures['accepted']}", f"{closures['dropped']}"]

    return page.table(["log, beams", "refined", *(f"{name}:" for name, _ in sweeps.BANDS), "max, m:", "relations:",
                       "unmatched:", "closures:", "dropped:"], [cells(row) for row in rows])


def bands_text(rows):
    if not rows:
        return ""
    return f"""### By the time that relations span

Means of translation, m / rotation, deg. Under 3 s it is mostly the odometry's error, over 100 s that of loop closures.

{band_table(rows)}
"""


def flights_table(rows):
    def cells(run, result):
        theirs, limit = CELLS[run.log.name]
        live, final = result["live"], result["final"]["cells_20_cm"]
        return [run.log.name, f"{theirs}", f"{limit}", f"{final}", verdict(final, limit),
                NONE if live is None else f"{live['cells_20_cm']}", f"{result['odometry']['cells_20_cm']}"]

    return page.table(["flight", "paper's code:", "limit:", "final:", "", "live:", "odometry:"],
                      [cells(*row) for row in rows])


def offices_table(rows):
    def rmse(judged):
        return NONE if judged is None else f"{judged['rmse_m']:.3f}"

    return page.table(["simulated flight", "before (odometry):", "live:", "after (final):"],
                      [[run.log.name, *(rmse(result[which]) for which in mapped_runs.TRAJECTORIES)] for run, result in rows])


def tables(rows):
    """The tables of the first part, as the program prints them."""
    parts = []
    for refine, heading in ((False, "Without refinement"), (True, "With refinement")):
        chosen = [row for row in rows["laser"] if row["run"].refine == refine]
        if chosen:
            parts.append(f"### {heading}\n\n{laser_table(chosen)}")
    if rows["flights"]:
        parts.append(f"### Flights: distinct cells of 0.2 m\n\n{flights_table(rows['flights'])}")
    if rows["offices"]:
        parts.append(f"### Simulated flights: ATE, m\n\n{offices_table(rows['offices'])}")
    return "\n\n".join(parts)


def milliseconds(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.2g}"


def times_table(there):
    def cells(run, stage, figures):
        return [run.log.name, stage.replace("_", " "), f"{figures['count']}",
                *(milliseconds(figures[key]) for key in ("mean_ms", "p50_ms", "p99_ms", "max_ms"))]

    return page.table(["log", "stage", "calls:", "mean:", "p50:", "p99:", "max:"],
                      [cells(run, stage, result["report"]["stage_times"][stage])
                       for run, result in there for stage in ("frontend", "backend", "final_pass")])


def bullets(lines):
    return "\n".join(textwrap.fill(f"- {line}", WIDTH, subsequent_indent="  ", break_on_hyphens=False)
                     for line in lines or ["none"])


def live_note(rows):
    judged = [row["result"]["live"] for row in rows["laser"]] + [result["live"] for _, result in rows["flights"]]
    if any(one is None for one in judged):
        return f"\nA live figure is {NONE} where the program wrote no `live.tum`.\n"
    return ""


def sweep_text(sweep, get):
    if not any(sweeps.curves(sweep, get)):
        return f"## {sweep.heading}\n\n{NOT_MADE}\n"
    return f"""## {sweep.heading}

{textwrap.fill(sweep.introduction, WIDTH)}

![{sweep.heading}](accuracy/{sweep.part}.svg)

{sweeps.table(sweep, get)}

Of the curves of translation:

{bullets(sweeps.verdicts(sweep, get))}
"""


def times_text(there):
    if not there:
        return f"## Processing times (Fig. 9)\n\n{NOT_MADE}\n"
    return f"""## Processing times (Fig. 9)

Times of single calls in ms, at 11 beams with refinement. The paper's figure is a histogram; here percentiles from
`report.json` are drawn instead. A call of the backend takes one scan, mostly without a keyframe. The final pass with
its refinement is one call at the end. [speed](speed.md) has whole runs, measured one at a time.

![Processing times](accuracy/times.svg)

{times_table(there)}
"""


def document(results, circumstances):
    """The page: all existing runs, and the data that the others lack."""
    get = results.get
    rows = rows_of(get)
    made_or_not = [(run, get(run)) for run in runs.runs_of(runs.PARTS)]
    at_once = max((result["at_once"] for _, result in made_or_not if result is not None), default=1)
    missing = sorted({file for run, result in made_or_not if result is None for file in run.log.missing()})
    left_out = "".join(f"\nLeft out, because it was missing: `{file}`.\n" for file in missing)
    lines = missed(rows)
    out, points = sweeps.break_out_count(get)
    swept = "\n".join(sweep_text(sweep, get) for sweep in sweeps.SWEEPS)
    return f"""{page.head("Accuracy of mapping", "benchmark-accuracy", circumstances)}Program: sha256 \
{results.program}..., at most {at_once} runs at once.
{left_out}
All runs have the default settings ([configuration](../configuration.md)), the same for every log and number of beams,
except what a table names. Figures are means (± standard deviation) over the logs' relations by `swiftlet eval`
([evaluation](../evaluation.md)). "Final" is `trajectory.tum`; "live" are the poses as published; "odometry" is the
vehicle's own dead reckoning. "Without refinement" is `refine = false`.
{live_note(rows)}
Limits met: {limits_count(rows) - len(lines)} of {limits_count(rows)}. Missed:

{bullets(lines)}

Outliers of the sweeps, with over {sweeps.BREAK_OUT:g} times the median error of their curve: {out} of {points} points.
Axes are logarithmic where such a point would flatten the rest.

## The paper's table, and beyond

"Paper's code" was measured on two such cores with its own settings for each log, and is the limit without refinement.
For Killian it is the paper's figure: by rounding alone its code gives 0.16 to 1.43 m.

{tables(rows) or NOT_MADE}

{bands_text(rows["laser"])}
{swept}
## Changed logs

{changes.text(get) or NOT_MADE}

{times_text(made("times", get))}"""
