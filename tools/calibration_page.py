# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/calibration.md: estimates of the calibration beside the truth, and what maps gain from them."""

import dataclasses
import math
import statistics
import textwrap

import benchmark_page as page
import wheels_by_relations

NONE = "–"
TELLING_SIGMAS = 2.0
WIDTH = 120  # of a line of text
WAYS = ("without", "with", "default")  # a map is made


@dataclasses.dataclass(frozen=True)
class Figure:
    heading: str
    setting: str
    form: str = ".3f"
    factor: float = 1.0

    def text(self, value):
        return format(self.factor * value, self.form)

    def found(self, value, sigma):
        digits = self.form.lstrip("+")
        return f"{self.text(value)} ± {self.factor * sigma:{digits}}"


AGE = Figure("age, s", "sensor.range_age_s")
FORWARD = Figure("forward scale", "sensor.odometry_forward_scale")
SIDEWAYS = Figure("sideways scale", "sensor.odometry_sideways_scale")
TURN = Figure("turn missed", "sensor.missed_yaw_per_radian", "+.3f")
PER_METRE = Figure("yaw, deg/m", "sensor.missed_yaw_per_metre_rad", "+.2f", math.degrees(1))
PER_SECOND = Figure("yaw, deg/s", "sensor.missed_yaw_per_second_rad", "+.2f", math.degrees(1))
KNOWN = [AGE, FORWARD, SIDEWAYS, TURN, PER_SECOND]  # of simulated flights


def of_setting(rows, figure):
    [row] = [row for row in rows if row["setting"] == figure.setting]
    return row


def flights_table(flights):
    def cell(flight, figure):
        known = of_setting(flight["figures"], figure)
        found = NONE if known["found"] is None else figure.found(known["found"], known["sigma"])
        return f"{figure.text(known['true'])} / {found}"

    def cells(flight):
        return [str(flight["seed"]), f"{flight['min_age_s']:.3f} to {flight['max_age_s']:.3f}",
                *(cell(flight, figure) for figure in KNOWN)]

    return page.table(["seed", "age within the flight, s", *(f"{figure.heading}: true / found" for figure in KNOWN)],
                      [cells(flight) for flight in flights])


def agreement(flights):
    """Agreement of estimated and true figures."""
    off = [(abs(known["found"] - known["true"]) / known["sigma"], figure.heading.split(",")[0], flight["seed"])
           for flight in flights for figure in KNOWN
           if (known := of_setting(flight["figures"], figure))["found"] is not None]
    if not off:
        return "No figure was observable."
    near = sum(sigmas <= TELLING_SIGMAS for sigmas, _, _ in off)
    sigmas, what, seed = max(off)
    return textwrap.fill(
        f"Of {len(off)} figures found, {near} lie within {TELLING_SIGMAS:g} standard deviations of the true one. "
        f"Farthest off is the {what} of seed {seed}, by {sigmas:.1f}.", WIDTH)


def offices_table(rows):
    figures = [[row[how][which]["rmse_m"] for which in ("live", "final") for how in WAYS]
               for row in rows]
    names = [row["input"] for row in rows]
    if figures:
        names.append("mean")
        figures.append([statistics.mean(column) for column in zip(*figures)])
    return page.table(["flight", "live, m, `--no-calibrate`:", "and the file:", "by default:",
                       "final, m, `--no-calibrate`:", "and the file:", "by default:"],
                      [[name, *(f"{value:.3f}" for value in values)] for name, values in zip(names, figures)])


def findings_table(rows):
    def cell(row, figure):
        finding = of_setting(row["calibration"]["findings"], figure)
        if finding["verdict"] == "not_observable":
            return NONE
        found = figure.found(finding["value"], finding["sigma"])
        return {"matters": f"**{found}**", "learnt": f"{found}, learnt"}.get(finding["verdict"], found)

    figures = [AGE, FORWARD, SIDEWAYS, TURN, PER_METRE, PER_SECOND]
    return page.table(["input", *(figure.heading for figure in figures), "it takes, s:"],
                      [[row["input"], *(cell(row, figure) for figure in figures), f"{row['seconds']:.0f}"]
                       for row in rows])


def judged_text(judged):
    """Of a final trajectory: relations in m and deg, or a flight's cells."""
    if "cells_20_cm" in judged:
        return f"{judged['cells_20_cm']} cells"
    return f"{judged['all']['translation_m']['mean']:.4f} m, {judged['all']['rotation_deg']['mean']:.3f} deg"


def gains_table(rows):
    def cells(row):
        check = row["calibration"]["check"]
        held_out = [NONE, NONE] if check is None else [f"{1e3 * check['held_out_before_m']:.1f} mm",
                                                        f"{1e3 * check['held_out_after_m']:.1f} mm"]
        return [row["input"], *held_out, *(judged_text(row[how]["final"]) for how in WAYS)]

    return page.table(["input", "held-out:", "with the file:", "map, `--no-calibrate`:", "and the file:",
                       "by default:"], [cells(row) for row in rows])


def wheels_text(rows):
    def cells(row):
        wheels = row["wheels"]
        return [row["input"], str(wheels["relations"]),
                *(NONE if wheels[key] is None else figure.found(*wheels[key])
                  for key, figure in (("scale", FORWARD), ("missed_yaw_per_metre_rad", PER_METRE)))]

    there = [row for row in rows if row["wheels"] is not None]
    if not there:
        return ""
    return f"""
The same wheels by relations that span less than {wheels_by_relations.LONGEST_S:g} s, without any map:

{page.table(["log", "relations:", "scale", "yaw, deg/m"], [cells(row) for row in there])}
"""


def ages_table(rows):
    ages = sorted({row["age_s"] for row in rows})
    texts = {(row["input"], row["age_s"]): judged_text(row["final"]) for row in rows}
    return page.table(["input", *(f"{age_s:g} s:" for age_s in ages)],
                      [[name, *(texts[name, age_s] for age_s in ages)]
                       for name in dict.fromkeys(row["input"] for row in rows)])


def tables(report):
    """All tables, for stdout and for the page."""
    logs = f"""
## Recorded inputs

Bold: matters, and is in the file. Learnt: estimated in every run.

{findings_table(report['logs'])}

What a map gains from the file, and by default. "Held-out": mean distance of held-out returns from the walls, by
`swiftlet calibrate`. "Map": mean errors by relations, or the distinct cells of 0.2 m that a flight's map covers, by
`swiftlet eval`. Cells shrink with the metre, too, so they compare ages but not scales.

{gains_table(report['logs'])}
{wheels_text(report['logs'])}
## The age alone

Final trajectories of the same inputs with `--no-calibrate` and `range_age_s` set:

{ages_table(report['ages'])}
""" if report["logs"] else ""
    return f"""## Simulated flights

`sim://office?seed=N`.
{agreement(report['flights'])}

{flights_table(report['flights'])}

## The same office with other sensors

The age of a reading when it is published is 20, 60, 100, 40 and 130 ms in place of 78 ms (`VehicleModel::range_age`);
the scales of flow and gyro are off by up to 10 and 5 % in place of 0.8 and 1 % (`scale_spread`, `turn_scale_spread`).
{agreement(report['others'])}

{flights_table(report['others'])}

## What simulated flights gain from the file

RMSE of the path against the true one, of the flights with the usual sensors. By default `swiftlet map` estimates age
and scales itself ([before every map](../calibration_evidence.md#before-every-map)); `--no-calibrate` switches that off.

{offices_table(report['offices'])}
{logs}"""


def document(report):
    return f"""{page.head("Calibration", "benchmark-calibration", report)}{page.left_out(report["missing"])}
The estimates of `swiftlet calibrate`, with their standard deviations, beside what is known. {NONE}: not observable.
[calibration_evidence.md](../calibration_evidence.md) describes the figures and the conclusions.

True figures of simulated flights: the age is that at which the simulator's own rangers, without noise, fit the readings
best along the true path, once for the whole flight and once for each eighth of it (least to greatest). A reading waits
for the log packet that carries it, so it is older than when it was published. Scales and yaw are regressions of
measured steps on true ones. The program is `tests/benchmarks/calibration_flights.cpp`.

{tables(report)}"""
