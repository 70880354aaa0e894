#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs swiftletd as its users do. swiftletd_test.py CASE SWIFTLETD CONSUMER DATASETS_BESIDE

CASE is the name of one of the functions below. Exit code 77: skipped, the last line says why.
"""

import json
import math
import os
import pty
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

URL = "udpm://239.255.76.67:7667?ttl=0"
TIMEOUT_S = 300
LISTENS_WITHIN_S = 30
NOT_LISTENING = 3
# A network of its own, so that nothing else is heard and nothing leaves the machine.
NETWORK = ["unshare", "--user", "--map-root-user", "--net", "--", "sh", "-c",
           'ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"', "sh"]


class Skipped(Exception):
    """What a case needs is not here."""


class Failed(Exception):
    """The daemon did something else than it should."""


def expect(condition, why):
    if not condition:
        raise Failed(why)


class Bench:
    def __init__(self, swiftletd, consumer, datasets_beside, folder):
        self.swiftletd, self.consumer, self.folder = swiftletd, consumer, Path(folder)
        self.datasets = Path(os.environ.get("SWIFTLET_DATASETS", datasets_beside))

    def dataset(self, name):
        path = self.datasets / name
        if not path.exists():
            raise Skipped(f"{path} is not there")
        return path

    def daemon(self, *arguments):
        """To its end, publishing nowhere: (exit code, lines on stderr)."""
        url = f"file://{self.folder}/run.lcm?mode=w"
        done = subprocess.run([self.swiftletd, "--lcm-url", url, *map(str, arguments)], stderr=subprocess.PIPE,
                              cwd=self.folder, timeout=TIMEOUT_S, check=False)
        return done.returncode, done.stderr.decode().splitlines()


def in_own_network(command):
    allowed = subprocess.run([*NETWORK, "true"], capture_output=True, check=False)
    if allowed.returncode != 0:
        raise Skipped("network namespaces are not permitted here: " + allowed.stderr.decode().strip())
    limit_s = TIMEOUT_S + 30
    with subprocess.Popen([*NETWORK, *command], start_new_session=True) as process:
        try:
            return process.wait(timeout=limit_s)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise Failed(f"not over after {limit_s} s") from None


def rebuild_over_multicast(bench, uri, rate):
    """Daemon and consumer in two processes; both maps must be the same bytes."""
    out, rebuilt, said = bench.folder / "out", bench.folder / "rebuilt.pgm", bench.folder / "consumer.txt"
    script = bench.folder / "both.sh"
    script.write_text(
        f"'{bench.consumer}' '{URL}' '{rebuilt}' {TIMEOUT_S} > '{said}' 2>&1 &\n"
        "consumer=$!\n"
        "trap 'kill $consumer 2> /dev/null' EXIT\n"
        f"looks_left={20 * LISTENS_WITHIN_S}\n"
        f"until grep -q listening '{said}'; do\n"
        f"  [ $((looks_left -= 1)) -gt 0 ] && kill -0 $consumer 2> /dev/null || exit {NOT_LISTENING}\n"
        "  sleep 0.05\n"
        "done\n"
        f"'{bench.swiftletd}' --input '{uri}' --lcm-url '{URL}' --rate {rate} -o '{out}' || exit 1\n"
        "wait $consumer\n", encoding="utf-8")
    code = in_own_network(["sh", str(script)])
    last_said = (said.read_text(encoding="utf-8").splitlines() or ["nothing"])[-1]
    expect(code != NOT_LISTENING, f"no consumer listened within {LISTENS_WITHIN_S} s; it said: {last_said}")
    expect(code == 0, f"the daemon or its consumer failed; the consumer said: {last_said}")
    expect(rebuilt.read_bytes() == (out / "map.pgm").read_bytes(), "the consumer's map is not the daemon's map.pgm")
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    expect(report, "the report is empty")


def consumer_rebuilds_the_map_of_a_simulated_flight(bench):
    rebuild_over_multicast(bench, "sim://loop?seed=1", 100)


def consumer_rebuilds_the_map_of_a_captured_flight(bench):
    rebuild_over_multicast(bench, f"replay:{bench.dataset('flights/olsson.pcap')}", 20)


def threads_come_to_the_same_trajectory_every_time(bench):
    runs = []
    for rate in (200, 1000):
        out = bench.folder / f"rate{rate}"
        code, lines = bench.daemon("--input", "sim://loop?seed=2", "--rate", rate, "-o", out)
        expect(code == 0, lines)
        runs.append(((out / "trajectory.tum").read_bytes(), (out / "map.pgm").read_bytes()))
    expect(runs[0] == runs[1], "the pace of the replay changed the result")


def turns_deg(tum_file):
    """From each of its poses to the next, none over half a turn."""
    yaws = [2 * math.atan2(z, w) for z, w in ((float(t) for t in line.split()[6:8])
                                              for line in tum_file.read_text(encoding="utf-8").splitlines())]
    return [abs(math.degrees(math.remainder(after - before, math.tau))) for before, after in zip(yaws, yaws[1:])]


def a_heading_that_leaps_stays_in_the_dead_reckoning_alone(bench):
    out = bench.folder / "out"
    code, lines = bench.daemon("sim://loop?seed=2&fault=jump@60:30", "--rate", 1000, "-o", out)
    expect(code == 0, f"exit code {code}: {lines}")
    expect(any("heading" in line for line in lines), f"no word of the leap: {lines}")
    for name, least_deg, most_deg in (("odometry", 20, 40), ("trajectory", 0, 20)):
        turn_deg = max(turns_deg(out / f"{name}.tum"))
        expect(least_deg <= turn_deg <= most_deg, f"{name}.tum turns by {turn_deg:.1f} deg between two samples")


def wait_for_words(daemon, words):
    """Until it says them on stderr."""
    said = daemon.stderr.readline()
    while words not in said:
        expect(said, "the daemon ended by itself")
        said = daemon.stderr.readline()


def wait_for_poses(bench, daemon):
    """Until some are in its log of messages."""
    until = time.monotonic() + 60.0
    while b"SWIFTLET_POSE" not in (bench.folder / "run.lcm").read_bytes():
        expect(daemon.poll() is None and time.monotonic() < until, "no pose was published")
        time.sleep(0.01)


def stop_with(bench, number):
    out = bench.folder / "out"
    with subprocess.Popen([bench.swiftletd, "--input", "sim://office?seed=1", "--rate", "20", "-o", str(out),
                           "--lcm-url", f"file://{bench.folder}/run.lcm?mode=w"], stderr=subprocess.PIPE) as daemon:
        wait_for_words(daemon, b"publishing on")
        wait_for_poses(bench, daemon)
        daemon.send_signal(number)
        _, said = daemon.communicate(timeout=60)
    expect(daemon.returncode == 0, said.decode())
    expect(b"stopped by a signal" in said, said.decode())
    for name in ("map.pgm", "map.png", "trajectory.tum", "report.json"):
        expect((out / name).stat().st_size > 0, name + " is empty")


def sigint_ends_the_run_with_its_outputs(bench):
    stop_with(bench, signal.SIGINT)


def sigterm_ends_the_run_with_its_outputs(bench):
    stop_with(bench, signal.SIGTERM)


def sighup_ends_the_run_with_its_outputs(bench):
    stop_with(bench, signal.SIGHUP)


def threads_that_take_sigint(pid):
    """The names of those that do not block it."""
    takers = []
    for thread in Path(f"/proc/{pid}/task").iterdir():
        status = dict(line.split(":\t", 1) for line in (thread / "status").read_text().splitlines() if ":\t" in line)
        if not int(status["SigBlk"], 16) >> (signal.SIGINT - 1) & 1:
            takers.append(status["Name"])
    return takers


def sigint_ends_a_wait_for_the_dongle(bench):
    """The USB library's own thread must not take the signal."""
    with subprocess.Popen([bench.swiftletd, "--input", "radio://NOSUCHSERIAL/80", "--no-record", "--no-output",
                           "--lcm-url", f"file://{bench.folder}/run.lcm?mode=w"], stderr=subprocess.PIPE) as daemon:
        wait_for_words(daemon, b"plug it in")
        takers = threads_that_take_sigint(daemon.pid)
        daemon.send_signal(signal.SIGINT)
        _, said = daemon.communicate(timeout=60)
    expect(takers == ["signals"], f"these threads take SIGINT: {takers}")
    expect(daemon.returncode == 2 and b"stopped by a signal" in said, f"{daemon.returncode}: {said.decode()}")


def a_log_that_nobody_reads_any_more_costs_no_outputs(bench):
    out = bench.folder / "out"
    with subprocess.Popen([bench.swiftletd, "--input", "sim://office?seed=1", "--rate", "20", "-o", str(out),
                           "--lcm-url", f"file://{bench.folder}/run.lcm?mode=w"], stderr=subprocess.PIPE) as daemon:
        wait_for_words(daemon, b"publishing on")
        daemon.stderr.close()
        wait_for_poses(bench, daemon)
        daemon.send_signal(signal.SIGINT)
        expect(daemon.wait(timeout=60) == 0, f"exit code {daemon.returncode}")
    expect((out / "map.pgm").stat().st_size > 0, "no map")


def bad_input_gets_one_line_and_exit_code_2(bench):
    config = bench.folder / "bad.toml"
    config.write_text("[map]\nresolution_m = 0.05\nresolutoin_m = 0.1\n", encoding="utf-8")
    garbage = bench.folder / "garbage.pcap"
    garbage.write_bytes(b"no capture at all" * 10)
    for arguments, part in [
            (["--input", bench.folder / "missing.pcap"], "missing.pcap"),
            (["--input", garbage], "garbage.pcap"),
            (["--input", "sim://nowhere"], "nowhere"),
            (["--input", "sim://loop", "--config", bench.folder / "missing.toml"], "missing.toml"),
            (["--input", "sim://loop", "--config", config], "bad.toml:3"),
            (["--input", "sim://loop", "--config", bench.folder], "is a directory; name the TOML file"),
            (["--input", "sim://loop", "--config", ""], "--config: names no file"),
            (["--input", "sim://loop", "--log-file", ""], "--log-file: names no file"),
            (["--input", "sim://loop", "--rate", "-1"], "--rate"),
            (["--input", "sim://loop", "--rate", "nan"], "--rate: nan is no number"),
            (["--input", "sim://loop", "--rate", "inf"], "--rate: inf is no number"),
            (["--input", "sim://loop", "-o", ""], "-o names no directory"),
            (["--input", "sim://loop", "-o", "/proc/nowhere"], "/proc/nowhere"),
            ([], "for example: swiftletd radio://0/80/2M/E7E7E7E7E7"),
            (["--share", "--view", "--commands"], "no INPUT is named"),
            (["--view", "127.0.0.1:8441", "--commands", "127.0.0.1:8451", "--record", "flight.pcap"], "no INPUT is named"),
            (["--record", "udp://127.0.0.1:1"], "taken for the file of --record; name INPUT before --record"),
            (["--share", "udp://127.0.0.1:1"], "taken for the address of --share; name INPUT before --share"),
            (["--view", "flight.pcap"], "taken for the address of --view; name INPUT before --view"),
            (["--commands", "sim://loop"], "taken for the address of --commands; name INPUT before --commands")]:
        code, lines = bench.daemon(*arguments)
        expect(code == 2, f"{arguments}: exit code {code}")
        expect(len(lines) == 1 and part in lines[0], f"{arguments}: {lines}")
    for url, part in (("mqtt://here", "mqtt://here"), ("file://run.lcm", "write 'file://run.lcm?mode=w'")):
        done = subprocess.run([bench.swiftletd, "--input", "sim://loop", "--lcm-url", url],
                              capture_output=True, check=False, text=True)
        expect(done.returncode == 2 and part in done.stderr, done.stderr)


def without_a_directory_each_flight_gets_a_folder(bench):
    for _ in range(2):
        code, lines = bench.daemon("sim://loop?seed=2", "--rate", 1000)
        expect(code == 0, lines)
    folders = sorted((bench.folder / "flights").iterdir())
    expect(len(folders) == 2 and all("_loop" in folder.name for folder in folders), folders)
    for folder in folders:
        expect((folder / "thumbnail.png").stat().st_size > 0, "no thumbnail")
    code, lines = bench.daemon("sim://loop?seed=2", "--rate", 1000, "-o", folders[0])
    expect(code == 0 and any("its files were replaced" in line for line in lines), lines)
    code, lines = bench.daemon("sim://loop?seed=2", "--rate", 1000, "--no-output")
    expect(code == 0 and len(list((bench.folder / "flights").iterdir())) == 2, lines)


def a_second_run_into_the_same_directory_is_refused(bench):
    out = bench.folder / "out"
    with subprocess.Popen([bench.swiftletd, "sim://office?seed=1", "--rate", "5", "-o", str(out),
                           "--lcm-url", "memq://"], stderr=subprocess.PIPE, text=True) as daemon:
        expect("publishing on" in daemon.stderr.readline(), "it did not begin")
        code, lines = bench.daemon("sim://loop", "-o", out)
        expect(code == 2 and len(lines) == 1 and "out: another run writes there" in lines[0], lines)
        daemon.send_signal(signal.SIGINT)
        daemon.communicate(timeout=60)
    expect(daemon.returncode == 0 and (out / "map.png").exists(), "the first one lost its outputs")


def a_terminal_without_wish_for_colours_gets_none(bench):
    for refused, expected in (("", True), ("1", False)):
        mine, theirs = pty.openpty()
        environment = {**os.environ, "NO_COLOR": refused}
        daemon = subprocess.run([bench.swiftletd, "sim://loop", "--rate", "1000", "--lcm-url", "memq://", "--no-output"],
                                stderr=theirs, env=environment, timeout=TIMEOUT_S, check=False)
        os.close(theirs)
        said = os.read(mine, 4096)
        os.close(mine)
        expect(daemon.returncode == 0 and (b"\x1b[" in said) == expected, said)


def without_a_multicast_route_it_says_so_in_one_line(bench):
    alone = ["unshare", "--user", "--map-root-user", "--net", "--"]
    if subprocess.run([*alone, "true"], capture_output=True, check=False).returncode != 0:
        raise Skipped("network namespaces are not permitted here")
    done = subprocess.run([*alone, bench.swiftletd, "sim://loop", "--lcm-url", URL], cwd=bench.folder,
                          capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    lines = done.stderr.splitlines()
    expect(done.returncode == 2 and len(lines) == 1, done.stderr)
    for part in ("no route to 239.255.76.67", "sudo ip link set lo up multicast on", "sudo ip route add 224.0.0.0/4 dev lo"):
        expect(part in lines[0], lines)


def an_absent_server_of_messages_is_told_of_once(bench):
    done = subprocess.run([bench.swiftletd, "sim://loop", "--rate", "1000", "--lcm-url", "tcpq://127.0.0.1:1",
                           "--no-output"], capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    lines = done.stderr.splitlines()
    expect(done.returncode == 0 and len(lines) < 20, f"{len(lines)} lines: {lines[:20]}")
    expect(sum("start its server" in line for line in lines) == 1, lines)


def a_full_disk_is_told_of_at_the_end(bench):
    url = f"file://{bench.folder}/run.lcm?mode=w"
    done = subprocess.run([bench.swiftletd, "sim://loop", "--rate", "1000", "--lcm-url", url, "--no-output"],
                          capture_output=True, text=True, timeout=TIMEOUT_S, check=False, restore_signals=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
    said = [line for line in done.stderr.splitlines() if "the LCM log is not complete: 4096 of" in line]
    expect(done.returncode == 2 and len(said) == 1, f"{done.returncode}: {done.stderr}")


def a_truncated_capture_is_used_up_to_the_damage(bench):
    whole = bench.dataset("flights/olsson.pcap").read_bytes()
    cut = bench.folder / "cut.pcap"
    cut.write_bytes(whole[:len(whole) // 10])
    out = bench.folder / "out"
    code, lines = bench.daemon("--input", cut, "--rate", 1000, "-o", out)
    expect(code == 2, f"exit code {code}")
    expect(sum("cut.pcap" in line and line.startswith("swiftletd: ") for line in lines) == 1, lines)
    expect((out / "trajectory.tum").stat().st_size > 0, "what came before the damage is lost")


def killed_while_recording_it_loses_no_more_than_a_second(bench):
    recording = bench.folder / "flight.pcap"
    command = [bench.swiftletd, "--input", "sim://office?seed=7", "--record", str(recording), "--no-output",
               "--lcm-url", f"file://{bench.folder}/run.lcm?mode=w"]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as daemon:
        until = time.monotonic() + 60.0
        while not recording.exists() or recording.stat().st_size == 24:  # the header: nothing heard yet
            expect(time.monotonic() < until, "nothing was recorded")
            time.sleep(0.01)
        time.sleep(4.0)
        daemon.kill()
        daemon.wait()
    code, lines = bench.daemon("--input", recording, "--rate", 1000, "-o", bench.folder / "kept")
    expect(code == 0, lines)
    kept = (bench.folder / "kept" / "trajectory.tum").read_text(encoding="utf-8").splitlines()
    expect(len(kept) >= 30, f"{len(kept)} samples of 4 s at 10 Hz")  # 1 s less, and not a tenth more


def sighup_opens_the_log_file_anew(bench):
    log, moved = bench.folder / "swiftletd.log", bench.folder / "swiftletd.log.1"
    with subprocess.Popen([bench.swiftletd, "--input", "sim://office?seed=1", "--rate", "5", "--log-file", str(log), "--no-output",
                           "--lcm-url", f"file://{bench.folder}/run.lcm?mode=w"], stderr=subprocess.PIPE) as daemon:
        until = time.monotonic() + 60.0
        while not log.exists() or "publishing on" not in log.read_text(encoding="utf-8"):
            expect(daemon.poll() is None and time.monotonic() < until, "nothing was logged")
            time.sleep(0.01)
        log.rename(moved)
        daemon.send_signal(signal.SIGHUP)
        while not log.exists():
            expect(daemon.poll() is None and time.monotonic() < until, "no new log file")
            time.sleep(0.01)
        wait_for_poses(bench, daemon)
        daemon.send_signal(signal.SIGINT)
        _, said = daemon.communicate(timeout=60)
    expect(daemon.returncode == 0 and not said, f"{daemon.returncode}: {said.decode()}")
    expect("stopped by a signal" in log.read_text(encoding="utf-8"), "the log went on in the old file")


def what_real_time_needs_and_may_not_have_is_one_warning(bench):
    config = bench.folder / "realtime.toml"
    config.write_text("[realtime]\nradio_priority = 70\nfrontend_priority = 60\npublisher_priority = 50\n"
                      "publisher_cpu = 1023\nlock_memory = true\n", encoding="utf-8")
    no_privilege = ["unshare", "--user", "--", "sh", "-c", 'ulimit -r 0 -l 64; exec "$@"', "sh"]
    if subprocess.run([*no_privilege, "true"], capture_output=True, check=False).returncode != 0:
        raise Skipped("user namespaces are not permitted here")
    done = subprocess.run([*no_privilege, bench.swiftletd, "--input", "sim://loop?seed=1", "--rate", "1000", "--config",
                           str(config), "--no-output", "--lcm-url", f"file://{bench.folder}/run.lcm?mode=w"],
                          stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=False)
    lines = [line for line in done.stderr.decode().splitlines() if "real time" in line]
    expect(done.returncode == 0 and len(lines) == 1, done.stderr.decode())
    for part in ("locked memory", "radio: SCHED_FIFO priority 70", "frontend: ", "publisher: processor 1023"):
        expect(part in lines[0], lines[0])


def an_existing_recording_is_not_overwritten(bench):
    recording = bench.folder / "flight.pcap"
    recording.write_text("mine", encoding="utf-8")
    code, lines = bench.daemon("--input", "sim://loop", "--record", recording)
    expect(code == 2 and len(lines) == 1 and "flight.pcap: is there already" in lines[0], lines)
    expect(recording.read_text(encoding="utf-8") == "mine", "it was written to")
    code, lines = bench.daemon("--input", recording, "--record", bench.folder / "copy.pcap")
    expect(code == 2 and len(lines) == 1 and "is no vehicle" in lines[0], lines)


def a_recording_replays_to_the_same_map_and_needs_to_be_asked_for_in_a_simulation(bench):
    state = bench.folder / "state"
    os.environ["STATE_DIRECTORY"] = str(state)
    live = ["--input", "sim://loop?seed=2", "--rate", 1000, "-o", bench.folder / "live"]
    code, lines = bench.daemon(*live)
    expect(code == 0 and not state.exists(), lines)
    code, lines = bench.daemon(*live, "--record")
    expect(code == 0, lines)
    (recording,) = state.glob("swiftlet_*.pcap")
    expect(any(f"recording to {recording}" in line for line in lines), lines)
    code, lines = bench.daemon("--input", recording, "--rate", 1000, "-o", bench.folder / "again")
    expect(code == 0, lines)
    for name in ("trajectory.tum", "map.pgm"):
        same = (bench.folder / "live" / name).read_bytes() == (bench.folder / "again" / name).read_bytes()
        expect(same, name + " differs")


def main():
    case, swiftletd, consumer, datasets_beside = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        try:
            globals()[case](Bench(swiftletd, consumer, datasets_beside, folder))
        except Skipped as why:
            print("SKIPPED:", why)
            return 77
        except Failed as why:
            print("FAILED:", why)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
