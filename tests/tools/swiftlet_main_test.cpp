// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// The command line as its user meets it: exit codes, one line for what is wrong, files.

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

class SwiftletCommand : public testing::Test {
 protected:
  /// `arguments` as a shell takes them; {} stands for the test's directory.
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    return run_as(SWIFTLET_COMMAND, arguments);
  }
  [[nodiscard]] Outcome run_in(const std::string& directory, const std::string& arguments) const {
    return run_as("cd " + directory + " && " + SWIFTLET_COMMAND, arguments);
  }
  [[nodiscard]] Outcome run_as(const std::string& program, const std::string& arguments) const {
    const fs::path out = directory_.path() / "stdout";
    const fs::path err = directory_.path() / "stderr";
    std::string command =
        program + " " + arguments + " >" + out.string() + " 2>" + err.string() + " </dev/null";
    for (auto at = command.find("{}"); at != std::string::npos; at = command.find("{}"))
      command.replace(at, 2, directory_.path());
    const int status = std::system(command.c_str());  // NOLINT(*-env33-c,cert-*): a shell is what is tested
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return directory_.path() / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

 private:
  TemporaryDirectory directory_;
};

auto refuses_with(const std::string& what) {
  return AllOf(
      testing::Field(&Outcome::exit_code, 2), testing::Field(&Outcome::out, ""),
      testing::Field(
          &Outcome::err,
          AllOf(StartsWith("swiftlet: "), HasSubstr(what), EndsWith("\n"),
                testing::ResultOf(
                    [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }, 1))));
}

/// Half a minute of CARMEN log: a robot that drives along a wall, nothing to correct.
std::string small_log() {
  std::ostringstream text;
  for (int i = 0; i < 150; ++i) {
    text << "FLASER 180";
    for (int beam = 0; beam < 180; ++beam) text << (beam < 90 ? " 2.0" : " 3.0");
    const double x = 0.1 * i;
    text << " " << x << " 0 0 " << x << " 0 0 " << 100.0 + 0.2 * i << " host " << 0.2 * i << "\n";
  }
  return text.str();
}

TEST_F(SwiftletCommand, ConvertsSamplesToATableThatMapsTheSame) {
  write("log.clf", small_log());
  const Outcome converted = run("convert {}/log.clf {}/log.csv");
  EXPECT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_THAT(converted.out, StartsWith("150 samples: "));
  EXPECT_EQ(converted.err, "");
  ASSERT_EQ(run("map --no-calibrate {}/log.clf -o {}/a").exit_code, 0);
  ASSERT_EQ(run("map --no-calibrate {}/log.csv -o {}/b").exit_code, 0);
  EXPECT_EQ(text_of(file("a/trajectory.tum")), text_of(file("b/trajectory.tum")));
  EXPECT_EQ(text_of(file("a/map.pgm")), text_of(file("b/map.pgm")));
}

TEST_F(SwiftletCommand, ConvertsToAPoseGraphAndTellsWhatItReplaces) {
  write("log.clf", small_log());
  EXPECT_EQ(run("convert {}/log.clf {}/run.g2o").exit_code, 0);
  EXPECT_THAT(text_of(file("run.g2o")),
              AllOf(StartsWith("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 "), HasSubstr("\nFIX 0\nEDGE_SE2 0 1 ")));
  const Outcome again = run("convert {}/log.clf {}/run.g2o");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("run.g2o was there and has been replaced"));
}

TEST_F(SwiftletCommand, ConvertRefusesWhatItCannotReadOrWriteInOneLine) {
  write("log.clf", small_log());
  EXPECT_THAT(run("convert"), refuses_with("for example: swiftlet convert flight.pcap flight.csv"));
  EXPECT_THAT(run("convert {}/log.clf {}/out.bag"), refuses_with("must end with .csv"));
  EXPECT_THAT(run("convert {}/none.clf {}/out.csv"), refuses_with("none.clf"));
  EXPECT_THAT(run("convert {}/log.clf {}/none/out.csv"), refuses_with("there is no directory"));
  EXPECT_THAT(run("convert udp://127.0.0.1:1 {}/out.csv"), refuses_with("a live vehicle has no end"));
  write("table.csv", "1,2\n");
  EXPECT_THAT(run("convert {}/table.csv {}/table.csv"), refuses_with("this is the input"));
  EXPECT_THAT(run("convert replay:{}/table.csv {}/table.csv"), refuses_with("this is the input"));
  EXPECT_THAT(run("convert {}/table.csv {}/out.g2o"), refuses_with("is no table of samples"));
  EXPECT_FALSE(fs::exists(file("out.csv")));
  EXPECT_FALSE(fs::exists(file("out.g2o")));
}

TEST_F(SwiftletCommand, MapLooksAtTheOutputDirectoryBeforeTheInput) {
  write("taken", "a file");
  EXPECT_THAT(run("map {}/none.clf -o {}/taken"), refuses_with("taken"));
  EXPECT_THAT(run("map {}/none.clf -o {}/new/out"), refuses_with("none.clf"));
  EXPECT_FALSE(fs::exists(file("new")));
}

TEST_F(SwiftletCommand, MapThatIsStoppedSaysSoAndLeavesNoFolder) {
  for (const char* const how : {"", "--no-calibrate "})
    EXPECT_THAT(run_as(std::string("timeout --preserve-status --signal INT 2 ") + SWIFTLET_COMMAND,
                       std::string("map 'sim://patrol?laps=1000' -o {}/new/out ") + how),
                refuses_with("mapping stopped before its end; nothing was written"));
  EXPECT_FALSE(fs::exists(file("new")));
}

TEST_F(SwiftletCommand, ConvertThatIsStoppedSaysSoAndLeavesNoFile) {
  fs::create_directory(file("out"));
  for (const char* const name : {"run.csv", "run.g2o", "run.mcap"})
    EXPECT_THAT(run_as(std::string("timeout --preserve-status --signal INT 1 ") + SWIFTLET_COMMAND,
                       std::string("convert 'sim://patrol?laps=1000' {}/out/") + name),
                refuses_with("conversion stopped before its end; nothing was written"));
  EXPECT_TRUE(fs::is_empty(file("out")));
}

TEST_F(SwiftletCommand, ViewTellsOfADamagedInput) {
  write("log.clf", small_log() + "FLASER 180 garbled\n");
  const Outcome viewed = run_as(std::string("timeout --preserve-status --signal INT 5 ") + SWIFTLET_COMMAND,
                                "view {}/log.clf --listen 127.0.0.1:0");
  EXPECT_EQ(viewed.exit_code, 2);
  EXPECT_THAT(viewed.err, HasSubstr("log.clf:151: FLASER line cut off or garbled; the line is left out"));
}

TEST_F(SwiftletCommand, LatencyTellsAndDrawsHowARunKeptTime) {
  write("small.clf", small_log());
  ASSERT_EQ(run("map {}/small.clf -o {}/out").exit_code, 0);
  const Outcome told = run("latency {}/out/report.json --picture {}/latency.png");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, AllOf(HasSubstr("frontend "), HasSubstr("p99.9"), HasSubstr("picture: ")));
  EXPECT_GT(fs::file_size(file("latency.png")), 1000U);
  EXPECT_THAT(run("latency"), refuses_with("name a report.json, or --listen"));
  EXPECT_THAT(run("latency {}/small.clf"), refuses_with("not a report.json"));
  EXPECT_THAT(run("latency {}"), refuses_with("is a directory"));
  EXPECT_THAT(run("latency {}/out/report.json --picture {}/out/report.json"),
              refuses_with("this is the input"));
  EXPECT_THAT(run("latency --listen --picture {}/p.png"), refuses_with("a picture needs a report.json"));
  EXPECT_THAT(run("latency --listen --lcm-url mqtt://here"), refuses_with("mqtt://here"));
}

TEST_F(SwiftletCommand, HelpAndVersionAreNoErrors) {
  const Outcome help = run("map --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("INPUT"), HasSubstr("--frontend-only")));
  const Outcome version = run("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out,
              testing::ContainsRegex("^swiftlet [0-9.]+ \\(commit ([0-9a-f]+(-dirty)?|unknown)\\)\n"
                                     "built by .* Eigen 3\\..* CHOLMOD .* LCM .* libusb "));
}

TEST_F(SwiftletCommand, HelpNamesACommand) {
  EXPECT_EQ(run("help map").out, run("map --help").out);
  EXPECT_THAT(run("help map").out, HasSubstr("--frontend-only"));
  EXPECT_EQ(run("help").out, run("--help").out);
  EXPECT_THAT(run("help fly"), refuses_with("no command 'fly'; see swiftlet --help"));
}

TEST_F(SwiftletCommand, ShowsHowToWriteACommandThatLacksSomething) {
  EXPECT_THAT(run("map"), refuses_with("map: INPUT is required; for example: swiftlet map flight.pcap"));
  EXPECT_THAT(run("record sim://office"), refuses_with("record: --output is required; for example: "));
  EXPECT_THAT(run("eval"), refuses_with("eval: TRAJECTORY is required; for example: "));
  EXPECT_THAT(run("map in.clf --beams 1"), refuses_with("see swiftlet help map"));
}

TEST_F(SwiftletCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(run(""), refuses_with("no command given; see swiftlet --help"));
  EXPECT_THAT(run("fly"), refuses_with("no command 'fly'; see swiftlet --help"));
  EXPECT_THAT(run("map in.pcap -o {}/out --frobnicate"), refuses_with("--frobnicate"));
  write("run.clf", small_log());
  EXPECT_THAT(run("map {}/run.clf -o ''"), refuses_with("-o names no directory"));
  EXPECT_THAT(run("map in.clf -o {}/out --beams 1"), refuses_with("--beams"));
  EXPECT_THAT(run("map in.clf -o {}/out --odometry-only --frontend-only"), refuses_with("--frontend-only"));
}

TEST_F(SwiftletCommand, NamesTheInputThatCannotBeUsed) {
  EXPECT_THAT(run("map {}/missing.pcap -o {}/out"), refuses_with("missing.pcap"));
  write("text.pcap", "this is no capture");
  EXPECT_THAT(run("map {}/text.pcap -o {}/out"), refuses_with("text.pcap"));
  write("empty.clf", "");
  EXPECT_THAT(run("map {}/empty.clf -o {}/out"), refuses_with("empty.clf"));
  EXPECT_THAT(run("map 'sim://nowhere?seed=1' -o {}/out"), refuses_with("nowhere"));
  EXPECT_THAT(run("map {}/file.docx -o {}/out"), refuses_with("file.docx"));
}

TEST_F(SwiftletCommand, MapsNoLiveVehicleAndNamesWhatDoes) {
  const auto refusal = AllOf(refuses_with("map it with swiftletd udp://127.0.0.1:1,"),
                             refuses_with("swiftlet record udp://127.0.0.1:1 -o flight.pcap"));
  EXPECT_THAT(run_as("timeout 20 " SWIFTLET_COMMAND, "map udp://127.0.0.1:1 -o {}/out"), refusal);
  EXPECT_THAT(run("eval --live udp://127.0.0.1:1"), refusal);
  EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(SwiftletCommand, TakesNoNumberThatIsNone) {
  for (const std::string number : {"nan", "-nan", "inf", "-inf"}) {
    for (const std::string option : {"--battery", "--clock-start", "--loss", "--delay", "--duplicates"}) {
      std::string command = "sim --udp 127.0.0.1:0 ";
      std::string refusal = "sim: ";
      EXPECT_THAT(run_as("timeout 20 " SWIFTLET_COMMAND, command.append(option).append(" ").append(number)),
                  refuses_with(refusal.append(option).append(": ").append(number) + " is no number from "));
    }
    EXPECT_THAT(run("record sim://loop -o {}/a.pcap --seconds " + number), refuses_with("--seconds: "));
    EXPECT_THAT(run("eval --live sim://patrol --batch " + number), refuses_with("--batch: "));
  }
}

TEST_F(SwiftletCommand, TakesNoFileWithoutAName) {
  write("run.clf", small_log());
  for (const char* arguments :
       {"map {}/run.clf -o {}/out --config ''", "convert {}/run.clf {}/out.csv --config ''",
        "eval --live {}/run.clf --config ''", "view {}/run.clf --config ''"})
    EXPECT_THAT(run_as("timeout 20 " SWIFTLET_COMMAND, arguments), refuses_with(": --config: names no file"));
  EXPECT_THAT(run("latency {}/report.json --picture ''"), refuses_with("latency: --picture: names no file"));
  EXPECT_THAT(run("calibrate {}/log.clf -o ''"), refuses_with("calibrate: --output: names no file"));
  EXPECT_THAT(run("eval {}/path.tum --json ''"), refuses_with("eval: --json: names no file"));
  EXPECT_THAT(run_as("timeout 20 " SWIFTLET_COMMAND, "view ''"), refuses_with("view: INPUT: names no file"));
}

TEST_F(SwiftletCommand, TellsOnlyWhatIsAnAddressWithAPort) {
  for (const std::string to : {"foo", "''", "127.0.0.1", ":8450", "127.0.0.1:0", "127.0.0.1:84500", "a:b:1"})
    EXPECT_THAT(run("tell save-map --to " + to), refuses_with(": must be ADDRESS:PORT")) << to;
  for (const std::string to : {"127.0.0.1:1", "localhost:1"})
    EXPECT_THAT(run("tell save-map --to " + to), refuses_with("nobody takes commands on " + to));
}

TEST_F(SwiftletCommand, ViewAllowsOnlyOriginsThatABrowserMayName) {
  for (const std::string origin : {"foo", "''", "null", "app.foxglove.dev", "https://", "://host", "1://host",
                                   "https://app.foxglove.dev/", "https://host:0", "file:///home"})
    EXPECT_THAT(run_as("timeout 20 " SWIFTLET_COMMAND, "view --listen 127.0.0.1:0 --allow-origin " + origin),
                refuses_with(": must be SCHEME://HOST[:PORT]"))
        << origin;
  for (const std::string origin :
       {"https://app.foxglove.dev", "http://127.0.0.1:8080", "http://[::1]:8080", "file://"})
    EXPECT_THAT(run("view --listen nowhere --allow-origin " + origin),
                refuses_with("'nowhere' is no address"))
        << origin;
}

TEST_F(SwiftletCommand, SaysThatItsOutputCouldNotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  write("path.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  for (const char* arguments : {"eval {}/path.tum --truth {}/path.tum", "--help", "help eval", "--version"}) {
    const Outcome outcome = run_as("sh -c '" SWIFTLET_COMMAND " \"$@\" >/dev/full' sh", arguments);
    EXPECT_THAT(outcome, refuses_with("the output is not complete: No space left on device")) << arguments;
  }
}

TEST_F(SwiftletCommand, NamesWhatTheSimulationCannotUse) {
  EXPECT_THAT(run("sim --world nowhere"), refuses_with("office, maze, loop, corridors, wings, patrol"));
  EXPECT_THAT(run("sim --udp somewhere"), refuses_with("somewhere"));
  EXPECT_THAT(run("sim --udp 127.0.0.1:99999"), refuses_with("127.0.0.1:99999"));
  EXPECT_THAT(run("sim --udp 192.0.2.1:19850"), refuses_with("192.0.2.1:19850"));
  EXPECT_THAT(run("sim --missing-deck lighthouse"), refuses_with("lighthouse"));
  EXPECT_THAT(run("sim --loss 101"), refuses_with("--loss"));
}

TEST_F(SwiftletCommand, SimTakesTheSeedsThatAnAddressTakes) {
  for (const std::string seed : {"-1", "+1", "1.5", "0x10", "18446744073709551616", "''"})
    EXPECT_THAT(run_as("timeout 20 " SWIFTLET_COMMAND, "sim --udp 127.0.0.1:0 --seed " + seed),
                refuses_with("sim: --seed: the seed must be a whole number from 0 to 18446744073709551615"))
        << seed;
}

TEST_F(SwiftletCommand, SimTakesALastInstructionWithoutAnEndOfLine) {
  const Outcome outcome = run_as("sh -c 'printf quit | timeout 20 " SWIFTLET_COMMAND " \"$@\"' sh",
                                 "sim --udp 127.0.0.1:0 --seed 010");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(", seed 10; "), EndsWith("\nended\n")));
}

TEST_F(SwiftletCommand, SimWithoutStdinTakesNoPacketsForInstructions) {
  write("send-quit", R"(heard=$1
shift
"$@" sim --udp 127.0.0.1:0 <&- >"$heard" &
for _ in $(seq 100); do
  port=$(sed -n 's/^listening on .*:\([0-9]*\), world.*/\1/p' "$heard")
  [ -n "$port" ] && break
  sleep 0.1
done
echo quit >"/dev/udp/127.0.0.1/$port"
sleep 0.5
kill -KILL $!
wait $!
echo "exit code $?"
)");
  const Outcome outcome = run_as("bash {}/send-quit {}/heard " SWIFTLET_COMMAND, "");
  EXPECT_EQ(outcome.out, "exit code 137\n");  // it ran on until it was killed
}

TEST_F(SwiftletCommand, NamesTheConfigurationThatCannotBeUsed) {
  write("run.clf", small_log());
  EXPECT_THAT(run("map {}/run.clf -o {}/out --config {}/none.toml"), refuses_with("none.toml"));
  EXPECT_THAT(run("map {}/run.clf -o {}/out --config {}"),
              refuses_with(": is a directory; name the TOML file"));
  write("bad.toml", "[map]\nresolution_m = -1.0\n");
  EXPECT_THAT(run("map {}/run.clf -o {}/out --config {}/bad.toml"), refuses_with("bad.toml"));
  write("tuning.toml", "[tuning.backend_matcher]\nfloor_sigma_m = nan\n");
  EXPECT_THAT(run("map {}/run.clf -o {}/out --config {}/tuning.toml"),
              refuses_with("floor_sigma_m = nan: must lie"));
}

TEST_F(SwiftletCommand, NamesTheOutputDirectoryThatCannotBeWritten) {
  write("run.clf", small_log());
  write("file", "in the way");
  EXPECT_THAT(run("map {}/run.clf -o {}/file"), refuses_with("file"));
  EXPECT_EQ(text_of(file("file")), "in the way");
}

TEST_F(SwiftletCommand, KeepsWhatAnEarlierRunWroteWhenItRefuses) {
  write("run.clf", small_log());
  ASSERT_EQ(run("map {}/run.clf -o {}/out").exit_code, 0);
  const std::string before = text_of(file("out/trajectory.tum"));
  ASSERT_FALSE(before.empty());
  write("empty.clf", "");
  EXPECT_THAT(run("map {}/empty.clf -o {}/out"), refuses_with("empty.clf"));
  EXPECT_EQ(text_of(file("out/trajectory.tum")), before);
}

TEST_F(SwiftletCommand, MapsALaserLogAndSaysWhereTheFilesAre) {
  write("run.clf", small_log());
  const Outcome outcome = run("map {}/run.clf -o {}/out --beams 7");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("150 samples"), HasSubstr("map.png")));
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("[")));  // no progress bar where there is no terminal
  for (const char* name :
       {"map.png", "map.pgm", "map.yaml", "trajectory.tum", "odometry.tum", "live.tum", "report.json"})
    EXPECT_GT(fs::file_size(file("out") / name), 0U) << name;
  const std::string trajectory = text_of(file("out/trajectory.tum"));
  EXPECT_EQ(std::count(trajectory.begin(), trajectory.end(), '\n'), 150);
}

TEST_F(SwiftletCommand, WithoutADirectoryEachFlightGetsAFolderThatFlightsLists) {
  write("run.clf", small_log());
  for (int i = 0; i < 2; ++i) {
    const Outcome mapped = run_in("{}", "map run.clf");
    EXPECT_EQ(mapped.exit_code, 0) << mapped.err;
    EXPECT_THAT(mapped.out, testing::ContainsRegex("files: flights/[-0-9_]*_run"));
  }
  std::set<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(file("flights"))) folders.insert(entry.path());
  ASSERT_EQ(folders.size(), 2U);
  for (const fs::path& folder : folders) EXPECT_GT(fs::file_size(folder / "thumbnail.png"), 0U);
  write("flights/notes.txt", "no flight");
  fs::create_directories(file("flights/no flight/report.json"));
  const Outcome listed = run_in("{}", "flights");
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 3);  // a heading and two flights
  EXPECT_THAT(listed.out, testing::ContainsRegex("_run *14\\.9 *0:30 *0  flights/.*_run/thumbnail.png\n"));
  EXPECT_THAT(run("flights {}/none"), refuses_with("none"));
}

TEST_F(SwiftletCommand, ReplacesAnEarlierRunAndSaysSo) {
  write("run.clf", small_log());
  ASSERT_EQ(run("map 'sim://patrol?seed=1' -o {}/out").exit_code, 0);
  ASSERT_TRUE(fs::exists(file("out/ground_truth.tum")));
  const Outcome second = run("map {}/run.clf -o {}/out");
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_THAT(second.err, HasSubstr("out held an earlier run: its files were replaced, removed those that "
                                    "this run does not have: ground_truth.tum\n"));
  EXPECT_FALSE(fs::exists(file("out/ground_truth.tum")));
}

TEST_F(SwiftletCommand, RefusesADirectoryThatAnotherRunWritesTo) {
  write("run.clf", small_log());
  fs::create_directory(file("out"));
  const Outcome second = run_as("flock {}/out " SWIFTLET_COMMAND, "map {}/run.clf -o {}/out");
  EXPECT_THAT(second, refuses_with("out: another run writes there"));
}

TEST_F(SwiftletCommand, OdometryOnlyCorrectsNothing) {
  write("run.clf", small_log());
  ASSERT_EQ(run("map {}/run.clf -o {}/out --odometry-only").exit_code, 0);
  EXPECT_EQ(text_of(file("out/trajectory.tum")), text_of(file("out/odometry.tum")));
}

TEST_F(SwiftletCommand, OdometryStaysAsReportedWhereTheHeadingLeaps) {
  const std::string flight = "map 'sim://loop?seed=2&fault=jump@60:30' --no-calibrate -o {}/";
  const Outcome mapped = run(flight + "out");
  EXPECT_EQ(mapped.exit_code, 0);
  EXPECT_THAT(mapped.err, HasSubstr("heading"));
  ASSERT_EQ(run(flight + "reported --odometry-only").exit_code, 0);
  EXPECT_EQ(text_of(file("out/odometry.tum")), text_of(file("reported/odometry.tum")));
}

TEST_F(SwiftletCommand, GivesTheSameBytesTwice) {
  write("run.clf", small_log());
  for (const char* name : {"a", "b"})
    ASSERT_EQ(run("map {}/run.clf -o {}/" + std::string(name)).exit_code, 0);
  for (const char* name : {"map.png", "map.pgm", "trajectory.tum", "live.tum"})
    EXPECT_EQ(text_of(file("a") / name), text_of(file("b") / name)) << name;
}

TEST_F(SwiftletCommand, ARecordingOutlivesWhoeverReadsItsMessages) {
  const Outcome outcome = run_as("(sleep 0.2; " SWIFTLET_COMMAND
                                 " record 'sim://corridors?seed=3' -o {}/flight.pcap --seconds 20 2>&1 "
                                 ">{}/said; echo $? >{}/code) | true; cat",
                                 "{}/code");
  EXPECT_EQ(outcome.out, "0\n");
  EXPECT_GT(fs::file_size(file("flight.pcap")), 10'000U);
}

TEST_F(SwiftletCommand, RecordsAFlightThatMapsAsTheFlightItselfDoes) {
  const Outcome outcome = run("record 'sim://corridors?seed=3' -o {}/flight.pcap --seconds 60");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(" samples, "), HasSubstr(" kB: "), HasSubstr("flight.pcap")));
  EXPECT_THAT(outcome.err, AllOf(StartsWith("swiftlet: note: connected to the vehicle"),
                                 HasSubstr("\nswiftlet: warning: input: holes in the ranges: ")));
  const Outcome whole = run("record 'sim://corridors?seed=3' -o {}/whole.pcap");
  EXPECT_EQ(whole.exit_code, 0);
  EXPECT_GT(fs::file_size(file("whole.pcap")), fs::file_size(file("flight.pcap")));
  ASSERT_EQ(run("map {}/whole.pcap -o {}/replayed").exit_code, 0);
  ASSERT_EQ(run("map 'sim://corridors?seed=3' -o {}/live").exit_code, 0);
  for (const char* name : {"map.pgm", "trajectory.tum", "odometry.tum", "live.tum"})
    EXPECT_EQ(text_of(file("replayed") / name), text_of(file("live") / name)) << name;
}

TEST_F(SwiftletCommand, CalibratesFromASimulatedFlightAndMapsWithWhatItFound) {
  const Outcome outcome = run("calibrate 'sim://office?seed=4' -o {}/found.toml");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("age of the ranges, s"), HasSubstr("MATTERS"),
                                 HasSubstr("not observable: "), HasSubstr("found.toml")));
  EXPECT_EQ(outcome.err, "");
  const std::string found = text_of(file("found.toml"));
  const std::string setting = "\nrange_age_s = ";  // 0.173 s by the simulation, 0.1 s by default
  ASSERT_THAT(found, HasSubstr(setting));
  EXPECT_NEAR(std::stod(found.substr(found.find(setting) + setting.size())), 0.173, 0.02);
  EXPECT_EQ(run("map 'sim://office?seed=4' -o {}/out --config {}/found.toml").exit_code, 0);
  EXPECT_THAT(run("calibrate 'sim://office?seed=4' -o {}/found.toml"), refuses_with("is there already"));
  EXPECT_EQ(text_of(file("found.toml")), found);
}

TEST_F(SwiftletCommand, MapsWithTheAgeThatTheInputShows) {
  const Outcome outcome = run("map 'sim://office?seed=4' -o {}/out");
  EXPECT_EQ(outcome.exit_code, 0);
  const std::string note = "by the input itself: age of the ranges ";  // 0.173 s by the simulation
  ASSERT_THAT(outcome.err, HasSubstr(note));
  EXPECT_NEAR(std::stod(outcome.err.substr(outcome.err.find(note) + note.size())), 0.173, 0.02);
  EXPECT_THAT(text_of(file("out/report.json")), HasSubstr("\"expected\": 0.1,"));
  const Outcome plain = run("map 'sim://office?seed=4' -o {}/plain --no-calibrate");
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_THAT(plain.err, Not(HasSubstr(note)));
  EXPECT_THAT(text_of(file("plain/report.json")),
              AllOf(HasSubstr("\"calibration\": null"), HasSubstr("\"range_age_s\": 0.1,")));
  write("age.toml", "[sensor]\nrange_age_s = 0.15\n");
  EXPECT_EQ(run("map 'sim://office?seed=4' -o {}/set --config {}/age.toml").exit_code, 0);
  EXPECT_THAT(text_of(file("set/report.json")), HasSubstr("\"range_age_s\": 0.15,"));
}

TEST_F(SwiftletCommand, CalibratesNoAgeFromATableWhoseRangesHaveTheirPlace) {
  ASSERT_EQ(run("convert 'sim://office?seed=4' {}/flight.csv").exit_code, 0);
  const Outcome outcome = run("calibrate {}/flight.csv -o {}/found.toml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("not observable: ranges and dead reckoning of this input have one stamp"));
  EXPECT_THAT(text_of(file("found.toml")),
              AllOf(HasSubstr("# range_age_s: not observable: "), Not(HasSubstr("\nrange_age_s"))));
}

TEST_F(SwiftletCommand, CalibratesNothingFromARunWithoutTurns) {
  write("run.clf", small_log());
  const Outcome outcome = run("calibrate {}/run.clf --json");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("not_observable"), HasSubstr("\"check\": null")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\"value\"")));
}

TEST_F(SwiftletCommand, RefusesToCalibrateFromWhatItCannot) {
  EXPECT_THAT(run("calibrate {}/missing.pcap"), refuses_with("missing.pcap"));
  EXPECT_THAT(run("calibrate 'sim://nowhere'"), refuses_with("nowhere"));
  EXPECT_THAT(run("calibrate radio://0/80/2M"), refuses_with("record it first"));
  EXPECT_THAT(run("calibrate"), refuses_with("LOG"));
  write("empty.clf", "");
  EXPECT_THAT(run("calibrate {}/empty.clf -o {}/found.toml"), refuses_with("empty.clf"));
  EXPECT_FALSE(fs::exists(file("found.toml")));
}

TEST_F(SwiftletCommand, RefusesToRecordWhatItCannot) {
  write("there.pcap", "mine");
  EXPECT_THAT(run("record 'sim://office' -o {}/there.pcap"), refuses_with("there.pcap: is there already"));
  EXPECT_EQ(text_of(file("there.pcap")), "mine");
  EXPECT_THAT(run("record {}/there.pcap -o {}/copy.pcap"), refuses_with("there.pcap: is no vehicle"));
  EXPECT_THAT(run("record 'sim://nowhere' -o {}/none.pcap"), refuses_with("nowhere"));
  EXPECT_FALSE(fs::exists(file("none.pcap")));
  EXPECT_THAT(run("record 'sim://office' -o {}/none/a.pcap"), refuses_with("none/a.pcap: cannot be written"));
  EXPECT_THAT(run("record 'sim://office'"), refuses_with("--output"));
  EXPECT_THAT(run("record 'sim://office' -o {}/a.pcap --seconds 0"), refuses_with("--seconds"));
}

TEST_F(SwiftletCommand, SaysThatARecordingEndedEarlyAndKeepsWhatItHas) {
  write("run", "ulimit -f 200\nexec \"$@\"\n");  // in units of 512 or 1024 bytes
  const fs::path script = file("run");
  const std::string limited = "sh " + script.string() + " " + SWIFTLET_COMMAND;
  const Outcome outcome = run_as(limited, "record 'sim://office?seed=1' -o {}/flight.pcap");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("\nswiftlet: recording stopped: "),
                    EndsWith("flight.pcap holds what came before; make room or record elsewhere\n")));
  EXPECT_EQ(run("map {}/flight.pcap -o {}/out").exit_code, 0);
}

TEST_F(SwiftletCommand, EvaluatesATrajectoryForPeopleAndPrograms) {
  write("path.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  write("motions.txt", "1 2 1.5 0 0 0 0 0\n2 9 0 0 0 0 0 0\n");
  const Outcome people = run("eval {}/path.tum {}/motions.txt --json {}/figures.json");
  EXPECT_EQ(people.exit_code, 0) << people.err;
  EXPECT_THAT(people.out,
              AllOf(HasSubstr("1 of 2 relations"), HasSubstr("not in the trajectory: 9.000000\n")));
  EXPECT_EQ(people.err, "");
  const Outcome programs = run("eval --relations {}/motions.txt --truth {}/path.tum {}/path.tum --json -");
  EXPECT_EQ(programs.exit_code, 0) << programs.err;
  EXPECT_THAT(programs.out, AllOf(StartsWith("{"), EndsWith("}\n"), HasSubstr("\"rmse_m\": 0.0")));
  EXPECT_THAT(text_of(file("figures.json")), AllOf(StartsWith("{"), HasSubstr("\"missed\": 1")));
}

TEST_F(SwiftletCommand, EvaluatesPosesAsTheyWerePublished) {
  const Outcome programs = run("eval --live sim://patrol?seed=1 --json -");
  EXPECT_EQ(programs.exit_code, 0) << programs.err;
  EXPECT_THAT(programs.out, AllOf(StartsWith("{"), HasSubstr("\"live\": {\n    \"moments\": 0")));
  EXPECT_THAT(run("eval sim://patrol?seed=1 --batch 8"), refuses_with("--live"));
  EXPECT_THAT(run("eval sim://patrol?seed=1 --no-calibrate"), refuses_with("--live"));
  EXPECT_THAT(run("eval --live {}/none.pcap"), refuses_with("none.pcap: no such file"));
  EXPECT_THAT(run("eval --live sim://patrol --truth {}/a.tum --truth {}/b.tum"),
              refuses_with("takes one reference at most"));
}

TEST_F(SwiftletCommand, EvaluatesADamagedInputLiveUpToItsDamageAndSaysSo) {
  write("log.clf", small_log() + "FLASER 180 garbled\n");
  const Outcome people = run("eval --live {}/log.clf --json {}/figures.json");
  EXPECT_EQ(people.exit_code, 2);
  EXPECT_THAT(people.out, AllOf(HasSubstr("0 poses at known places"), HasSubstr("rms unknown, ")));
  EXPECT_THAT(people.err, AllOf(StartsWith("swiftlet: note: dead reckoning from the FLASER lines"),
                                HasSubstr("\nswiftlet: "), HasSubstr("log.clf:151: FLASER line cut off"),
                                EndsWith("the line is left out\n")));
  EXPECT_THAT(text_of(file("figures.json")), AllOf(HasSubstr("log.clf:151: "), HasSubstr("\"rms_m\": null")));
}

TEST_F(SwiftletCommand, RefusesATruthOfAnotherTimeInEitherWay) {
  write("log.clf", small_log());
  write("path.tum", "100 0 0 0 0 0 0 1\n101 1 0 0 0 0 0 1\n");
  write("other.tum", "5 0 0 0 0 0 0 1\n6 1 0 0 0 0 0 1\n");
  const auto refusal =
      AllOf(refuses_with("other.tum: has no po"), refuses_with("from 5.000000 to 6.000000 s"),
            refuses_with("the trajectory's from 100.000000 to "));
  EXPECT_THAT(run("eval {}/path.tum --truth {}/other.tum"), refusal);
  EXPECT_THAT(run("eval --live {}/log.clf --truth {}/other.tum"), refusal);
}

TEST_F(SwiftletCommand, WritesNoFiguresOverWhatTheyAreMadeOf) {
  write("path.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  write("motions.txt", "1 2 1.5 0 0 0 0 0\n");
  write("log.clf", small_log());
  write("settings.toml", "");
  const auto refusal = refuses_with("this is the input; name another output");
  EXPECT_THAT(run("eval {}/path.tum {}/motions.txt --json {}/motions.txt"), refusal);
  EXPECT_THAT(run("eval {}/path.tum {}/motions.txt --json {}/path.tum"), refusal);
  EXPECT_THAT(run("eval {}/path.tum --truth {}/path.tum --json {}/path.tum"), refusal);
  EXPECT_THAT(run("eval {}/path.tum --relations {}/motions.txt --json {}/./motions.txt"), refusal);
  EXPECT_THAT(run("eval --live {}/log.clf --json {}/log.clf"), refusal);
  EXPECT_THAT(run("eval --live replay:{}/log.clf --json {}/log.clf"), refusal);
  EXPECT_THAT(run("eval --live {}/log.clf --truth {}/path.tum --json {}/path.tum"), refusal);
  EXPECT_THAT(run("eval --live {}/log.clf --config {}/settings.toml --json {}/settings.toml"), refusal);
  EXPECT_THAT(run("calibrate {}/log.clf -o {}/log.clf"), refusal);
  EXPECT_THAT(run("calibrate replay:{}/log.clf -o {}/log.clf"), refusal);
  EXPECT_EQ(text_of(file("log.clf")), small_log());
  EXPECT_EQ(text_of(file("motions.txt")), "1 2 1.5 0 0 0 0 0\n");
}

TEST_F(SwiftletCommand, LooksAtTheOutputFileBeforeItEvaluatesOrCalibrates) {
  EXPECT_THAT(run("eval --live {}/none.clf --json {}"), refuses_with("this is a directory"));
  EXPECT_THAT(run("eval --live {}/none.clf --json {}/none/a.json"), refuses_with("there is no directory"));
  EXPECT_THAT(run("calibrate {}/none.clf -o {}"), refuses_with("this is a directory"));
  EXPECT_THAT(run("calibrate {}/none.clf -o {}/none/a.toml"), refuses_with("there is no directory"));
}

TEST_F(SwiftletCommand, PrintsTheTableThoughItsFileCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  write("path.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  const Outcome outcome = run("eval {}/path.tum --truth {}/path.tum --json /dev/full");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("2 of 2 positions"));
  EXPECT_THAT(outcome.err, HasSubstr("/dev/full was not written: No space left on device"));
}

TEST_F(SwiftletCommand, NamesWhatItCannotEvaluate) {
  write("path.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  write("motions.txt", "1 2 1.5 0 0 0 0 0\n");
  write("cut.relations", "1 2 1.5 0 0 0 0 0\n1 2 1.5\n");
  write("other.relations", "11 12 1.5 0 0 0 0 0\n");
  EXPECT_THAT(run("eval"), refuses_with("TRAJECTORY"));
  EXPECT_THAT(run("eval {}/path.tum"), refuses_with("no reference given"));
  EXPECT_THAT(run("eval {}/none.tum {}/motions.txt"), refuses_with("none.tum: no such file"));
  EXPECT_THAT(run("eval {}/path.tum {}/none.pcap"), refuses_with("none.pcap: no such file"));
  EXPECT_THAT(run("eval {}/path.tum {}/cut.relations"), refuses_with("cut.relations:2: has 3 columns"));
  EXPECT_THAT(run("eval {}/path.tum {}/other.relations"), refuses_with("other.relations: "));
  EXPECT_THAT(run("eval {}/motions.txt {}/path.tum"), refuses_with("motions.txt:1: "));
  EXPECT_THAT(run("eval {}/path.tum {}/motions.txt --json {}/none/figures.json"),
              refuses_with("none/figures.json"));
}

fs::path dataset(const std::string& name) {
  const char* folder = std::getenv("SWIFTLET_DATASETS");  // NOLINT(concurrency-*)
  return fs::path(folder != nullptr ? folder : SWIFTLET_DATASETS_BESIDE) / name;
}

TEST_F(SwiftletCommand, UsesACaptureUpToTheDamageAndReportsIt) {
  const fs::path flight = dataset("flights/olsson.pcap");
  if (!fs::exists(flight)) GTEST_SKIP() << flight << " is missing";
  const std::string whole = text_of(flight);
  std::ofstream(file("cut.pcap"), std::ios::binary) << whole.substr(0, whole.size() / 8 + 7);
  const Outcome outcome = run("map {}/cut.pcap -o {}/out --no-calibrate");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("swiftlet: "), HasSubstr("byte")));
  // Before it there may be a note on what so short a map follows.
  EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2);
  EXPECT_THAT(text_of(file("out/report.json")), HasSubstr("byte"));
  EXPECT_GT(fs::file_size(file("out/trajectory.tum")), 1000U);
}

TEST_F(SwiftletCommand, EvaluatesOnACaptureUpToItsDamageAndSaysSo) {
  const fs::path flight = dataset("flights/olsson.pcap");
  if (!fs::exists(flight)) GTEST_SKIP() << flight << " is missing";
  const std::string whole = text_of(flight);
  std::ofstream(file("cut.pcap"), std::ios::binary) << whole.substr(0, whole.size() / 8 + 7);
  write("path.tum", "1627252325 0 0 0 0 0 0 1\n1627252345 0 0 0 0 0 0 1\n");
  const Outcome outcome = run("eval {}/path.tum {}/cut.pcap");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, HasSubstr(" cells of 0.2 m"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("byte"), EndsWith("what precedes it is used\n")));
}

TEST_F(SwiftletCommand, RefusesACaptureThatIsCutBeforeItsFirstSample) {
  const fs::path flight = dataset("flights/olsson.pcap");
  if (!fs::exists(flight)) GTEST_SKIP() << flight << " is missing";
  std::ofstream(file("cut.pcap"), std::ios::binary) << text_of(flight).substr(0, 300);
  EXPECT_THAT(run("map {}/cut.pcap -o {}/out"), refuses_with("cut.pcap"));
}

TEST_F(SwiftletCommand, DoctorRefusesWhatIsNoInputOrNoLcmUrl) {
  EXPECT_THAT(run("doctor foo://bar"), refuses_with("unknown scheme 'foo'"));
  EXPECT_THAT(run("doctor radio//0/80"), refuses_with("radio//0/80: no such file"));
  EXPECT_THAT(run("doctor udp://127.0.0.1:19850 --lcm-url udpm://1.2.3.4"),
              refuses_with("no multicast address"));
}

TEST_F(SwiftletCommand, DoctorTellsThatNobodyAnswersAndExitsWithOne) {
  const Outcome people = run("doctor udp://127.0.0.1:1");
  EXPECT_EQ(people.exit_code, 1);
  EXPECT_THAT(people.out, AllOf(HasSubstr("skipped  cable "), HasSubstr("problem  vehicle "),
                                HasSubstr("nobody answers at 127.0.0.1:1 -> "), HasSubstr("not ready")));
}

TEST_F(SwiftletCommand, DoctorTellsProgramsInJson) {
  const Outcome programs = run("doctor sim://office --lcm-url memq:// --json");
  EXPECT_EQ(programs.exit_code, 0);
  EXPECT_THAT(programs.out, AllOf(StartsWith("{"), HasSubstr("\"ready\": true"), HasSubstr("\"lcm route\"")));
}

}  // namespace
}  // namespace swiftlet
