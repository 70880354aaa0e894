// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/command_executor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/outputs/finished_run.hpp"
#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

const HostTime kNow{std::chrono::seconds(1'700'000'001)};

Command mark(std::string_view name) {
  Command command{.kind = Command::Kind::kMarkPlace, .name = {}};
  for (const char letter : name) static_cast<void>(command.name.try_push_back(letter));
  return command;
}

bool nobody() { return false; }

TEST(CommandExecutor, SavesTheMapAsItIs) {
  const TemporaryDirectory directory;
  const FinishedRun run;
  CommandExecutor executor({.directory = directory.path(), .is_live = true, .has_client = nobody, .end = {}});
  executor.execute({.kind = Command::Kind::kSaveMap, .name = {}}, run.map, kNow);
  EXPECT_THAT(text_of(directory.path() / "map.pgm"), testing::StartsWith("P5"));
  EXPECT_THAT(text_of(directory.path() / "map.yaml"), testing::HasSubstr("map.pgm"));
}

TEST(CommandExecutor, WithoutADirectoryNothingIsSavedOrMarked) {
  const FinishedRun run;
  CommandExecutor executor({.directory = {}, .is_live = true, .has_client = nobody, .end = {}});
  executor.execute({.kind = Command::Kind::kSaveMap, .name = {}}, run.map, kNow);
  executor.execute(mark("kitchen"), run.map, kNow);
  EXPECT_TRUE(executor.places().empty());
}

TEST(CommandExecutor, MarksTheNewestSample) {
  const FinishedRun run;
  CommandExecutor executor({.directory = "out", .is_live = true, .has_client = nobody, .end = {}});
  executor.execute(mark("too early"), run.map, std::nullopt);
  executor.execute(mark("kitchen"), run.map, kNow);
  ASSERT_EQ(executor.places().size(), 1U);
  EXPECT_EQ(executor.places()[0].name, "kitchen");
  EXPECT_EQ(executor.places()[0].stamp, kNow);
}

TEST(CommandExecutor, ANewMapBeginsOnlyWhereMoreIsToCome) {
  const FinishedRun run;
  int ended = 0;
  const Command new_map{.kind = Command::Kind::kNewMap, .name = {}};
  CommandExecutor recording(
      {.directory = {}, .is_live = false, .has_client = nobody, .end = [&ended] { ++ended; }});
  recording.execute(new_map, run.map, kNow);
  EXPECT_FALSE(recording.wants_new_map());
  EXPECT_EQ(ended, 0);
  bool has_client = true;
  CommandExecutor flight({.directory = {},
                          .is_live = true,
                          .has_client = [&has_client] { return has_client; },
                          .end = [&ended] { ++ended; }});
  flight.execute(new_map, run.map, kNow);
  EXPECT_FALSE(flight.wants_new_map()) << "the client would lose the vehicle in flight";
  EXPECT_EQ(ended, 0);
  has_client = false;
  flight.execute(new_map, run.map, kNow);
  EXPECT_TRUE(flight.wants_new_map());
  EXPECT_EQ(ended, 1);
}

}  // namespace
}  // namespace swiftlet
