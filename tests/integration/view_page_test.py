#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The page of `swiftlet view` in a browser without a screen. view_page_test.py SWIFTLET SWIFTLETD

Runs in a network of its own, so that nothing else is received. Exit code 77: skipped, the last line says why.
"""

import http.client
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from xml.etree import ElementTree

INSIDE = "--inside"
NETWORK = ["unshare", "--user", "--map-root-user", "--net", "--", "sh", "-c",
           'ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"', "sh"]
LCM_URL = "udpm://239.255.76.67:7667?ttl=0"
FLIGHT = "sim://loop?seed=1"
PATIENCE_S = 60
SKIPPED = 77
MEASURE_LINES = 7  # width and height, their ends, the scale bar
DRIVER = "/usr/bin/chromedriver"
SAVED_FILE = """const [format, done] = arguments;
swiftletPage.save.file(format).then((file) => file.arrayBuffer()).then((bytes) => done([...new Uint8Array(bytes)]));"""
# Of PNG, SVG, the SVG of walls alone, and PDF.
SAVED_FILES = """const done = arguments[0], save = swiftletPage.save, bytes = async (format, content) => {
  save.content.value = content;
  return [...new Uint8Array(await (await save.file(format)).arrayBuffer())];
};
(async () => done([await bytes('PNG', 'all'), await bytes('SVG', 'all'), await bytes('SVG', 'plan'), await bytes('PDF', 'all')]))();"""
# Of the cells that are surely occupied or free: the share whose pixel on the canvas is dark or light accordingly.
PICTURE_AGREES = """const page = swiftletPage, [good, all] = [[], []];
for (const name of Object.keys(page.layers)) page.layers[name] = name === 'map';
page.transform.scale_px = 60 / page.model.resolution_m / 10; page.isFitted = false;
const tile = [...page.tileMap.tiles.values()].reduce((a, b) =>
  a.cells.filter((p) => p >= 90).length > b.cells.filter((p) => p >= 90).length ? a : b);
const side = 64 * page.model.resolution_m;
page.transform.center = [(tile.x + 0.5) * side, (tile.y + 0.5) * side]; page.draw();
tile.cells.forEach((percent, i) => {
  if (percent < 90 && (percent < 0 || percent > 30)) return;
  const point = [(tile.x * 64 + i % 64 + 0.5), (tile.y * 64 + Math.floor(i / 64) + 0.5)].map((c) => c * page.model.resolution_m);
  const [x, y] = page.transform.toScreen(point).map((c) => Math.floor(c * devicePixelRatio));
  if (x < 0 || y < 0 || x >= page.canvas.width || y >= page.canvas.height - 40) return;
  const shade = page.context.getImageData(x, y, 1, 1).data[0];
  all.push(i); if (percent >= 90 ? shade < 100 : shade > 200) good.push(i);
}); return [good.length, all.length];"""
# Of the beams of the first poses, which no correction moves much: how many hit something, and how many of these where
# the map has a wall, in that cell or beside it.
BEAMS_AT_WALLS = """const page = swiftletPage, side = page.model.resolution_m, around = [-side, 0, side];
const hits = page.model.poses.slice(0, 200).flatMap((pose) => page.model.hitsOf(pose));
const atWall = ([x, y]) => around.some((dx) => around.some((dy) => page.tileMap.percentAt([x + dx, y + dy], side) >= 65));
return [hits.length, hits.filter(atWall).length];"""
# Of two runs of 1000 poses, both generation 1: paths that are drawn of both.
PATHS_OF_BOTH_RUNS = """const done = arguments[0];
(async () => {
  const [{RunModel}, {TrailPaths}] = await Promise.all([import('./run_model.js'), import('./trail_paths.js')]);
  const [model, strokes] = [new RunModel(), []];
  const trail = new TrailPaths(model, 'map');
  for (const map_id of ['1', '2']) {
    model.begin({generation: 1, map_id});
    model.addPoses(Array.from({length: 1000}, (_, i) => ({map: [i, 0, 0], odom: [i, 0, 0], segment: 0, storey: 0})), []);
    const paths = new Set();
    trail.stroke({stroke: (path) => paths.add(path)}, 0, 999);
    strokes.push(paths);
  }
  done([...strokes[0]].filter((path) => strokes[1].has(path)).length);
})();"""
# Of a vehicle that flies 2 m ahead, its estimator begins anew, and it flies 1 m ahead.
PLACED_ODOM = """const done = arguments[0];
(async () => {
  const {RunModel} = await import('./run_model.js'), model = new RunModel();
  const pose = (segment, map, odom) => ({segment, storey: 0, map, odom});
  model.addPoses([pose(0, [0, 0, 0], [5, 1, Math.PI / 2]), pose(0, [2, 0, 0], [5, 3, Math.PI / 2]),
                  pose(1, [2, 1, Math.PI / 2], [0, 0, 0]), pose(1, [2, 2, Math.PI / 2], [1, 0, 0])], []);
  done([model.poses.map((pose) => pose.raw.map((part) => Math.round(part * 1e6) / 1e6 + 0)),
        model.poses.map((pose) => pose.travel_m)]);
})();"""
# Of a vehicle that restarts after one pose, is in doubt for two, and then is not: the returns that wait at each pose, in
# frame local, and where that frame lies in the map.
WAITING = """const done = arguments[0];
(async () => {
  const [{RunModel}, {WaitingReturns}] = await Promise.all([import('./run_model.js'), import('./waiting_returns.js')]);
  globalThis.Path2D = class { points = []; moveTo(...point) { this.points.push(point); } lineTo() {} };
  const pose = (segment, tracking, map, local, ranges) =>
    ({segment, tracking, map, local, ranges, odom: [0, 0, 0], storey: 0, utime_us: 0});
  const [model, rounded] = [new RunModel(), (point) => point.map((part) => Math.round(part * 1e6) / 1e6 + 0)];
  model.addPoses([pose(0, 3, [0, 0, 0], [0, 0, 0], [1, 1]), pose(1, 3, [0, 0, 0], [0, 0, 0], [1, 2]),
                  pose(1, 1, [5, 5, Math.PI], [1, 0, Math.PI / 2], [1, 0]),
                  pose(1, 0, [5, 6, 0], [1, 1, 0], [1, 1])], [0, Math.PI]);
  const returns = new WaitingReturns(model);
  done([2, 1, 2, 3, -1].map((index) => {
    const waiting = returns.at(index);
    return waiting && [waiting.path.points.map(rounded), rounded(waiting.T_map_local)];
  }));
})();"""
# A drone in doubt far from the origin, without any map.
FAR_FROM_THE_MAP = """swiftletPage.model.addPoses(
  [{segment: 0, tracking: 3, map: [100, 50, 1], local: [0, 0, 0], odom: [0, 0, 0], ranges: [3, 2], storey: 0,
    utime_us: 1, covariance: [0, 0, 0, 0]}], [0, Math.PI]);
swiftletPage.redraw();"""
NO_STORAGE = """Object.defineProperty(window, 'localStorage', {get() { throw new DOMException('of the test', 'SecurityError'); }});"""
BOXES = """return ['#stage', '#notice', '#tools button'].flatMap((what) => [...document.querySelectorAll(what)])
  .map((element) => element.getBoundingClientRect().toJSON());"""
# Of the sheet with one layer or none, and of the plan with none: how many lines each has.
LINES_OF_LAYERS = """const done = arguments[0], page = swiftletPage;
(async () => {
  const {makeSheet} = await import('./sheet.js'), lines = {};
  const count = (layers, isPlan) => makeSheet(page.model, page.tileMap, layers, null, isPlan).lines.length;
  for (const name of ['none', 'walls', 'closures']) lines[name] = count({[name]: true}, false);
  done({...lines, plan: count({}, true)});
})();"""
programs = {}


class View:
    """`swiftlet view` as a process."""

    def __init__(self, *options, port=0):
        self.process = subprocess.Popen([programs["swiftlet"], "view", *options, "--listen", f"127.0.0.1:{port}"],
                                        stdout=subprocess.PIPE, text=True)
        self.url = re.search(r"http://\S+", self.process.stdout.readline())[0]
        self.port = int(self.url.rsplit(":", 1)[1])

    def end(self):
        self.process.terminate()
        self.process.wait(PATIENCE_S)
        self.process.stdout.close()


def fly(*options):
    return [programs["swiftletd"], FLIGHT, "--lcm-url", LCM_URL, *map(str, options)]


class ServerTest(unittest.TestCase):
    """The server without a browser."""

    def setUp(self):
        self.view = View("--lcm-url", LCM_URL)
        self.addCleanup(self.view.end)

    def status(self, path="/", method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.view.port, timeout=PATIENCE_S)
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        answer.read()
        connection.close()
        return answer.status

    def handshake(self, origin):
        key = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
               "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="}
        return self.status("/live", **key, Origin=origin)

    def test_answers_its_own_page_alone(self):
        self.assertEqual(self.status(), 200)
        self.assertEqual(self.status(method="HEAD"), 200)
        self.assertEqual(self.status("/../etc/passwd"), 404)
        self.assertEqual(self.status(Host="evil.example"), 403)
        self.assertEqual(self.status(Origin="http://evil.example"), 403)
        self.assertEqual(self.status(method="POST"), 405)
        self.assertEqual(self.handshake("http://evil.example"), 403)
        self.assertEqual(self.handshake(self.view.url), 101)

    def test_what_is_no_request_is_refused_and_the_next_one_answered(self):
        for nonsense in (b"\x16\x03\x01\r\n\r\n", b"GET / HTTP/1.1\r\nX: " + 20_000 * b"x" + b"\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", self.view.port), timeout=PATIENCE_S) as client:
                client.sendall(nonsense)
                self.assertTrue(client.recv(100).startswith(b"HTTP/1.1 400"))
        self.assertEqual(self.status(), 200)

    def test_a_log_that_has_ended_can_be_looked_at_and_costs_nothing(self):
        with tempfile.NamedTemporaryFile(suffix=".lcm") as log:
            log.write(struct.pack(">IqqII4sx", 0xEDA1DA01, 0, 0, 4, 1, b"NONE"))
            log.flush()
            view = View("--lcm-url", f"file://{log.name}")
            self.addCleanup(view.end)
            time.sleep(1)
            times = Path(f"/proc/{view.process.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]
            self.assertIsNone(view.process.poll())
            self.assertLess(sum(map(int, times)) / os.sysconf("SC_CLK_TCK"), 0.2)

    def test_bad_options_get_one_line_and_exit_code_2(self):
        for options in (["--listen", "nowhere:1"], ["--listen", "127.0.0.1:x"], ["--lcm-url", "nothing://"],
                        ["missing.pcap"], ["--rate", "5"], ["--listen", self.view.url[7:]]):
            done = subprocess.run([programs["swiftlet"], "view", *options], capture_output=True, text=True,
                                  timeout=PATIENCE_S, check=False)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), (options, done.stderr))


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1200,800"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(options=options, service=Service(DRIVER))

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def view(self, *options, port=0):
        view = View(*options, port=port)
        self.addCleanup(lambda: view.process.poll() is None and view.end())
        return view

    def js(self, expression):
        return self.browser.execute_script("return " + expression)

    def set_screen(self, width, height, ratio=1):
        """In CSS pixels, of a phone where the ratio is above 1."""
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": ratio, "mobile": ratio > 1})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})

    def wait_until(self, expression):
        end = time.monotonic() + PATIENCE_S
        while not self.js(expression):
            self.assertLess(time.monotonic(), end, f"not in time: {expression}; status {self.js('swiftletPage.model.status')}")
            time.sleep(0.05)

    def press(self, *keys):
        from selenium.webdriver.common.action_chains import ActionChains
        ActionChains(self.browser).send_keys(*keys).perform()

    def open_finished(self):
        """A whole recording, looked at from its end."""
        view = self.view(FLIGHT, "--rate", "100")
        self.browser.get(view.url)
        self.wait_until("swiftletPage.model.poses.length > 0")
        self.js("swiftletPage.player.goLive()")
        self.wait_until("swiftletPage.model.status?.state === 2 && swiftletPage.isSynced")
        return view

    def daemon_with_view(self, *options, port=0):
        """A flight whose page is open."""
        daemon = subprocess.Popen(fly(*options, "--view", f"127.0.0.1:{port}"), stderr=subprocess.PIPE, text=True)
        self.addCleanup(daemon.stderr.close)
        self.addCleanup(daemon.wait)
        self.addCleanup(daemon.kill)
        url = next(found[0] for line in daemon.stderr if (found := re.search(r"http://\S+", line)))
        if not port:
            self.browser.get(url)
        self.wait_until("swiftletPage.tileMap.tiles.size > 10")
        return daemon, int(url.rsplit(":", 1)[1])

    def look_back(self):
        """To ten seconds after the first pose, in the air. The tiles that were there already."""
        tiles = self.js("swiftletPage.tileMap.tiles.size")
        self.press(" ")
        self.js("swiftletPage.player.seek(swiftletPage.model.first_us + 10_000_000)")
        self.wait_until(f"swiftletPage.isSynced && swiftletPage.tileMap.tiles.size < {tiles}")
        return self.js("swiftletPage.tileMap.tiles.size")

    def saved(self, file_format):
        return bytes(self.browser.execute_async_script(SAVED_FILE, file_format))

    def check_ros_map(self, folder):
        """The page saves what the program writes; only the picture in YAML may have another name."""
        self.assertEqual(self.saved("PGM"), (folder / "map.pgm").read_bytes())
        image, rest = self.saved("YAML").decode().split("\n", 1)
        self.assertRegex(image, r"^image: \S+\.pgm$")
        self.assertEqual(rest, (folder / "map.yaml").read_text(encoding="utf-8").split("\n", 1)[1])

    def test_1_a_recording_ends_with_the_daemons_own_map(self):
        with tempfile.TemporaryDirectory() as parent:
            out = Path(parent, "out")
            subprocess.run(fly("--rate", 1000, "-o", out), check=True, capture_output=True)
            view = self.open_finished()
            self.check_ros_map(out)
        good, count = self.browser.execute_script(PICTURE_AGREES)
        self.assertGreater(count, 50)
        self.assertGreaterEqual(good, 0.98 * count)
        self.assertEqual([line for line in self.browser.get_log("browser") if line["level"] == "SEVERE"], [])
        view.process.terminate()
        self.assertEqual(view.process.stdout.read(), "", "the page tells what happens")

    def test_2_pan_zoom_and_keys(self):
        self.open_finished()
        self.press("f")
        time.sleep(0.2)
        before = self.js("[swiftletPage.transform.scale_px, ...swiftletPage.transform.center]")
        self.press("+")
        self.assertGreater(self.js("swiftletPage.transform.scale_px"), before[0])
        self.press("\ue014")  # arrow right
        self.assertGreater(self.js("swiftletPage.transform.center[0]"), before[1])
        self.press("l")
        self.assertEqual(self.js("document.getElementById('follow').getAttribute('aria-pressed')"), "true")
        self.press("4")
        self.assertTrue(self.js("swiftletPage.layers.raw"))
        self.press("m")
        for x, y in ((400, 300), (500, 300)):
            from selenium.webdriver.common.action_chains import ActionChains
            ActionChains(self.browser).move_by_offset(x, y).click().move_by_offset(-x, -y).perform()
        self.assertEqual(self.js("swiftletPage.measure.points.length"), 2)

    def test_3_pause_seek_and_step_go_back_to_the_map_of_then(self):
        self.open_finished()
        all_tiles = self.js("swiftletPage.tileMap.tiles.size")
        self.press(" ")
        self.js("swiftletPage.player.seek(swiftletPage.model.first_us + 5e6)")
        self.wait_until("swiftletPage.player.requested_us === swiftletPage.player.at_us && swiftletPage.isSynced && "
                        f"swiftletPage.tileMap.tiles.size < {all_tiles}")
        self.assertGreater(self.js("document.querySelectorAll('#log .later').length"), 0)
        self.assertGreater(self.js("document.querySelectorAll('#log li:not(.later)').length"), 0)
        index = self.js("swiftletPage.model.indexAt(swiftletPage.player.at_us)")
        self.press(".")
        self.assertEqual(self.js("swiftletPage.model.indexAt(swiftletPage.player.at_us)"), index + 1)
        self.press("\ue010")  # End
        self.wait_until(f"swiftletPage.tileMap.tiles.size === {all_tiles}")
        self.assertEqual(self.js("document.querySelectorAll('#log .later').length"), 0)

    def test_4_a_lost_connection_is_told_and_mended(self):
        view = self.open_finished()
        view.end()
        self.wait_until("document.getElementById('notice').textContent.startsWith('Connection lost')")
        self.view(FLIGHT, port=view.port)
        self.wait_until("document.getElementById('notice').textContent === ''")

    def test_5_a_narrow_screen_in_the_dark(self):
        self.set_screen(390, 844, ratio=2)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                     {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        self.open_finished()
        self.assertEqual(self.js("document.documentElement.scrollWidth"), 390)
        self.assertEqual(self.js("document.documentElement.dataset.theme"), "dark")
        self.assertLess(self.js("[...document.getElementById('map').getContext('2d').getImageData(5, 5, 1, 1).data][0]"), 60)
        self.press("t")
        self.assertEqual(self.js("document.documentElement.dataset.theme"), "light")
        self.js("localStorage.clear()")

    def test_6_a_late_page_sees_a_live_flight_and_its_successor(self):
        view = self.view("--lcm-url", LCM_URL)
        with tempfile.TemporaryDirectory() as parent:
            first, second = Path(parent, "first"), Path(parent, "second")
            subprocess.run(fly("--rate", 200, "-o", first), check=True, capture_output=True)
            self.browser.get(view.url)
            self.wait_until("swiftletPage.model.status?.state === 2 && swiftletPage.isSynced")
            self.check_ros_map(first)
            run = self.js("swiftletPage.model.run.map_id")
            subprocess.run(fly("--rate", 200, "-o", second), check=True, capture_output=True)
            self.wait_until(f"swiftletPage.model.run.map_id !== '{run}' && swiftletPage.model.status?.state === 2 && "
                            "swiftletPage.isSynced")
            self.check_ros_map(second)

    def test_7_beams_end_at_walls(self):
        self.open_finished()
        hits, at_walls = self.browser.execute_script(BEAMS_AT_WALLS)
        self.assertGreater(hits, 200)
        self.assertGreater(at_walls, 0.95 * hits)
        self.press("8")
        self.assertFalse(self.js("swiftletPage.layers.beams"))
        self.js("localStorage.clear()")

    def test_8_a_phone_sees_a_flight_that_the_daemon_shows_itself(self):
        self.set_screen(390, 844, ratio=2)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        flight = fly("--rate", 20, "--no-output", "--record", f"{folder.name}/flight.pcap", "--view", "127.0.0.1:0")
        with subprocess.Popen(flight, stderr=subprocess.PIPE, text=True) as daemon:
            self.addCleanup(daemon.kill)
            url = next(found[0] for line in daemon.stderr if (found := re.search(r"http://\S+", line)))
            self.browser.get(url)
            self.wait_until("document.querySelectorAll('#gauges > div').length >= 7")
            self.wait_until(r"/Recording\s*[0-9.]+ MB/.test(document.getElementById('gauges').textContent)")
            self.assertEqual(self.js("document.documentElement.scrollWidth"), 390)
            daemon.terminate()
            daemon.communicate(timeout=PATIENCE_S)
        self.wait_until("document.getElementById('notice').textContent.startsWith('swiftletd has ended')")

    def test_9_sheets_have_measures_and_a_plan_has_walls_alone(self):
        self.open_finished()
        walls = self.js("swiftletPage.model.walls.length")
        png, svg, plan, pdf = map(bytes, self.browser.execute_async_script(SAVED_FILES))
        self.assertTrue(png.startswith(b"\x89PNG"))
        self.assertTrue(pdf.startswith(b"%PDF-") and pdf.rstrip().endswith(b"%%EOF"))
        svg, plan = (ElementTree.fromstring(text) for text in (svg, plan))
        count = lambda sheet, name: len(sheet.findall("{http://www.w3.org/2000/svg}" + name))  # noqa: E731
        self.assertEqual((count(svg, "image"), count(plan, "image")), (1, 0))
        self.assertGreater(count(svg, "polyline"), count(plan, "polyline"))
        self.assertEqual(count(plan, "polyline"), walls + MEASURE_LINES)
        texts = [text.text for text in plan.iter("{http://www.w3.org/2000/svg}text")]
        self.assertEqual(len([text for text in texts if re.fullmatch(r"\d+\.\d\d m", text)]), 2)
        self.assertTrue(any(re.search(r"UTC, .* flown, 1:\d+ on A3", text) for text in texts), texts)

    def test_a_page_that_looked_back_sees_the_next_run_of_the_daemon(self):
        daemon, port = self.daemon_with_view("--rate", 20, "--no-output")
        self.look_back()
        run = self.js("swiftletPage.model.run.map_id")
        daemon.kill()
        daemon.wait(PATIENCE_S)
        self.daemon_with_view("--rate", 20, "--no-output", port=port)
        self.assertNotEqual(self.js("swiftletPage.model.run.map_id"), run)
        self.assertIsNone(self.js("swiftletPage.player.at_us"))

    def test_a_page_that_looks_back_gets_the_final_map_when_the_daemon_ends(self):
        with tempfile.TemporaryDirectory() as parent:
            out = Path(parent, "out")
            daemon, _ = self.daemon_with_view("--rate", 20, "-o", out)
            self.look_back()
            daemon.terminate()
            self.wait_until("document.getElementById('notice').textContent !== ''")
            self.assertEqual(self.js("document.getElementById('notice').textContent"),
                             "swiftletd has ended: the map is final")
            daemon.wait(PATIENCE_S)
            self.check_ros_map(out)

    def test_a_page_that_does_not_get_the_final_map_says_so(self):
        daemon, _ = self.daemon_with_view("--rate", 20, "--no-output")
        self.look_back()
        self.js("swiftletPage.connection.lookAt = () => {}")
        daemon.terminate()
        self.wait_until("document.getElementById('notice').textContent === 'swiftletd has ended: the map is not final'")

    def test_a_page_that_looks_back_at_a_finished_run_misses_nobody(self):
        view = self.view("--lcm-url", LCM_URL)
        subprocess.run(fly("--rate", 200, "--no-output"), check=True, capture_output=True)
        self.browser.get(view.url)
        self.wait_until("swiftletPage.model.status?.state === 2 && swiftletPage.isSynced")
        self.look_back()
        self.js("swiftletPage.lastMessage_ms -= 60_000")
        self.assertEqual(self.js("swiftletPage.connectionState()"), ["there", ""])

    def test_a_page_that_looks_back_does_so_after_a_lost_connection(self):
        self.open_finished()
        tiles = self.look_back()
        self.js("swiftletPage.connection.socket.close()")
        self.wait_until("!swiftletPage.isConnected")
        self.js("swiftletPage.tileMap.clear()")
        self.wait_until("swiftletPage.tileMap.tiles.size > 0 && swiftletPage.isSynced")
        self.assertEqual(self.js("swiftletPage.tileMap.tiles.size"), tiles)

    def test_a_new_run_has_no_trail_of_the_one_before(self):
        self.browser.get(self.view("--lcm-url", LCM_URL).url)
        self.assertEqual(self.browser.execute_async_script(PATHS_OF_BOTH_RUNS), 0)

    def test_dead_reckoning_is_drawn_from_where_the_map_has_its_segment(self):
        self.browser.get(self.view("--lcm-url", LCM_URL).url)
        placed, travel = self.browser.execute_async_script(PLACED_ODOM)
        self.assertEqual(placed, [[0, 0], [2, 0], [2, 1], [2, 2]])
        self.assertEqual(travel, [0, 2, 2, 3])

    def test_what_waits_for_its_place_is_drawn_from_where_the_drone_is_now(self):
        self.browser.get(self.view("--lcm-url", LCM_URL).url)
        both, first, again, good, none = self.browser.execute_async_script(WAITING)
        self.assertEqual(both, [[[1, 0], [-2, 0], [1, 1]], [5, 4, 1.570796]])
        self.assertEqual(first, [[[1, 0], [-2, 0]], [0, 0, 0]])
        self.assertEqual(again, both)
        self.assertIsNone(good)
        self.assertIsNone(none)

    def test_a_flight_in_doubt_shows_what_its_map_does_not(self):
        view = self.view("sim://loop?seed=1&fault=restart@30:60", "--rate", "100")
        self.browser.get(view.url)
        self.wait_until("swiftletPage.model.status?.state === 2 && swiftletPage.model.poses.some((pose) => pose.tracking > 0)")
        self.press(" ")
        waiting = "swiftletPage.scene.waiting.at(swiftletPage.model.indexAt(swiftletPage.player.at_us))"
        self.js("swiftletPage.player.seek(swiftletPage.model.poses.find((pose) => pose.tracking > 0).utime_us)")
        self.wait_until("!swiftletPage.isStale && swiftletPage.scene.waiting.path !== null")
        self.assertFalse(self.js(f"{waiting} === null"))

    def test_a_daemon_is_not_silent_that_seldom_tells_its_status(self):
        self.browser.get(self.view("--lcm-url", LCM_URL).url)
        self.js("swiftletPage.model.begin({generation: 1, map_id: '', title: '', is_recording: false, rate: 1})")
        for ago_s in (60, 30, 0):
            self.browser.execute_script(f"""swiftletPage.onMessage({{type: 'status'}});
              swiftletPage.lastMessage_ms -= {ago_s}e3, swiftletPage.lastStatus_ms -= {ago_s}e3;""")
        state = "swiftletPage.connectionState()[0]"
        for silent_s, expected in ((40, "there"), (70, "silent")):
            self.js(f"swiftletPage.lastMessage_ms = performance.now() - {silent_s}e3")
            self.assertEqual(self.js(state), expected)

    def test_a_view_that_nobody_moved_has_the_drone_and_what_waits_in_sight(self):
        self.browser.get(self.view("--lcm-url", LCM_URL).url)
        self.browser.execute_script(FAR_FROM_THE_MAP)
        self.wait_until("!swiftletPage.isStale")
        width, height = self.js("swiftletPage.transform.size")
        places = self.js("swiftletPage.scene.placesToSee(null).map((place) => swiftletPage.transform.toScreen(place))")
        self.assertEqual(len(places), 5)
        for x, y in places:
            self.assertTrue(0 < x < width and 0 < y < height, places)

    def test_a_screen_of_another_pixel_ratio_gets_a_canvas_of_its_own(self):
        self.set_screen(1200, 800)
        self.browser.get(self.view("--lcm-url", LCM_URL).url)
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": 1200, "height": 800, "deviceScaleFactor": 2, "mobile": False})
        self.wait_until("devicePixelRatio === 2")
        self.wait_until("swiftletPage.canvas.width === 2 * swiftletPage.canvas.clientWidth")

    def test_a_page_that_may_store_nothing_works(self):
        script = self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": NO_STORAGE})
        self.addCleanup(self.browser.execute_cdp_cmd, "Page.removeScriptToEvaluateOnNewDocument", script)
        self.open_finished()
        before = self.js("document.documentElement.dataset.theme")
        self.press("t")
        self.assertNotEqual(self.js("document.documentElement.dataset.theme"), before)
        self.press("4")
        self.wait_until("swiftletPage.layers.raw && !swiftletPage.isStale")

    def test_an_error_while_drawing_costs_one_frame(self):
        self.open_finished()
        self.js("swiftletPage.scene.draw = () => { delete swiftletPage.scene.draw; throw new Error('of the test'); }")
        self.js("swiftletPage.redraw()")
        self.wait_until("!Object.hasOwn(swiftletPage.scene, 'draw')")
        self.js("swiftletPage.redraw()")
        self.wait_until("!swiftletPage.isStale")

    def test_a_closure_newer_than_the_newest_pose_is_drawn(self):
        self.open_finished()
        self.js("swiftletPage.model.addClosures([{...swiftletPage.model.closures.values().next().value, index: 1e6, "
                "found_us: swiftletPage.model.newest_us + 10e6}])")
        self.js("swiftletPage.draw()")

    def test_keys_work_after_a_layer_is_ticked_with_the_mouse(self):
        self.open_finished()
        self.browser.find_element("id", "layer-raw").click()
        scale = self.js("swiftletPage.transform.scale_px")
        self.press("+")
        self.assertGreater(self.js("swiftletPage.transform.scale_px"), scale)
        self.press(" ")
        self.assertFalse(self.js("swiftletPage.layers.raw"), "space is the box's own")
        self.assertTrue(self.js("swiftletPage.player.isPlaying"))
        self.js("localStorage.clear()")

    def test_a_phone_held_sideways_shows_all_tools(self):
        for width, height in ((667, 331), (844, 340), (568, 270)):
            self.set_screen(width, height, ratio=2)
            self.browser.get(self.view("--lcm-url", LCM_URL).url)
            self.wait_until("document.getElementById('notice').textContent === 'Waiting for swiftletd'")
            panel = self.js("document.body.classList.contains('panel-closed') || document.getElementById('panel')"
                            ".getBoundingClientRect().bottom <= document.getElementById('timeline').getBoundingClientRect().top")
            self.assertTrue(panel, "the panel ends above the time line")
            stage, notice, *tools = self.browser.execute_script(BOXES)
            for box in (notice, *tools):
                self.assertTrue(stage["left"] <= box["left"] and box["right"] <= stage["right"], (stage, box))
                self.assertTrue(stage["top"] <= box["top"] and box["bottom"] <= stage["bottom"], (stage, box))
            self.assertLess(notice["right"], min(tool["left"] for tool in tools))

    def test_a_sheet_as_shown_has_the_layers_that_are_shown(self):
        self.open_finished()
        lines = self.browser.execute_async_script(LINES_OF_LAYERS)
        self.assertEqual(lines["none"], MEASURE_LINES)
        self.assertEqual(lines["walls"] - lines["none"], self.js("swiftletPage.model.walls.length"))
        self.assertEqual(lines["closures"] - lines["none"], self.js("swiftletPage.model.closuresAt(null).length"))
        self.assertEqual(lines["plan"], lines["walls"], "walls alone, whatever is shown")


def skip(why):
    print("skipped: " + why)
    return SKIPPED


def main():
    if INSIDE not in sys.argv:
        try:
            import selenium  # noqa: F401
        except ImportError:
            return skip("python3-selenium is not installed")
        if not Path(DRIVER).exists():
            return skip("chromium-driver is not installed")
        if subprocess.run([*NETWORK, "true"], capture_output=True, check=False).returncode != 0:
            return skip("network namespaces are not permitted here")
        return subprocess.run([*NETWORK, sys.executable, *sys.argv[:3], INSIDE, *sys.argv[3:]], check=False).returncode
    programs["swiftlet"], programs["swiftletd"] = map(os.path.abspath, sys.argv[1:3])
    with tempfile.TemporaryDirectory() as home:  # chromium writes there
        os.environ["HOME"] = home
        return not unittest.main(argv=[sys.argv[0], *sys.argv[4:]], exit=False, verbosity=2).result.wasSuccessful()


if __name__ == "__main__":
    sys.exit(main())
