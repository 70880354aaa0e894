# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Break-outs of the ensembles: runs whose error exceeds that of their like by far, or that of dead reckoning. Tables
and docs/results/robustness.md."""

import dataclasses
import math
import random
import statistics
import textwrap

import accuracy_page
import benchmark_page as page
import robustness_runs as runs

OVER_QUARTER = 1.5  # times the error below which the best quarter of a group lies
OVER_QUARTER_CELLS = 1.25  # the same of cells over those of dead reckoning
OVER_ODOMETRY = 1.02
TOLERANCE = f"{100 * (OVER_ODOMETRY - 1):.0f} %"
CONFIDENCE_Z = 1.96  # 95 %
CONFIDENCE = 0.025, 0.975
DRAWS = 10000  # of the bootstrap
PICTURES_OF_BUILDINGS = 8
NONE = "–"
WIDTH = 120  # of a line of text


@dataclasses.dataclass(frozen=True)
class Outcome:
    """Of one run. No error: it failed."""
    run: runs.Run
    error: float | None  # m; of cells the ratio
    ratio: float | None  # to dead reckoning
    is_in_cells: bool
    failed: str = ""
    figures: dict = dataclasses.field(default_factory=dict)
    live_ratio: float | None = None  # of the poses as published
    each_m: list | None = None  # errors of all relations; of those that the run does not hold None
    rotation_deg: float | None = None  # mean of all relations

    def is_worse_than_odometry(self):
        return self.ratio is not None and self.ratio > OVER_ODOMETRY

    def error_over(self, held):
        """The error over the relations that another run holds; None where this one does not hold them all. All errors
        that are not of relations are comparable."""
        if self.each_m is None or held.each_m is None:
            return self.error
        errors = [own for own, other in zip(self.each_m, held.each_m) if other is not None]
        return None if None in errors else statistics.fmean(errors)

    def exceeds(self, quarter):
        factor = OVER_QUARTER_CELLS if self.is_in_cells else OVER_QUARTER
        return self.error is not None and quarter is not None and self.error > factor * quarter


def over(odometry, error):
    return error / odometry if odometry else math.inf


def outcome(run, result):
    if "failed" in result:
        return Outcome(run, None, None, False, result["failed"])
    for which, what in (("final", "final trajectory"), ("odometry", "dead reckoning")):
        if result[which] is None:
            return Outcome(run, None, None, False, f"no {what}")
    error, live, odometry = (runs.error_of(result.get(which)) for which in ("final", "live", "odometry"))
    ratio = over(odometry, error)
    live_ratio = None if live is None else over(odometry, live)
    in_cells = runs.is_in_cells(result["final"])
    figures = {**result["report"], "at_once": result["at_once"]}
    return Outcome(run, ratio if in_cells else error, ratio, in_cells, figures=figures, live_ratio=live_ratio,
                   each_m=result["final"].get("each_translation_m"), rotation_deg=runs.rotation_of(result["final"]))


def outcomes(wanted, get):
    """Of the runs that exist."""
    return [outcome(run, result) for run in wanted if (result := get(run)) is not None]


def grouped(all_outcomes, key):
    """{key of the run: outcomes}, in the order of the list of ensembles, other logs last."""
    groups = {}
    for one in all_outcomes:
        groups.setdefault(key(one.run), []).append(one)
    order = {ensemble.log.name: place for place, ensemble in enumerate(runs.ENSEMBLES)}
    return dict(sorted(groups.items(), key=lambda item: (order.get(item[1][0].run.log.name, len(order)), item[0])))


def attainable_m(log, group):
    """Error known to be possible, so that a log on which every run is bad has break-outs, too."""
    limit_m, _ = accuracy_page.REFINED_LIMITS.get((log, 4 if group.endswith(runs.FEW) else 11), (math.inf, None))
    return limit_m


class Quarters:
    """The errors below which the best quarters of groups lie: what a run is held against. `sets`: of outcomes; of
    several the lowest counts."""

    def __init__(self, *sets):
        self.sets = [grouped(several, runs.Run.group) for several in sets]
        self.found = {}

    def of(self, one):
        """For this run: among those of its group that hold all its relations, over these. With many beams none is
        higher than with few. None without a true reference, or where no run has an error."""
        if one.run not in self.found:
            self.found[one.run] = None if one.run.log.name in runs.WITHOUT_TRUTH else self.lowest(one)
        return self.found[one.run]

    def lowest(self, one):
        names = {one.run.group(), one.run.group().replace(runs.MANY, runs.FEW)}
        return min((quarter for groups in self.sets for name in names
                    if (quarter := self.quarter(groups.get(name, []), name, one)) is not None), default=None)

    @staticmethod
    def quarter(group, name, one):
        errors = sorted(error for other in group
                        if other.error is not None and (error := other.error_over(one)) is not None)
        return min(errors[(len(errors) - 1) // 4], attainable_m(one.run.log.name, name)) if errors else None


def breaks_out(one, limits):
    """`limits`: Quarters."""
    return bool(one.failed) or one.is_worse_than_odometry() or one.exceeds(limits.of(one))


def interval(count, of):
    """Wilson's, of the rate."""
    if of == 0:
        return 0.0, 1.0
    rate, z2 = count / of, CONFIDENCE_Z**2
    middle = (rate + z2 / (2 * of)) / (1 + z2 / of)
    half = CONFIDENCE_Z / (1 + z2 / of) * math.sqrt(rate * (1 - rate) / of + z2 / (4 * of**2))
    return max(middle - half, 0.0), min(middle + half, 1.0)


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(round(share * (len(ordered) - 1)), len(ordered) - 1)]


def interval_over_logs(logs):
    """Of the rate of all runs: a bootstrap that draws whole logs. `logs`: [(break-outs, runs)]. None where all logs
    have one rate."""
    if len({count / of for count, of in logs}) < 2:
        return None
    chance = random.Random(runs.SEED)
    drawn = [chance.choices(logs, k=len(logs)) for _ in range(DRAWS)]
    rates = [sum(count for count, _ in some) / sum(of for _, of in some) for some in drawn]
    low, high = (percentile(rates, share) for share in CONFIDENCE)
    return low, high


def percent(share):
    return f"{100 * share:.1f}"


def rate_cells(count, of, bounds):
    return [str(of), str(count), percent(count / of),
            NONE if bounds is None else f"{percent(bounds[0])} to {percent(bounds[1])}"]


def counts(group, limits):
    """Break-outs and runs."""
    return sum(breaks_out(one, limits) for one in group), len(group)


def rates_row(name, group, limits, bounds):
    ratios = [one.ratio for one in group if one.ratio is not None]
    return [name, *rate_cells(*counts(group, limits), bounds),
            str(sum(one.exceeds(limits.of(one)) for one in group)),
            str(sum(one.is_worse_than_odometry() for one in group)), str(sum(bool(one.failed) for one in group)),
            f"{statistics.median(ratios):.3f}" if ratios else NONE, f"{max(ratios):.2f}" if ratios else NONE]


def by_log(all_outcomes):
    return grouped(all_outcomes, lambda run: run.log.name)


def rates_table(all_outcomes, limits):
    rows = [rates_row(name, group, limits, interval(*counts(group, limits)))
            for name, group in by_log(all_outcomes).items()]
    true = [one for one in all_outcomes if runs.has_truth(one.run.log)]
    for name, several in (("**with truth**", true), ("**all**", all_outcomes)):
        if several:
            logs = [counts(group, limits) for group in by_log(several).values()]
            rows.append(rates_row(name, several, limits, interval_over_logs(logs)))
    return page.table(["log", "runs:", "break-outs:", "%:", "95 %:", "over quarter:", "over odometry:", "failed:",
                       "median ratio:", "worst ratio:"], rows)


def kind_of(one):
    return "as recorded" if one.run.change is None else one.run.change.name


def kinds_table(all_outcomes, limits):
    """By change."""
    kinds = {}
    for one in all_outcomes:
        kinds.setdefault(kind_of(one), []).append(one)
    return page.table(["change", "runs:", "break-outs:", "%:", "95 %:"],
                      [[name, *rate_cells(*counts(group, limits), interval(*counts(group, limits)))]
                       for name, group in sorted(kinds.items())])


def groups_table(all_outcomes, limits):
    def cells(name, group):
        errors = sorted(one.error for one in group if one.error is not None)
        unit = "" if group[0].is_in_cells else " m"
        quarters = [quarter for one in group if (quarter := limits.of(one)) is not None]
        low, high = (min(quarters), max(quarters)) if quarters else (None, None)
        known = [low, high, *((statistics.median(errors), errors[-1]) if errors else (None, None))]
        return [name, str(len(group)), *(NONE if value is None else f"{value:.4f}{unit}" for value in known)]

    return page.table(["log, beams", "runs:", "best quarter, lowest:", "highest:", "median:", "worst:"],
                      [cells(name, group) for name, group in grouped(all_outcomes, runs.Run.group).items()])


def worst_first(broken, limits):
    def by_how_much(one):
        if one.failed:
            return math.inf
        return max(one.ratio / OVER_ODOMETRY, one.error / (limits.of(one) or math.inf) / OVER_QUARTER)

    return sorted(broken, key=by_how_much, reverse=True)


def broken_lines(all_outcomes, limits):
    """A row for each break-out."""
    def cells(one):
        if one.failed:
            return [one.run.title(), one.failed, "", ""]
        quarter = limits.of(one)
        over = f"{one.error / quarter:.2f}" if quarter else NONE
        return [one.run.title(), f"{one.error:.3f}", over, f"{one.ratio:.2f}"]

    broken = worst_first([one for one in all_outcomes if breaks_out(one, limits)], limits)
    return page.table(["run", "error:", "over quarter:", "over odometry:"], [cells(one) for one in broken])


def pictured(all_outcomes, limits):
    """The break-outs that have a map, worst first."""
    return worst_first([one for one in all_outcomes if breaks_out(one, limits) and not one.failed], limits)


def building_kind(one):
    """A building that failed has none."""
    return one.figures.get("kind") or NONE


def most_over_odometry(all_outcomes):
    """Those worse than dead reckoning, worst first."""
    worse = [one for one in all_outcomes if one.is_worse_than_odometry()]
    return sorted(worse, key=lambda one: one.ratio, reverse=True)


def pictured_buildings(all_outcomes):
    """The worst of each kind, at most PICTURES_OF_BUILDINGS."""
    chosen = {}
    for one in most_over_odometry(all_outcomes):
        chosen.setdefault(building_kind(one), one)
    return list(chosen.values())[:PICTURES_OF_BUILDINGS]


def tables(all_outcomes):
    limits = Quarters(all_outcomes)
    return "\n\n".join(table(all_outcomes, limits)
                       for table in (rates_table, kinds_table, groups_table, broken_lines))


def plain_table(all_outcomes):
    """Errors and ratios of the logs as they are (of relations also those of the angle), and the mean of the flights with
    motion capture."""
    logs = {}
    for one in all_outcomes:
        logs.setdefault(one.run.log.name, {})[one.run.beams] = one

    def cell(one):
        if one is None or one.failed:
            return "" if one is None else one.failed
        turned = "" if one.rotation_deg is None else f"{one.rotation_deg:.2f} deg, "
        text = f"{one.ratio:.2f}" if one.is_in_cells else f"{one.error:.3f} m, {turned}{one.ratio:.2f}"
        return f"**{text}**" if one.is_worse_than_odometry() else text

    rows = [[name, *(cell(by_beams.get(beams)) for beams in runs.PLAIN_BEAMS), cell(by_beams.get(None))]
            for name, by_beams in logs.items()]
    captured = [one for one in all_outcomes if runs.is_captured(one.run.log) and not one.failed]
    if captured:
        mean_m = statistics.mean(one.error for one in captured)
        odometry_m = statistics.mean(one.error / one.ratio for one in captured)
        rows.append([f"Vicon, mean of {len(captured)}", *[""] * len(runs.PLAIN_BEAMS),
                     f"{mean_m:.3f} m (odometry {odometry_m:.3f})"])
    return page.table(["log", *(f"{beams} beams:" for beams in runs.PLAIN_BEAMS), "flight:"], rows)


def pieces_row(name, pieces):
    ratios = [one.ratio for one in pieces if one.ratio]
    over = sum(one.is_worse_than_odometry() for one in pieces)
    mean, worst = (f"{statistics.geometric_mean(ratios):.3f}", f"{max(ratios):.2f}") if ratios else (NONE, NONE)
    return [name, str(len(pieces)), str(sum(bool(one.failed) for one in pieces)), mean, str(over), worst]


def pieces_table(all_outcomes):
    """Ratios to dead reckoning, their geometric mean. No best quarter: each piece is another run."""
    by_name = grouped(all_outcomes, lambda run: "Vicon" if runs.is_captured(run.log) else run.log.name)
    rows = [pieces_row(name, pieces) for name, pieces in [*by_name.items(), ("**all**", all_outcomes)]]
    return page.table(["log", "pieces:", "failed:", "mean ratio:", f"over {OVER_ODOMETRY:g}:", "worst:"], rows)


def comparison(before, after):
    """Which runs break out in one set and not in the other."""
    earlier = {unset(one.run): one for one in before}
    pairs = [(earlier[unset(one.run)], one) for one in after if unset(one.run) in earlier]
    limits = Quarters(*zip(*pairs))  # both are held against the same
    rows = []
    for name, group in grouped_pairs(pairs).items():
        out = [(breaks_out(a, limits), breaks_out(b, limits)) for a, b in group]
        ratios = [b.error / a.error for a, b in group if a.error and b.error]
        rows.append([name, str(len(group)), str(sum(a for a, _ in out)), str(sum(b for _, b in out)),
                     str(out.count((True, False))), str(out.count((False, True))),
                     f"{statistics.median(ratios):.3f}" if ratios else NONE])
    summary = page.table(["log", "runs:", "before:", "after:", "mended:", "broken:", "median error, after / before:"],
                         rows)
    return f"{summary}\n\n{changed_pairs(pairs, limits)}"


def unset(run):
    """The run whatever its settings."""
    return runs.with_settings(run, "")


def grouped_pairs(pairs):
    groups = {}
    for pair in pairs:
        groups.setdefault(pair[0].run.log.name, []).append(pair)
    return {**groups, "**all**": pairs}


def changed_pairs(pairs, limits):
    def text(one):
        return one.failed or f"{one.error:.3f} ({one.ratio:.2f})"

    changed = [(a, b) for a, b in pairs if breaks_out(a, limits) != breaks_out(b, limits)]
    return page.table(["run", "", "before, error (ratio):", "after:"],
                      [[b.run.title(), "mended" if breaks_out(a, limits) else "**broken**", text(a), text(b)]
                       for a, b in sorted(changed, key=lambda pair: (pair[1].run.log.name, pair[1].run.title()))])


def bad_runs(all_outcomes):
    """How many are worse than dead reckoning or failed."""
    return sum(one.is_worse_than_odometry() or bool(one.failed) for one in all_outcomes)


def median_and_p95(ratios):
    return [f"{statistics.median(ratios):.3f}", f"{percentile(ratios, 0.95):.3f}"] if ratios else [NONE, NONE]


def share_cell(count, of):
    low, high = interval(count, of)
    return f"{percent(count / of)} ({percent(low)} to {percent(high)})"


def live_rows(done):
    """Of the poses as published."""
    ratios = [one.live_ratio for one in done if one.live_ratio is not None]
    if not ratios:
        return []
    worse = sum(ratio > OVER_ODOMETRY for ratio in ratios)
    median, p95 = median_and_p95(ratios)
    return [[f"published poses: error over {OVER_ODOMETRY:g} times that of dead reckoning, %",
             share_cell(worse, len(ratios))],
            ["published poses: median ratio", median], ["published poses: p95", p95]]


def kinds_of_buildings_table(name, all_outcomes):
    """`name`: of what the kinds of buildings are counted by."""
    kinds = {}
    for one in all_outcomes:
        kinds.setdefault(building_kind(one), []).append(one)

    def cells(name, group):
        bad = bad_runs(group)
        ratios = [one.ratio for one in group if not one.failed]
        return [name, *rate_cells(bad, len(group), interval(bad, len(group))), *median_and_p95(ratios)]

    return page.table(["kind", f"{name}:", f"over {OVER_ODOMETRY:g} times or failed:", "%:", "95 %:", "median ratio:",
                       "p95:"], [cells(name, group) for name, group in sorted(kinds.items())])


def named_seeds(intro, texts):
    """`texts`: [(outcome, what is said of it)]."""
    seeds = (f"{runs.seed_of(one.run.log)} ({text})" for one, text in texts)
    return [textwrap.fill(f"{intro}: {', '.join(seeds)}.", WIDTH, break_on_hyphens=False)] if texts else []


def buildings_text(all_outcomes):
    """Figures of the simulated buildings."""
    if not all_outcomes:
        return "No run."
    done = [one for one in all_outcomes if not one.failed]
    failed = [one for one in all_outcomes if one.failed]
    bad = bad_runs(all_outcomes)
    median, p95 = median_and_p95([one.ratio for one in done])
    rows = [["buildings", str(len(all_outcomes))], ["failed", str(len(failed))],
            [f"final error over {OVER_ODOMETRY:g} times that of dead reckoning, %", share_cell(bad, len(all_outcomes))],
            ["median ratio to dead reckoning", median], ["p95 of the ratio", p95], *live_rows(done)]
    if done:
        per_sample_ms = statistics.mean(one.figures["mean_per_scan_ms"] for one in done)
        rows += [["mean time per sample, ms", f"{per_sample_ms:.3f}"],
                 ["runs at once", ", ".join(map(str, sorted({one.figures["at_once"] for one in done})))],
                 ["longest call of the backend, ms", f"{max(one.figures['backend_max_ms'] for one in done):.1f}"]]
    worse = [(one, f"{building_kind(one)}, {one.ratio:.2f}") for one in most_over_odometry(done)]
    return "\n\n".join([page.table(["", ":"], rows), kinds_of_buildings_table("buildings", all_outcomes),
                        *named_seeds(f"Over {OVER_ODOMETRY:g} times, seed (kind, ratio)", worse),
                        *named_seeds("Failed, seed (why)", [(one, one.failed) for one in failed])])


def robots_row(beams, group):
    done = [one for one in group if not one.failed]
    live = [one.live_ratio for one in done if one.live_ratio is not None]
    bad = bad_runs(group)
    return [str(beams), *rate_cells(bad, len(group), interval(bad, len(group))),
            *median_and_p95([one.ratio for one in done]), str(sum(ratio > OVER_ODOMETRY for ratio in live)),
            *median_and_p95(live)]


def robots_text(all_outcomes):
    """Figures of the simulated robots with wheels."""
    if not all_outcomes:
        return "No run."
    by_beams = {}
    for one in all_outcomes:
        by_beams.setdefault(one.run.beams, []).append(one)
    bad_name = f"over {OVER_ODOMETRY:g} times or failed:"
    table = page.table(["beams", "robots:", bad_name, "%:", "95 %:", "median ratio:", "p95:", "published poses, over:",
                        "median:", "p95:"], [robots_row(*item) for item in sorted(by_beams.items())])
    worse = [(one, f"{building_kind(one)}, {one.run.beams} beams, {one.ratio:.2f}")
             for one in most_over_odometry(all_outcomes)]
    failed = [(one, one.failed) for one in all_outcomes if one.failed]
    return "\n\n".join([table, kinds_of_buildings_table("robots", all_outcomes),
                        *named_seeds(f"Over {OVER_ODOMETRY:g} times, seed (kind, beams, ratio)", worse),
                        *named_seeds("Failed, seed (why)", failed)])


def pictures_text(shown):
    def title(one):
        return one.run.title() if one.run.log.files() else f"{one.run.title()}, {building_kind(one)}"

    return "\n\n".join(f"{title(one)}: error {one.error:.3f}, {one.ratio:.2f} of dead reckoning.\n\n"
                       f"![map](robustness/{name})" for name, one in shown) or "None."


def simulated_text(buildings, shown):
    if not buildings:
        return ""
    return f"""
## Simulated buildings

{buildings_text(buildings)}

The map of the worst of each kind, of at most {PICTURES_OF_BUILDINGS} kinds:

{pictures_text(shown)}
"""


def driven_text(robots):
    if not robots:
        return ""
    return f"""
## Robots with wheels

A robot with wheels and a laser scanner drives through the building of each seed, whose walls are 8 to 30 cm thick here
(`tests/benchmarks/robot_log.cpp`). Its speed, scanner, lag, the scanner's place and the errors of its wheels are drawn;
the log has {", ".join(map(str, runs.PLAIN_BEAMS))} beams in turn. "Over": {OVER_ODOMETRY:g} times the error of dead
reckoning.

{robots_text(robots)}
"""


def captured_text(all_outcomes):
    """How little is known of the true paths of some flights."""
    poses = [runs.true_poses(log) for log in {one.run.log for one in all_outcomes} if runs.is_captured(log)]
    return f"\nEach flight of Vicon has {min(poses)} to {max(poses)} true poses, at its stops.\n" if poses else ""


def document(real, plain, pieces, buildings, robots, shown, report):
    """`shown`: [(file name, outcome)] of the pictures. `report`: circumstances and what is missing."""
    limits = Quarters(real)
    of_logs = [(name, one) for name, one in shown if one.run.log.files()]
    of_buildings = [(name, one) for name, one in shown if not one.run.log.files()]
    missing = f"\nLeft out, for lack of data: {'; '.join(report['missing'])}.\n" if report["missing"] else ""
    return f"""{page.head("Robustness", "benchmark-robustness", report)}{missing}
Each log and flight is mapped many times, each time changed otherwise: with 4 to 6 or 9 to 13 beams (some with
{runs.DENSE_BEAMS}), dead reckoning moved against the ranges by up to {runs.LEAD_MAX_S * 1e3:g} ms, the start cut off by
up to {runs.CUT_MAX:.0%}, mirrored, played backwards, with noise or systematic errors added to the dead reckoning. The
choices are drawn once, by a fixed seed. All runs have the default settings.

A run **breaks out** if its error exceeds {OVER_QUARTER:g} times the error that a quarter of the runs of its log and
numbers of beams stay below (or with fewer beams, or that is known to be attainable), or if it is worse than dead
reckoning by more than {TOLERANCE}. Errors are those of [evaluation](../evaluation.md): the mean translational error of
relations, the RMSE against a true path; where there is no truth, the number of distinct cells with returns over that of
dead reckoning (limit: {OVER_QUARTER_CELLS:g} times the best quarter). The reference of
{" and ".join(sorted(runs.WITHOUT_TRUTH))} is another program's estimate: there a run breaks out only where dead
reckoning is nearer to it by as much. "Ratio" is the error over that of dead reckoning in the same run.
A cut start leaves a part of the log, which may be easier. So a run is held against those that have all of its
relations, over these: each has a best quarter of its own. Where the reference is a path, or there is none, errors are
those over what the cut leaves.

A map that lays two corridors on each other covers fewer cells, so logs without truth
({", ".join(sorted(runs.IN_CELLS))}) do not show it.
"With truth" are neither these nor those with an estimate.
{captured_text(real)}
Intervals are Wilson's, as of independent runs; those of the rows in bold are a bootstrap over whole logs ({DRAWS}
draws, a fixed seed), because runs of one log are alike.

## Break-outs

{rates_table(real, limits)}

### By change

{kinds_table(real, limits)}

### Errors

{groups_table(real, limits)}

### Each break-out

{broken_lines(real, limits)}

## Logs as they are

Error (of relations with that of the angle), and its ratio to that of dead reckoning; the ratio alone where there is no
truth. **Bold**: over {OVER_ODOMETRY:g} times that of dead reckoning.

{plain_table(plain)}

## Short runs

{runs.PIECES} pieces of each log and flight, as recorded: {runs.PIECE_OF_LOG[0]:.0%} to {runs.PIECE_OF_LOG[1]:.0%} of a
log, {runs.PIECE_OF_FLIGHT[0]:.0%} to {runs.PIECE_OF_FLIGHT[1]:.0%} of a flight. They meet few places again. "Mean" is
the geometric one of the ratio to dead reckoning.

{pieces_table(pieces)}
{simulated_text(buildings, of_buildings)}{driven_text(robots)}
## Pictures

The map of each break-out, worst first.

{pictures_text(of_logs)}
"""
