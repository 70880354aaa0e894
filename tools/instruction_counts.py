# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Instructions by stage of mapping, from a profile of callgrind, compared with a baseline."""

import json
import re

OWN = "swiftlet::"
# A stage is all calls of some functions, with what these call. Function and caller are in different source files, so no
# compiler inlines one into the other.
STAGES = {
    "decoding": ["LinkSampleSource::next()"],
    "frontend": ["Frontend::process("],
    "backend": ["Backend::add("],
    "final pass": ["Backend::finish("],
    "map": ["MapBuilder::settle("],
}
PARTS = {  # of backend and final pass
    "submaps": ["build_submap("],
    "loop detection": ["LoopDetector::find("],
    "pose graph": ["PoseGraphOptimizer::optimize("],
    "online refinement": ["OnlineRefinement::step("],
}
TOTAL = "all stages"
DEFAULT_TOLERANCE_PERCENT = 2.0


class Unusable(Exception):
    """Why a profile or a baseline cannot be used, in one line."""


def inclusive_costs(profile):
    """Cost of all calls of a function with what it calls, by its name. `profile`: lines of callgrind's output for one
    event."""
    names = {}
    costs = {}
    called = None
    lines = iter(profile)
    for line in lines:
        if named := re.match(r"c?fn=(\(\d+\))(?: (.+))?", line):
            number, name = named.groups()
            names.setdefault(number, name)
            if line.startswith("cfn="):
                called = names[number]
        elif line.startswith("calls="):
            costs[called] = costs.get(called, 0) + int(next(lines).split()[-1])
    return costs


def counts_of(profile):
    """Instructions by stage, by part and in total. Raises Unusable where a function of a stage was never called."""
    costs = {name: cost for name, cost in inclusive_costs(profile).items()
             if "{lambda" not in name and "[clone" not in name}  # inside what they are named after

    def count(stage, functions):
        found = [cost for start in functions for name, cost in costs.items() if name.startswith(OWN + start)]
        if len(found) != len(functions):
            raise Unusable(f"{stage}: one of {', '.join(OWN + name for name in functions)} was not called, or is "
                           f"ambiguous; tools/instruction_counts.py names the functions of each stage")
        return sum(found)

    counts = {stage: count(stage, functions) for stage, functions in {**STAGES, **PARTS}.items()}
    return {TOTAL: sum(counts[stage] for stage in STAGES), **counts}


def baseline(flight, build, packages, counts, tolerance_percent):
    """The content of a baseline file, as a dictionary. `build`: must be equal for figures to be comparable."""
    return {"written_by": "tools/benchmark-instructions --record", "flight": flight, "build": build,
            "packages": packages, "tolerance_percent": tolerance_percent, "instructions": counts}


def load_baseline(path):
    """Raises Unusable."""
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        fits = (set(kept["instructions"]) == {TOTAL, *STAGES, *PARTS} and isinstance(kept["build"], dict)
                and all(isinstance(count, int) and count > 0 for count in kept["instructions"].values())
                and isinstance(kept["packages"], dict) and kept["tolerance_percent"] > 0 and kept["flight"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise Unusable(f"{path}: no baseline ({error.__class__.__name__}: {error})") from error
    if not fits:
        raise Unusable(f"{path}: no baseline of these stages")
    return kept


def differences(kept, now):
    """The differences of two dictionaries as text."""
    return "; ".join(f"{key} {kept.get(key, 'nothing')}, now {now.get(key, 'nothing')}"
                     for key in sorted({*kept, *now}) if kept.get(key) != now.get(key))


def change_percent(kept, now):
    return 100.0 * (now / kept - 1.0)


def table(kept, now):
    """One line a stage; a part is indented."""
    lines = [f"{'':17}{'baseline':>16}{'now':>16}{'change':>10}"]
    lines += [f"{'  ' * (stage in PARTS) + stage:17}{kept[stage]:16,}{count:16,}"
              f"{change_percent(kept[stage], count):+9.2f}%" for stage, count in now.items()]
    return "\n".join(lines)


def beyond_tolerance(kept, now, tolerance_percent):
    """One line for each stage that needs more instructions than the tolerance allows, or fewer."""
    def line(stage):
        percent = change_percent(kept[stage], now[stage])
        return (f"{stage}: {'slower' if percent > 0 else 'faster'}: {now[stage]:,} instructions, baseline "
                f"{kept[stage]:,}: {percent:+.1f} %, tolerance {tolerance_percent:g} %")

    return [line(stage) for stage in now if abs(change_percent(kept[stage], now[stage])) > tolerance_percent]
