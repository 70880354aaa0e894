#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Manual pages, completions and documents name the options that --help names. command_pages_test.py SWIFTLET SWIFTLETD"""

import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = {"swiftlet": sys.argv[1], "swiftletd": sys.argv[2]}
OPTION = r"(?<![\w-])--?[a-z][a-z-]*"
# Options of other programs that the documents run.
FOREIGN = set("""--baseline --build --buildings --compare --compare-config --cpp --cpp-hpath --cpp-std --install --now --offline --only
    --patrol --pieces --plain --prefix --preset --python --robots --screen --seeds --target""".split())


def output_of(program, *arguments):
    return subprocess.run([PROGRAMS[program], *arguments], capture_output=True, text=True, check=True, timeout=60).stdout


def options_in_help(text):
    """Of the lines that begin with a name; what follows on them and below describes it."""
    names = set()
    for line in text.splitlines():
        if found := re.match(r"  (-[^ ]+)", line):
            names.update(found[1].split(","))
    return names


def help_of_all():
    """(program, command) and the options that help shows; command "" is the program itself."""
    shown = {(program, ""): options_in_help(output_of(program, "--help")) for program in PROGRAMS}
    commands = re.findall(r"^  ([a-z]+) ", output_of("swiftlet", "--help").split("Subcommands:")[1], re.MULTILINE)
    for command in commands:
        shown["swiftlet", command] = options_in_help(output_of("swiftlet", "help", command))
    return shown


HELP = help_of_all()
COMMANDS = [command for program, command in HELP if command]


def manual_sections(program):
    """Command, or "" for what stands above the commands, and its part of the page."""
    plain = re.sub(r"\\f[BIR]", "", output_of(program, "--print-page", "man")).replace("\\-", "-")
    parts = re.split(r"^\.SS \w+ (\w+).*\n", plain, flags=re.MULTILINE)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}


def completed(program, *words):
    """What bash offers for the last of the words."""
    script = output_of(program, "--print-page", "bash") + """
shift  # the name of the shell
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
compopt() { :; }  # works while completing only
""" + f'_{program}\n[[ ${{#COMPREPLY[@]}} == 0 ]] || printf "%s\\n" "${{COMPREPLY[@]}}"\n'
    shell = subprocess.run(["bash", "--norc", "-c", script, "bash", "", program, *words], capture_output=True, text=True,
                           check=True, timeout=60)
    if shell.stderr:
        raise AssertionError(shell.stderr)
    return shell.stdout.split()


class ManualTest(unittest.TestCase):
    def test_it_names_the_options_of_help_and_no_others(self):
        for (program, command), options in HELP.items():
            with self.subTest(program=program, command=command):
                section = manual_sections(program)[command]
                entries = re.findall(r"^\.TP\n(-.*)", section, re.MULTILINE)
                self.assertEqual({name for entry in entries for name in re.findall(OPTION, entry)}, options)

    def test_a_value_that_may_be_left_out_stands_whole(self):
        page = re.sub(r"\\f[BIR]", "", output_of("swiftletd", "--print-page", "man")).replace("\\-", "-")
        for entry in ("--view [ADDRESS:PORT]", "--commands [ADDRESS:PORT]", "--share [ADDRESS]", "--record [FILE]"):
            self.assertIn(f".TP\n{entry}\n", page)
        self.assertNotIn("Takes PORT", page)

    def test_a_sentence_ends_before_the_line_of_inputs(self):
        self.assertIn("without it a running swiftletd is.\n.br\n", output_of("swiftlet", "--print-page", "man"))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_roff_has_nothing_to_warn_of(self):
        for program in PROGRAMS:
            roff = subprocess.run(["groff", "-ww", "-man", "-Tutf8"], input=output_of(program, "--print-page", "man"),
                                  capture_output=True, text=True, timeout=60, check=True)
            self.assertEqual(roff.stderr, "")


class BashTest(unittest.TestCase):
    def test_it_offers_the_options_of_help_and_no_others(self):
        for (program, command), options in HELP.items():
            with self.subTest(program=program, command=command):
                self.assertEqual(set(completed(program, *[command] * bool(command), "-")), options)

    def test_it_offers_commands_and_choices_that_fit(self):
        self.assertEqual(completed("swiftlet", ""), COMMANDS)
        self.assertEqual(completed("swiftlet", "help", "la"), ["latency"])
        self.assertEqual(completed("swiftlet", "sim", "--world", "o"), ["office"])
        self.assertEqual(completed("swiftlet", "sim", "--missing-deck", ""), ["flow", "multiranger"])

    def test_it_leaves_files_to_the_shell(self):
        for words in (["map", ""], ["map", "-o", ""], ["map", "--config", ""], ["map", "map", ""]):
            self.assertEqual(completed("swiftlet", *words), [])
        self.assertEqual(completed("swiftletd", "--record", ""), [])

    def test_it_is_registered(self):
        for program in PROGRAMS:
            script = output_of(program, "--print-page", "bash") + f"complete -p {program}"
            shell = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, timeout=60, check=True)
            self.assertEqual(shell.stdout.split(), ["complete", "-o", "default", "-F", f"_{program}", program])


class ZshTest(unittest.TestCase):
    def test_it_offers_the_options_of_help_and_no_others(self):
        for program in PROGRAMS:
            parts = re.split(r"^        (\w+)\)\n", output_of(program, "--print-page", "zsh"), flags=re.MULTILINE)
            sections = {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}
            for command, section in sections.items():
                with self.subTest(program=program, command=command):
                    names = re.findall(r"^ +'[^']*'\{?([^'}]*)\}?'\[", section, re.MULTILINE)
                    self.assertEqual({name for group in names for name in group.split(",")}, HELP[program, command])


class DocumentsTest(unittest.TestCase):
    def test_options_behind_our_programs_are_theirs(self):
        call = re.compile(r"(?<![\w/.-])(swiftletd|swiftlet) ([^\n`|;#&>]*)")
        for page, text in self.pages():
            for program, rest in call.findall(text):
                command = rest.split(" ")[0]
                options = HELP.get((program, command), set()) | HELP[program, ""]
                if program == "swiftlet" and command not in COMMANDS:
                    continue  # a sentence
                for option in re.findall(OPTION + r"(?= |$|=)", rest):
                    self.assertIn(option, options, f"{page}: {program} {rest}")

    def test_options_in_the_text_are_of_one_of_them(self):
        known = set().union(*HELP.values()) | FOREIGN
        for page, text in self.pages():
            for option in re.findall(r"(?<![\w-])--[a-z][a-z-]*", text):
                self.assertIn(option, known, page)

    def test_security_names_every_port_that_is_listened_on_by_default(self):
        text = (ROOT / "SECURITY.md").read_text(encoding="utf-8")
        shown = "".join([output_of("swiftletd", "--help"), *(output_of("swiftlet", "help", name) for name in COMMANDS)])
        ports = set(re.findall(r"127\.0\.0\.1:(\d+)", shown))
        self.assertLessEqual({"8440", "8450", "19850"}, ports)
        for port in ports:
            self.assertIn(f"port {port} ", text)

    @staticmethod
    def pages():
        for path in [ROOT / "README.md", ROOT / "SECURITY.md", *sorted((ROOT / "docs").glob("*.md"))]:
            yield path.name, path.read_text(encoding="utf-8")


if __name__ == "__main__":
    sys.exit(unittest.main(argv=sys.argv[:1]))
