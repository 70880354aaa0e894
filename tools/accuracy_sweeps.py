# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The paper's sweeps: errors over one setting, whether the curve has the paper's shape, and, where not, which relations
make the difference."""

import dataclasses
import statistics
from collections.abc import Callable

import accuracy_runs as runs
import benchmark_page as page

FLAT = 0.05  # share by which best and worst of a curve must differ to show an effect of the setting
BREAK_OUT = 1.5  # times the median: an outlier by missed or wrong loops, irrelevant to the rest of the curve
BANDS = [("under 3 s", "under_3_s"), ("of 3 to 100 s", "from_3_to_100_s"), ("over 100 s", "over_100_s")]


def falls_ever_less(errors):
    """Fig. 6: more beams help, the first ones most. Errors by setting -> the contradiction, None if there is none."""
    first, last, middle = min(errors), max(errors), 11 if 11 in errors else sorted(errors)[len(errors) // 2]
    worse = [value for value in errors if first < value < last and errors[value] > errors[first]]
    if worse:
        return f"worse at {worse[0]} than at {first}"
    if errors[last] >= errors[first]:
        return f"no better at {last} than at {first}"
    if errors[first] - errors[middle] <= errors[middle] - errors[last]:
        return f"gains more from {middle} to {last} than from {first} to {middle}"
    return None


def least_at_three(errors):
    """Fig. 4: the 3x3 kernel is best, and errors grow with the width beyond it."""
    best = min(errors, key=errors.get)
    if best != 3:
        return f"least at {best}"
    beyond = [errors[width] for width in errors if width >= 3]
    return None if beyond == sorted(beyond) else "not growing beyond 3"


def sweet_spot(errors):
    """Fig. 5: least in the middle."""
    best = min(errors, key=errors.get)
    return f"least at the end, {best}" if best in (min(errors), max(errors)) else None


@dataclasses.dataclass(frozen=True)
class Sweep:
    part: str  # of accuracy_runs.PARTS
    heading: str
    axis: str  # what is swept
    values: list
    beams: list  # one curve each
    run: Callable  # log, beams, value, refine -> Run
    contradiction: Callable  # one of those above
    introduction: str
    is_steep: bool = False  # in the paper, too: outliers belong to its shape


SWEEPS = [
    Sweep("beams", "Number of beams (Fig. 6)", "beams", runs.BEAMS, [None],
          lambda log, _, value, refine: runs.Run(log, beams=value, refine=refine), falls_ever_less,
          "In the paper, on Intel, errors fall with the number of beams, and each further beam helps less."),
    Sweep("kernel", "Max kernel (Fig. 4)", "width of the max kernel, cells", runs.KERNELS, [4, 11],
          lambda log, beams, value, refine: runs.kernel_run(value, log=log, beams=beams, refine=refine),
          least_at_three,
          "`max_kernel_cells`; 1 is no kernel. In the paper, on Intel with 4 beams, 3x3 is best, wider ones are worse.",
          is_steep=True),
    Sweep("multiscan", "Multiscan size (Fig. 5)", "multiscan size, points", runs.MULTISCANS, [4, 11],
          lambda log, beams, value, refine: runs.Run(log, beams=beams, refine=refine, multiscan=value), sweet_spot,
          "`multiscan_points`. In the paper, with 4 beams, errors are least in the middle. Whole scans are taken: at "
          "11 beams 100 and 108 points are both 10 scans, 124 and 132 both 12."),
]


def curves(sweep, get):
    """Each curve of the sweep that has a run: log, beams, refine, results by setting. `get`: the result of a run, None
    where there is none."""
    for log in runs.SWEPT_LOGS:
        for beams in sweep.beams:
            for refine in (False, True):
                made = {value: get(sweep.run(log, beams, value, refine)) for value in sweep.values}
                made = {value: result for value, result in made.items() if result is not None}
                if made:
                    yield log, beams, refine, made


def curve_name(log, beams, refine):
    return ", ".join([log.name, *([] if beams is None else [f"{beams} beams"]),
                      "refined" if refine else "not refined"])


def errors_of(results, kind="translation_m"):
    return {value: result["final"]["all"][kind]["mean"] for value, result in results.items()}


def table(sweep, get):
    def cells(results):
        translation, rotation = errors_of(results), errors_of(results, "rotation_deg")
        return [f"{translation[value]:.4f} / {rotation[value]:.2f}" if value in results else ""
                for value in sweep.values]

    return page.table(["m / deg", *(f"{value}:" for value in sweep.values)],
                      [[curve_name(log, beams, refine), *cells(results)]
                       for log, beams, refine, results in curves(sweep, get)])


def shares_of_difference(worse, better):
    """Evaluated relations of two runs -> share of each band in the difference of their mean translations."""
    def part(judged, key):
        band = judged[key]
        return band["count"] * band["translation_m"]["mean"] / judged["all"]["count"] if band["count"] else 0.0

    whole = sum(part(worse, key) - part(better, key) for _, key in BANDS)
    return {name: (part(worse, key) - part(better, key)) / whole for name, key in BANDS}


def explanation(results, errors):
    """The band of relations with most of the difference between the worst and the best setting, and their closures."""
    best, worst = min(errors, key=errors.get), max(errors, key=errors.get)
    shares = shares_of_difference(results[worst]["final"], results[best]["final"])
    band = max(shares, key=shares.get)

    def closures(value):
        counts = results[value]["report"]["backend"]["closures"]
        return f"{counts['accepted'] - counts['dropped']} kept and {counts['dropped']} dropped at {value}"

    return (f"From {worst} to {best}, {shares[band]:.0%} of the difference is that of relations {band}; closures: "
            f"{closures(worst)}, {closures(best)}.")


def shape(sweep, results):
    """Whether a curve has the paper's shape."""
    errors = errors_of(results)
    spread = max(errors.values()) / min(errors.values()) - 1
    if spread < FLAT:
        return f"flat; worst over best +{spread:.1%}, so the setting has hardly any effect."
    contradiction = sweep.contradiction(errors)
    if contradiction is None:
        return f"the paper's shape; worst over best +{spread:.0%}."
    return f"**not the paper's shape**: {contradiction}; worst over best +{spread:.0%}. {explanation(results, errors)}"


def break_outs(errors):
    """The settings whose error is an outlier."""
    return [value for value, error in errors.items() if error > BREAK_OUT * statistics.median_low(errors.values())]


def verdict(sweep, results):
    """A few sentences on one curve of translation."""
    errors = errors_of(results)
    if len(errors) < len(sweep.values):
        return "not all runs exist."
    out = break_outs(errors)
    if not out:
        return shape(sweep, results)
    named = f"**outlier** at {', '.join(f'{value} ({errors[value]:.3g} m)' for value in out)}"
    if sweep.is_steep and sweep.contradiction(errors) is None:
        return f"the paper's shape, with an {named}. {explanation(results, errors)}"
    rest = {value: result for value, result in results.items() if value not in out}
    return f"{named}. {explanation(results, errors)} The others: {shape(sweep, rest)}"


def verdicts(sweep, get):
    return [f"{curve_name(log, beams, refine)}: {verdict(sweep, results)}"
            for log, beams, refine, results in curves(sweep, get)]


def break_out_count(get):
    """The number of outliers on all complete curves, and the number of their points."""
    complete = [errors_of(results) for sweep in SWEEPS for *_, results in curves(sweep, get)
                if len(results) == len(sweep.values)]
    return sum(len(break_outs(errors)) for errors in complete), sum(len(errors) for errors in complete)
