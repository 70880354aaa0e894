#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/troubleshooting.md quotes every message of the sources, and no other.

A message is any text of two words in core, daemon, firmware_link and tools that is not left out below. The page quotes
it in the first column of a table, in backticks, as source_messages.py reads it: with `…` where something is put in. A
new message fails this test until the page explains it, or until it is left out here with a reason.
"""

import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from source_messages import grouped, messages, texts  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "troubleshooting.md"

# Calls whose texts are promises between our own parts, or descriptions that --help shows.
SILENT_CALLS = {"SWIFTLET_CHECK", "static_assert", "add_option", "add_flag", "add_flag_callback", "add_subcommand",
                "WorldPlan"}

# Files without messages, by what they hold.
SILENT_FILES = {
    "names of a firmware's variables, and what a simulated vehicle's console prints":
        r"firmware_link/simulation/(log_table|param_table|platform|vehicle)\.cpp",
    "names and descriptions of simulated buildings": r"firmware_link/simulation/building_generator\.cpp",
    "descriptions of settings; docs/configuration.md has them":
        r"(core|daemon)/.*(_config|/configuration|/sensor_overrides)\.hpp|daemon/config/configuration_reference\.cpp",
    "manual pages and completions": r"daemon/manual/.*",
    "tables of figures": r"tools/evaluation/(eval|live)_report\.cpp|tools/latency/latency_(table|picture)\.cpp",
    "words beside a picture's colours": r"core/mapping/picture/map_legend\.cpp",
    "the head of a file": r"daemon/outputs/(places_file|ros_map)\.cpp",
}

# Single texts, by why nobody has to act on them.
SILENT_TEXTS = {
    "never shown: the caller waits, or the input is over": """
        no packet
        no sample yet
        …: end of the capture
        …: end of the log
        end of the laser log
        end of the table of samples
        end of the table of log blocks
        the writer has closed the FIFO
        the simulated flight is over
        ends early
        too few samples""",
    "never shown: counted as solver failures, which are a message of their own": """
        pose graph: no elimination order found (out of memory?)
        pose graph: symbolic analysis failed (out of memory?)
        pose graph underconstrained near pose …: its constraints leave a direction open
        pose graph: factorisation failed (out of memory?)
        pose graph: solve failed (out of memory?)
        chain of poses underconstrained near pose …: its constraints leave a direction open
        pose graph diverged: poses are no longer finite
        the joint problem of poses, walls and systematic errors has no solution
        the joint problem of poses, walls and systematic errors diverged
        the systematic errors of the sensors have no finite estimate""",
    "never shown: requests are made by ourselves": """
        a packet of … bytes; CRTP takes 1 to 31
        null packets are the link's own; send requests only""",
    "names that stand within messages": """
        dead reckoning
        pose graph
        other yaw noise
        floor known
        age of the ranges
        metres moved per metre measured, forward
        the same, sideways
        yaw missed per metre forward
        share of each turn missed
        yaw missed per second
        scale of the odometry
        missed yaw
        by the input itself:
        true or false
        a whole number
        a whole number, not negative
        a text in quotes
        locked memory
        udpm://239.255.76.67:7667?ttl=0
        WORLD?seed=N&laps=N
        sim://office?seed=1
        replay:flight.pcap
        follow:flight.pcap
        a path (.pcap, .csv or .clf, also in gzip)
        seed, laps, fault, without
        # swiftlet samples 1
        the line of the sensor
        the dead reckoning
        the line of the bearings
        the number of beams
        more than 64
        what follows the last column
        what follows the range age
        Bitcraze Crazyflie
        from byte
        … and in … more places
        … deg off on average, not …""",
    "names of doctor's checks, and what it reads and sends": """
        dongle firmware
        in use
        usb power
        lcm route
        lcm self-test
        lcm buffers
        vehicle firmware
        flow deck
        bus … device …
        another program
        Max realtime priority
        Max locked memory
        swiftlet doctor""",
    "doctor's findings in good order, or of what need not be checked": """
        no dongle
        no cable
        no link
        none here
        usb:// needs none
        … needs none
        recordings and simulations need none
        the LCM URL is not udpm://
        this machine only
        ttl …: leaves this machine
        an ordinary kernel
        the kernel may put the device to sleep while no program uses it
        swiftlet: looking, this takes some seconds
        : nothing stops a flight""",
    "progress and results": """
        swiftlet: note: …
        … (until stopped by a signal)
        … at … times its pace
        …, publishing on …
        recording to …
        stopped by a signal: the map is finished first; a second signal would lose it
        log file reopened
        … samples, … keyframes, … loop closures (… of them dropped)
        … samples, … keyframes, … loop closures (… of them dropped), … input problems
        … keyframes, … closures: …
        … samples (… Hz), … keyframes, … submaps, … closures, … tiles…
        …: … samples, … keyframes, … closures, … packets missing
        ; link … % acknowledged, … packets/s, round trip … ms…
        … samples, … Hz, … gaps, …
        recorded … packets, …: …
        the recording goes on in …
        error before correction … m, live … m, after … m (RMSE of … positions, aligned)
        loop … between keyframes … and …: … m apart, score …
        frontend: batches rolled back
        listening on …; Ctrl-C ends
        …: open … in a browser; Ctrl-C ends
        the live map: open … in a browser
        commands are taken on …
        map saved: …
        place … marked
        a new map: this run ends
        sent to …; the log of swiftletd says what became of it
        file: …: for --config of swiftlet map and swiftletd
        kind of building: …
        …: … samples in … s; … m forward and back, … m sideways, … turns
        …  held-out returns lie … mm off the walls, with what matters set … mm
        set now
        no live link: a recording or a simulation
        first pose
        input ended: the final pass runs
        finished: the map is final
        loop … closed: keyframe … meets …, score …
        client … connected
        client … gone
        vehicle on air
        vehicle silent
        took off
        flight interrupted
        listening on udp://…, world …, seed …; type help for instructions""",
    "the text of Python's help": """
        What cannot be done, in one line: what, where, and what to do.""",
    "a header of the web server":
        "\ndefault-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "help and manual pages": """
        swiftletd: maps a building live from four range beams, and publishes over LCM
        swiftlet(1), systemctl(1), /usr/share/doc/swiftlet
        2D SLAM for four range beams
        swiftlet map flight.pcap -o out
        swiftlet record radio://0/80/2M/E7E7E7E7E7 -o flight.pcap
        swiftlet eval out/trajectory.tum truth.tum
        swiftlet calibrate flight.pcap
        swiftlet convert flight.pcap flight.csv
        swiftlet tell mark-place kitchen""",
}


def is_silent(name, group):
    """Calls without messages, and findings of doctor in good order."""
    return name in SILENT_CALLS or (group[:2] == ["Mark", "::"] and group[2] in ("kOk", "kSkipped"))


def is_silent_file(path):
    return any(re.fullmatch(pattern, path) for pattern in SILENT_FILES.values())


def silent_texts():
    return {line.strip() for lines in SILENT_TEXTS.values() for line in lines.split("\n")[1:]}


def quoted_on(page):
    """{message: line} of the first columns."""
    quotes = {}
    for number, line in enumerate(page.split("\n"), 1):
        if line.startswith("| `"):
            for quote in re.findall(r"`([^`]+)`", line.split(" | ")[0]):
                quotes.setdefault(quote, number)
    return quotes


def differences(found, left_out, quotes):
    """What the page lacks, what it has of no source, and what is left out but not there."""
    missing = [f"{places[0]}: `{text}`" for text, places in found.items() if text not in left_out | quotes.keys()]
    unknown = [f"{PAGE.name}:{line}: `{quote}`" for quote, line in quotes.items() if quote not in found]
    stale = [text for text in left_out if text not in found]
    return missing, unknown, stale


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = messages(ROOT, is_silent, is_silent_file)
        cls.missing, cls.unknown, cls.stale = differences(cls.found, silent_texts(),
                                                          quoted_on(PAGE.read_text(encoding="utf-8")))

    def test_it_has_every_message_of_the_sources(self):
        self.assertGreater(len(self.found), 300)
        if self.missing:
            self.fail("\n".join(["explain in docs/troubleshooting.md, or leave out above:", *self.missing]))

    def test_it_has_no_message_that_no_source_has(self):
        if self.unknown:
            self.fail("\n".join(["no source has, or has otherwise:", *self.unknown]))

    def test_what_is_left_out_is_there(self):
        if self.stale:
            self.fail("\n".join(["left out above, but no source has:", *self.stale]))

    def test_every_message_has_a_meaning_and_a_remedy(self):
        for number, line in enumerate(PAGE.read_text(encoding="utf-8").split("\n"), 1):
            if line.startswith("| `"):
                cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")]
                self.assertEqual(len(cells), 3, f"{PAGE.name}:{number}")
                self.assertTrue(all(cells), f"{PAGE.name}:{number}")


class ReaderTest(unittest.TestCase):
    SOURCE = """
        // "no message of a comment"
        #include "no/file of an include.hpp"
        Error not_written(const std::string& path) {
          return {ErrorCode::kOutOfSpace, path + ": was not written: " +
                                              std::string("to the disk ") + reason() + "; "
                                              "make room"};
        }
        void tell(char c) {
          SWIFTLET_CHECK(c != '"', "a promise between parts");
          spdlog::warn("queue of {}: full, {:.1f} % refused", name, share);
          note(fmt::format("unknown {} \\"{}\\"", is_key ? "sort of key" : "sort of section", name) + " in " + path);
          text += "; and so on";
          check({Mark::kOk, "battery check", "in good order"});
          check({Mark::kProblem, "battery check", count < 1'000 ? "quite empty" : "word"});
        }"""

    def test_texts_are_joined_with_gaps(self):
        found = {text for _, text in texts(grouped(self.SOURCE), is_silent) if " " in text}
        self.assertEqual(found, {
            "…: was not written: to the disk …; make room", "queue of …: full, … % refused", 'unknown … "…" in …',
            "sort of key", "sort of section", "…; and so on", "battery check", "quite empty"})

    def test_lines_are_those_of_the_source(self):
        self.assertIn((11, "queue of …: full, … % refused"), list(texts(grouped(self.SOURCE), is_silent)))

    def test_a_changed_message_is_noticed_on_both_sides(self):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "daemon" / "a.cpp"
            source.parent.mkdir()
            page = "| `log file …: …` | It cannot be written. | Name another. |\n"
            source.write_text('Error e{kNotFound, "log file " + path + ": " + why};', encoding="utf-8")
            self.assertEqual(differences(messages(folder, is_silent), set(), quoted_on(page)), ([], [], []))
            source.write_text('Error e{kNotFound, "the log file " + path + ": " + why};', encoding="utf-8")
            self.assertEqual(differences(messages(folder, is_silent), set(), quoted_on(page)),
                             (["daemon/a.cpp:1: `the log file …: …`"], ["troubleshooting.md:1: `log file …: …`"], []))


if __name__ == "__main__":
    sys.exit(unittest.main())
