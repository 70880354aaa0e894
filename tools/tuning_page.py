# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/tuning.md: what comes of each constant at half and at double."""

import dataclasses
import math
import statistics

import benchmark_page as page
import robustness_page
import tuning_runs

ISLAND = 0.03  # more new break-outs than this, of all runs
NONE = "–"
HALF, DOUBLE = 0.5, 2.0


@dataclasses.dataclass(frozen=True)
class Effect:
    """Of one constant with another value, on the runs of the ensemble."""
    variant: tuning_runs.Variant
    runs: int
    out: int  # break-outs
    broken: int  # of these, not with the default
    mended: int  # break-outs with the default alone
    is_same: bool  # byte for byte
    error: float  # geometric mean of the errors over those with the default
    median_ratio: float  # to dead reckoning

    def is_island(self):
        return self.broken / self.runs > ISLAND


@dataclasses.dataclass(frozen=True)
class Yardstick:
    """The default settings on the ensemble: their results, outcomes, and the errors of their best quarters."""
    results: list
    outcomes: list
    limits: robustness_page.Quarters

    def out(self):
        """Of each run, whether it breaks out."""
        return [robustness_page.breaks_out(one, self.limits) for one in self.outcomes]


def yardstick(runs, get):
    """`get`: the result of a run. Buildings break out by being worse than dead reckoning alone. Raises LookupError
    where a result is missing."""
    results = [get(run) for run in tuning_runs.varied(runs, None)]
    if None in results:
        raise LookupError("not all runs with the default settings exist")
    outcomes = [robustness_page.outcome(run, result) for run, result in zip(runs, results)]
    limits = robustness_page.Quarters([one for one in outcomes if one.run.log.files()])
    return Yardstick(results, outcomes, limits)


def mean_of(ratios):
    """Geometric; of those that are positive numbers."""
    logs = [math.log(ratio) for ratio in ratios if 0.0 < ratio < math.inf]
    return math.exp(statistics.mean(logs)) if logs else 1.0


def effect(variant, runs, default, get):
    """None where a run is missing."""
    results = [get(run) for run in tuning_runs.varied(runs, variant)]
    if any(result is None for result in results):
        return None
    outcomes = [robustness_page.outcome(run, result) for run, result in zip(runs, results)]
    out = [robustness_page.breaks_out(one, default.limits) for one in outcomes]
    changes = list(zip(default.out(), out))
    pairs = [(now.error, before.error) for now, before in zip(outcomes, default.outcomes)]
    same = all("digest" in now and now["digest"] == before.get("digest")
               for now, before in zip(results, default.results))
    ratios = [one.ratio for one in outcomes if one.ratio is not None]
    return Effect(variant, len(runs), sum(out), changes.count((False, True)), changes.count((True, False)), same,
                  mean_of([now / before for now, before in pairs if now and before]),
                  statistics.median(ratios) if ratios else math.nan)


@dataclasses.dataclass(frozen=True)
class Swept:
    """One constant."""
    constant: tuning_runs.Constant
    effects: dict  # by factor

    def worst(self):
        """What to sort by: new break-outs, then errors."""
        return (max(one.broken for one in self.effects.values()), max(one.error for one in self.effects.values()))

    def is_island(self):
        return any(one.is_island() for one in self.effects.values())

    def changes_nothing(self):
        return all(one.is_same for one in self.effects.values())


def swept(variants, runs, default, get):
    """The constants all of whose runs exist, worst first."""
    found = {}
    for variant in variants:
        found.setdefault(variant.constant, {})[variant.factor] = effect(variant, runs, default, get)
    done = [Swept(constant, effects) for constant, effects in found.items() if None not in effects.values()]
    return sorted(done, key=Swept.worst, reverse=True)


def effect_cells(one):
    if one is None:
        return [NONE, "", "", ""]
    rate = f"{robustness_page.percent(one.out / one.runs)} (+{one.broken} -{one.mended})"
    return [one.variant.text, f"**{rate}**" if one.is_island() else rate, f"{one.error:.3f}",
            f"{one.median_ratio:.3f}"]


def constant_row(one):
    name = f"`{one.constant.name()}`"
    return [f"**{name}**" if one.is_island() else name, one.constant.text, one.constant.origin,
            *effect_cells(one.effects.get(HALF)), *effect_cells(one.effects.get(DOUBLE))]


def table_of(constants):
    head = ["constant", "value:", "where it comes from", "half:", "break-outs, %:", "error:", "ratio:", "double:",
            "break-outs, %:", "error:", "ratio:"]
    return page.table(head, [constant_row(one) for one in constants])


def unchanged_table(constants):
    return page.table(["constant", "value:", "where it comes from"],
                      [[f"`{one.constant.name()}`", one.constant.text, one.constant.origin] for one in constants])


def body(constants, default):
    """The page without its head. `constants`: swept()."""
    total, out = len(default.outcomes), sum(default.out())
    moving = [one for one in constants if not one.changes_nothing()]
    still = [one for one in constants if one.changes_nothing()]
    islands = sum(one.is_island() for one in constants)
    ratios = [one.ratio for one in default.outcomes if one.ratio is not None]
    rate = robustness_page.percent(out / total)
    parts = [f"{len(constants)} constants: {islands} islands, {len(still)} that change nothing. With the defaults "
             f"{out} of {total} runs break out ({rate} %); median ratio to dead reckoning "
             f"{statistics.median(ratios):.3f}."]
    if moving:
        parts.append(table_of(moving))
    if still:
        parts.append(f"## Constants that change nothing\n\nNeither half nor double changes a byte of any output.\n\n"
                     f"{unchanged_table(still)}")
    return "\n\n".join(parts)


def document(constants, default, buildings, circumstances):
    real = len(default.outcomes) - buildings
    return f"""{page.head("Tuning constants", "benchmark-tuning", circumstances)}
Constants of the algorithms that are no settings (`[tuning.PART]`: [CONTRIBUTING](../CONTRIBUTING.md)).
Results should hardly depend on them. Each is halved and doubled alone, within its range, over a screening ensemble:
{buildings} simulated buildings and {real} short real runs of `tools/benchmark-robustness --screen`.

Break-outs are those of [robustness](results/robustness.md), held against the best quarters of the default settings; a
building breaks out if its error exceeds that of dead reckoning by more than {robustness_page.TOLERANCE}.
Each log has one real run, whose error is its own best quarter: with the defaults it breaks out only by dead reckoning,
or by an error known to be attainable.

In brackets: + runs that break out and did not with the default, - runs that did and no longer do. "Error" is the
geometric mean of the errors over those with the default, "ratio" the median of the error over that of dead reckoning.
**Bold** is an island: over {100 * ISLAND:.0f} % of the runs break out that did not. The list is sorted by the worse of
both sides.

{body(constants, default)}
"""
