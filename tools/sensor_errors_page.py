# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/sensor_errors.md: what each error of the simulated sensors costs, and what the refinement could give at
best."""

import math
import statistics

import benchmark_page as page
import sensor_errors_runs as runs

TAIL = 1.96  # of the normal distribution, 95 % to both sides
WORSE = 1.02  # than dead reckoning
REFINED = {"as mapped": "final_m", "from the truth": "from_truth_m",
           "from the truth, on true walls": "on_true_walls_m"}
RATIO_COLUMNS = ["over dead reckoning, median:", "95 %:", "worse:"]


def change(spared, usual):
    """Of errors by seed: their geometric mean as a multiple, with its 95 % interval."""
    logs = [math.log(spared[seed] / usual[seed]) for seed in usual]
    mean = statistics.mean(logs)
    off = TAIL * statistics.stdev(logs) / math.sqrt(len(logs))
    return f"{math.exp(mean):.2f} ({math.exp(mean - off):.2f} to {math.exp(mean + off):.2f})"


def by_error_spared(rows):
    """By that and by seed."""
    results = {}
    for run, result in rows:
        results.setdefault(run.without, {})[run.seed] = result
    return results


def ratio_cells(ratios):
    """`ratios`: to dead reckoning."""
    return [f"{page.quantile(ratios, .5):.3f}", f"{page.quantile(ratios, .95):.3f}",
            str(sum(ratio > WORSE for ratio in ratios))]


def spared(without):
    if without == runs.NONE:
        return "none"
    return f"{runs.TOGETHER[without]} (`{without}`)" if without in runs.TOGETHER else f"`{without}`"


def errors_of(path, results):
    """By seed."""
    return {seed: result[path] for seed, result in results.items()}


def table(rows):
    by_error = by_error_spared(rows)
    usual = by_error[runs.NONE]
    lines = []
    for without, results in by_error.items():
        multiples = [change(errors_of(path, results), errors_of(path, usual)) if without else "1"
                     for path in runs.PATHS]
        lines.append([spared(without), *multiples,
                      f"{page.quantile(errors_of('corrected', results).values(), .5):.3f}",
                      *ratio_cells([result["corrected"] / result["odometry"] for result in results.values()])])
    paths = (f"{name}:" for name in runs.PATHS.values())
    return page.table(["spared", *paths, "final, median, m:", *RATIO_COLUMNS], lines)


def table_from_truth(rows):
    lines = []
    for without, results in by_error_spared(rows).items():
        for name, path in REFINED.items():
            ratios = [result[path] / result["odometry_m"] for result in results.values()]
            lines.append([spared(without), name, *ratio_cells(ratios)])
    return page.table(["spared", "refined", *RATIO_COLUMNS], lines)


def preferred(rows):
    """The share of the flights without bad floors whose path from the truth explains the ranges better."""
    found = by_error_spared(rows)["floors"].values()
    better = sum(result["from_truth_misfit"] < result["final_misfit"] for result in found)
    return f"{better} of {len(found)}"


def document(report):
    return f"""{page.head("What each error of the sensors costs", "benchmark-sensor-errors", report)}
The [simulated buildings](../simulated_buildings.md#errors) with seeds {runs.SEEDS.start} to {runs.SEEDS.stop - 1},
each mapped as it is and spared one error of its sensors (`without` in the URI); all else is the same. "Dead reckoning",
"published" and "final" are the RMS errors of these paths as multiples of those with all errors: geometric means over
the buildings, with 95 % intervals. "Worse" are maps that are more than 2 % worse than their dead reckoning.

Where the published and final error hardly change, that error is estimated from the input, averaged out, or small
beside the others. Where they change, it is what limits the maps.

{table(report["rows"])}

## What the refinement could give at best

Each flight is mapped, and the final refinement is begun again at the true path: the same returns and dead reckoning,
no loop closures, and no floors as unknowns (`tests/benchmarks/refined_truth.cpp`). Where that ends is left to what was
measured and to how the refinement weighs it. A better search for the path, for closures or among paths would hardly
lead beyond. Where the floors are spared, the path from the truth explains the ranges better than that of the map does
in {preferred(report["from_truth"])} flights; half of them would mean that the ranges do not tell the two apart.

"On true walls": beside the true path it is known which face of which wall each return is on, if on any, that walls are
straight, and about where short ones point; where they stand is not known, and floors are unknowns. A better way to find
walls would hardly lead beyond.

{table_from_truth(report["from_truth"])}
"""
