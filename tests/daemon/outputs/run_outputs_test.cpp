// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/run_outputs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "daemon/outputs/ros_map.hpp"
#include "tests/daemon/outputs/finished_run.hpp"
#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) names.insert(entry.path().filename());
  return names;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::istringstream text(text_of(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(RunOutputs, WritesEveryFileAndNothingElse) {
  const TemporaryDirectory directory;
  const FinishedRun run;
  ASSERT_TRUE(write_run_outputs(directory.path() / "new", run.view(false)).ok());
  EXPECT_EQ(names_in(directory.path() / "new"),
            (std::set<std::string>{"live.tum", "map.pgm", "map.png", "map.yaml", "odometry.tum",
                                   "report.json", "thumbnail.png", "trajectory.tum"}));
}

TEST(RunOutputs, EachStoreyHasFilesOfItsOwn) {
  const TemporaryDirectory directory;
  FinishedRun run(81, 40);
  run.input.storey_levels_m = {0.0, 3.1};
  ASSERT_TRUE(write_run_outputs(directory.path(), run.view(false)).ok());
  EXPECT_EQ(names_in(directory.path()),
            (std::set<std::string>{"live.tum", "map.pgm", "map.png", "map.yaml", "map_storey1.pgm",
                                   "map_storey1.png", "map_storey1.yaml", "odometry.tum", "report.json",
                                   "thumbnail.png", "trajectory.tum"}));
  EXPECT_THAT(text_of(directory.path() / "map_storey1.yaml"), testing::HasSubstr("image: map_storey1.pgm"));
  EXPECT_NE(text_of(directory.path() / "map.pgm"), text_of(directory.path() / "map_storey1.pgm"));
  EXPECT_THAT(text_of(directory.path() / "report.json"), testing::HasSubstr("\"level_m\": 3.1"));
}

TEST(RunOutputs, WritesTheTruthWhereItIsKnown) {
  const TemporaryDirectory directory;
  const FinishedRun run;
  ASSERT_TRUE(write_run_outputs(directory.path(), run.view(true)).ok());
  EXPECT_EQ(lines_of(directory.path() / "ground_truth.tum").size(), 81U);
}

TEST(RunOutputs, MarkedPlacesStandWhereTheFinalMapHasThem) {
  const TemporaryDirectory directory;
  const FinishedRun run;
  RunView view = run.view(true);
  view.places = {{.stamp = run.truth[20].stamp, .name = "kitchen"},
                 {.stamp = run.truth[13].stamp, .name = "door"},
                 {.stamp = run.truth[13].stamp, .name = "threshold"}};
  const auto written = write_run_outputs(directory.path(), view);
  ASSERT_TRUE(written.ok());
  EXPECT_THAT(written->files, testing::Contains("places.csv"));
  const std::vector<std::string> lines = lines_of(directory.path() / "places.csv");
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "name,time_s,x_m,y_m,yaw_rad,storey");
  EXPECT_THAT(lines[1], testing::StartsWith("door,1600000001.423000,1.300000,"));
  EXPECT_THAT(lines[2], testing::StartsWith("threshold,1600000001.423000,1.300000,"));
  EXPECT_THAT(lines[3], testing::AllOf(testing::StartsWith("kitchen,"), testing::EndsWith(",0")));
}

TEST(RunOutputs, TrajectoriesHaveOneLineASample) {
  const TemporaryDirectory directory;
  const FinishedRun run;
  ASSERT_TRUE(write_run_outputs(directory.path(), run.view(false)).ok());
  const std::vector<std::string> corrected = lines_of(directory.path() / "trajectory.tum");
  ASSERT_EQ(corrected.size(), 81U);
  EXPECT_THAT(corrected[13], testing::StartsWith("1600000001.423000 1.300000 "));
  EXPECT_THAT(lines_of(directory.path() / "odometry.tum")[13],
              testing::StartsWith("1600000001.423000 1.300000 "));
}

TEST(RunOutputs, TrajectoriesAreInTheOrderOfTheirStamps) {
  const TemporaryDirectory directory;
  const FinishedRun run(81, 1000, 13);
  ASSERT_TRUE(write_run_outputs(directory.path(), run.view(false)).ok());
  const std::vector<std::string> corrected = lines_of(directory.path() / "trajectory.tum");
  ASSERT_EQ(corrected.size(), 81U);
  EXPECT_THAT(corrected[13], testing::StartsWith("1600000001.523000 1.400000 "));
  EXPECT_THAT(corrected[15], testing::StartsWith("1600000001.673000 1.300000 "));
}

TEST(RunOutputs, TheGridFileHoldsTheMapsTiles) {
  const TemporaryDirectory directory;
  const FinishedRun run;
  ASSERT_TRUE(write_run_outputs(directory.path(), run.view(false)).ok());
  const std::string text = text_of(directory.path() / "map.pgm");
  std::istringstream header(text);
  std::string magic;
  std::size_t width = 0;
  std::size_t height = 0;
  header >> magic >> width >> height;
  ASSERT_EQ(magic, "P5");
  ASSERT_GT(text.size(), width * height);
  const std::string pixels = text.substr(text.size() - width * height);
  long occupied = 0;
  for (const TileIndex index : run.map.tiles())
    for (const std::int8_t percent : run.map.tile(index).occupancy_percent)
      if (pgm_value(percent) == kPgmOccupied) ++occupied;
  EXPECT_GT(occupied, 100);
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), '\0'), occupied);
}

TEST(RunOutputs, AreTheSameBytesForTheSameRun) {
  const TemporaryDirectory directory;
  for (const char* name : {"a", "b"})
    ASSERT_TRUE(write_run_outputs(directory.path() / name, FinishedRun().view(true)).ok());
  for (const char* file :
       {"map.png", "map.pgm", "map.yaml", "trajectory.tum", "odometry.tum", "live.tum", "ground_truth.tum"})
    EXPECT_EQ(text_of(directory.path() / "a" / file), text_of(directory.path() / "b" / file)) << file;
}

TEST(RunOutputs, NamesTheFileThatCannotBeWrittenAndKeepsTheOthers) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "report.json") << "{}";
  fs::create_directory(directory.path() / "map.png");
  const Result<WrittenOutputs> written = write_run_outputs(directory.path(), FinishedRun().view(false));
  ASSERT_FALSE(written.ok());
  EXPECT_THAT(written.error().message, testing::HasSubstr("map.png"));
  EXPECT_FALSE(fs::exists(directory.path() / "report.json")) << "an earlier run's, beside this run's files";
  EXPECT_EQ(lines_of(directory.path() / "trajectory.tum").size(), 81U);
}

TEST(RunOutputs, WriteTheMapAlthoughATrajectoryCannotBe) {
  const TemporaryDirectory directory;
  fs::create_directory(directory.path() / "trajectory.tum");
  const Result<WrittenOutputs> written = write_run_outputs(directory.path(), FinishedRun().view(false));
  ASSERT_FALSE(written.ok());
  EXPECT_THAT(written.error().message, testing::HasSubstr("trajectory.tum"));
  EXPECT_THAT(names_in(directory.path()),
              testing::IsSupersetOf({"map.pgm", "map.yaml", "map.png", "thumbnail.png"}));
  EXPECT_FALSE(fs::exists(directory.path() / "report.json"));
}

TEST(RunOutputs, ReplaceAnEarlierRunsFilesAndLeaveNoneOfThem) {
  const TemporaryDirectory directory;
  const fs::path& path = directory.path();
  const Result<WrittenOutputs> first = write_run_outputs(path, FinishedRun().view(true));
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(replacement_note(path, *first), std::nullopt);
  std::ofstream(path / "notes.txt") << "mine";
  const Result<WrittenOutputs> second = write_run_outputs(path, FinishedRun().view(false));
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(replacement_note(path, *second),
            path.string() +
                " held an earlier run: its files were replaced, removed those that this run "
                "does not have: ground_truth.tum");
  EXPECT_FALSE(fs::exists(path / "ground_truth.tum"));
  EXPECT_EQ(text_of(path / "notes.txt"), "mine");
}

TEST(RunOutputs, RemoveNoFileThatNoRunWrote) {
  const TemporaryDirectory directory;
  const fs::path out = directory.path() / "out";
  ASSERT_TRUE(write_run_outputs(out, FinishedRun().view(false)).ok());
  std::ofstream(out / "ground_truth.tum") << "measured by somebody";
  std::ofstream(directory.path() / "outside") << "mine";
  ASSERT_TRUE(write_run_outputs(out, FinishedRun().view(false)).ok());
  EXPECT_EQ(text_of(out / "ground_truth.tum"), "measured by somebody");
  std::ofstream(out / "report.json") << R"({"files": ["../outside", "..", 7, "gone.tum"]})";
  const Result<WrittenOutputs> written = write_run_outputs(out, FinishedRun().view(false));
  ASSERT_TRUE(written.ok());
  EXPECT_THAT(written->removed, testing::IsEmpty());
  EXPECT_TRUE(fs::exists(directory.path() / "outside"));
}

TEST(RunError, PairsByStampAndLeavesOutWhatTheTruthDoesNotKnow) {
  const FinishedRun run;
  std::vector<StampedPose> some;
  for (std::size_t i = 0; i < run.truth.size(); i += 2) some.push_back(run.truth[i]);
  some.insert(some.begin(), {run.truth.front().stamp - Duration(5), Pose2(99.0, 99.0, 0.0)});
  RunView view = run.view(false);
  EXPECT_FALSE(run_error(view).has_value());
  view.truth = some;
  const auto error = run_error(view);
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->odometry.pairs, 41U);
}

}  // namespace
}  // namespace swiftlet
