#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/live_runs.py asks for the figures that tools/live_page.py writes down."""

import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import live_page as page  # noqa: E402
import live_runs as runs  # noqa: E402
import mapped_runs  # noqa: E402

# Stands in for swiftlet: writes down how it was called.
PRETENDS = """#!/bin/sh
echo "$@" >> "$0.calls"
echo '{"input": "a flight", "live": {"moments": 7, "errors_m": [[0, 0.1]]}, "poses": []}'
"""


def live(moments=100, rms_m=0.3, **figures):
    return {"moments": moments, "rms_m": rms_m, "p95_m": 0.6, "max_m": 1.0, "share_off": 0.5, "across_p95_m": 0.4,
            "along_p95_m": None, "contacts": 3, "contacts_off": 2, "settled_p50_s": 12.5, "jumps": 1,
            "greatest_jump_m": 0.7, "map_rms_m": [0.1, 0.2, None], "errors_m": [[0.1 * i, 0.6] for i in range(moments)],
            "across_m": [0.4] * moments, "along_m": [], "settled_s": [12.5, 14.0], **figures}


class LivePage(unittest.TestCase):
    def test_a_flight_is_asked_for_its_figures_and_those_of_its_batches(self):
        with tempfile.TemporaryDirectory() as name:
            program = Path(name, "swiftlet")
            program.write_text(PRETENDS)
            program.chmod(0o755)
            with mock.patch.object(mapped_runs, "DATASETS", Path("/data")):
                row = runs.evaluate(runs.SIMULATED[1], program)
                runs.evaluate(runs.RECORDED[0], program, "my.toml")
            self.assertEqual(Path(f"{program}.calls").read_text().splitlines(),
                             ["eval --live sim://office?seed=2 --batch 20 --json -",
                              "eval --live /data/flights/olsson.pcap --batch 8 --config my.toml --json -"])
        self.assertEqual(row, {"world": "office", "is_recorded": False, "input": "a flight",
                               "live": {"moments": 7, "errors_m": [[0, 0.1]]}})

    def test_a_row_has_all_figures_and_marks_what_is_unknown(self):
        self.assertEqual(page.cells(live()), ["0.300", "0.60", "1.00", "50.0 %", "0.40", "–", "3", "2", "12.5", "1",
                                              "0.70", "0.10", "0.20", "–"])
        self.assertEqual(page.cells(live(contacts_off=0, settled_p50_s=None))[8], "–", "no contact was off")
        self.assertEqual(set(page.cells({"moments": 0})), {"–"})

    def test_flights_of_a_world_count_by_their_time(self):
        both = page.combined([live(300, 0.1, share_off=0.0), live(100, 0.5), {"moments": 0}])
        self.assertAlmostEqual(both["rms_m"], ((3 * 0.01 + 0.25) / 4) ** 0.5)
        self.assertAlmostEqual(both["share_off"], 0.125)
        self.assertEqual((both["contacts"], both["jumps"]), (6, 2))
        self.assertEqual(both["map_rms_m"][2], None)

    def test_their_quantiles_are_of_all_their_values(self):
        flights = [live(100, errors_m=[[0, 0.1]] * 100, across_m=[0.1] * 10, contacts_off=1, settled_s=[1.0]),
                   live(10, errors_m=[[0, 0.8]] * 10, across_m=[0.2] * 190, contacts_off=3, settled_s=[5.0, 6.0, 9.0])]
        both = page.combined(flights)
        self.assertEqual((both["p95_m"], both["across_p95_m"], both["along_p95_m"]), (0.8, 0.2, None))
        self.assertEqual(both["settled_p50_s"], 5.0)
        self.assertEqual(page.combined([live(contacts_off=0, settled_s=[])])["settled_p50_s"], None)

    def test_of_batches_without_a_known_place_nothing_is_known(self):
        none = {"moments": 0, "rms_m": None, "share_off": None, "live_rms_m": None, "live_share_off": None}
        table = page.batch_table([{"world": "maze", "batch": none}])
        self.assertEqual(table.splitlines()[-1], "| maze | 0 | – | – | – | – |")

    def test_the_page_tells_its_circumstances_and_shows_batches_beside_the_live_pose(self):
        batch = {"moments": 20, "rms_m": 0.2, "share_off": 0.1, "live_rms_m": 0.4, "live_share_off": 0.3}
        worse = {"moments": 60, "rms_m": 0.6, "share_off": 0.5, "live_rms_m": 0.4, "live_share_off": 0.3}
        none = {"moments": 0, "rms_m": 0.0, "share_off": 0.0, "live_rms_m": 0.0, "live_share_off": 0.0}
        rows = [{"world": "Hall", "is_recorded": True, "input": "hall.pcap", "live": live(), "batch": batch},
                *({"world": "maze", "is_recorded": False, "input": f"sim://maze?seed={seed}", "live": live(),
                   "batch": of} for seed, of in enumerate((batch, worse, none), 1))]
        text = page.document({"date": "2026-01-02", "commit": "abc", "machine": "a machine", "missing": ["b.pcap"],
                              "rows": rows})
        self.assertIn("`tools/benchmark-live --record` on 2026-01-02, commit abc", text)
        self.assertIn("have an easier sensor", text)
        self.assertIn("they are of all their\nmoments and contacts", text)
        self.assertIn("for lack of data: b.pcap.", text)
        self.assertIn("| Hall | 20 | 0.400 | 30.0 % | 0.200 | 10.0 % |", text)
        self.assertIn("| maze | 80 | 0.400 | 30.0 % | 0.529 | 40.0 % |", text)
        self.assertIn("| `sim://maze?seed=1` | 0.300 |", text)
        self.assertNotIn("| `hall.pcap` |", text)


if __name__ == "__main__":
    unittest.main()
